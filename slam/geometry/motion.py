"""The coarse motion between matched features: Procrustes or PnP, inside RANSAC."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.noise import SensorNoise

FloatArray = NDArray[np.float64]
Method = Literal["pnp", "procrustes"]


class MotionSettings(Settings):
    """How the coarse motion is found."""

    method: Method = Field(default="pnp", description="pnp (3-D to 2-D) or procrustes (3-D to 3-D)")
    iterations: int = Field(
        default=300, ge=10, le=100_000, description="maximum number of RANSAC hypotheses"
    )
    pixel_threshold: float = Field(
        default=3.0, gt=0, le=50, description="maximum reprojection error of an inlier, pixels"
    )
    sigma_threshold: float = Field(
        default=3.0, gt=0, le=20, description="maximum 3-D error of an inlier, standard deviations"
    )
    min_inliers: int = Field(
        default=15, ge=6, description="minimum number of inlier matches for a motion"
    )


@dataclass(frozen=True, slots=True)
class Correspondences:
    """Points seen from one camera and found again by another.

    Attributes
    ----------
    points : (N, 3) float64
        In the reference camera, metres.
    pixels : (N, 2) float64
        Where the second camera sees them.
    depths : (N,) float64
        What the second camera measures there, metres; NaN where it has no reading.
    """

    points: FloatArray
    pixels: FloatArray
    depths: FloatArray

    def __len__(self) -> int:
        return len(self.points)

    def take(self, chosen: NDArray[np.generic]) -> Correspondences:
        """Return the chosen ones, by mask or index."""
        return Correspondences(self.points[chosen], self.pixels[chosen], self.depths[chosen])


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion that `inliers` (N,) of the correspondences agree with."""

    T_camera_reference: FloatArray
    inliers: NDArray[np.bool_]

    @property
    def count(self) -> int:
        """How many agree."""
        return int(self.inliers.sum())


def procrustes(source: FloatArray, target: FloatArray) -> FloatArray:
    """Return the rigid motions that map `source` to `target` best, in closed form by SVD.

    The orthogonal Procrustes problem with a proper rotation (Kostavelis & Gasteratos, 2013,
    section 3.1.1, equation 1; Umeyama, 1991).

    Parameters
    ----------
    source, target : (..., N, 3) float64
        Matched points, N >= 3.

    Returns
    -------
    (..., 4, 4) float64
    """
    source_mean, target_mean = source.mean(-2, keepdims=True), target.mean(-2, keepdims=True)
    covariance = np.swapaxes(target - target_mean, -1, -2) @ (source - source_mean)
    U, _, Vt = np.linalg.svd(covariance)
    U[..., :, 2] *= np.sign(np.linalg.det(U @ Vt))[..., None]
    T = np.zeros((*covariance.shape[:-2], 4, 4))
    R = U @ Vt
    T[..., :3, :3] = R
    T[..., :3, 3] = (target_mean - source_mean @ np.swapaxes(R, -1, -2))[..., 0, :]
    T[..., 3, 3] = 1
    return T


def estimate_motion(
    found: Correspondences,
    intrinsics: Intrinsics,
    noise: SensorNoise,
    settings: MotionSettings,
    seed: int = 0,
) -> Motion | None:
    """Return the motion that most correspondences agree with, or None if too few do."""
    if len(found) < settings.min_inliers:
        return None
    if settings.method == "pnp":
        motion = _pnp(found, intrinsics, settings, seed)
    else:
        motion = _procrustes_ransac(found, intrinsics, noise, settings, seed)
    return motion if motion is not None and motion.count >= settings.min_inliers else None


def _pnp(
    found: Correspondences, intrinsics: Intrinsics, settings: MotionSettings, seed: int
) -> Motion | None:
    parameters = cv2.UsacParams()
    parameters.threshold = settings.pixel_threshold
    parameters.maxIterations = settings.iterations
    parameters.confidence = 0.999
    parameters.score = cv2.SCORE_METHOD_MSAC
    parameters.sampler = cv2.SAMPLING_UNIFORM
    parameters.loMethod = cv2.LOCAL_OPTIM_INNER_LO
    parameters.randomGeneratorState = seed
    success, _, rotation, translation, inliers = cv2.solvePnPRansac(
        found.points, found.pixels, intrinsics.K, None, params=parameters
    )
    if not success or inliers is None:
        return None
    mask = np.zeros(len(found), dtype=bool)
    mask[inliers.ravel()] = True
    T = se3.pose(cv2.Rodrigues(rotation)[0], translation.ravel())
    return Motion(T, mask) if np.all(np.isfinite(T)) else None


def _procrustes_ransac(
    found: Correspondences,
    intrinsics: Intrinsics,
    noise: SensorNoise,
    settings: MotionSettings,
    seed: int,
) -> Motion | None:
    """Try minimal samples of three point pairs, all at once, and refit on the inliers."""
    known = np.flatnonzero(np.isfinite(found.depths))
    if len(known) < settings.min_inliers:
        return None
    source = found.points[known]
    target = intrinsics.backproject(found.pixels[known], found.depths[known])
    rng = np.random.default_rng(seed)
    samples = np.argsort(rng.random((settings.iterations, len(known))), axis=1)[:, :3]
    sigma = noise.depth_sigma(source[:, 2]) + noise.depth_sigma(target[:, 2])
    allowed = settings.sigma_threshold * sigma

    def agreeing(T: FloatArray) -> NDArray[np.bool_]:
        moved = source @ np.swapaxes(T[..., :3, :3], -1, -2) + T[..., None, :3, 3]
        return np.asarray(np.linalg.norm(moved - target, axis=-1) < allowed)

    hypotheses = procrustes(source[samples], target[samples])
    best = agreeing(hypotheses).sum(axis=-1).argmax()
    T, mask = hypotheses[best], agreeing(hypotheses[best])
    for _ in range(3):
        if mask.sum() < settings.min_inliers:
            return None
        T = procrustes(source[mask], target[mask])
        mask = agreeing(T)
    every = np.zeros(len(found), dtype=bool)
    every[known[mask]] = True
    return Motion(T, every)
