"""The fine motion: reprojection and depth together, each by its own uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.geometry.chi_square import CHI2_95_3DOF
from roomgraph.slam.geometry.motion import Correspondences
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.normal_equations import HOLD, motion_equations

FloatArray = NDArray[np.float64]

# Robust kernels, as the powers of (1 + e / c) that they divide by.
CAUCHY, GEMAN_MCCLURE = 1, 2
# Metres and radians: steps as small as this.
NEARLY_AT_REST, AT_REST = 1e-3, 1e-5


@dataclass(frozen=True, slots=True)
class RefinedMotion:
    """A motion with what the measurements know of it.

    Attributes
    ----------
    T_camera_reference : (4, 4) float64
        Maps reference points to the camera.
    information : (6, 6) float64
        Inverse covariance in the camera's frame: rotation, then translation.
    inliers : (N,) bool
        Correspondences within the 95 % bound.
    """

    T_camera_reference: FloatArray
    information: FloatArray
    inliers: NDArray[np.bool_]

    @property
    def count(self) -> int:
        """How many correspondences agree."""
        return int(self.inliers.sum())


def refine_motion(
    T_camera_reference: FloatArray,
    found: Correspondences,
    intrinsics: Intrinsics,
    noise: SensorNoise,
    iterations: int = 50,
    width: float = 1.0,
) -> RefinedMotion:
    """Improve a motion by iteratively reweighted Gauss-Newton.

    Each correspondence has three residuals: two pixels and an inverse depth. Their covariance is
    the camera's noise plus that of the reference depth, carried through the projection, so a
    point measured from afar counts as little along its ray as it should. Cauchy's kernel tames
    the wrong matches; once at rest, Geman and McClure's takes its place, to which a pattern
    mistaken by one period means hardly anything. From the beginning that would cling to
    whatever few matches are near.

    Parameters
    ----------
    T_camera_reference : (4, 4) float64
        Where to start.
    found : Correspondences
        N of them, at least 3.
    width : float
        Of the kernel at first, in standard deviations; halved each time until it is 1. A wide one
        draws in a start that is some pixels off (graduated non-convexity).
    """
    system = _System(found, intrinsics, noise)
    T, power = T_camera_reference, CAUCHY
    for _ in range(iterations):
        _, H, g = system.at(T, CHI2_95_3DOF * width**2, power)
        step = -np.asarray(np.linalg.solve(H + HOLD * np.eye(6), g), np.float64)
        T = se3.exponential(step) @ T
        length = np.abs(step).max()
        if width > 1.0:
            width = max(1.0, width / 2)
        elif power == CAUCHY and length < NEARLY_AT_REST:
            power = GEMAN_MCCLURE
        elif length < AT_REST:
            break
    error, _, _ = system.at(T)
    inliers = error < CHI2_95_3DOF
    _, H, _ = _System(found.take(inliers), intrinsics, noise).at(T)
    return RefinedMotion(T, H, inliers)


class _System:
    """The equations of one motion.

    A correspondence's covariance is a diagonal, the camera's noise, plus that of the reference's
    depth, which lies along one ray.
    """

    def __init__(self, found: Correspondences, intrinsics: Intrinsics, noise: SensorNoise) -> None:
        z = found.points[:, 2:]
        self._measured = (
            found.points, found.points * (noise.depth_sigma(z) / z), found.pixels, found.depths,
            inverse_variances(found.depths, noise),
        )  # fmt: skip
        self._K = intrinsics.parameters

    def at(
        self, T: FloatArray, bound: float = np.inf, power: int = CAUCHY
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return squared errors (N,), standard deviations, and the system (6, 6), (6,) to solve.

        Without a `bound`, the squared error at which Cauchy's kernel counts a correspondence by
        half, all count in full.
        """
        return motion_equations(T, *self._measured, self._K, bound, power)


def inverse_variances(depths: FloatArray, noise: SensorNoise) -> FloatArray:
    """Return how much two pixels and an inverse depth count (N, 3), given the depths (N,)."""
    known = np.isfinite(depths)
    depths = np.where(known, depths, 1.0)
    inverse = np.full((len(depths), 3), noise.pixel**-2.0)
    inverse[:, 2] = np.where(known, (depths**2 / noise.depth_sigma(depths)) ** 2, 0.0)
    return inverse
