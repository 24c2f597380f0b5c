"""Aligning depth images, point to plane, by projection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.geometry.compiled import compiled
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.range_image import EDGE_SHARE, RangeImage, without_edges

FloatArray = NDArray[np.float64]

# Metres and radians: a step as small as this, far below any camera's noise, is the last.
CONVERGED = 1e-4


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

    def at(self, points: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
        """Return which of points (N, 3) fall onto a reading (M,), and what is there (M, 3)."""
        height, width = self.points.shape[:2]
        which = np.flatnonzero(points[:, 2] > 0.1)
        x, y, z = points[which].T
        K = self.intrinsics
        columns = np.rint((K.fx * x / z + K.cx) / self.stride).astype(np.intp)
        rows = np.rint((K.fy * y / z + K.cy) / self.stride).astype(np.intp)
        inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
        which, found = which[inside], self.points[rows[inside], columns[inside]]
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
    K = target.intrinsics.parameters / target.stride
    for _ in range(iterations):
        found, g, count = _equations(
            T,
            cloud,
            normals,
            offsets,
            target.points.shape[:2],
            K,
            noise.coefficients,
            max_distance_m,
        )
        if count < 100:
            break
        H = found
        moved_by = se3.logarithm(T @ se3.inverse(T_target_cloud))
        gradient = g + prior_information @ moved_by
        step = np.asarray(np.linalg.solve(H + prior_information, gradient))
        T = se3.exponential(-step) @ T
        if np.abs(step).max() < CONVERGED:
            break
    return T, H


@compiled
def _equations(
    T: FloatArray,
    cloud: FloatArray,
    normals: FloatArray,
    offsets: FloatArray,
    shape: tuple[int, int],
    K: FloatArray,
    noise: FloatArray,
    max_distance: float,
) -> tuple[FloatArray, FloatArray, int]:
    """Sum the point-to-plane equations of a cloud on a surface; see `align_surface`.

    Parameters
    ----------
    T : (4, 4) float64
        T_target_cloud.
    cloud : (N, 3) float64
    normals, offsets : (H W, 3), (H W,) float64
        The surface's planes, n . p = offset, by cell; NaN where there is none.
    shape : (int, int)
        H and W.
    K : (4,) float64
        fx, fy, cx, cy, in cells.
    noise : (2,) float64
        Standard deviation of a depth: at no distance, and what a square metre adds.
    max_distance : float
        Points further off a plane are left out, metres.

    Returns
    -------
    H, g : (6, 6), (6,) float64
    count : int
        Of the points that lie on planes.
    """
    H, g, J, count = np.zeros((6, 6)), np.zeros(6), np.empty(6), 0
    height, width = shape
    for i in range(len(cloud)):
        px, py, pz = cloud[i]
        z = T[2, 0] * px + T[2, 1] * py + T[2, 2] * pz + T[2, 3]
        if not z > 0.1:
            continue
        x = T[0, 0] * px + T[0, 1] * py + T[0, 2] * pz + T[0, 3]
        y = T[1, 0] * px + T[1, 1] * py + T[1, 2] * pz + T[1, 3]
        column, row = round(K[0] * x / z + K[2]), round(K[1] * y / z + K[3])
        if column < 0 or column >= width or row < 0 or row >= height:
            continue
        cell = row * width + column
        nx, ny, nz = normals[cell]
        r = x * nx + y * ny + z * nz - offsets[cell]
        if not abs(r) < max_distance:  # also drops what has no normal
            continue
        count += 1
        sigma = noise[0] + noise[1] * z * z
        # Neighbouring readings err together: count one in ten. Cauchy's kernel.
        weight = 0.1 / (sigma * sigma + r * r)
        J[0], J[1], J[2] = y * nz - z * ny, z * nx - x * nz, x * ny - y * nx
        J[3], J[4], J[5] = nx, ny, nz
        for a in range(6):
            scaled = weight * J[a]
            g[a] += scaled * r
            for b in range(a + 1):
                H[a, b] += scaled * J[b]
    for a in range(6):
        for b in range(a):
            H[b, a] = H[a, b]
    return H, g, count
