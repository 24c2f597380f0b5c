"""Measuring the focal lengths from the motion between the frames."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.settings import Settings
from roomgraph.slam.features.extraction import FeatureExtractor, FeatureSettings
from roomgraph.slam.features.matching import match
from roomgraph.slam.features.view import View
from roomgraph.slam.geometry.chi_square import CHI2_95_3DOF
from roomgraph.slam.geometry.motion import Correspondences, MotionSettings, estimate_motion
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.refinement import refine_motion

FloatArray = NDArray[np.float64]

# Focal lengths that the search starts from, in units of the given ones.
STARTS = (1.0, 0.8, 1.25)
# Focal lengths further off than this, as a logarithm, are not to be believed.
FARTHEST = np.log(4.0)
# Steps of the adjustment; it ends when focal lengths move less than the last.
ITERATIONS, CONVERGED = 15, 1e-4


class CalibrationSettings(Settings):
    """How focal lengths are measured from the images, and when wrong ones are reported."""

    tolerance: float = Field(
        default=0.07,
        gt=0,
        lt=1,
        description="largest focal length error that is not reported, as a share",
    )
    min_sigmas: float = Field(
        default=5.0, ge=1, description="minimum focal length error to report, standard errors"
    )
    min_pairs: int = Field(
        default=4, ge=2, description="minimum number of frame pairs to measure focal lengths"
    )
    min_matches: int = Field(
        default=60, ge=20, description="minimum number of matches in a pair of frames"
    )
    features: int = Field(default=600, ge=50, description="number of features matched per frame")
    ratio: float = Field(
        default=0.75,
        gt=0,
        lt=1,
        description="maximum ratio of the nearest to the second nearest descriptor distance "
        "(ratio test)",
    )
    principal_share: float = Field(
        default=0.02, gt=0, lt=0.5,
        description="likely error of the principal point, as a share of the image's width",
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Pair:
    """Features of one frame, with depth, found again in another.

    Attributes
    ----------
    camera : Intrinsics
        As given.
    pixels : (N, 2) float64
        In the first frame.
    depths : (N,) float64
        There, metres.
    seen : (N, 2) float64
        In the second frame.
    depths_seen : (N,) float64
        There, metres; NaN without a reading.
    """

    camera: Intrinsics
    pixels: FloatArray
    depths: FloatArray
    seen: FloatArray
    depths_seen: FloatArray

    def under(self, camera: Intrinsics) -> Correspondences:
        """Return the points that a camera would make of them."""
        return Correspondences(
            camera.backproject(self.pixels, self.depths), self.seen, self.depths_seen
        )


@dataclass(frozen=True, slots=True)
class Focal:
    """Focal lengths that fit best, and the standard error (2,) of their logarithms."""

    fx: float
    fy: float
    sigma: FloatArray


def pair_of(first: Frame, others: Iterable[Frame], settings: CalibrationSettings) -> Pair | None:
    """Match a frame with the first of the others that shows enough of the same."""
    # The halved image serves: where that shows little, the whole one would cost more than it gives.
    extractor = FeatureExtractor(FeatureSettings(max_features=settings.features, min_features=0))
    start = View(first, extractor, np.inf)
    known = np.flatnonzero(start.has_point)
    for other in others:
        end = View(other, extractor, np.inf)
        matches = match(start.features.descriptors[known], end.features.descriptors, settings.ratio)
        if len(matches) >= settings.min_matches:
            rows, columns = known[matches[:, 0]], matches[:, 1]
            return Pair(
                first.intrinsics, start.features.pixels[rows], start.points_camera[rows, 2],
                end.features.pixels[columns], end.points_camera[columns, 2],
            )  # fmt: skip
    return None


def measure_focal(
    pairs: Sequence[Pair], settings: CalibrationSettings, noise: SensorNoise
) -> Focal | None:
    """Adjust focal lengths, principal point and all motions to fit the pairs best.

    None where too few pairs are matched consistently, or these do not tell.
    """
    best: list[tuple[Pair, FloatArray]] = []
    camera = start = pairs[0].camera
    for factor in STARTS:
        tried = replace(camera, fx=factor * camera.fx, fy=factor * camera.fy)
        moving = _consistent(pairs, tried, settings, noise)
        if sum(len(p.depths) for p, _ in moving) > sum(len(p.depths) for p, _ in best):
            best, start = moving, tried
    if len(best) < settings.min_pairs:
        return None
    return _adjust(
        [p for p, _ in best],
        [T for _, T in best],
        given=camera,
        start=start,
        settings=settings,
        noise=noise,
    )


def _consistent(
    pairs: Sequence[Pair], camera: Intrinsics, settings: CalibrationSettings, noise: SensorNoise
) -> list[tuple[Pair, FloatArray]]:
    """Return pairs reduced to the matches that a motion explains roughly, with that motion."""
    # A wrong focal length bends the image: RANSAC has to let more pass than noise.
    ransac = MotionSettings(pixel_threshold=max(3.0, 0.01 * camera.width))
    found = []
    for pair in pairs:
        motion = estimate_motion(pair.under(camera), camera, noise, ransac)
        if motion is None or motion.count < settings.min_matches:
            continue
        kept = Pair(
            pair.camera, pair.pixels[motion.inliers], pair.depths[motion.inliers],
            pair.seen[motion.inliers], pair.depths_seen[motion.inliers],
        )  # fmt: skip
        fine = refine_motion(motion.T_camera_reference, kept.under(camera), camera, noise)
        found.append((kept, fine.T_camera_reference))
    return found


def _adjust(
    pairs: list[Pair],
    motions: list[FloatArray],
    given: Intrinsics,
    start: Intrinsics,
    settings: CalibrationSettings,
    noise: SensorNoise,
) -> Focal | None:
    """Gauss-Newton over log fx, log fy, cx, cy and a motion a pair; motions are eliminated.

    None where that runs away, as it does where the pairs hold next to nothing.
    """
    theta = np.array([np.log(start.fx), np.log(start.fy), start.cx, start.cy])
    centre = np.array([0.0, 0.0, given.cx, given.cy])
    spread = settings.principal_share * given.width
    prior = np.diag([0.0, 0.0, spread**-2, spread**-2])
    H = np.eye(4)
    for _ in range(ITERATIONS):
        H, g = prior.copy(), prior @ (theta - centre)
        eliminated = []
        for pair, T in zip(pairs, motions, strict=True):
            r, J_motion, J_theta, W = _linearise(pair, T, theta, given, noise)
            A = np.einsum("nki,nk,nkj->ij", J_motion, W, J_motion) + 1e-6 * np.eye(6)
            B = np.einsum("nki,nk,nkj->ij", J_motion, W, J_theta)
            a = np.einsum("nki,nk,nk->i", J_motion, W, r)
            H += np.einsum("nki,nk,nkj->ij", J_theta, W, J_theta) - B.T @ np.linalg.solve(A, B)
            g += np.einsum("nki,nk,nk->i", J_theta, W, r) - B.T @ np.linalg.solve(A, a)
            eliminated.append((A, B, a))
        step = -np.linalg.solve(H, g)
        theta = theta + step
        if np.abs(theta[:2] - np.log([given.fx, given.fy])).max() > FARTHEST:
            return None
        motions = [
            se3.exponential(-np.linalg.solve(A, a + B @ step)) @ T
            for (A, B, a), T in zip(eliminated, motions, strict=True)
        ]
        if np.abs(step[:2]).max() < CONVERGED:
            break
    sigma = np.sqrt(np.diag(np.linalg.inv(H))[:2])
    return Focal(float(np.exp(theta[0])), float(np.exp(theta[1])), sigma)


def _linearise(
    pair: Pair, T: FloatArray, theta: FloatArray, given: Intrinsics, noise: SensorNoise
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return residuals (N, 3), derivatives by motion (N, 3, 6) and camera (N, 3, 4), weights."""
    r = _residuals(pair, T, theta, given)
    J_motion, J_theta = np.empty((*r.shape, 6)), np.empty((*r.shape, 4))
    for k in range(6):
        xi = np.zeros(6)
        xi[k] = 1e-6
        J_motion[..., k] = (
            _residuals(pair, se3.exponential(xi) @ T, theta, given) - r
        ) / 1e-6  # fmt: skip
    for k, size in enumerate((1e-6, 1e-6, 1e-3, 1e-3)):
        moved = theta.copy()
        moved[k] += size
        J_theta[..., k] = (_residuals(pair, T, moved, given) - r) / size
    known = np.isfinite(pair.depths_seen)
    depths = np.where(known, pair.depths_seen, 1.0)
    # Both readings err; what the first error does to the pixels is small beside the pixel's own.
    sigma = np.hypot(noise.depth_sigma(depths), noise.depth_sigma(pair.depths)) / depths**2
    W = np.empty_like(r)
    W[:, :2] = noise.pixel**-2
    W[:, 2] = np.where(known, sigma**-2, 0.0)
    error = (W * r**2).sum(axis=1)
    return r, J_motion, J_theta, W / (1.0 + error / CHI2_95_3DOF)[:, None]


def _residuals(pair: Pair, T: FloatArray, theta: FloatArray, given: Intrinsics) -> FloatArray:
    camera = replace(
        given, fx=float(np.exp(theta[0])), fy=float(np.exp(theta[1])),
        cx=float(theta[2]), cy=float(theta[3]),
    )  # fmt: skip
    moved = se3.transform(T, camera.backproject(pair.pixels, pair.depths))
    z = np.maximum(moved[:, 2:], 1e-2)
    pixels = camera.project(np.concatenate([moved[:, :2], z], axis=1))
    depths = np.where(np.isfinite(pair.depths_seen), pair.depths_seen, z[:, 0])
    return np.column_stack([pixels - pair.seen, 1 / z[:, 0] - 1 / depths])
