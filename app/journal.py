"""The frames of a run with their labels, and where they are as far as known now."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from app.viewer import MapView
from datasets.trajectory import Trajectory
from semantics.floor import places_at
from semantics.graph import SemanticGraph
from semantics.labeller import FrameLabel
from semantics.parts import Vote
from slam.map import PointMap
from slam.slam import Slam
from slam.tracking import Anchor, Tracking, TrackingState

FloatArray = NDArray[np.float64]


class Journal:
    """Keeps what was found of each frame, and says where that is in the world.

    Parameters
    ----------
    slam : Slam
        Knows where keyframes are; frames hang on them.

    Attributes
    ----------
    labels : list of FrameLabel
        By frame, without their features.
    """

    def __init__(self, slam: Slam) -> None:
        self.slam = slam
        self.labels: list[FrameLabel] = []

    def add(self, label: FrameLabel) -> None:
        """Keep the next frame's label."""
        self.labels.append(replace(label, tracking=label.tracking.without_view()))

    def settle(self) -> list[Trajectory]:
        """Say at last of each frame whether its place in the world became known.

        Frames of a sub-map that was joined count as relocalised where they were lost; those of a
        sub-map that never was are lost. Returns the ways through these, each in its own frame.
        """
        apart: dict[int, list[tuple[float, FloatArray]]] = {}
        for i, label in enumerate(self.labels):
            tracking, anchor = label.tracking, label.tracking.anchor
            if anchor is None:
                continue
            if self.slam.is_placed(anchor):
                state = tracking.state
                if state is TrackingState.LOST:
                    state = TrackingState.RELOCALISED
                tracking = replace(tracking, state=state)
            else:
                if anchor.keyframe in self.slam.keyframes:  # else it failed in the making
                    submap = self.slam.mapper.graph.component_of(anchor.keyframe)
                    way = (tracking.stamp_s, self.slam.pose_of(anchor))
                    apart.setdefault(submap, []).append(way)
                tracking = replace(
                    tracking, state=TrackingState.LOST, inliers=0, method="none", anchor=None,
                    T_world_camera=None,
                )  # fmt: skip
            self.labels[i] = replace(label, tracking=tracking)
        return [_trajectory_of(ways) for ways in apart.values()]

    def trajectory(self) -> Trajectory:
        """Return the poses of all frames that have a place in the world."""
        return _trajectory_of([(t.stamp_s, self.slam.pose_of(anchor)) for t, anchor in self._way()])

    def votes(self, keyframes: Sequence[int]) -> list[Vote]:
        """Return where frames that hang on one of `keyframes` were, and what they look like."""
        known = set(keyframes)
        return [
            Vote(label.tracking.index, self.slam.pose_of(anchor)[:3, 3], label.label, label.score)
            for label in self.labels
            if (anchor := label.tracking.anchor) is not None and anchor.keyframe in known
        ]

    def map_view(self, points: PointMap, graph: SemanticGraph | None = None) -> MapView:
        """Return a map as viewers are shown it, with keyframes, links and the way."""
        T = self.slam.placed_poses
        links = [k for k in self.slam.links if k.first in T and k.second in T]
        ends = np.array([(T[k.first][:3, 3], T[k.second][:3, 3]) for k in links])
        loops = np.array([link.is_loop for link in links], dtype=bool)
        ends = ends.reshape(-1, 2, 3)
        way = self._way()
        return MapView(
            points, self._label_ids(points, graph), tuple(T),
            np.array(list(T.values())).reshape(-1, 4, 4), ends[~loops], ends[loops],
            self.trajectory().positions, tuple(t.index for t, _ in way),
            tuple(t.state for t, _ in way),
        )  # fmt: skip

    def _way(self) -> list[tuple[Tracking, Anchor]]:
        """Return the frames that have a place in the world, and what holds their pose."""
        return [
            (label.tracking, anchor)
            for label in self.labels
            if (anchor := label.tracking.anchor) is not None and self.slam.is_placed(anchor)
        ]

    def _label_ids(self, points: PointMap, graph: SemanticGraph | None) -> NDArray[np.uint16]:
        """Give each map point the label of the place it lies in, else of the keyframe that saw it.

        Without a place's extent, what is seen through a door bears the label of this side of it.
        """
        of_keyframe = np.zeros(max(self.slam.keyframe_poses, default=0) + 1, dtype=np.uint16)
        for label in self.labels:
            tracking = label.tracking
            if tracking.is_keyframe and tracking.anchor is not None:
                of_keyframe[tracking.anchor.keyframe] = label.label_id
        seen_from = of_keyframe[points.keyframes]
        if graph is None or not graph.extents:
            return seen_from
        of_extent = np.array([extent.label_id for extent in graph.extents], dtype=np.uint16)
        place = places_at(graph, points.points_world)
        return np.where(place >= 0, of_extent[place], seen_from)


def _trajectory_of(way: list[tuple[float, FloatArray]]) -> Trajectory:
    stamps = np.array([stamp for stamp, _ in way])
    return Trajectory(stamps, np.array([T for _, T in way]).reshape(-1, 4, 4))
