"""Keyframes, their pose graph, and the insertion of new ones."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.slam.backend.alignment import KeyframeAligner
from roomgraph.slam.backend.local_bundle_adjustment import LocalBundleAdjustment
from roomgraph.slam.backend.loop_closing import LoopCloser
from roomgraph.slam.backend.pose_graph import Constraint, PoseGraph
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.estimate import Estimate
from roomgraph.slam.frontend.keyframe_selection import KeyframeSettings
from roomgraph.slam.frontend.local_map import LocalMap, covisible, local_map
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.planes import PlaneSettings, extract_planes
from roomgraph.slam.geometry.range_image import range_image_of
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.point_map import MapSettings
from roomgraph.slam.tracking import LoopClosure

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class MapUpdate:
    """The changes of the map after a keyframe.

    Attributes
    ----------
    keyframe : Keyframe
        The new one.
    poses : dict of int to (4, 4) float64
        T_world_keyframe of all, as estimated now.
    closures : tuple of LoopClosure
        All loops that hold.
    new_closures : tuple of LoopClosure
        Those of them that it closed.
    constraints : tuple of Constraint
        All constraints that hold.
    placed : frozenset of int
        Keyframes of the sub-map that is the world.
    """

    keyframe: Keyframe
    poses: dict[int, FloatArray]
    closures: tuple[LoopClosure, ...]
    new_closures: tuple[LoopClosure, ...]
    constraints: tuple[Constraint, ...]
    placed: frozenset[int]


class Mapper:
    """Owns keyframes and pose graph; all world positions come from here."""

    def __init__(
        self,
        settings: KeyframeSettings,
        planes: PlaneSettings,
        cloud: MapSettings,
        noise: SensorNoise,
        aligner: KeyframeAligner,
        loops: LoopCloser,
        local_bundle: LocalBundleAdjustment,
        graph: PoseGraph,
        seed: int = 0,
    ) -> None:
        self.settings, self.planes, self.cloud, self.noise = settings, planes, cloud, noise
        self.aligner, self.loops, self.graph, self.seed = aligner, loops, graph, seed
        self.local_bundle = local_bundle
        self.keyframes: dict[int, Keyframe] = {}
        self.closures: list[LoopClosure] = []
        self._neighbours: defaultdict[int, set[int]] = defaultdict(set)

    def describe(self, keyframe_id: int, view: View) -> Keyframe:
        """Create a keyframe from a view; may run ahead in a separate thread.

        Of the map it only changes the vocabulary, which grows online: views are to come in
        order.
        """
        frame = view.frame
        image = range_image_of(frame, self.cloud.stride, self.cloud.max_depth_m)
        planes = (
            extract_planes(image.points.astype(np.float64), self.noise, self.planes, self.seed)
            if self.planes.enabled
            else ()
        )
        return Keyframe(
            id=keyframe_id,
            frame_index=frame.index,
            stamp_s=frame.stamp_s,
            features=view.features,
            points=view.points_camera,
            words=self.loops.index.words_of(view.features.descriptors),
            planes=planes,
            image=image,
            intrinsics=frame.intrinsics,
        )

    def start(self, keyframe: Keyframe, view: View, T_world_camera: FloatArray) -> MapUpdate:
        """Insert the first keyframe of the map, or of a sub-map not yet joined to it."""
        self.graph.add_keyframe(keyframe.id, T_world_camera, starts_component=True)
        self.local_bundle.add(keyframe)
        return self._finish(view, keyframe)

    def insert(self, keyframe: Keyframe, view: View, estimate: Estimate) -> MapUpdate:
        """Insert a keyframe with known pose; connect it to its neighbours."""
        T_world_camera = self.graph[estimate.reference] @ estimate.anchor.T_keyframe_camera
        self.graph.add_keyframe(keyframe.id, T_world_camera)
        self.local_bundle.add(keyframe)
        for constraint in self._constraints(view, keyframe, estimate):
            self._add(constraint)
        self.keyframes[keyframe.id] = keyframe
        self._adjust(keyframe.id)
        return self._finish(view, keyframe)

    def _adjust(self, newest: int) -> None:
        """Run local bundle adjustment and derive the constraints from it."""
        if not self.local_bundle.settings.enabled:
            return
        self.graph.optimise()
        T_world = self.graph.poses
        latest = [k for k in sorted(T_world)[-self.local_bundle.settings.size :]]
        around = set(latest).union(*(self._neighbours[k] for k in latest))
        adjusted = self.local_bundle.adjust(newest, around, self.keyframes, T_world)
        if adjusted:
            self.graph.measure_again(adjusted, since=min(set(adjusted) & set(latest)))

    def _finish(self, view: View, keyframe: Keyframe) -> MapUpdate:
        """Close loops and update all poses."""
        self.keyframes[keyframe.id] = keyframe
        known = self._neighbours[keyframe.id].union(
            *(self._neighbours[k] for k in self._neighbours[keyframe.id])
        )
        measured = self.loops.close(view, keyframe, self.keyframes, self.graph, known)
        for constraint in (constraint for loop in measured for constraint in loop.constraints):
            self._add(constraint)
        closed = tuple(
            LoopClosure(loop.constraint.second, loop.constraint.first, loop.inliers)
            for loop in measured
        )
        self.closures.extend(closed)
        for constraint in self.graph.optimise():
            self._forget(constraint)
        return MapUpdate(
            keyframe=keyframe,
            poses=self.graph.poses,
            closures=tuple(self.closures),
            new_closures=tuple(closure for closure in closed if closure in self.closures),
            constraints=tuple(self.graph.constraints),
            placed=frozenset(self.graph.members_of(self.graph.world)),
        )

    def around(self, reference: int) -> LocalMap:
        """Return the points of a keyframe and of its covisible neighbours."""
        T_world = self.graph.poses
        chosen = covisible(
            reference, self._neighbours[reference], T_world, self.settings.neighbours
        )
        return local_map([(self.keyframes[k], T_world[k]) for k in chosen])

    def _constraints(self, view: View, keyframe: Keyframe, estimate: Estimate) -> list[Constraint]:
        """Return constraints to neighbouring keyframes; without any, that of tracking."""
        located = self.aligner.tracker.guided(
            view, self.around(estimate.reference), estimate.T_camera_reference, scale=0.25
        )
        constraints = []
        if located is not None:
            measured = self.aligner.from_tracking(view, keyframe, self.keyframes, located)
            owners = located.local_map.owners[located.matches[:, 0]]
            for owner in np.unique(owners).tolist():
                chosen = located.matches[owners == owner]
                rows = np.column_stack([located.local_map.rows[chosen[:, 0]], chosen[:, 1]])
                self.local_bundle.match(keyframe, self.keyframes[owner], rows)
            constraints = [constraint for m in measured for constraint in m.constraints]
        if not constraints:
            T = estimate.anchor.T_keyframe_camera
            constraints.append(
                Constraint(
                    estimate.reference, keyframe.id, T, estimate.information, is_loop=False,
                    by="depth",
                )
            )  # fmt: skip
        return constraints

    def _add(self, constraint: Constraint) -> None:
        self.graph.add_constraint(constraint)
        self._neighbours[constraint.first].add(constraint.second)
        self._neighbours[constraint.second].add(constraint.first)

    def _forget(self, rejected: Constraint) -> None:
        """Remove a loop closure that turned out wrong."""
        ends = rejected.second, rejected.first
        self.closures = [c for c in self.closures if (c.keyframe, c.matched_keyframe) != ends]
        between = {rejected.first, rejected.second}
        if not any(
            {constraint.first, constraint.second} == between
            for constraint in self.graph.constraints
        ):
            self._neighbours[rejected.first].discard(rejected.second)
            self._neighbours[rejected.second].discard(rejected.first)
