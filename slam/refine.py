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
    iterations: int = 10,
    width: float = 1.0,
) -> RefinedMotion:
    """Improve a motion by iteratively reweighted Gauss-Newton.

    Each correspondence has three residuals: two pixels and an inverse depth. Their covariance is
    the camera's noise plus that of the reference depth, carried through the projection, so a
    point measured from afar counts as little along its ray as it should. Cauchy's kernel tames
    the wrong matches.

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
    rays = found.points / found.points[:, 2:]
    sigma_reference = noise.depth_sigma(found.points[:, 2])
    for _ in range(iterations):
        residual, J = _residuals(T, found, intrinsics)
        W = _weights(T, J, rays * sigma_reference[:, None], found, noise)
        error = np.einsum("ni,nij,nj->n", residual, W, residual)
        W *= (1.0 / (1.0 + error / (CHI2_95 * width**2)))[:, None, None]
        JW = np.swapaxes(J, 1, 2) @ W
        H = (JW @ J).sum(axis=0)
        step = -np.linalg.solve(H + 1e-6 * np.eye(6), (JW @ residual[..., None]).sum(axis=0)[:, 0])
        T = poses.exponential(step) @ T
        if width == 1.0 and np.abs(step).max() < 1e-5:
            break
        width = max(1.0, width / 2)
    residual, J = _residuals(T, found, intrinsics)
    W = _weights(T, J, rays * sigma_reference[:, None], found, noise)
    error = np.einsum("ni,nij,nj->n", residual, W, residual)
    inliers = (error < CHI2_95) & (poses.transform(T, found.points)[:, 2] > 0)
    J, W = J[inliers], W[inliers]
    return RefinedMotion(T, (np.swapaxes(J, 1, 2) @ W @ J).sum(axis=0), inliers)


def _residuals(
    T: FloatArray, found: Correspondences, intrinsics: Intrinsics
) -> tuple[FloatArray, FloatArray]:
    """Return residuals (N, 3) and their derivatives (N, 3, 6) by a left step of `T`."""
    points = poses.transform(T, found.points)
    z = np.maximum(points[:, 2], 1e-3)
    residual = np.zeros((len(points), 3))
    projected = points[:, :2] / z[:, None]
    residual[:, :2] = projected * (intrinsics.fx, intrinsics.fy)
    residual[:, :2] += np.array([intrinsics.cx, intrinsics.cy]) - found.pixels
    known = np.isfinite(found.depths)
    residual[known, 2] = 1.0 / z[known] - 1.0 / found.depths[known]
    by_point = np.zeros((len(points), 3, 3))
    by_point[:, 0, 0] = intrinsics.fx / z
    by_point[:, 1, 1] = intrinsics.fy / z
    by_point[:, 0, 2] = -intrinsics.fx * projected[:, 0] / z
    by_point[:, 1, 2] = -intrinsics.fy * projected[:, 1] / z
    by_point[:, 2, 2] = np.where(known, -1.0 / z**2, 0.0)
    return residual, np.concatenate([-by_point @ poses.hat(points), by_point], axis=2)


def _weights(
    T: FloatArray,
    J: FloatArray,
    spread: FloatArray,
    found: Correspondences,
    noise: SensorNoise,
) -> FloatArray:
    """Return the inverse covariances (N, 3, 3) of the residuals."""
    along = (J[:, :, 3:] @ (spread @ T[:3, :3].T)[..., None])[..., 0]
    known = np.isfinite(found.depths)
    depths = np.where(known, found.depths, 1.0)
    inverse = np.full(along.shape, noise.pixel**-2)
    inverse[:, 2] = np.where(known, depths**2 / noise.depth_sigma(depths), 1 / NO_READING) ** 2
    # The covariance is a diagonal and one column times itself: inverted after Sherman & Morrison.
    scaled = inverse * along
    weights = -scaled[:, :, None] * scaled[:, None, :]
    weights /= (1.0 + (scaled * along).sum(axis=1))[:, None, None]
    weights[:, (0, 1, 2), (0, 1, 2)] += inverse
    return weights
