"""The large surfaces of a view, by RANSAC repeated on the points that are left."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.noise import SensorNoise

FloatArray = NDArray[np.float64]


class PlaneSettings(Settings):
    """What counts as a plane."""

    enabled: bool = Field(
        default=True, description="extract planes, for the floor and for motion from depth alone"
    )
    max_planes: int = Field(default=5, ge=1, le=50, description="maximum number of planes per view")
    min_share: float = Field(
        default=0.06, gt=0, le=1, description="minimum share of a view's points for a plane"
    )
    iterations: int = Field(
        default=128, ge=8, le=10_000, description="number of RANSAC hypotheses per plane"
    )
    sigma_threshold: float = Field(
        default=2.0,
        gt=0,
        le=20,
        description="maximum distance of a point from its plane, standard deviations",
    )
    flatness: float = Field(
        default=0.45,
        gt=0,
        le=1,
        description="maximum RMS distance of a plane's points, as a share of the threshold above",
    )
    points: int = Field(
        default=4000, ge=200, description="maximum number of points of a view that are searched"
    )


@dataclass(frozen=True, slots=True)
class Plane:
    """Points on one surface: ``normal . p + offset = 0``, the normal towards the camera.

    Attributes
    ----------
    normal : (3,) float64
    offset : float
        Distance of the camera from the plane, metres, >= 0.
    points : (N, 3) float64
        In the camera frame, metres.
    """

    normal: FloatArray
    offset: float
    points: FloatArray


def extract_planes(
    points_camera: FloatArray, noise: SensorNoise, settings: PlaneSettings, seed: int = 0
) -> tuple[Plane, ...]:
    """Return the planes among points (N, 3), the largest first.

    RANSAC on three random points, scored by the points within a distance alpha; found planes'
    points are left out and the search repeated (Kostavelis & Gasteratos, 2013, section 3.1.2).
    Alpha follows the depth noise at each point.
    """
    rng = np.random.default_rng(seed)
    if len(points_camera) > settings.points:
        points_camera = points_camera[:: -(-len(points_camera) // settings.points)]
    needed = max(30, int(settings.min_share * len(points_camera)))
    planes: list[Plane] = []
    rest = points_camera
    for _ in range(settings.max_planes):
        if len(rest) < needed:
            break
        alpha = settings.sigma_threshold * noise.depth_sigma(rest[:, 2])
        on_plane = _best_sample(rest, alpha, settings.iterations, rng)
        if on_plane.sum() < needed:
            break
        normal, offset = fit_plane(rest[on_plane])
        on_plane = np.abs(rest @ normal + offset) < alpha
        if on_plane.sum() < needed:
            break
        normal, offset = fit_plane(rest[on_plane])
        distance = (rest[on_plane] @ normal + offset) / alpha[on_plane]
        # Clutter fills the slab evenly (a root mean square of 0.58); a surface lies in its middle.
        if np.sqrt(np.mean(distance**2)) < settings.flatness:
            planes.append(Plane(normal, offset, rest[on_plane]))
        rest = rest[~on_plane]
    return tuple(planes)


def fit_plane(points: FloatArray) -> tuple[FloatArray, float]:
    """Return normal (3,), towards the origin, and offset of the plane nearest to points (N, 3)."""
    centre = points.mean(axis=0)
    _, vectors = np.linalg.eigh(np.cov((points - centre).T))
    normal = vectors[:, 0]
    offset = -float(normal @ centre)
    return (normal, offset) if offset >= 0 else (-normal, -offset)


def _best_sample(
    points: FloatArray, alpha: FloatArray, iterations: int, rng: np.random.Generator
) -> NDArray[np.bool_]:
    """Return which points lie on the best of many planes through three random points."""
    a, b, c = points[rng.integers(len(points), size=(3, iterations))]
    normals = np.cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1)
    sound = length > 1e-6
    normals = normals[sound] / length[sound, None]
    if not len(normals):
        return np.zeros(len(points), dtype=bool)
    offsets = -np.einsum("ij,ij->i", normals, a[sound])
    # A quarter of the points ranks the hypotheses as well as all of them.
    few = points[::4].astype(np.float32)
    distance = np.abs(few @ normals.T.astype(np.float32) + offsets.astype(np.float32))
    best = int((distance < alpha[::4, None].astype(np.float32)).sum(axis=0).argmax())
    return np.asarray(np.abs(points @ normals[best] + offsets[best]) < alpha)
