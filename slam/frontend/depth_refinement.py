"""Depth refinement: poses of views with little texture, refined on keyframe surfaces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.settings import Settings
from roomgraph.slam.frontend.estimate import Estimate
from roomgraph.slam.geometry.chi_square import CHI2_984_6DOF
from roomgraph.slam.geometry.depth_alignment import Surface, align_surface, surface_of
from roomgraph.slam.geometry.noise import SensorNoise


class DepthRefinementSettings(Settings):
    """When a feature-based pose is refined by depth."""

    enabled: bool = Field(
        default=True, description="refine poses from few features by aligning depth surfaces"
    )
    inliers: int = Field(
        default=100,
        ge=0,
        description="poses with at least this many feature inliers are not refined",
    )
    columns: int = Field(
        default=80, ge=8, le=2000, description="number of columns of the depth image that are used"
    )
    max_surface_m: float = Field(
        default=0.05,
        gt=0,
        le=1,
        description="maximum distance between paired surface points, metres",
    )
    iterations: int = Field(default=4, ge=1, le=100, description="maximum number of iterations")


class DepthRefiner:
    """Aligns a view's depth with that of the keyframe that it is measured against.

    A few dozen features, all of them on a poster or along an edge, hold a pose badly; the walls
    and the floor around hold what they leave open. What depth asks for must lie within what the
    features allow: else these are believed.
    """

    def __init__(self, settings: DepthRefinementSettings, noise: SensorNoise) -> None:
        self.settings, self.noise = settings, noise
        self._keyframe: int | None = None
        self._frame: Frame | None = None
        self._surface: Surface | None = None

    def rest_on(self, keyframe: int, frame: Frame) -> None:
        """Use a new keyframe's depth as the reference of later views."""
        self._keyframe, self._frame, self._surface = keyframe, frame, None

    def refine(self, frame: Frame, estimate: Estimate) -> Estimate:
        """Return an estimate refined on the surfaces, or unchanged."""
        s = self.settings
        if not s.enabled or estimate.inliers >= s.inliers or estimate.reference != self._keyframe:
            return estimate
        if self._surface is None:
            assert self._frame is not None
            self._surface = self._thinned(self._frame)
        cloud = self._thinned(frame).cloud
        T = estimate.T_camera_reference
        # From the camera's frame to the keyframe's, which surfaces are aligned in.
        A = se3.adjoint(T)
        known = A.T @ estimate.information @ A
        T_reference_camera, found = align_surface(
            cloud,
            self._surface,
            T_target_cloud=se3.inverse(T),
            prior_information=known,
            noise=self.noise,
            max_distance_m=s.max_surface_m,
            iterations=s.iterations,
        )
        refined = se3.inverse(T_reference_camera)
        step = se3.logarithm(refined @ se3.inverse(T))
        # A step this long contradicts the features.
        if not found.any() or step @ estimate.information @ step >= CHI2_984_6DOF:
            return estimate
        back = se3.adjoint(T_reference_camera)
        return replace(
            estimate, T_camera_reference=refined,
            information=np.asarray(estimate.information + back.T @ found @ back),
        )  # fmt: skip

    def _thinned(self, frame: Frame) -> Surface:
        return surface_of(frame, max(1, frame.depth.shape[1] // self.settings.columns))
