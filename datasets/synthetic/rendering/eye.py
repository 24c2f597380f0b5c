"""Eyes: the directions in which the pixels of a camera look."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Eye:
    """A camera of any kind, by its rays.

    Attributes
    ----------
    rays : (H, W, 3) float32
        Directions in the camera's frame. A pinhole's have z = 1: a ray's parameter is the depth.
    lengths : (H, W) float32
        Lengths of the rays.
    focal_px : float or (H, W) float32
        Pixels a radian: a pinhole's in the middle of its image, another eye's everywhere.
    is_pinhole : bool
    """

    rays: Float32Array
    lengths: Float32Array
    focal_px: float | Float32Array
    is_pinhole: bool = True

    def world_rays(self, T_world_camera: FloatArray) -> Float32Array:
        """Return the rays (H, W, 6): origin, direction.

        The camera is at `T_world_camera` (4, 4), or its rows are, one by one (H, 4, 4).
        """
        rays = np.empty((*self.rays.shape[:2], 6), dtype=np.float32)
        if T_world_camera.ndim == 2:
            rays[..., :3] = T_world_camera[:3, 3]
            rays[..., 3:] = cv2.transform(self.rays, T_world_camera[:3, :3])
            return rays
        rays[..., :3] = T_world_camera[:, None, :3, 3]
        R = T_world_camera[:, :3, :3].astype(np.float32)
        np.matmul(self.rays, R.swapaxes(1, 2), out=rays[..., 3:])
        return rays

    def depth(self, point: FloatArray, T: FloatArray) -> float:
        """Return how far a point (3,) is, as this eye's rays measure it, from (4, 4)."""
        way = point - T[:3, 3]
        return float(way @ T[:3, 2]) if self.is_pinhole else float(np.linalg.norm(way))

    def window(self, centre: FloatArray, radius_m: float, T: FloatArray) -> tuple[slice, slice]:
        """Return the rows and columns that may see a ball, from a camera at T_world_camera (4, 4).

        An eye that is no pinhole may see it anywhere.
        """
        height, width = self.lengths.shape
        x, y, z = T[:3, :3].T @ (centre - T[:3, 3])
        if not self.is_pinhole or z < radius_m * 1.2:
            seen = not self.is_pinhole or z > -radius_m
            return (slice(0, height), slice(0, width)) if seen else (slice(0, 0), slice(0, 0))
        middle, focal_px = ((width - 1) / 2, (height - 1) / 2), float(np.mean(self.focal_px))
        reach = focal_px * radius_m / np.sqrt(z * z - radius_m * radius_m)
        # A ball beside the optical axis looks wider; rolling rows see it elsewhere.
        reach *= 1.15 + 0.5 * np.hypot(x, y) / z
        columns, rows = (
            slice(
                int(np.clip(m + focal_px * v / z - reach, 0, size)),
                int(np.clip(m + focal_px * v / z + reach + 1, 0, size)),
            )
            for m, v, size in ((middle[0], x, width), (middle[1], y, height))
        )
        return rows, columns


def pinhole(intrinsics: Intrinsics) -> Eye:
    """Return the eye of a pinhole camera."""
    x = (np.arange(intrinsics.width) - intrinsics.cx) / intrinsics.fx
    y = (np.arange(intrinsics.height) - intrinsics.cy) / intrinsics.fy
    rays = np.stack([*np.meshgrid(x, y), np.ones((len(y), len(x)))], axis=-1).astype(np.float32)
    return Eye(rays, np.linalg.norm(rays, axis=2), float(intrinsics.fx))
