"""Bundle adjustment with depth: a few keyframes and the landmarks that they share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.geometry.chi_square import CHI2_95_3DOF
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.normal_equations import (
    HOLD,
    bundle_equations,
    bundle_errors,
    landmark_steps,
)
from roomgraph.slam.geometry.refinement import inverse_variances

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Observations:
    """Observations of landmarks by cameras; each camera sees a landmark at most once.

    Attributes
    ----------
    cameras, landmarks : (N,) int
        Which camera sees which landmark.
    pixels : (N, 2) float64
        Where.
    depths : (N,) float64
        How far, metres; NaN without a reading.
    """

    cameras: NDArray[np.intp]
    landmarks: NDArray[np.intp]
    pixels: FloatArray
    depths: FloatArray

    def __len__(self) -> int:
        return len(self.cameras)

    def take(self, rows: NDArray[np.intp]) -> Observations:
        """Return the selected observations."""
        return Observations(
            self.cameras[rows], self.landmarks[rows], self.pixels[rows], self.depths[rows]
        )


@dataclass(frozen=True, slots=True)
class Adjusted:
    """The outcome of an adjustment.

    Attributes
    ----------
    T_camera_world : (K, 4, 4) float64
        All cameras; those held are as they were.
    landmarks : (L, 3) float64
        In the world, metres.
    inliers : (N,) bool
        Observations within the 95 % bound.
    """

    T_camera_world: FloatArray
    landmarks: FloatArray
    inliers: NDArray[np.bool_]


def adjust(
    T_camera_world: FloatArray,
    is_free: NDArray[np.bool_],
    landmarks: FloatArray,
    seen: Observations,
    intrinsics: Intrinsics,
    noise: SensorNoise,
    iterations: int = 5,
) -> Adjusted:
    """Adjust cameras and landmarks to fit the observations best.

    Gauss-Newton on two pixels and an inverse depth an observation, with Geman and McClure's
    kernel; landmarks are eliminated first (Schur complement; Triggs et al., 2000, section 6.1),
    so that the system solved is as large as the cameras are many.

    Parameters
    ----------
    T_camera_world : (K, 4, 4) float64
        Where the cameras are believed to be.
    is_free : (K,) bool
        Which of them may move; at least one may not.
    landmarks : (L, 3) float64
        Where they are believed to be.
    """
    system = _System(seen, is_free, intrinsics, noise)
    T, points = T_camera_world.copy(), landmarks.copy()
    for _ in range(iterations):
        step, moves = system.solve(T, points)
        for xi, k in zip(step, np.flatnonzero(is_free), strict=True):
            T[k] = se3.exponential(xi) @ T[k]
        points += moves
        if not len(step) or np.abs(step).max() < 1e-4:
            break
    return Adjusted(T, points, system.errors(T, points) < CHI2_95_3DOF)


class _System:
    """The equations of one adjustment."""

    def __init__(
        self,
        seen: Observations,
        is_free: NDArray[np.bool_],
        intrinsics: Intrinsics,
        noise: SensorNoise,
    ) -> None:
        self._order = np.argsort(seen.landmarks, kind="stable")
        seen = seen.take(self._order)
        self._seen = seen.cameras, seen.landmarks
        self._measured = (
            *self._seen, seen.pixels, seen.depths, inverse_variances(seen.depths, noise),
            intrinsics.parameters,
        )  # fmt: skip
        self._free = int(is_free.sum())
        self._slots = np.where(is_free, np.cumsum(is_free) - 1, -1)

    def errors(self, T: FloatArray, points: FloatArray) -> FloatArray:
        """Return the observations' squared errors (N,), standard deviations; inf when behind."""
        errors = np.empty(len(self._order))
        errors[self._order] = bundle_errors(T, points, *self._measured)
        return errors

    def solve(self, T: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the steps of the free cameras (K', 6) and of all landmarks (L, 3)."""
        H, g, *of_landmarks = bundle_equations(
            T, self._slots, self._free, points, *self._measured, CHI2_95_3DOF
        )
        step = -np.asarray(np.linalg.solve(H + HOLD * np.eye(len(g)), g), np.float64)
        steps = step.reshape(-1, 6)
        return steps, landmark_steps(steps, self._slots, *self._seen, *of_landmarks)
