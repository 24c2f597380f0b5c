"""RGB-D SLAM: frames in, poses, keyframes and a map out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.slam.backend.alignment import KeyframeAligner
from roomgraph.slam.backend.backend import Backend
from roomgraph.slam.backend.local_bundle_adjustment import (
    LocalBundleAdjustment,
)
from roomgraph.slam.backend.loop_closing import LoopCloser
from roomgraph.slam.backend.mapper import Mapper
from roomgraph.slam.backend.pose_graph import Constraint, PoseGraph
from roomgraph.slam.features.extraction import FeatureExtractor
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.depth_odometry import DepthOdometry
from roomgraph.slam.frontend.depth_refinement import DepthRefiner
from roomgraph.slam.frontend.estimate import Estimate
from roomgraph.slam.frontend.keyframe_selection import KeyframeSelector
from roomgraph.slam.frontend.localiser import Localiser, estimate_of
from roomgraph.slam.frontend.motion_model import MotionModel
from roomgraph.slam.frontend.optical_flow import FlowTracker
from roomgraph.slam.frontend.tracker import Tracker
from roomgraph.slam.frontend.tracking_status import TrackingStatus
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.point_map import LiveMap, PointMap, build_map
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.tracking import Anchor, LoopClosure, Tracking, TrackingState

FloatArray = NDArray[np.float64]


class Slam:
    """Tracks a camera against local keyframes and keeps the keyframes consistent.

    SLAM of Kostavelis & Gasteratos (2013, section 3.1): matched features give a coarse
    motion, points of common planes refine it by ICP; here between keyframes, joined in a pose
    graph with loop closures. Between keyframes corners are followed by optical flow; keyframes are
    linked, adjusted in bundles and searched for loops in a thread. A lost camera begins a sub-map,
    which is joined where it meets the map.

    Examples
    --------
    >>> slam = Slam(SlamSettings())  # doctest: +SKIP
    >>> for frame in sequence:  # doctest: +SKIP
    ...     tracking = slam.process(frame)
    >>> slam.finish()  # doctest: +SKIP
    """

    def __init__(self, settings: SlamSettings, seed: int = 0) -> None:
        self.settings = settings
        self._status = TrackingStatus()
        self._extractor = FeatureExtractor(settings.features)
        self._tracker = Tracker(settings.tracker, settings.motion, settings.noise, seed)
        aligner = KeyframeAligner(self._tracker, settings.icp, settings.noise)
        self._mapper = Mapper(
            settings=settings.keyframes,
            planes=settings.planes,
            cloud=settings.map,
            noise=settings.noise,
            aligner=aligner,
            loops=LoopCloser(settings.loops, settings.word_index, aligner),
            local_bundle=LocalBundleAdjustment(settings.local_bundle_adjustment, settings.noise),
            graph=PoseGraph(settings.pose_graph),
            seed=seed,
        )
        self._backend = Backend(self._mapper)
        self._localiser = self._make_localiser(seed)
        self._live_map = LiveMap(settings.map, settings.noise)
        self._selector = KeyframeSelector(settings.keyframes, settings.depth_odometry.keyframe_m)

    def prepare(self, frame: Frame) -> View:
        """Prepare a frame; needs no state and may run ahead in a thread."""
        view = View(frame, self._extractor, self.settings.max_depth_m)
        if self._status.needs_features and view.has_depth:
            view.describe()
        return view

    def process(self, frame: Frame | View) -> Tracking:
        """Process the next frame and return the pose of the camera."""
        view = frame if isinstance(frame, View) else self.prepare(frame)
        if self._status.is_initialising:
            return self._begin(view)
        estimate, was_lost = self._localiser.locate(view), self._status.is_lost
        if estimate is None and view.has_depth:
            estimate, was_lost = self._relocalise(view), True
        if estimate is None:
            return self._lose(view)
        state = TrackingState.RELOCALISED if was_lost else TrackingState.OK
        return self._accept(view, estimate, state)

    def finish(self) -> tuple[LoopClosure, ...]:
        """Wait for the keyframes in progress; then poses and map are final.

        Returns the loops that became known with them, of which no frame told.
        """
        self._backend.finish()
        return self._backend.new_closures()

    @property
    def keyframes(self) -> Mapping[int, Keyframe]:
        """The finished keyframes by id."""
        return MappingProxyType(self._backend.keyframes)

    @property
    def keyframe_poses(self) -> Mapping[int, FloatArray]:
        """T_world_keyframe (4, 4) of all keyframes, as estimated now."""
        return MappingProxyType(self._backend.poses)

    def pose_of(self, anchor: Anchor) -> FloatArray:
        """Return T_world_camera (4, 4) of an anchored pose, as estimated now."""
        return np.asarray(self._backend.poses[anchor.keyframe] @ anchor.T_keyframe_camera)

    @property
    def constraints(self) -> tuple[Constraint, ...]:
        """The constraints between finished keyframes."""
        return self._backend.constraints

    @property
    def closures(self) -> tuple[LoopClosure, ...]:
        """All valid loop closures between finished keyframes."""
        return self._backend.closures

    @property
    def pose_graph(self) -> PoseGraph:
        """The pose graph itself, to be read only, and only after `finish`.

        Until then a thread changes it: `keyframe_poses` and `constraints` may be read at any time.
        """
        return self._mapper.graph

    def submap_of(self, anchor: Anchor) -> int:
        """Return the id of the oldest keyframe of a pose's sub-map, after `finish`.

        Raises
        ------
        SlamError
            Its keyframe is not in the graph: making it failed.
        """
        return self.pose_graph.component_of(anchor.keyframe)

    def is_placed(self, anchor: Anchor) -> bool:
        """Whether a pose in the world is known, which it is not in an unconnected sub-map."""
        return anchor.keyframe in self._backend.placed

    @property
    def placed_poses(self) -> dict[int, FloatArray]:
        """T_world_keyframe (4, 4) of the keyframes with a known pose in the world."""
        return {k: T for k, T in self._backend.poses.items() if k in self._backend.placed}

    def build_map(self) -> PointMap:
        """Fuse the keyframes with a known pose in the world, at their present poses."""
        placed = [k for k in self.keyframes.values() if k.id in self._backend.placed]
        return build_map(placed, self.keyframe_poses, self.settings.map, self.settings.noise)

    def map_sketcher(self) -> Callable[[], PointMap]:
        """Return a function that builds a coarse map of the present keyframes.

        It may be called later and in another thread, but one at a time and in the order in which
        they were asked for.
        """
        every, T_world_keyframe = self.settings.map.sketch_every, self.placed_poses
        chosen = {
            k: v for k, v in self.keyframes.items() if k in T_world_keyframe and k % every == 0
        }
        return partial(self._live_map.update, chosen, T_world_keyframe)

    def _make_localiser(self, seed: int) -> Localiser:
        s = self.settings
        return Localiser(
            flow=FlowTracker(s.flow, s.noise),
            tracker=self._tracker,
            depth=DepthOdometry(s.depth_odometry, s.planes, s.icp, s.noise, seed),
            motion=MotionModel(s.prediction),
            refiner=DepthRefiner(s.depth_refinement, s.noise),
            known=self._backend,
            status=self._status,
            min_correlation=s.loss.min_correlation,
        )

    def _begin(self, view: View) -> Tracking:
        """Start the map with the first frame that has depth."""
        if not view.has_depth:
            return _without_pose(view, TrackingState.SKIPPED)
        keyframe = self._backend.start(view, np.eye(4))
        tracking = self._make_keyframe(view, keyframe, TrackingState.OK)
        self._status.began(view.frame)
        return tracking

    def _relocalise(self, view: View) -> Estimate | None:
        """Relocalise a view in similar keyframes near the position where tracking was lost.

        Further off it may be a place that merely looks the same: then a sub-map waits for several
        keyframes to agree on where it belongs.
        """
        self._backend.finish()
        seconds = max(0.0, view.frame.stamp_s - self._status.last_seen_s)
        reach = self.settings.loss.reach_m + self.settings.loss.speed_m_s * seconds
        here = self._localiser.T_world_camera[:3, 3]
        for candidate in self._mapper.loops.alike(view, 4):
            located = self._tracker.locate(view, self._backend.around(candidate))
            if located is None or not self._mapper.loops.is_sound(
                located.inliers, located.motion.T_camera_reference, view, self.keyframes[candidate]
            ):
                continue
            estimate = estimate_of(located, view)
            if np.linalg.norm(self.pose_of(estimate.anchor)[:3, 3] - here) < reach:
                self._selector.outline = self._backend.known_points(estimate.reference)
                return estimate
        return None

    def _lose(self, view: View) -> Tracking:
        """Set the state to lost, and begin a sub-map if the view has enough features."""
        self._localiser.stand_still()
        if not view.has_depth:
            self._status.interrupted(view.frame)
            return _without_pose(view, TrackingState.SKIPPED)
        self._status.lost(view.frame)
        if not self._may_begin_submap(view):
            return _without_pose(view, TrackingState.LOST)
        keyframe = self._backend.start(view, self._localiser.T_world_camera)
        tracking = self._make_keyframe(view, keyframe, TrackingState.LOST)
        self._status.began_submap(view.frame)
        return tracking

    def _may_begin_submap(self, view: View) -> bool:
        """Whether a lost view has enough features, and the last attempt is long enough ago."""
        loss = self.settings.loss
        is_due = self._status.lost_in_a_row % loss.pause == 1 % loss.pause
        return loss.submaps and is_due and bool(view.has_point.sum() >= loss.min_features)

    def _accept(self, view: View, estimate: Estimate, state: TrackingState) -> Tracking:
        """Continue from a located view."""
        tracking = self._move_to(view, estimate, state)
        self._status.found(view.frame, by_flow=estimate.method == "flow")
        return tracking

    def _move_to(self, view: View, estimate: Estimate, state: TrackingState) -> Tracking:
        """Turn a located view into a keyframe, or at least track against it."""
        if self._selector.wants(view, estimate):
            known = self._known(view, estimate)
            if known is None:
                keyframe = self._backend.insert(view, estimate)
                return self._make_keyframe(view, keyframe, state, estimate)
            estimate = known
        anchor = estimate.anchor
        self._localiser.moved_to(view, anchor, estimate)
        if estimate.method == "features":
            self._localiser.follow(view, anchor)
            self._selector.outline = self._backend.known_points(anchor.keyframe)
        return self._report(view, state, anchor, estimate)

    def _known(self, view: View, estimate: Estimate) -> Estimate | None:
        """Return a view's pose from an older keyframe that can be reused instead of a new one.

        Only where it agrees with the way tracked: otherwise a loop is to be closed first.
        """
        T_world_camera = self.pose_of(estimate.anchor)
        other = None if estimate.method == "depth" else self._nearest(estimate, T_world_camera)
        if other is None:
            return None
        T_camera_other = se3.inverse(T_world_camera) @ self._backend.poses[other]
        located = self._tracker.guided(view, self._backend.around(other), T_camera_other)
        if located is None:
            return None
        known = estimate_of(located, view)
        return known if self._selector.serves(known, T_camera_other) else None

    def _nearest(self, estimate: Estimate, T_world_camera: FloatArray) -> int | None:
        """Return the keyframe with the most similar view, other than the reference."""
        placed, T_world = self._backend.placed, self._backend.poses
        others = [
            k
            for k in T_world
            if k != estimate.reference and (k in placed) == (estimate.reference in placed)
        ]
        T_world_others = np.array([T_world[k] for k in others]).reshape(-1, 4, 4)
        nearest = self._selector.nearest(T_world_camera, T_world_others)
        return None if nearest is None else others[nearest]

    def _make_keyframe(
        self, view: View, keyframe: int, state: TrackingState, estimate: Estimate | None = None
    ) -> Tracking:
        """Track against a view that has just become a keyframe."""
        anchor = Anchor(keyframe, np.eye(4))
        self._localiser.moved_to(view, anchor, None)
        self._selector.outline = self._localiser.follow(view, anchor).points
        return self._report(view, state, anchor, estimate, is_keyframe=True)

    def _report(
        self,
        view: View,
        state: TrackingState,
        anchor: Anchor,
        estimate: Estimate | None,
        is_keyframe: bool = False,
    ) -> Tracking:
        seen = np.empty((0, 2)) if estimate is None else estimate.pixels
        inliers = len(self._selector.outline) if estimate is None else estimate.inliers
        # Not whether its features happen to be there: that depends on which thread was faster.
        is_looked_at = is_keyframe or (estimate is not None and estimate.method != "flow")
        return Tracking(
            index=view.frame.index,
            stamp_s=view.frame.stamp_s,
            state=state,
            inliers=inliers,
            method="features" if estimate is None else estimate.method,
            anchor=anchor,
            T_world_camera=self.pose_of(anchor),
            is_keyframe=is_keyframe,
            closures=self._backend.new_closures(),
            pixels=seen,
            view=view if is_looked_at else None,
        )


def _without_pose(view: View, state: TrackingState) -> Tracking:
    return Tracking(
        index=view.frame.index,
        stamp_s=view.frame.stamp_s,
        state=state,
        inliers=0,
        method="none",
        anchor=None,
        T_world_camera=None,
        is_keyframe=False,
    )
