"""Bundle adjustment with depth: a few keyframes and the landmarks that they share."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from datasets import poses
from datasets.camera import Intrinsics
from slam.noise import SensorNoise
from slam.refine import CHI2_95, NO_READING, residuals

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

    def take(self, rows: NDArray[np.intp]) -> Observations:
        """Return the chosen ones."""
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
    """Move cameras and landmarks to where the observations fit best.

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
    system = _System(seen, is_free, len(landmarks), intrinsics, noise)
    T, points = T_camera_world.copy(), landmarks.copy()
    for _ in range(iterations):
        step, moves = system.solve(T, points)
        for xi, k in zip(step, np.flatnonzero(is_free), strict=True):
            T[k] = poses.exponential(xi) @ T[k]
        points += moves
        if not len(step) or np.abs(step).max() < 1e-4:
            break
    return Adjusted(T, points, system.errors(T, points) < CHI2_95)


class _System:
    """The equations of one adjustment, camera by camera."""

    def __init__(
        self,
        seen: Observations,
        is_free: NDArray[np.bool_],
        landmarks: int,
        intrinsics: Intrinsics,
        noise: SensorNoise,
    ) -> None:
        self.intrinsics, self.is_free, self.landmarks = intrinsics, is_free, landmarks
        self._order = np.argsort(seen.cameras, kind="stable")
        self.seen = seen.take(self._order)
        ends = np.searchsorted(self.seen.cameras, np.arange(len(is_free) + 1)).tolist()
        self._of_camera = [slice(a, b) for a, b in pairwise(ends)]
        self._inverse_variance = _inverse_variances(self.seen, noise)

    def errors(self, T: FloatArray, points: FloatArray) -> FloatArray:
        """Return the observations' squared errors (N,), standard deviations; inf when behind."""
        local = self._in_cameras(T, points)
        residual, _ = residuals(local, self.seen.pixels, self.seen.depths, self.intrinsics)
        error = (self._inverse_variance * residual**2).sum(axis=0)
        errors = np.empty(len(error))
        errors[self._order] = np.where(local[:, 2] > 0, error, np.inf)
        return errors

    def solve(self, T: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the steps of the free cameras (K', 6) and of all landmarks (L, 3)."""
        local = self._in_cameras(T, points)
        residual, J = residuals(local, self.seen.pixels, self.seen.depths, self.intrinsics)
        error = (self._inverse_variance * residual**2).sum(axis=0)
        weight = self._inverse_variance / (1.0 + error / CHI2_95) ** 2
        cameras = int(self.is_free.sum())
        H, g = np.zeros((cameras, 6, cameras, 6)), np.zeros((cameras, 6))
        # Of each landmark: its Hessian, its gradient.
        H_points, g_points = np.zeros((self.landmarks, 3, 3)), np.zeros((self.landmarks, 3))
        coupling = np.zeros((cameras, 6, self.landmarks, 3))
        WJ = J * weight[:, :, None]
        slot = 0
        for k, rows in enumerate(self._of_camera):
            # A camera sees a landmark once, so that indices do not repeat.
            landmarks, r = self.seen.landmarks[rows], residual[:, rows]
            WJ_point = np.swapaxes(WJ[:, rows, 3:] @ T[k, :3, :3], 0, 1)
            J_point = np.swapaxes(J[:, rows, 3:] @ T[k, :3, :3], 0, 1)
            H_points[landmarks] += np.swapaxes(WJ_point, 1, 2) @ J_point
            g_points[landmarks] += (r.T[:, None] @ WJ_point)[:, 0]
            if self.is_free[k]:
                own = WJ[:, rows].reshape(-1, 6)
                H[slot, :, slot] = own.T @ J[:, rows].reshape(-1, 6)
                g[slot] = own.T @ r.ravel()
                coupling[slot][:, landmarks] = np.swapaxes(
                    J[:, rows].transpose(1, 2, 0) @ WJ_point, 0, 1
                )
                slot += 1
        return _eliminate(
            H.reshape(6 * cameras, -1), g.ravel(), coupling.reshape(6 * cameras, -1, 3),
            H_points, g_points,
        )  # fmt: skip

    def _in_cameras(self, T: FloatArray, points: FloatArray) -> FloatArray:
        """Return what is observed (N, 3), each in the camera that observes it."""
        local = points[self.seen.landmarks]
        for k, rows in enumerate(self._of_camera):
            local[rows] = poses.transform(T[k], local[rows])
        return local


def _eliminate(
    H: FloatArray, g: FloatArray, coupling: FloatArray, H_points: FloatArray, g_points: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Solve for the cameras (6 K') without the landmarks (L), then for these.

    Parameters
    ----------
    H, g : (6 K', 6 K'), (6 K',) float64
        Of the cameras.
    coupling : (6 K', L, 3) float64
        Of cameras and landmarks.
    H_points, g_points : (L, 3, 3), (L, 3) float64
        Of the landmarks.
    """
    inverse = np.linalg.inv(H_points + 1e-6 * np.eye(3))
    moved = np.einsum("lij,lj->li", inverse, g_points)
    flat = coupling.reshape(len(g), -1)
    # Batched by landmark: a product of many small matrices.
    gone = np.matmul(coupling.transpose(1, 0, 2), inverse).transpose(1, 0, 2).reshape(len(g), -1)
    reduced = H - gone @ flat.T + 1e-6 * np.eye(len(g))
    step = -np.asarray(np.linalg.solve(reduced, g - flat @ moved.ravel()), np.float64)
    moves = -moved - (gone.T @ step).reshape(-1, 3)
    return step.reshape(-1, 6), moves


def _inverse_variances(seen: Observations, noise: SensorNoise) -> FloatArray:
    """Return how much each residual (3, N) counts."""
    known = np.isfinite(seen.depths)
    depths = np.where(known, seen.depths, 1.0)
    sigma = np.where(known, noise.depth_sigma(depths) / depths**2, NO_READING)
    pixel = np.full(len(sigma), noise.pixel)
    return np.asarray(np.stack([pixel, pixel, sigma]) ** -2.0)
