"""The fine motion: reprojection and depth together, each by its own uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from datasets import poses
from datasets.camera import Intrinsics
from slam.motion import Correspondences
from slam.noise import SensorNoise

FloatArray = NDArray[np.float64]

# 95 % of a chi-square with three degrees of freedom: two pixels and an inverse depth.
CHI2_95 = 7.81
NO_READING = 1e3
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
    iterations: int = 12,
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
    T = T_camera_reference
    spread = found.points * (noise.depth_sigma(found.points[:, 2]) / found.points[:, 2])[:, None]
    power = CAUCHY
    for _ in range(iterations):
        local = poses.transform(T, found.points)
        residual, J = residuals(local, found.pixels, found.depths, intrinsics)
        error, H, g = _normal_equations(
            T, residual, J, spread, found, noise, CHI2_95 * width**2, power
        )
        step = -np.asarray(np.linalg.solve(H + 1e-6 * np.eye(6), g), np.float64)
        T = poses.exponential(step) @ T
        length = np.abs(step).max()
        if width > 1.0:
            width = max(1.0, width / 2)
        elif power == CAUCHY and length < NEARLY_AT_REST:
            power = GEMAN_MCCLURE
        elif length < AT_REST:
            break
    local = poses.transform(T, found.points)
    residual, J = residuals(local, found.pixels, found.depths, intrinsics)
    error, _, _ = _normal_equations(T, residual, J, spread, found, noise, np.inf)
    inliers = (error < CHI2_95) & (local[:, 2] > 0)
    agreeing = found.take(inliers)
    _, H, _ = _normal_equations(
        T, residual[:, inliers], J[:, inliers], spread[inliers], agreeing, noise, np.inf
    )
    return RefinedMotion(T, H, inliers)


def residuals(
    points: FloatArray, pixels: FloatArray, depths: FloatArray, intrinsics: Intrinsics
) -> tuple[FloatArray, FloatArray]:
    """Compare points in the camera (N, 3) with the pixels (N, 2) and depths (N,) that it measured.

    Returns
    -------
    residual : (3, N) float64
        Two pixels and an inverse depth; this is 0 where the measured one is NaN.
    J : (3, N, 6) float64
        Their derivatives by a left step of the camera's motion.
    """
    x, y, z = points.T
    z = np.maximum(z, 1e-3)
    d = 1.0 / z
    u, v = x * d, y * d
    fx, fy = intrinsics.fx, intrinsics.fy
    known = np.isfinite(depths)
    residual = np.zeros((3, len(z)))
    residual[0] = fx * u + intrinsics.cx - pixels[:, 0]
    residual[1] = fy * v + intrinsics.cy - pixels[:, 1]
    residual[2, known] = d[known] - 1.0 / depths[known]
    J = np.zeros((3, len(z), 6))
    J[0, :, 0], J[0, :, 1], J[0, :, 2] = -fx * u * v, fx * (1 + u * u), -fx * v
    J[0, :, 3], J[0, :, 5] = fx * d, -fx * u * d
    J[1, :, 0], J[1, :, 1], J[1, :, 2] = -fy * (1 + v * v), fy * u * v, fy * u
    J[1, :, 4], J[1, :, 5] = fy * d, -fy * v * d
    d = np.where(known, d, 0.0)
    J[2, :, 0], J[2, :, 1], J[2, :, 5] = -v * d, u * d, -d * d
    return residual, J


def _normal_equations(
    T: FloatArray,
    residual: FloatArray,
    J: FloatArray,
    spread: FloatArray,
    found: Correspondences,
    noise: SensorNoise,
    bound: float,
    power: int = CAUCHY,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Weigh the residuals (3, N) by their covariances and by a robust kernel.

    The inverse covariance is a diagonal less one column times itself (Sherman & Morrison), so the
    sums are two matrix products.

    Parameters
    ----------
    spread : (N, 3) float64
        The standard deviations of the reference points, along their rays.
    bound : float
        Squared error at which Cauchy's kernel counts a residual by half; `inf` for no kernel.
    power : int
        Which kernel.

    Returns
    -------
    error, H, g : (N,), (6, 6), (6,) float64
        Squared errors in standard deviations, and the system to solve.
    """
    along = J[:, :, 3:] @ T[:3, :3]
    along = np.einsum("kni,ni->kn", along, spread)
    known = np.isfinite(found.depths)
    depths = np.where(known, found.depths, 1.0)
    inverse = np.full(along.shape, noise.pixel**-2)
    inverse[2] = np.where(known, depths**2 / noise.depth_sigma(depths), 1 / NO_READING) ** 2
    scaled = inverse * along
    share = 1.0 / (1.0 + (scaled * along).sum(axis=0))
    shift = (scaled * residual).sum(axis=0)
    error = (inverse * residual**2).sum(axis=0) - share * shift**2
    kernel = (1.0 + error / bound) ** -power
    weight = (inverse * kernel).reshape(-1, 1)
    column = np.einsum("kn,kni->ni", scaled, J)
    flat = J.reshape(-1, 6)
    less = column * (share * kernel)[:, None]
    H = (flat * weight).T @ flat - less.T @ column
    g = flat.T @ (weight[:, 0] * residual.ravel()) - less.T @ shift
    return error, H, g
