"""Bundle adjustment with depth: a few keyframes and the landmarks that they share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from datasets import poses
from datasets.camera import Intrinsics
from slam.noise import SensorNoise
from slam.refine import CHI2_95, NO_READING

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Observations:
    """What cameras see of landmarks; each camera sees a landmark at most once.

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
    """Move cameras and landmarks to where the observations fit best.

    Gauss-Newton on two pixels and an inverse depth an observation, with Cauchy's kernel; landmarks
    are eliminated first (Schur complement; Triggs et al., 2000, section 6.1), so that the system
    solved is as large as the cameras are many.

    Parameters
    ----------
    T_camera_world : (K, 4, 4) float64
        Where the cameras are believed to be.
    is_free : (K,) bool
        Which of them may move; at least one may not.
    landmarks : (L, 3) float64
        Where they are believed to be.
    """
    T, points = T_camera_world.copy(), landmarks.copy()
    slots = np.cumsum(is_free) - 1
    free = np.flatnonzero(is_free)
    for _ in range(iterations):
        residual, J_camera, J_point, weight = _linearise(T, points, seen, intrinsics, noise)
        step, moves = _solve(
            residual, J_camera, J_point, weight, seen, is_free, slots, len(free), len(points)
        )
        T[free] = np.array(
            [poses.exponential(xi) @ T[k] for xi, k in zip(step, free, strict=True)]
        ).reshape(-1, 4, 4)
        points += moves
        if not len(free) or np.abs(step).max() < 1e-4:
            break
    error = _errors(*_residuals(T, points, seen, intrinsics)[:2], seen, noise)
    return Adjusted(T, points, error < CHI2_95)


def _residuals(
    T: FloatArray, points: FloatArray, seen: Observations, intrinsics: Intrinsics
) -> tuple[FloatArray, FloatArray]:
    """Return residuals (N, 3), pixels and inverse depth, and the points in their cameras (N, 3)."""
    of_camera = T[seen.cameras]
    local = (of_camera[:, :3, :3] @ points[seen.landmarks][..., None])[..., 0] + of_camera[:, :3, 3]
    z = np.maximum(local[:, 2], 1e-2)
    residual = np.empty((len(local), 3))
    residual[:, 0] = intrinsics.fx * local[:, 0] / z + intrinsics.cx - seen.pixels[:, 0]
    residual[:, 1] = intrinsics.fy * local[:, 1] / z + intrinsics.cy - seen.pixels[:, 1]
    residual[:, 2] = np.where(np.isfinite(seen.depths), 1.0 / z - 1.0 / seen.depths, 0.0)
    return residual, local


def _inverse_variances(seen: Observations, noise: SensorNoise) -> FloatArray:
    """Return how much each residual (N, 3) counts."""
    depths = np.where(np.isfinite(seen.depths), seen.depths, 1.0)
    sigma = np.where(np.isfinite(seen.depths), noise.depth_sigma(depths) / depths**2, NO_READING)
    pixel = np.full(len(sigma), noise.pixel)
    return np.asarray(np.column_stack([pixel, pixel, sigma]) ** -2.0)


def _errors(
    residual: FloatArray, local: FloatArray, seen: Observations, noise: SensorNoise
) -> FloatArray:
    """Return the squared errors (N,) in standard deviations; infinite behind the camera."""
    error = (residual**2 * _inverse_variances(seen, noise)).sum(axis=1)
    return np.where(local[:, 2] > 0, error, np.inf)


def _linearise(
    T: FloatArray,
    points: FloatArray,
    seen: Observations,
    intrinsics: Intrinsics,
    noise: SensorNoise,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return residuals (N, 3), derivatives by camera (N, 3, 6) and point (N, 3, 3), weights."""
    residual, local = _residuals(T, points, seen, intrinsics)
    z = np.maximum(local[:, 2], 1e-2)
    by_local = np.zeros((len(local), 3, 3))
    by_local[:, 0, 0] = intrinsics.fx / z
    by_local[:, 1, 1] = intrinsics.fy / z
    by_local[:, 0, 2] = -intrinsics.fx * local[:, 0] / z**2
    by_local[:, 1, 2] = -intrinsics.fy * local[:, 1] / z**2
    by_local[:, 2, 2] = np.where(np.isfinite(seen.depths), -1.0 / z**2, 0.0)
    J_camera = np.concatenate([-by_local @ poses.hat(local), by_local], axis=2)
    J_point = by_local @ T[seen.cameras][:, :3, :3]
    error = _errors(residual, local, seen, noise)
    weight = _inverse_variances(seen, noise) / (1.0 + error / CHI2_95)[:, None]
    return residual, J_camera, J_point, weight


def _solve(
    residual: FloatArray,
    J_camera: FloatArray,
    J_point: FloatArray,
    weight: FloatArray,
    seen: Observations,
    is_free: NDArray[np.bool_],
    slots: NDArray[np.intp],
    cameras: int,
    landmarks: int,
) -> tuple[FloatArray, FloatArray]:
    """Return the steps of the free cameras (K', 6) and of all landmarks (L, 3)."""
    WJ_point = J_point * weight[:, :, None]
    H_points = _sums(np.swapaxes(WJ_point, 1, 2) @ J_point, seen.landmarks, landmarks)
    g_points = _sums((WJ_point * residual[:, :, None]).sum(axis=1), seen.landmarks, landmarks)
    inverse = np.linalg.inv(H_points + 1e-6 * np.eye(3))
    moving = is_free[seen.cameras]
    slot, landmark = slots[seen.cameras[moving]], seen.landmarks[moving]
    J, r = J_camera[moving], residual[moving]
    WJ = np.swapaxes(J * weight[moving][:, :, None], 1, 2)
    H = np.zeros((cameras, 6, cameras, 6))
    H[np.arange(cameras), :, np.arange(cameras), :] = _sums(WJ @ J, slot, cameras)
    g = _sums((WJ @ r[..., None])[..., 0], slot, cameras)
    # What couples cameras and landmarks, (6 K', 3 L): each pair at most once.
    couples = WJ @ J_point[moving]
    coupling, eliminated = np.zeros((2, cameras, 6, landmarks, 3))
    coupling[slot, :, landmark, :] = couples
    eliminated[slot, :, landmark, :] = couples @ inverse[landmark]
    flat, gone = coupling.reshape(6 * cameras, -1), eliminated.reshape(6 * cameras, -1)
    reduced = H.reshape(6 * cameras, 6 * cameras) - gone @ flat.T
    right = g.ravel() - gone @ g_points.ravel()
    step = -np.asarray(np.linalg.solve(reduced + 1e-6 * np.eye(6 * cameras), right), np.float64)
    moves = -(g_points + (flat.T @ step).reshape(-1, 3))
    return step.reshape(-1, 6), np.einsum("lij,lj->li", inverse, moves)


def _sums(values: FloatArray, groups: NDArray[np.intp], count: int) -> FloatArray:
    """Return the sum of the values (N, ...) of each of `count` groups."""
    flat = values.reshape(len(values), -1)
    columns = [np.bincount(groups, weights=column, minlength=count) for column in flat.T]
    stacked = np.stack(columns, axis=1).astype(np.float64)
    return stacked.reshape(count, *values.shape[1:])
