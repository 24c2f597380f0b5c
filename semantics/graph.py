"""The semantic topological graph as plain data."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from semantics.labels import LabelSpace


class EdgeKind(StrEnum):
    """Why two nodes are joined."""

    PATH = "path"
    REVISIT = "revisit"


@dataclass(frozen=True, slots=True)
class GraphNode:
    """A spot that the camera passed.

    Attributes
    ----------
    id : int
        From 0, in the order of passing.
    frame : int
        Index of the frame it was dropped at.
    stamp_s : float
        That frame's time stamp, seconds.
    position_world : (3,) float64
        Camera centre in the world, metres.
    label, label_id : str, int
        Kind of place (``office``).
    place : str
        The very place (``office2``).
    score : float
        Of the label, 0 to 1.
    histogram : (Q,) float64
        Visual memory: the frame's appearance, of unit length; empty without a model.
    """

    id: int
    frame: int
    stamp_s: float
    position_world: NDArray[np.float64]
    label: str
    label_id: int
    place: str
    score: float
    histogram: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class GraphEdge:
    """Two nodes joined, with the Euclidean distance between them in metres."""

    source: int
    target: int
    length_m: float
    kind: EdgeKind


@dataclass(frozen=True, slots=True)
class SemanticGraph:
    """Nodes along the path with their places, at the positions known when it was drawn."""

    labels: LabelSpace
    nodes: tuple[GraphNode, ...]
    edges: tuple[GraphEdge, ...]

    @property
    def places(self) -> tuple[str, ...]:
        """Names of the places, in the order of first passing."""
        return tuple(dict.fromkeys(node.place for node in self.nodes))

    @property
    def positions(self) -> NDArray[np.float64]:
        """Positions of the nodes (N, 3), metres."""
        return np.array([node.position_world for node in self.nodes]).reshape(-1, 3)
