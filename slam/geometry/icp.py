"""Point-to-plane ICP on the points of planes that both views see."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy.spatial import cKDTree

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.planes import Plane

FloatArray = NDArray[np.float64]


class IcpSettings(Settings):
    """How planes are paired and aligned."""

    on: Literal["surface", "planes", "nothing"] = Field(
        default="surface",
        description="what two keyframes are aligned on: surface (all of it), planes, or nothing",
    )
    max_surface_m: float = Field(
        default=0.05,
        gt=0,
        le=1,
        description="maximum distance between paired surface points, metres",
    )
    max_angle_deg: float = Field(
        default=10.0,
        gt=0,
        le=90,
        description="maximum angle between the normals of paired planes, degrees",
    )
    max_distance_m: float = Field(
        default=0.10,
        gt=0,
        le=1,
        description="maximum distance between paired points of planes (paper: th_max), metres",
    )
    points_per_plane: int = Field(
        default=300, ge=20, description="number of points used of each plane"
    )
    iterations: int = Field(default=8, ge=1, le=100, description="maximum number of iterations")
    sigma_correlated_m: float = Field(
        default=0.01, gt=0, le=0.1, description="error that all readings of one plane share, metres"
    )


@dataclass(frozen=True, slots=True)
class PlaneAlignment:
    """The outcome of plane-restricted ICP.

    Attributes
    ----------
    T_target_source : (4, 4) float64
        The motion found.
    information : (6, 6) float64
        What the planes alone know of it, in the target's frame: rotation, then translation.
    rmse_before_m, rmse_after_m : float
        Distance along the normals of the paired points.
    pairs : int
        Planes paired.
    """

    T_target_source: FloatArray
    information: FloatArray
    rmse_before_m: float
    rmse_after_m: float
    pairs: int

    @property
    def improves(self) -> bool:
        """Whether the fit became better."""
        return self.rmse_after_m < self.rmse_before_m


def align_planes(
    source: Sequence[Plane],
    target: Sequence[Plane],
    T_target_source: FloatArray,
    prior_information: FloatArray,
    noise: SensorNoise,
    settings: IcpSettings,
) -> PlaneAlignment | None:
    """Refine a coarse motion on the planes common to both views.

    Algorithm 1 of Kostavelis & Gasteratos (2013, section 3.1.3): closest points, those beyond
    th_max left out, the distance along the target's normal minimised. Directions in which the
    planes leave the camera free to slide are held by the coarse motion, as strongly as
    `prior_information` (6, 6) says.

    Returns
    -------
    PlaneAlignment or None
        None where no plane is seen in both views.
    """
    pairs = _pair(source, target, T_target_source, settings)
    if not pairs:
        return None
    clouds: list[tuple[FloatArray, Any, FloatArray]] = [
        (_thin(s.points, settings), cKDTree(t.points), t.normal) for s, t in pairs
    ]
    T, before, rmse = T_target_source, np.inf, np.inf
    H = np.zeros((6, 6))
    for step_number in range(settings.iterations + 1):
        H, gradient, rmse = _normal_equations(clouds, T, noise, settings)
        if not np.isfinite(rmse):
            return None
        if step_number == 0:
            before = rmse
        if step_number == settings.iterations:
            break
        moved = se3.logarithm(T @ se3.inverse(T_target_source))
        step: Any = np.linalg.solve(H + prior_information, gradient + prior_information @ moved)
        T = se3.exponential(-step) @ T
        if np.abs(step).max() < 1e-5:
            break
    return PlaneAlignment(T, H, before, rmse, len(pairs))


def _pair(
    source: Sequence[Plane], target: Sequence[Plane], T: FloatArray, settings: IcpSettings
) -> list[tuple[Plane, Plane]]:
    """Pair each source plane with the target plane that it falls onto."""
    pairs = []
    limit = np.cos(np.radians(settings.max_angle_deg))
    for plane in source:
        normal = T[:3, :3] @ plane.normal
        centre = se3.transform(T, plane.points.mean(axis=0, keepdims=True))[0]
        gaps = [
            abs(float(other.normal @ centre) + other.offset)
            if normal @ other.normal > limit
            else np.inf
            for other in target
        ]
        if gaps and min(gaps) < settings.max_distance_m:
            pairs.append((plane, target[int(np.argmin(gaps))]))
    return pairs


def _thin(points: FloatArray, settings: IcpSettings) -> FloatArray:
    return points[:: max(1, len(points) // settings.points_per_plane)]


def _normal_equations(
    clouds: list[tuple[FloatArray, Any, FloatArray]],
    T: FloatArray,
    noise: SensorNoise,
    settings: IcpSettings,
) -> tuple[FloatArray, FloatArray, float]:
    """Return H (6, 6), gradient (6,) and the root mean square distance along the normals."""
    H, gradient, squares, count = np.zeros((6, 6)), np.zeros(6), 0.0, 0
    for points, tree, normal in clouds:
        moved = se3.transform(T, points)
        distance, index = tree.query(moved, distance_upper_bound=settings.max_distance_m)
        near = np.isfinite(distance)
        if near.sum() < 10:
            continue
        moved, closest = moved[near], np.asarray(tree.data)[index[near]]
        residual = (moved - closest) @ normal
        J = np.concatenate([np.cross(moved, normal), np.tile(normal, (len(moved), 1))], axis=1)
        # Readings of one surface err together (calibration, quantisation): n of them never know
        # more than the correlated part allows.
        n = len(moved)
        variance = noise.depth_sigma(moved[:, 2]) ** 2 + n * settings.sigma_correlated_m**2
        weight = 1.0 / variance / (1.0 + residual**2 / variance)
        H += (J * weight[:, None]).T @ J
        gradient += (J * weight[:, None]).T @ residual
        squares += float(residual @ residual)
        count += n
    return H, gradient, float(np.sqrt(squares / count)) if count else np.inf
