"""Dynamic-point removal: voxels that other keyframes see through."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.geometry.compiled import compiled
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.geometry.voxel_hash import SIDE_BITS, cells_of
from roomgraph.slam.reconstruction.fusion import Voxels

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
SIGMAS = 3.0
NEAREST_M = 0.1
# Blocks are hidden if they lie behind all readings within this many cells of their centre.
AROUND = 20


@dataclass(frozen=True, slots=True)
class VisibilityCounts:
    """Visibility counts of N voxels.

    Attributes
    ----------
    on, through : (N,) int32
        Keyframes that see a surface at the voxel, and that see one clearly behind it.
    """

    on: NDArray[np.int32]
    through: NDArray[np.int32]

    @property
    def is_empty(self) -> NDArray[np.bool_]:
        """Which voxels (N,) are seen through more often than they are seen."""
        return self.through > self.on


def count_visibility(
    voxels: Voxels,
    voxel_m: float,
    images: Iterable[tuple[int, RangeImage]],
    T_world_keyframe: Mapping[int, FloatArray],
    noise: SensorNoise,
) -> VisibilityCounts:
    """Project voxels into all keyframes and compare their depth with what is read there.

    A voxel is seen through where all nine readings around it lie behind it, by more than three
    standard deviations and the voxel's diagonal; slanting surfaces and edges that fall between
    two readings are thus left alone. Nothing is said of voxels hidden behind a surface, or
    without readings around.
    """
    visibility = VisibilityCounts(*np.zeros((2, len(voxels.keys)), np.int32))
    blocks = _blocks(voxels, voxel_m)
    for keyframe, image in images:
        T_camera_world = se3.inverse(T_world_keyframe[keyframe]).astype(np.float32)
        near, far, through = _bounds(image, noise, np.sqrt(3.0) * voxel_m)
        chosen = blocks.in_view(T_camera_world, image, far)
        _compare(
            voxels.points, chosen, T_camera_world, image.intrinsics.parameters.astype(np.float32),
            near, far, through, visibility.on, visibility.through,
        )  # fmt: skip
    return visibility


def _bounds(
    image: RangeImage, noise: SensorNoise, slack_m: float
) -> tuple[Float32Array, Float32Array, Float32Array]:
    """Return between which depths (H, W) a surface is seen, and before which none is (0: never)."""
    depth, kernel = image.depth, np.ones((3, 3), np.uint8)
    nearest = cv2.erode(np.where(depth > 0, depth, np.float32(np.inf)), kernel)
    farthest = cv2.dilate(depth, kernel)
    seen = farthest > 0
    nearest = np.where(seen, nearest, np.float32(0))
    near = nearest - (SIGMAS * noise.depth_sigma(nearest) + slack_m).astype(np.float32)
    far = farthest + (SIGMAS * noise.depth_sigma(farthest) + slack_m).astype(np.float32)
    # Outside the image nothing is known either: there OpenCV's border never is the smallest.
    all_known = cv2.erode((depth > 0).astype(np.uint8), kernel, borderValue=0) > 0
    return (
        np.where(seen, near, np.float32(np.inf)),
        np.where(seen, far, np.float32(0)),
        np.where(all_known, near, np.float32(0)),
    )


@dataclass(frozen=True, slots=True)
class _Blocks:
    """Voxels by blocks: those of block i are ``starts[i] ... starts[i] + counts[i] - 1``."""

    centres: Float32Array
    radius: float
    starts: NDArray[np.intp]
    counts: NDArray[np.intp]

    def in_view(
        self, T_camera_world: Float32Array, image: RangeImage, far: Float32Array
    ) -> NDArray[np.intp]:
        """Return the voxels (M,) of all blocks that may be in a view, and not behind it."""
        K, r = image.intrinsics, np.float32(self.radius)
        x, y, z = (self.centres @ T_camera_world[:3, :3].T + T_camera_world[:3, 3]).T
        wide = max(K.cx, K.width - K.cx) / K.fx
        high = max(K.cy, K.height - K.cy) / K.fy
        inside = (
            (z > NEAREST_M - r)
            & (z < far.max() + r)
            & (np.abs(x) < z * wide + r * np.hypot(1, wide))
            & (np.abs(y) < z * high + r * np.hypot(1, high))
        )
        chosen = np.flatnonzero(inside)
        z = np.maximum(z[chosen], np.float32(NEAREST_M))
        column = np.clip(x[chosen] / z * K.fx + K.cx, 0, K.width - 1).astype(np.intp)
        row = np.clip(y[chosen] / z * K.fy + K.cy, 0, K.height - 1).astype(np.intp)
        farthest = cv2.dilate(far, np.ones((2 * AROUND + 1, 2 * AROUND + 1), np.uint8))
        reaches = r * max(K.fx, K.fy) / np.maximum(z - r, np.float32(1e-6)) > AROUND
        chosen = chosen[reaches | (z - r < farthest[row, column])]
        starts, counts = self.starts[chosen], self.counts[chosen]
        offset = np.repeat(starts - np.cumsum(counts) + counts, counts)
        return np.asarray(offset + np.arange(len(offset)))


def _blocks(voxels: Voxels, voxel_m: float) -> _Blocks:
    block = voxels.keys >> 3 * SIDE_BITS
    starts = np.flatnonzero(np.r_[True, block[1:] != block[:-1]][: len(block)])
    side = 1 << SIDE_BITS
    corners = cells_of(voxels.keys[starts] >> 3 * SIDE_BITS << 3 * SIDE_BITS)
    return _Blocks(
        ((corners + side / 2) * voxel_m).astype(np.float32), np.sqrt(3) * side / 2 * voxel_m,
        starts, np.diff(np.r_[starts, len(block)]),
    )  # fmt: skip


@compiled
def _compare(
    points_world: Float32Array,
    chosen: NDArray[np.intp],
    T_camera_world: Float32Array,
    K: Float32Array,
    near: Float32Array,
    far: Float32Array,
    before: Float32Array,
    on: NDArray[np.int32],
    through: NDArray[np.int32],
) -> None:
    """Count which of the chosen points a view shows, and which it sees through.

    Parameters
    ----------
    K : (4,) float32
        fx, fy, cx, cy.
    near, far, before : (H, W) float32
        As `_bounds` returns them.
    """
    T, (height, width) = T_camera_world, near.shape
    for i in chosen:
        px, py, pz = points_world[i, 0], points_world[i, 1], points_world[i, 2]
        z = T[2, 0] * px + T[2, 1] * py + T[2, 2] * pz + T[2, 3]
        if z <= NEAREST_M:
            continue
        x = T[0, 0] * px + T[0, 1] * py + T[0, 2] * pz + T[0, 3]
        y = T[1, 0] * px + T[1, 1] * py + T[1, 2] * pz + T[1, 3]
        column, row = int(np.rint(x / z * K[0] + K[2])), int(np.rint(y / z * K[1] + K[3]))
        if 0 <= column < width and 0 <= row < height:
            through[i] += z < before[row, column]
            on[i] += near[row, column] <= z <= far[row, column]
