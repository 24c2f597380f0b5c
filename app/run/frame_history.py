"""The frames of a run with their labels and their present poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.storage.frames import LabelledFrame
from roomgraph.app.viewer.viewer import MapView
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.rooms.labelling import Vote
from roomgraph.semantics.rooms.lookup import places_at
from roomgraph.semantics.temporal.labeller import FrameLabel
from roomgraph.slam.backend.pose_graph import Constraint
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import Tracking, TrackingState

FloatArray = NDArray[np.float64]


class FrameHistory:
    """Keeps the results of each frame, and returns their present poses in the world.

    Parameters
    ----------
    slam : Slam
        Knows where keyframes are; frames hang on them.

    Attributes
    ----------
    frames : list of LabelledFrame
        By frame, without their images.
    online : list of str
        By frame, the labels before the rooms were known.
    """

    def __init__(self, slam: Slam) -> None:
        self.slam = slam
        self.frames: list[LabelledFrame] = []
        self.online: list[str] = []

    def add(self, tracking: Tracking, label: FrameLabel) -> LabelledFrame:
        """Store the next frame, and return the stored form."""
        frame = LabelledFrame(tracking.without_view(), label)
        self.frames.append(frame)
        self.online.append(label.label)
        return frame

    def settle(self) -> list[Trajectory]:
        """Set the final state of each frame: whether its pose in the world is known.

        Frames of a sub-map that was joined count as relocalised where they were lost; those of a
        sub-map that never was are lost. Returns the ways through these, each in its own frame.
        """
        apart: dict[int, list[tuple[float, FloatArray]]] = {}
        for i, frame in enumerate(self.frames):
            tracking, anchor = frame.tracking, frame.tracking.anchor
            if anchor is None:
                continue
            if self.slam.is_placed(anchor):
                state = tracking.state
                if state is TrackingState.LOST:
                    state = TrackingState.RELOCALISED
                tracking = replace(tracking, state=state)
            else:
                if anchor.keyframe in self.slam.keyframes:  # else making it failed
                    submap = self.slam.submap_of(anchor)
                    way = (tracking.stamp_s, self.slam.pose_of(anchor))
                    apart.setdefault(submap, []).append(way)
                tracking = replace(
                    tracking, state=TrackingState.LOST, inliers=0, method="none", anchor=None,
                    T_world_camera=None,
                )  # fmt: skip
            self.frames[i] = replace(frame, tracking=tracking)
        return [_trajectory_of(ways) for ways in apart.values()]

    def settle_labels(self, graph: SemanticGraph) -> None:
        """Give frames the label of the place that they were taken in, where its floor is known.

        In a doorway an image shows the next room while the camera is still in this one. A frame
        whose label changes gets the place's score; what its image spoke for stays noted beside.
        """
        way = _way_of(self.frames, self.slam.placed_poses)
        centres = np.array([T[:3, 3] for _, T in way]).reshape(-1, 3)
        for (tracking, _), place in zip(way, places_at(graph, centres), strict=True):
            frame = self.frames[tracking.index]
            label = frame.label
            room = graph.rooms[place] if place >= 0 else None
            if room is not None and room.label not in (UNKNOWN, label.label):
                named = replace(label, label=room.label, label_id=room.label_id, score=room.score)
                self.frames[tracking.index] = replace(frame, label=named)

    def trajectory(self) -> Trajectory:
        """Return the poses of all frames whose pose in the world is known."""
        way = _way_of(self.frames, self.slam.placed_poses)
        return _trajectory_of([(tracking.stamp_s, T) for tracking, T in way])

    def votes(self, keyframes: Sequence[int]) -> list[Vote]:
        """Return positions and labels of the frames anchored to one of `keyframes`."""
        known = set(keyframes)
        return [
            Vote(
                frame.tracking.index,
                self.slam.pose_of(anchor)[:3, 3],
                frame.label.label,
                frame.label.score,
            )
            for frame in self.frames
            if (anchor := frame.tracking.anchor) is not None and anchor.keyframe in known
        ]

    def map_view(self, points: PointMap, graph: SemanticGraph) -> MapView:
        """Return a finished map for viewers, with keyframes, constraints and path.

        Each point has the label of the place it lies in, else of the keyframe that saw it.
        """
        view = _view_of(points, self.frames, self.slam.placed_poses, self.slam.constraints)
        if not graph.rooms:
            return view
        of_room = np.array([room.label_id for room in graph.rooms], dtype=np.uint16)
        place = places_at(graph, points.points_world)
        return replace(view, label_ids=np.where(place >= 0, of_room[place], view.label_ids))

    def sketch(self) -> Callable[[], MapView]:
        """Return a function that draws the present map coarsely; see `Slam.map_sketcher`.

        Without a place's room, what is seen through a door gets the label of this side of it.
        """
        draw, frames = self.slam.map_sketcher(), list(self.frames)
        T_world_keyframe, constraints = self.slam.placed_poses, self.slam.constraints
        return lambda: _view_of(draw(), frames, T_world_keyframe, constraints)


def _view_of(
    points: PointMap,
    frames: Sequence[LabelledFrame],
    T_world_keyframe: dict[int, FloatArray],
    constraints: Sequence[Constraint],
) -> MapView:
    """Return a map for viewers; each point has the label of the keyframe that saw it."""
    between = [
        k for k in constraints if k.first in T_world_keyframe and k.second in T_world_keyframe
    ]
    ends = np.array([
        (T_world_keyframe[k.first][:3, 3], T_world_keyframe[k.second][:3, 3]) for k in between
    ]).reshape(-1, 2, 3)  # fmt: skip
    loops = np.array([constraint.is_loop for constraint in between], dtype=bool)
    label_ids = np.zeros(max(T_world_keyframe, default=0) + 1, dtype=np.uint16)
    way = _way_of(frames, T_world_keyframe)
    for frame in frames:
        tracking = frame.tracking
        anchor = tracking.anchor
        if tracking.is_keyframe and anchor is not None and anchor.keyframe in T_world_keyframe:
            label_ids[anchor.keyframe] = frame.label.label_id
    return MapView(
        points=points, label_ids=label_ids[points.keyframes], keyframes=tuple(T_world_keyframe),
        T_world_keyframe=np.array(list(T_world_keyframe.values())).reshape(-1, 4, 4),
        constraints=ends[~loops], loops=ends[loops],
        trajectory=np.array([T[:3, 3] for _, T in way]).reshape(-1, 3),
        frames=tuple(tracking.index for tracking, _ in way),
        states=tuple(tracking.state for tracking, _ in way),
    )  # fmt: skip


def _way_of(
    frames: Sequence[LabelledFrame], T_world_keyframe: dict[int, FloatArray]
) -> list[tuple[Tracking, FloatArray]]:
    """Return the frames with a known pose in the world, and T_world_camera (4, 4) of each."""
    return [
        (frame.tracking, T_world_keyframe[anchor.keyframe] @ anchor.T_keyframe_camera)
        for frame in frames
        if (anchor := frame.tracking.anchor) is not None and anchor.keyframe in T_world_keyframe
    ]


def _trajectory_of(way: list[tuple[float, FloatArray]]) -> Trajectory:
    stamps = np.array([stamp for stamp, _ in way])
    return Trajectory(stamps, np.array([T for _, T in way]).reshape(-1, 4, 4))
