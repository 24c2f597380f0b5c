"""The keyframes, the graph that holds them together, and how a new one joins."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets import poses
from datasets.settings import Settings
from slam.keyframe import Keyframe
from slam.linker import Linker
from slam.local_map import LocalMap, local_map
from slam.loops import LoopCloser
from slam.map import MapSettings
from slam.noise import SensorNoise
from slam.planes import PlaneSettings, extract_planes
from slam.pose_graph import Link, PoseGraph
from slam.range_image import range_image_of
from slam.tracker import Located
from slam.tracking import LoopClosure
from slam.view import View

FloatArray = NDArray[np.float64]


class KeyframeSettings(Settings):
    """When a view becomes a keyframe."""

    min_overlap: float = Field(
        0.75, gt=0, le=1, description="of the reference's points, the least still in view"
    )
    min_explained: float = Field(
        0.3, gt=0, le=1, description="of the view's features, the least found in the local map"
    )
    max_baseline_share: float = Field(
        0.15, gt=0, le=2, description="way from the reference, as a share of the depth, at most"
    )
    max_angle_deg: float = Field(20.0, gt=0, le=180, description="turn from the reference, at most")
    neighbours: int = Field(3, ge=0, le=50, description="keyframes tracked beside the reference")


@dataclass(frozen=True, slots=True)
class Coarse:
    """A pose without matches, from depth alone."""

    reference: int
    T_camera_reference: FloatArray
    information: FloatArray


class Mapper:
    """Owns keyframes and pose graph; all world positions come from here."""

    def __init__(
        self,
        settings: KeyframeSettings,
        planes: PlaneSettings,
        cloud: MapSettings,
        noise: SensorNoise,
        linker: Linker,
        loops: LoopCloser,
        graph: PoseGraph,
        seed: int = 0,
    ) -> None:
        self.settings, self.planes, self.cloud, self.noise = settings, planes, cloud, noise
        self.linker, self.loops, self.graph, self.seed = linker, loops, graph, seed
        self.keyframes: dict[int, Keyframe] = {}
        self.closures: list[LoopClosure] = []
        self._neighbours: defaultdict[int, set[int]] = defaultdict(set)

    def start(self, view: View, T_world_camera: FloatArray) -> int:
        """Make the first keyframe; return its id."""
        keyframe = self._keep(view)
        self.graph.add_keyframe(keyframe.id, T_world_camera)
        self.keyframes[keyframe.id] = keyframe
        self.graph.optimise()
        self.loops.index.add(keyframe.id, self.loops.index.words_of(keyframe.features.descriptors))
        return keyframe.id

    def insert(self, view: View, located: Located | Coarse) -> tuple[int, tuple[LoopClosure, ...]]:
        """Make a keyframe of a view with a pose; return its id and the loops it closes."""
        reference, T = _pose_of(located)
        keyframe = self._keep(view)
        self.graph.add_keyframe(keyframe.id, self.graph[reference] @ poses.inverse(T))
        self.keyframes[keyframe.id] = keyframe
        for link in self._links(view, keyframe, located):
            self._add(link)
        known = self._neighbours[keyframe.id].union(
            *(self._neighbours[k] for k in self._neighbours[keyframe.id])
        )
        measured = self.loops.close(view, keyframe, self.keyframes, self.graph, known)
        for loop in measured:
            self._add(loop.link)
        closures = tuple(
            LoopClosure(loop.link.second, loop.link.first, loop.inliers) for loop in measured
        )
        self.closures.extend(closures)
        for link in self.graph.optimise():
            self._forget(link)
        return keyframe.id, closures

    def around(self, reference: int) -> LocalMap:
        """Return the points of a keyframe and of those linked to it that look the same way."""
        T_reference_world = poses.inverse(self.graph[reference])
        ranked = []
        for other in self._neighbours[reference]:
            T = T_reference_world @ self.graph[other]
            ranked.append((np.linalg.norm(T[:3, 3]) + 2 * poses.rotation_angle(T), other))
        chosen = [reference, *(k for _, k in sorted(ranked)[: self.settings.neighbours])]
        return local_map([(self.keyframes[k], self.graph[k]) for k in chosen])

    def wants(self, view: View, located: Located) -> bool:
        """Whether a view should become a keyframe: it shows new space, or is losing touch."""
        T = located.motion.T_camera_reference
        reference = self.keyframes[located.local_map.reference]
        points = reference.points[np.isfinite(reference.points[:, 2])]
        moved = poses.transform(T, points)
        ahead = moved[moved[:, 2] > 0.1]
        pixels = view.frame.intrinsics.project(ahead)
        size = (view.frame.intrinsics.width, view.frame.intrinsics.height)
        overlap = np.all((pixels >= 0) & (pixels < size), axis=1).sum() / max(1, len(points))
        features = int(view.has_point.sum())
        depth = float(np.median(points[:, 2])) if len(points) else 1.0
        return bool(
            overlap < self.settings.min_overlap
            or located.inliers < self.settings.min_explained * features
            or np.linalg.norm(T[:3, 3]) > self.settings.max_baseline_share * depth
            or np.degrees(poses.rotation_angle(T)) > self.settings.max_angle_deg
        )

    def _keep(self, view: View) -> Keyframe:
        frame = view.frame
        image = range_image_of(frame, self.cloud.stride, self.cloud.max_depth_m)
        planes = (
            extract_planes(image.points.astype(np.float64), self.noise, self.planes, self.seed)
            if self.planes.enabled
            else ()
        )
        keyframe = Keyframe(
            len(self.keyframes), frame.index, frame.stamp_s, view.features, view.points_camera,
            planes, image, frame.intrinsics,
        )  # fmt: skip
        return keyframe

    def _links(self, view: View, keyframe: Keyframe, located: Located | Coarse) -> list[Link]:
        if isinstance(located, Located):
            measured = self.linker.from_tracking(view, keyframe, self.keyframes, located)
            if measured:
                return [m.link for m in measured]
            reference, T, information = (
                located.local_map.reference,
                located.motion.T_camera_reference,
                located.motion.information,
            )
        else:
            reference, T = located.reference, located.T_camera_reference
            information = located.information
        return [Link(reference, keyframe.id, poses.inverse(T), information, is_loop=False)]

    def _add(self, link: Link) -> None:
        self.graph.add_link(link)
        self._neighbours[link.first].add(link.second)
        self._neighbours[link.second].add(link.first)

    def _forget(self, rejected: Link) -> None:
        """Drop a loop that turned out wrong."""
        ends = rejected.second, rejected.first
        self.closures = [c for c in self.closures if (c.keyframe, c.matched_keyframe) != ends]
        self._neighbours[rejected.first].discard(rejected.second)
        self._neighbours[rejected.second].discard(rejected.first)


def _pose_of(located: Located | Coarse) -> tuple[int, FloatArray]:
    if isinstance(located, Located):
        return located.local_map.reference, located.motion.T_camera_reference
    return located.reference, located.T_camera_reference
