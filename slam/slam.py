"""RGB-D SLAM: frames in, poses, keyframes and a map out."""

from __future__ import annotations

import logging

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets import poses
from datasets.frame import Frame
from datasets.settings import Settings
from slam.appearance import AppearanceSettings
from slam.features import FeatureExtractor, FeatureSettings
from slam.ground import GroundSettings
from slam.icp import IcpSettings
from slam.keyframe import Keyframe
from slam.linker import Linker
from slam.local_map import LocalMap
from slam.loops import LoopCloser, LoopSettings
from slam.map import LiveMap, MapSettings, PointMap, build_map
from slam.mapper import Coarse, KeyframeSettings, Mapper
from slam.motion import MotionSettings
from slam.noise import SensorNoise
from slam.planes import PlaneSettings
from slam.pose_graph import PoseGraph, PoseGraphSettings
from slam.space import SpaceSettings
from slam.textureless import DepthOdometry, TexturelessSettings
from slam.tracker import Located, Tracker, TrackerSettings
from slam.tracking import Anchor, LoopClosure, Tracking, TrackingState
from slam.view import View, see

logger = logging.getLogger(__name__)

FloatArray = NDArray[np.float64]


class SlamSettings(Settings):
    """All of the low layer's settings."""

    max_depth_m: float = Field(8.0, gt=0, le=200, description="readings beyond are ignored")
    features: FeatureSettings = FeatureSettings()
    noise: SensorNoise = SensorNoise()
    motion: MotionSettings = MotionSettings()
    tracker: TrackerSettings = TrackerSettings()
    keyframes: KeyframeSettings = KeyframeSettings()
    planes: PlaneSettings = PlaneSettings()
    icp: IcpSettings = IcpSettings()
    loops: LoopSettings = LoopSettings()
    appearance: AppearanceSettings = AppearanceSettings()
    pose_graph: PoseGraphSettings = PoseGraphSettings()
    textureless: TexturelessSettings = TexturelessSettings()
    map: MapSettings = MapSettings()
    ground: GroundSettings = GroundSettings()
    space: SpaceSettings = SpaceSettings()


