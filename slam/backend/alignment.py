"""Measuring the motion between two keyframes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.backend.pose_graph import Constraint
from roomgraph.slam.features.matching import match
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.local_map import local_map
from roomgraph.slam.frontend.tracker import Located, Tracker, correspondences, one_a_position
from roomgraph.slam.geometry.chi_square import CHI2_984_6DOF
from roomgraph.slam.geometry.depth_alignment import (
    Surface,
    align_surface,
    surface_of_image,
)
from roomgraph.slam.geometry.icp import IcpSettings, align_planes
from roomgraph.slam.geometry.motion import Motion, estimate_motion, procrustes
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.refinement import RefinedMotion, refine_motion
from roomgraph.slam.keyframe import Keyframe

FloatArray = NDArray[np.float64]

# Number of strongest features of each side that are compared first, and how many must agree.
GLANCE = 300
GLANCE_INLIERS = 8


@dataclass(frozen=True, slots=True)
class Measured:
    """What was measured between two keyframes.

    Attributes
    ----------
    constraint : Constraint
        By matched features.
    inliers : int
        How many matches it rests on.
    by_depth : Constraint or None
        By the surface that both see, where it agrees with the features; it knows nothing of the
        directions in which surface slides on surface.
    """

    constraint: Constraint
    inliers: int
    by_depth: Constraint | None = None

    @property
    def constraints(self) -> list[Constraint]:
        """All measured constraints."""
        return [self.constraint] if self.by_depth is None else [self.constraint, self.by_depth]


class KeyframeAligner:
    """Measures constraints from matched features, and refines them on common planes."""

    def __init__(self, tracker: Tracker, icp: IcpSettings, noise: SensorNoise) -> None:
        self.tracker, self.icp, self.noise = tracker, icp, noise
        self._latest: tuple[int, Surface] | None = None

    def from_tracking(
        self, view: View, keyframe: Keyframe, owners: dict[int, Keyframe], located: Located
    ) -> list[Measured]:
        """Return a constraint to each keyframe of the local map that shares enough matches."""
        measured = []
        for owner_id, count in located.matches_by_owner().items():
            if count < self.tracker.settings.min_inliers:
                continue
            owner = owners[owner_id]
            chosen = located.matches[located.local_map.owners[located.matches[:, 0]] == owner_id]
            rows = np.column_stack([located.local_map.rows[chosen[:, 0]], chosen[:, 1]])
            found = correspondences(owner.points, view, rows)
            start = self._start(found.points, chosen, located)
            motion = refine_motion(start, found, view.frame.intrinsics, self.noise)
            if motion.count >= self.tracker.settings.min_inliers:
                measured.append(self._measure(keyframe, owner, motion, is_loop=False))
        return measured

    def between(self, view: View, keyframe: Keyframe, other: Keyframe) -> Measured | None:
        """Return a loop constraint to a keyframe whose relative pose is not known, or None."""
        coarse = self._at_a_glance(view, other)
        if coarse is None:
            return None
        T_camera_other = coarse.T_camera_reference
        located = self.tracker.track(view, local_map([(other, np.eye(4))]), T_camera_other)
        if located is None:
            return None
        return self._measure(keyframe, other, located.motion, is_loop=True)

    def _at_a_glance(self, view: View, other: Keyframe) -> Motion | None:
        """Return a motion from the strongest features; it rejects most wrong candidates."""
        known = np.flatnonzero(np.isfinite(other.points[:, 2]))[:GLANCE]
        pairs = match(
            other.features.descriptors[known], view.features.descriptors[:GLANCE],
            self.tracker.settings.ratio,
        )  # fmt: skip
        pairs[:, 0] = known[pairs[:, 0]]
        found = correspondences(other.points, view, one_a_position(pairs, view.features.pixels))
        settings = self.tracker.motion.model_copy(update={"min_inliers": GLANCE_INLIERS})
        return estimate_motion(
            found, view.frame.intrinsics, self.noise, settings, self.tracker.seed
        )

    def _surface(self, keyframe: Keyframe) -> Surface:
        """Return a keyframe's surface, cached because it is aligned with several others in turn."""
        if self._latest is None or self._latest[0] != keyframe.id:
            self._latest = keyframe.id, surface_of_image(keyframe.image, self.noise)
        return self._latest[1]

    def _start(self, points: FloatArray, chosen: NDArray[np.intp], located: Located) -> FloatArray:
        """Return T_camera_owner from two positions of the same points: a closed-form fit."""
        T_reference_owner = procrustes(points, located.local_map.points[chosen[:, 0]])
        return located.motion.T_camera_reference @ T_reference_owner

    def _measure(
        self, keyframe: Keyframe, other: Keyframe, motion: RefinedMotion, is_loop: bool
    ) -> Measured:
        """Build constraints from a feature-based motion and from planes that both keyframes see."""
        T_keyframe_other, information = motion.T_camera_reference, motion.information
        constraint = Constraint(
            other.id, keyframe.id, se3.inverse(T_keyframe_other), information, is_loop
        )
        fine = self._align(keyframe, other, T_keyframe_other, information)
        return Measured(constraint, motion.count, fine and replace(fine, is_loop=is_loop))

    def _align(
        self,
        keyframe: Keyframe,
        other: Keyframe,
        T_keyframe_other: FloatArray,
        information: FloatArray,
    ) -> Constraint | None:
        """Align the depth that both keyframes see; None if that contradicts the features."""
        if self.icp.on == "nothing":
            return None
        if self.icp.on == "planes":
            aligned = align_planes(
                other.planes,
                keyframe.planes,
                T_target_source=T_keyframe_other,
                prior_information=information,
                noise=self.noise,
                settings=self.icp,
            )
            if aligned is None or not aligned.improves:
                return None
            T, H = aligned.T_target_source, aligned.information
        else:
            T, H = align_surface(
                other.image.every(2).points.astype(np.float64),
                self._surface(keyframe),
                T_target_cloud=T_keyframe_other,
                prior_information=information,
                noise=self.noise,
                max_distance_m=self.icp.max_surface_m,
                iterations=self.icp.iterations,
            )
        step = se3.logarithm(T @ se3.inverse(T_keyframe_other))
        # The features must still agree, and depth must know something.
        if step @ information @ step >= CHI2_984_6DOF or not H.any():
            return None
        by: Literal["planes", "surface"] = "planes" if self.icp.on == "planes" else "surface"
        return Constraint(other.id, keyframe.id, se3.inverse(T), H, is_loop=False, by=by)
