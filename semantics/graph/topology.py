"""The semantic topological map: a node per metre travelled, with place names."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.graph import EdgeKind, GraphEdge, GraphNode, SemanticGraph
from roomgraph.semantics.graph.instances import InstanceSettings, Observation, PlaceNames
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.temporal.labeller import FrameLabel
from roomgraph.slam.tracking import Anchor

Poses = Mapping[int, NDArray[np.float64]]

# Steps below this are jitter of the pose estimate, not travel.
_MIN_STEP_M = 0.05
_ROUNDING_M = 1e-9


class TopologySettings(Settings):
    """When nodes are added and joined."""

    node_distance_m: float = Field(
        default=1.0, gt=0, description="distance travelled between nodes (paper: d = 1), metres"
    )
    revisit_radius_m: float = Field(
        default=0.6,
        ge=0,
        description="maximum distance between a node and an older one to join them, metres",
    )
    revisit_gap: int = Field(
        default=5, ge=2, description="minimum number of nodes between the two along the path"
    )
    instances: InstanceSettings = InstanceSettings()


@dataclass(frozen=True, slots=True)
class _Node:
    frame: int
    stamp_s: float
    anchor: Anchor
    label: str
    label_id: int
    stay: int | None
    score: float
    signature: NDArray[np.float64]
    evidence: Evidence


class TopologicalMap:
    """Grows a graph along the path (paper, section 3.3).

    A node is dropped at the first frame with a pose and after each further metre travelled. It
    keeps the frame's label, its signature as visual memory, and the anchor of its pose:
    positions are worked out from the keyframes' poses when they are asked for, so that nodes move
    with the map when a loop closes.

    Which place of its kind a node belongs to is decided by `PlaceNames`. So a mislabelled node
    opens a ghost place only under the paper's rule: if it is far from all nodes of that label and
    looks like none of them. Nodes labelled `unknown` share the place `unknown`.

    Parameters
    ----------
    settings : TopologySettings
        When nodes are dropped and joined, and when places are different.
    labels : LabelSpace
        Ids and names of the labels.
    """

    def __init__(self, settings: TopologySettings, labels: LabelSpace) -> None:
        self.settings = settings
        self.labels = labels
        self._nodes: list[_Node] = []
        self._waypoint: Anchor | None = None
        self._travelled_m = 0.0
        self._names = PlaceNames(settings.instances)

    def __len__(self) -> int:
        return len(self._nodes)

    def update(
        self, frame_label: FrameLabel, anchor: Anchor | None, T_world_keyframe: Poses
    ) -> bool:
        """Extend the path by one frame; return whether a node was added. Ignores lost frames.

        Parameters
        ----------
        frame_label : FrameLabel
            The frame's label.
        anchor : Anchor or None
            Its pose; None where it was lost.
        T_world_keyframe : mapping of int to (4, 4) float64
            Current pose of each keyframe.

        Raises
        ------
        SemanticsError
            A keyframe that a node or the frame is anchored to has no pose.
        """
        if anchor is None:
            return False
        if self._waypoint is not None:
            here, there = _position(anchor, T_world_keyframe), self._waypoint
            step = float(np.linalg.norm(here - _position(there, T_world_keyframe)))
            if step < _MIN_STEP_M:
                return False
            self._travelled_m += step
        self._waypoint = anchor
        if self._nodes:
            beyond = self._travelled_m - self.settings.node_distance_m
            if beyond < -_ROUNDING_M:
                return False
            # What was walked beyond the metre counts for the next: nodes do not fall behind.
            self._travelled_m = max(0.0, beyond) % self.settings.node_distance_m
        self._drop(frame_label, anchor, T_world_keyframe)
        return True

    def snapshot(self, T_world_keyframe: Poses, partial: bool = False) -> SemanticGraph:
        """Return the graph at its present positions in the world.

        Parameters
        ----------
        T_world_keyframe : mapping of int to (4, 4) float64
            Current pose of each keyframe.
        partial : bool
            Leave out the nodes whose keyframe has no pose.

        Raises
        ------
        SemanticsError
            A keyframe that a node is anchored to has no pose, and `partial` is not given.
        """
        kept = [n for n in self._nodes if not partial or n.anchor.keyframe in T_world_keyframe]
        nodes = tuple(
            GraphNode(
                id=i, frame=node.frame, stamp_s=node.stamp_s,
                position_world=_position(node.anchor, T_world_keyframe), label=node.label,
                label_id=node.label_id, place=self._place(node), score=node.score,
                signature=node.signature, evidence=node.evidence,
            )
            for i, node in enumerate(kept)
        )  # fmt: skip
        positions = np.array([node.position_world for node in nodes]).reshape(-1, 3)
        return SemanticGraph(self.labels, nodes, self._edges(positions))

    def keep(self, keyframes: Container[int]) -> None:
        """Remove the nodes anchored to other keyframes, which have no known pose in the world."""
        self._nodes = [node for node in self._nodes if node.anchor.keyframe in keyframes]

    def _drop(self, frame_label: FrameLabel, anchor: Anchor, T_world_keyframe: Poses) -> None:
        self._nodes.append(
            _Node(
                frame=frame_label.index,
                stamp_s=frame_label.stamp_s,
                anchor=anchor,
                label=frame_label.label,
                label_id=frame_label.label_id,
                stay=self._stay(frame_label, anchor, T_world_keyframe),
                score=frame_label.score,
                signature=frame_label.signature,
                evidence=Evidence.of(frame_label, self.labels),
            )
        )

    def _stay(self, frame_label: FrameLabel, anchor: Anchor, T_world_keyframe: Poses) -> int | None:
        label = frame_label.label
        if label == UNKNOWN:
            return None
        known = [node for node in self._nodes if node.label == label]
        return self._names.assign(
            label,
            Observation(_position(anchor, T_world_keyframe), frame_label.signature),
            [
                Observation(_position(node.anchor, T_world_keyframe), node.signature)
                for node in known
            ],
            [node.stay for node in known if node.stay is not None],
            follows_last=bool(self._nodes) and self._nodes[-1].label == label,
        )

    def _place(self, node: _Node) -> str:
        return UNKNOWN if node.stay is None else self._names.name(node.stay)

    def _edges(self, positions: NDArray[np.float64]) -> tuple[GraphEdge, ...]:
        """Join successive nodes, and each node to the nearest one of an earlier passing."""
        pairs = [(i, i + 1, EdgeKind.PATH) for i in range(len(positions) - 1)]
        for i in range(self.settings.revisit_gap + 1, len(positions)):
            older = positions[: i - self.settings.revisit_gap]
            lengths = np.linalg.norm(older - positions[i], axis=1)
            nearest = int(lengths.argmin())
            if lengths[nearest] <= self.settings.revisit_radius_m:
                pairs.append((nearest, i, EdgeKind.REVISIT))
        return tuple(
            GraphEdge(a, b, float(np.linalg.norm(positions[a] - positions[b])), kind)
            for a, b, kind in pairs
        )


def _position(anchor: Anchor, T_world_keyframe: Poses) -> NDArray[np.float64]:
    """Return the present position (3,) of the camera of `anchor`, metres."""
    try:
        T = T_world_keyframe[anchor.keyframe]
    except KeyError as error:
        raise SemanticsError(
            "a node's keyframe has no pose", where=f"keyframe {anchor.keyframe}",
            expected="the pose of every keyframe",
        ) from error  # fmt: skip
    return np.asarray(T[:3, :3] @ anchor.T_keyframe_camera[:3, 3] + T[:3, 3])