class Slam:
    """Tracks a camera against local keyframes and keeps these consistent.

    The low layer of Kostavelis & Gasteratos (2013, section 3.1): matched features give a coarse
    motion, points of common planes refine it by ICP; here between keyframes, joined in a pose
    graph with loop closures.

    Examples
    --------
    >>> slam = Slam(SlamSettings())  # doctest: +SKIP
    >>> for frame in sequence:  # doctest: +SKIP
    ...     tracking = slam.process(frame)
    """

    def __init__(self, settings: SlamSettings, seed: int = 0) -> None:
        self.settings = settings
        self._extractor = FeatureExtractor(settings.features)
        self._tracker = Tracker(settings.tracker, settings.motion, settings.noise, seed)
        linker = Linker(self._tracker, settings.icp, settings.noise)
        self.mapper = Mapper(
            settings.keyframes, settings.planes, settings.map, settings.noise, linker,
            LoopCloser(settings.loops, settings.appearance, linker),
            PoseGraph(settings.pose_graph), seed,
        )  # fmt: skip
        self._depth_odometry = DepthOdometry(
            settings.textureless, settings.planes, settings.icp, settings.noise, seed
        )
        self._live_map = LiveMap(settings.map, settings.noise)
        self._around: LocalMap | None = None
        self._last: Anchor | None = None
        self._last_view: View | None = None
        # Of the last pose, relative to its keyframe, in the camera's frame.
        self._covariance: FloatArray = np.zeros((6, 6))
        self._velocity = np.eye(4)
        self._lost = False

    def prepare(self, frame: Frame) -> View:
        """Find a frame's features: the part that needs no state and may run ahead in a thread."""
        return see(frame, self._extractor, self.settings.max_depth_m)

    def process(self, frame: Frame | View) -> Tracking:
        """Take the next frame in and say where the camera is."""
        view = frame if isinstance(frame, View) else self.prepare(frame)
        if not view.has_point.any() and not (view.frame.depth > 0).any():
            self._velocity = np.eye(4)
            return self._without_pose(view, TrackingState.SKIPPED)
        if self._around is None:
            return self._begin(view)
        located = self._locate(view)
        if located is None:
            logger.info("frame %d: lost", view.frame.index)
            self._lost, self._velocity = True, np.eye(4)
            return self._without_pose(view, TrackingState.LOST)
        return self._accept(view, located)

    @property
    def keyframes(self) -> dict[int, Keyframe]:
        """All keyframes by id."""
        return self.mapper.keyframes

    @property
    def keyframe_poses(self) -> dict[int, FloatArray]:
        """T_world_keyframe (4, 4) of all keyframes, as estimated now."""
        return self.mapper.graph.poses

    def pose_of(self, anchor: Anchor) -> FloatArray:
        """Return T_world_camera (4, 4) of an anchored pose, as estimated now."""
        return np.asarray(self.mapper.graph[anchor.keyframe] @ anchor.T_keyframe_camera)

    def build_map(self) -> PointMap:
        """Fuse all keyframes' points at their present poses."""
        return build_map(
            self.keyframes.values(), self.keyframe_poses, self.settings.map, self.settings.noise
        )

    def sketch_map(self) -> PointMap:
        """Return a coarse map to look at while the run goes on."""
        return self._live_map.update(self.keyframes, self.keyframe_poses)

    def _begin(self, view: View) -> Tracking:
        keyframe = self.mapper.start(view, np.eye(4))
        self._around = self.mapper.around(keyframe)
        return self._report(
            view, TrackingState.OK, int(view.has_point.sum()), "features",
            Anchor(keyframe, np.eye(4)), is_keyframe=True,
        )  # fmt: skip

    def _locate(self, view: View) -> Located | Coarse | None:
        """Find the pose: by features, by depth alone, or among all keyframes if lost."""
        assert self._around is not None
        if self._lost:
            return self._relocalise(view)
        return (
            self._tracker.track(view, self._around, self._prediction())
            or self._by_depth(view)
            or self._relocalise(view)
        )

    def _prediction(self) -> FloatArray | None:
        """Return T_camera_reference if the camera goes on as it did."""
        if self._last is None or self._around is None:
            return None
        T_camera_world = self._velocity @ poses.inverse(self.pose_of(self._last))
        # A prediction feeds the next one: left alone, rounding errors double with each frame.
        return poses.orthonormal(T_camera_world @ self.mapper.graph[self._around.reference])

    def _by_depth(self, view: View) -> Coarse | None:
        """Carry on from the last frame with a pose by depth alone."""
        if not self.settings.textureless.enabled or self._last is None or self._last_view is None:
            return None
        if not self._depth_odometry.is_tracking:
            self._depth_odometry.remember(self._last_view.frame)
        step = self._depth_odometry.register(view.frame, self._velocity)
        if step is None:
            return None
        T_camera_reference = step.T_camera_last @ poses.inverse(self._last.T_keyframe_camera)
        # The step's error comes on top of that of the pose it starts from.
        carried = poses.adjoint(step.T_camera_last)
        covariance = carried @ self._covariance @ carried.T + np.linalg.inv(step.information)
        return Coarse(self._last.keyframe, T_camera_reference, np.linalg.inv(covariance))

    def _relocalise(self, view: View) -> Located | None:
        """Look for the view among the keyframes last seen and those that look alike."""
        assert self._around is not None
        candidates = [self._around.reference, *self.mapper.loops.alike(view, 4)]
        for candidate in dict.fromkeys(candidates):
            located = self._tracker.track(view, self.mapper.around(candidate), None)
            if located is not None and located.inliers >= self.settings.loops.min_inliers:
                self._lost = True
                return located
        return None

    def _accept(self, view: View, located: Located | Coarse) -> Tracking:
        """Move on to a located view: keyframe or not, and what to track against next."""
        state = TrackingState.RELOCALISED if self._lost else TrackingState.OK
        closures: tuple[LoopClosure, ...] = ()
        if isinstance(located, Located):
            inliers, method = located.inliers, "features"
            self._depth_odometry.forget()
            anchor = _anchor(located.local_map.reference, located.motion.T_camera_reference)
            is_keyframe = self.mapper.wants(view, located)
            information = located.motion.information
        else:
            inliers, method = 0, "depth"
            anchor = _anchor(located.reference, located.T_camera_reference)
            is_keyframe = self._far(anchor)
            information = located.information
        self._covariance = np.asarray(np.linalg.inv(information + 1e-6 * np.eye(6)))
        self._follow(anchor)
        if is_keyframe:
            keyframe, closures = self.mapper.insert(view, located)
            anchor = Anchor(keyframe, np.eye(4))
            self._covariance = np.zeros((6, 6))
        self._settle(located, anchor, is_keyframe)
        self._last, self._last_view, self._lost = anchor, view, False
        return self._report(view, state, inliers, method, anchor, is_keyframe, closures)

    def _far(self, anchor: Anchor) -> bool:
        T = anchor.T_keyframe_camera
        return bool(
            np.linalg.norm(T[:3, 3]) > 0.3
            or np.degrees(poses.rotation_angle(T)) > self.settings.keyframes.max_angle_deg
        )

    def _follow(self, anchor: Anchor) -> None:
        """Take the step from the last frame as the velocity."""
        if self._last is None or self._lost:
            self._velocity = np.eye(4)
            return
        self._velocity = poses.inverse(self.pose_of(anchor)) @ self.pose_of(self._last)

    def _settle(self, located: Located | Coarse, anchor: Anchor, is_keyframe: bool) -> None:
        """Choose the keyframe to track against: the new one, or the one that shares most."""
        assert self._around is not None
        reference = anchor.keyframe
        if isinstance(located, Located) and not is_keyframe:
            counts = located.matches_by_owner()
            best = max(counts, key=lambda k: (counts[k], k))
            if counts[best] > 1.2 * counts.get(reference, 0):
                reference = best
        if reference != self._around.reference or is_keyframe:
            self._around = self.mapper.around(reference)

    def _report(
        self,
        view: View,
        state: TrackingState,
        inliers: int,
        method: str,
        anchor: Anchor,
        is_keyframe: bool,
        closures: tuple[LoopClosure, ...] = (),
    ) -> Tracking:
        self._last, self._last_view = anchor, view
        return Tracking(
            view.frame.index, view.frame.stamp_s, state, inliers, method, anchor,
            self.pose_of(anchor), is_keyframe, closures, view.features,
        )  # fmt: skip

    def _without_pose(self, view: View, state: TrackingState) -> Tracking:
        return Tracking(
            view.frame.index, view.frame.stamp_s, state, 0, "none", None, None, False, (),
            view.features,
        )  # fmt: skip


def _anchor(reference: int, T_camera_reference: FloatArray) -> Anchor:
    return Anchor(reference, poses.inverse(T_camera_reference))
