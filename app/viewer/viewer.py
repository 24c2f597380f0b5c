"""The interface of viewers, and a viewer that shows nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import LabelSpace
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.tracking import Tracking, TrackingState

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SessionView:
    """What is known before the first frame.

    Attributes
    ----------
    name : str
        The sequence's.
    frames : int
        How many there are.
    intrinsics : Intrinsics
        The camera.
    labels : LabelSpace
        Ids, names and colours of the labels.
    truth : (N, 3) float64 or None
        True camera centres, in the frame of the first true pose, metres.
    """

    name: str
    frames: int
    intrinsics: Intrinsics
    labels: LabelSpace
    truth: FloatArray | None


@dataclass(frozen=True, slots=True)
class MapView:
    """The map with its labels, as it is now.

    Attributes
    ----------
    points : PointMap
        N points, metres, with colours.
    label_ids : (N,) uint16
        Of the points.
    keyframes : tuple of int
        Ids of the K keyframes that have a place in the world.
    T_world_keyframe : (K, 4, 4) float64
        Their poses.
    constraints : (L, 2, 3) float64
        Ends of the pose graph's constraints.
    loops : (M, 2, 3) float64
        Ends of the constraints that close loops.
    trajectory : (F, 3) float64
        Camera centres of all labelled frames with a place in the world, as estimated now.
    frames : tuple of int
        Which frames these are.
    states : tuple of TrackingState
        How they fared.
    """

    points: PointMap
    label_ids: NDArray[np.uint16]
    keyframes: tuple[int, ...]
    T_world_keyframe: FloatArray
    constraints: FloatArray
    loops: FloatArray
    trajectory: FloatArray
    frames: tuple[int, ...]
    states: tuple[TrackingState, ...]


class Viewer(Protocol):
    """Shows or records a run in progress. It gets data, never the SLAM object."""

    def start(self, session: SessionView) -> None:
        """Start with what is known before the first frame."""
        ...

    def show_frame(self, frame: Frame, tracking: Tracking) -> None:
        """Show a frame with its features and, where it has one in the world, its pose."""
        ...

    def show_label(self, frame: int, label_id: int, label: str, score: float) -> None:
        """Show a frame's label, which is known a few frames after the frame."""
        ...

    def show_map(self, frame: int, draw: Callable[[], MapView]) -> None:
        """Show the map at a frame; it replaces the previous one.

        `draw` makes it, so that a viewer without need of it costs next to nothing. It may be called
        later and in another thread, but one at a time and in the order in which they came.
        """
        ...

    def show_graph(self, frame: int, graph: SemanticGraph) -> None:
        """Show the topological graph at a frame."""
        ...

    def log(self, frame: int, text: str) -> None:
        """Show an event: a loop closed, a place entered, tracking lost."""
        ...

    def close(self) -> None:
        """Finish and flush."""
        ...


class NoViewer:
    """Shows nothing."""

    def start(self, session: SessionView) -> None:
        """Do nothing."""

    def show_frame(self, frame: Frame, tracking: Tracking) -> None:
        """Do nothing."""

    def show_label(self, frame: int, label_id: int, label: str, score: float) -> None:
        """Do nothing."""

    def show_map(self, frame: int, draw: Callable[[], MapView]) -> None:
        """Do nothing."""

    def show_graph(self, frame: int, graph: SemanticGraph) -> None:
        """Do nothing."""

    def log(self, frame: int, text: str) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""
