"""The semantic topological graph as plain data."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.labels import LabelSpace

# What a place is called that nothing labels.
UNLABELLED = "room"


class EdgeKind(StrEnum):
    """Why two nodes are joined."""

    PATH = "path"
    REVISIT = "revisit"


@dataclass(frozen=True, slots=True)
class GraphNode:
    """A position on the path of the camera.

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
    signature : (S,) float64
        Visual memory: what views are compared by, of unit length; empty without a model.
    evidence : Evidence
        What spoke for the label that the node was dropped with. The place that it turned out to
        lie in may have given it another.
    """

    id: int
    frame: int
    stamp_s: float
    position_world: NDArray[np.float64]
    label: str
    label_id: int
    place: str
    score: float
    signature: NDArray[np.float64]
    evidence: Evidence = field(default_factory=Evidence)


@dataclass(frozen=True, slots=True)
class GraphEdge:
    """Two nodes joined, with the Euclidean distance between them in metres."""

    source: int
    target: int
    length_m: float
    kind: EdgeKind


@dataclass(frozen=True, slots=True)
class RoomPolygon:
    """Where a place lies on the floor, in the map frame (z up, floor at 0).

    Attributes
    ----------
    name : str
        The place's (``office2``), as at the nodes.
    label, label_id : str, int
        Kind of place.
    score : float
        Mean score, over all frames taken in it, of its label; 0 to 1.
    polygon_map : (N, 2) float64
        Outline of its floor, counter-clockwise, metres.
    area_m2 : float
        Of its floor, furniture included.
    centre_map : (2,) float64
        A spot in its middle that is far from its walls, metres.
    """

    name: str
    label: str
    label_id: int
    score: float
    polygon_map: NDArray[np.float64]
    area_m2: float
    centre_map: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Doorway:
    """A passage between two places: an edge of the graph of places.

    Attributes
    ----------
    places : (str, str)
        Names of the places, the one passed first in front.
    position_map : (2,) float64
        Its middle in the map frame, metres.
    width_m : float or None
        Clear width; None where the camera passed without looking.
    """

    places: tuple[str, str]
    position_map: NDArray[np.float64]
    width_m: float | None


@dataclass(frozen=True, slots=True)
class SemanticGraph:
    """Nodes along the path with their places, at the positions known when it was drawn.

    At the end of a run the places have rooms, and doorways join them.

    Attributes
    ----------
    labels : LabelSpace
        Ids and names of the labels.
    nodes, edges : tuple
        Spots along the path and what joins them.
    rooms : tuple of RoomPolygon
        Where the places lie, in the order of first passing.
    doorways : tuple of Doorway
        What joins the places.
    T_map_world : (4, 4) float64 or None
        Maps world points to the map frame; None while there are no rooms.
    """

    labels: LabelSpace
    nodes: tuple[GraphNode, ...]
    edges: tuple[GraphEdge, ...]
    rooms: tuple[RoomPolygon, ...] = ()
    doorways: tuple[Doorway, ...] = ()
    T_map_world: NDArray[np.float64] | None = None

    @property
    def places(self) -> tuple[str, ...]:
        """Names of the places, in the order of first passing."""
        return tuple(dict.fromkeys(node.place for node in self.nodes))

    @property
    def positions(self) -> NDArray[np.float64]:
        """Positions of the nodes (N, 3), metres."""
        return np.array([node.position_world for node in self.nodes]).reshape(-1, 3)
