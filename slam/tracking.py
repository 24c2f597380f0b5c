"""Results of SLAM for each frame."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from roomgraph.slam.features.extraction import Features
from roomgraph.slam.features.view import View


class TrackingState(StrEnum):
    """Tracking state of a frame."""

    OK = "ok"
    LOST = "lost"
    RELOCALISED = "relocalised"
    SKIPPED = "skipped"

    @property
    def has_pose(self) -> bool:
        """Whether a frame in this state has a pose."""
        return self in (TrackingState.OK, TrackingState.RELOCALISED)


@dataclass(frozen=True, slots=True)
class Anchor:
    """A pose held by a keyframe, so that it moves along when loops move the keyframe.

    Attributes
    ----------
    keyframe : int
        The keyframe's id.
    T_keyframe_camera : (4, 4) float64
        Maps camera points to the keyframe's camera.
    """

    keyframe: int
    T_keyframe_camera: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LoopClosure:
    """Two keyframes found to see the same thing, far apart in time."""

    keyframe: int
    matched_keyframe: int
    inliers: int


@dataclass(frozen=True, slots=True)
class Tracking:
    """The result of SLAM for one frame.

    Attributes
    ----------
    index, stamp_s : int, float
        The frame's.
    state : TrackingState
        How it fared. A `lost` frame that begins a sub-map has a pose in that.
    inliers : int
        Feature matches that agree with the pose; 0 if it does not come from features.
    method : str
        What the pose comes from: ``flow``, ``features``, ``depth`` alone, or ``none``.
    anchor : Anchor or None
        The pose, relative to a keyframe; None where there is none.
    T_world_camera : (4, 4) float64 or None
        The pose as estimated now; a later loop closure may move it (use `anchor` to follow).
    is_keyframe : bool
        Whether the frame became keyframe ``anchor.keyframe``.
    closures : tuple of LoopClosure
        Loops that this frame closed.
    pixels : (N, 2) float64
        Where the image shows the corners or features that agree with the pose.
    view : View or None
        The frame itself, of keyframes and of frames that flow did not track.
    """

    index: int
    stamp_s: float
    state: TrackingState
    inliers: int
    method: str
    anchor: Anchor | None
    T_world_camera: NDArray[np.float64] | None
    is_keyframe: bool
    closures: tuple[LoopClosure, ...] = ()
    pixels: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 2)))
    view: View | None = None

    @property
    def features(self) -> Features:
        """The features, shared with the semantic layer; none of frames tracked without.

        Waits for those of a keyframe that is still being made.
        """
        return Features.none() if self.view is None else self.view.features

    def without_view(self) -> Tracking:
        """Return the result without the frame, small enough to keep for every frame."""
        return replace(self, view=None, pixels=np.empty((0, 2)))
