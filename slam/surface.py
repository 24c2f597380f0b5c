"""Aligning depth images, point to plane, by projection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from datasets import poses
from datasets.camera import Intrinsics
from datasets.frame import Frame
from slam.equations import surface_equations
from slam.noise import SensorNoise
from slam.range_image import RangeImage
from slam.view import EDGE_SHARE, without_edges

FloatArray = NDArray[np.float64]

# Metres and radians: a step as small as this, far below any camera's noise, is the last.
CONVERGED = 1e-4
# Squared length, in the features' standard deviations, beyond which a step contradicts them:
# 98.4 % of a chi-square with six degrees of freedom.
STEP_BOUND = 15.6


@dataclass(frozen=True, slots=True)
class Surface:
    """A depth image, thinned: points with the normals of the surface that they lie on.

    Attributes
    ----------
    points : (H, W, 3) float64
        In the camera frame, metres; NaN where there is no reading.
    normals : (H, W, 3) float64
        Unit vectors; NaN at edges.
    intrinsics : Intrinsics
        Of the full image.
    stride : int
        Every n-th row and column of the full image is here.
    """

    points: FloatArray
    normals: FloatArray
    intrinsics: Intrinsics
    stride: int

    @property
    def cloud(self) -> FloatArray:
        """All points (N, 3)."""
        return np.asarray(self.points[np.isfinite(self.points[..., 2])])

    def cells(self, points: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Look up where points (N, 3) project to.

        Returns
        -------
        which : (M,) int
            Those in view.
        cells : (M,) int
            The cell that each falls into, counted row by row.
        """
        height, width = self.points.shape[:2]
        which = np.flatnonzero(points[:, 2] > 0.1)
        x, y, z = points.T if len(which) == len(points) else points[which].T
        K = self.intrinsics
        columns = np.rint((K.fx * x / z + K.cx) / self.stride).astype(np.intp)
        rows = np.rint((K.fy * y / z + K.cy) / self.stride).astype(np.intp)
        inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
        return which[inside], rows[inside] * width + columns[inside]

    def at(self, points: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
        """Return which of points (N, 3) fall onto a reading (M,), and what is there (M, 3)."""
        which, cells = self.cells(points)
        found = self.points.reshape(-1, 3)[cells]
        known = np.isfinite(found[:, 2])
        return which[known], found[known]


def surface_of(frame: Frame, stride: int) -> Surface:
    """Return the thinned surface of a frame's depth."""
    depth = without_edges(frame.depth)[::stride, ::stride].astype(np.float64)
    depth[depth <= 0] = np.nan
    rows, columns = np.indices(depth.shape)
    pixels = np.stack([columns, rows], axis=-1).reshape(-1, 2) * float(stride)
    points = frame.intrinsics.backproject(pixels, depth.ravel()).reshape(*depth.shape, 3)
    normals = np.full_like(points, np.nan)
    across = points[1:-1, 2:] - points[1:-1, :-2]
    down = points[2:, 1:-1] - points[:-2, 1:-1]
    normal = np.cross(across, down)
    middle = points[1:-1, 1:-1, 2:]
    steep = np.maximum(np.abs(across[..., 2:]), np.abs(down[..., 2:])) > 4 * EDGE_SHARE * middle
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    normals[1:-1, 1:-1] = np.where(
        steep | (length == 0), np.nan, normal / np.maximum(length, 1e-12)
    )
    return Surface(points, normals, frame.intrinsics, stride)


def surface_of_image(image: RangeImage, noise: SensorNoise) -> Surface:
    """Return the surface of a keyframe's thinned depth."""
    seen = image.depth_mm > 0
    points = np.full((*seen.shape, 3), np.nan)
    normals = np.full((*seen.shape, 3), np.nan)
    points[seen] = image.points
    found = image.normals(noise)
    known = found.any(axis=1)
    rows, columns = np.nonzero(seen)
    normals[rows[known], columns[known]] = found[known]
    return Surface(points, normals, image.intrinsics, 1)


def align_surface(
    cloud: FloatArray,
    target: Surface,
    T_target_cloud: FloatArray,
    prior_information: FloatArray,
    noise: SensorNoise,
    max_distance_m: float,
    iterations: int = 10,
) -> tuple[FloatArray, FloatArray]:
    """Move a cloud (N, 3) onto a surface, point to plane; pairs are found by projection.

    After Newcombe et al. (KinectFusion, 2011, section 3.5), with Cauchy weights.

    Returns
    -------
    T_target_cloud, information : (4, 4), (6, 6) float64
        The motion, and what the surface alone knows of it, in the target's frame.
    """
    T, H = T_target_cloud, np.zeros((6, 6))
    normals = target.normals.reshape(-1, 3)
    # Each cell's plane is n . p = offset.
    offsets = np.einsum("ni,ni->n", normals, target.points.reshape(-1, 3))
    camera = target.intrinsics
    K = np.array([camera.fx, camera.fy, camera.cx, camera.cy]) / target.stride
    sigma = np.array([noise.depth_floor_m, noise.depth_quadratic])
    for _ in range(iterations):
        found, g, count = surface_equations(
            T, cloud, normals, offsets, target.points.shape[:2], K, sigma, max_distance_m
        )
        if count < 100:
            break
        H = found
        moved_by = poses.logarithm(T @ poses.inverse(T_target_cloud))
        gradient = g + prior_information @ moved_by
        step = np.asarray(np.linalg.solve(H + prior_information, gradient))
        T = poses.exponential(-step) @ T
        if np.abs(step).max() < CONVERGED:
            break
    return T, H
