"""Fusion of keyframes into voxels, in any order, and their removal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.geometry.compiled import compiled
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.geometry.voxel_hash import VoxelTable, cells_of, grown, keys_of

FloatArray = NDArray[np.float64]
# Sums are kept in whole numbers, so that they come out the same in whatever order keyframes are
# added and taken out: offsets within a voxel in 256ths of it, normals in 127ths, weights up to
# 255. A view adds less than 2**16 to a sum of 32 bits: 32768 views of one voxel.
FINEST_OFFSET, LONGEST_NORMAL, LARGEST_WEIGHT = 256, 127, 255
# A reading without a normal looks to the camera, but counts little beside one that has it.
GUESSED_NORMAL = 0.1


@dataclass(frozen=True, slots=True)
class Fused:
    """The contribution of a keyframe to the voxels.

    Attributes
    ----------
    image : RangeImage
        What was fused, to take it out again.
    T_world_keyframe : (4, 4) float64
        The pose it was fused at.
    rows : (N,) int32
        Of the voxels.
    depth_mm : (N,) uint16
        How far the keyframe's camera was from each.
    typical_m : float
        The median of these, metres; 0 where nothing was seen.
    """

    image: RangeImage
    T_world_keyframe: FloatArray
    rows: NDArray[np.int32]
    depth_mm: NDArray[np.uint16]
    typical_m: float


@dataclass(frozen=True, slots=True)
class Voxels:
    """The voxels that something was seen in, sorted by their number.

    Attributes
    ----------
    keys : (N,) int64
        See `slam.voxels.keys_of`.
    points : (N, 3) float32
        The weighted mean of what was seen, metres, in the world.
    colours : (N, 3) uint8
    normals : (N, 3) float32
        Unit vectors towards the cameras.
    keyframes : (N,) int32
        The keyframe that saw each from nearest; of several the first.
    views : (N,) int32
        How many keyframes saw each.
    """

    keys: NDArray[np.int64]
    points: NDArray[np.float32]
    colours: NDArray[np.uint8]
    normals: NDArray[np.float32]
    keyframes: NDArray[np.int32]
    views: NDArray[np.int32]


class Fusion:
    """Voxels with the weighted means of the range images fused into them.

    Every keyframe counts once in a voxel, with the inverse variance of its depth there: the
    readings of one view err together. Nothing is left of a keyframe that is taken out.
    """

    def __init__(self, voxel_m: float, noise: SensorNoise) -> None:
        self.voxel_m, self.noise = voxel_m, noise
        self.fused: dict[int, Fused] = {}
        self._table = VoxelTable()
        # Weight, offset, colour and normal of each row.
        self._sums: NDArray[np.int32] = np.empty((0, 10), np.int32)
        self._views: NDArray[np.uint16] = np.empty(0, np.uint16)

    @property
    def nbytes(self) -> int:
        """Bytes held, the images left out."""
        lists = sum(f.rows.nbytes + f.depth_mm.nbytes for f in self.fused.values())
        return self._table.nbytes + self._sums.nbytes + self._views.nbytes + lists

    @property
    def waste(self) -> float:
        """The share of rows whose voxels nothing is seen in any more."""
        count = len(self._table)
        return 1.0 - np.count_nonzero(self._views[:count]) / count if count else 0.0

    def add(self, keyframe: int, image: RangeImage, T_world_keyframe: FloatArray) -> None:
        """Fuse a keyframe."""
        keys, sums, depth_mm = self._means(image, T_world_keyframe)
        rows = self._table.rows(keys)
        self._sums = grown(self._sums, len(self._table))
        self._views = grown(self._views, len(self._table))
        self._sums[rows] += sums
        self._views[rows] += 1
        typical_m = float(np.median(depth_mm)) / 1000 if len(depth_mm) else 0.0
        self.fused[keyframe] = Fused(image, T_world_keyframe.copy(), rows, depth_mm, typical_m)

    def remove(self, keyframe: int) -> None:
        """Remove a keyframe."""
        fused = self.fused.pop(keyframe)
        _, sums, _ = self._means(fused.image, fused.T_world_keyframe)
        self._sums[fused.rows] -= sums
        self._views[fused.rows] -= 1

    def voxels(self) -> Voxels:
        """Return the content of the voxels, independent of the order of fusion."""
        count = len(self._table)
        rows = np.flatnonzero(self._views[:count])
        keys = self._table.keys[rows]
        order = np.argsort(keys)
        rows, keys = rows[order], keys[order]
        points, colours, normals = _tallied(rows, cells_of(keys), self._sums, self.voxel_m)
        return Voxels(
            keys=keys, points=points, colours=colours, normals=normals,
            keyframes=self._nearest(count)[rows], views=self._views[rows].astype(np.int32),
        )  # fmt: skip

    def _nearest(self, count: int) -> NDArray[np.int32]:
        """Return the keyframe that saw each row from nearest."""
        best = np.full(count, np.iinfo(np.int64).max)
        for keyframe, fused in self.fused.items():
            bid = fused.depth_mm.astype(np.int64) << 32 | keyframe
            best[fused.rows] = np.minimum(best[fused.rows], bid)
        return (best & 0xFFFFFFFF).astype(np.int32)

    def _means(
        self, image: RangeImage, T_world_keyframe: FloatArray
    ) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.uint16]]:
        """Return the voxels (N,) that an image falls into, the sums (N, 10), the depths (N,)."""
        points = image.points
        # In voxels, float64: far from the origin float32 would not resolve a voxel.
        scaled = se3.transform(T_world_keyframe, points) / self.voxel_m
        cells = np.floor(scaled)
        keys = keys_of(cells.astype(np.int32))
        # Ties fall alike each time, so what is taken out again is what was added.
        order = np.argsort(keys)
        normals = _guessed(image.normals(self.noise), points)
        first, sums, depth_m = _summed(
            order, keys[order], scaled - cells, image.colours, normals,
            T_world_keyframe[:3, :3], points[:, 2],
            self.noise.coefficients,
        )  # fmt: skip
        return keys[order[first]], sums, np.rint(depth_m * 1000).astype(np.uint16)


@compiled
def _summed(
    order: NDArray[np.intp],
    keys: NDArray[np.int64],
    offsets: FloatArray,
    colours: NDArray[np.uint8],
    normals: NDArray[np.float32],
    R: FloatArray,
    z: NDArray[np.float32],
    noise: FloatArray,
) -> tuple[NDArray[np.intp], NDArray[np.int32], FloatArray]:
    """Sum what a view's points (N,) give to the voxels (M,) that they fall into.

    Parameters
    ----------
    order, keys : (N,) int
        The points sorted by voxel, and these voxels.
    offsets, colours, normals, z : (N, 3), (N, 3), (N, 3), (N,)
        Of the points as they come: within their voxel, and in the camera.
    R : (3, 3) float64
        R_world_camera.
    noise : (2,) float64
        Standard deviation of a depth: at no distance, and what a square metre adds.

    Returns
    -------
    first, sums, depth : (M,), (M, 10), (M,)
        Where each voxel begins in `order`; weight, offset, colour and normal; the mean depth.
    """
    count = 0
    for n in range(len(keys)):
        count += n == 0 or keys[n] != keys[n - 1]
    first, sums = np.empty(count, np.intp), np.empty((count, 10), np.int32)
    depth = np.empty(count)
    total, n = np.empty(9), 0
    for row in range(count):
        first[row] = n
        total[:] = 0.0
        far, key = 0.0, keys[n]
        while n < len(keys) and keys[n] == key:
            i = order[n]
            far += z[i]
            for k in range(3):
                total[k] += offsets[i, k] * FINEST_OFFSET - 0.5
                total[3 + k] += colours[i, k]
                turned = R[k, 0] * normals[i, 0] + R[k, 1] * normals[i, 1] + R[k, 2] * normals[i, 2]
                total[6 + k] += turned * LONGEST_NORMAL
            n += 1
        points = n - first[row]
        depth[row] = far / points
        share = noise[0] / (noise[0] + noise[1] * depth[row] ** 2)
        weight = max(np.rint(LARGEST_WEIGHT * share * share), 1.0)
        sums[row, 0] = weight
        for k in range(9):
            sums[row, 1 + k] = np.rint(total[k] / points) * weight
    return first, sums, depth


@compiled
def _tallied(
    rows: NDArray[np.intp], cells: NDArray[np.int32], sums: NDArray[np.int32], voxel_m: float
) -> tuple[NDArray[np.float32], NDArray[np.uint8], NDArray[np.float32]]:
    """Return the mean points, colours and normals, each (N, 3), of some rows of sums.

    Parameters
    ----------
    rows : (N,) int
        Of voxels in which something is seen.
    cells : (N, 3) int32
        Where these lie, in voxels.
    sums : (M, 10) int32
        Of all rows: weight, offset, colour, normal.
    voxel_m : float
        A voxel's side.
    """
    count = len(rows)
    points, normals = np.empty((count, 3), np.float32), np.empty((count, 3), np.float32)
    colours = np.empty((count, 3), np.uint8)
    for n in range(count):
        total = sums[rows[n]]
        weight = float(total[0])
        x, y, z = float(total[7]), float(total[8]), float(total[9])
        length = np.sqrt(x * x + y * y + z * z)
        if length == 0:  # Seen from both sides alike: any normal will do.
            z = length = 1.0
        normals[n, 0], normals[n, 1], normals[n, 2] = x / length, y / length, z / length
        for k in range(3):
            points[n, k] = (cells[n, k] + (total[1 + k] / weight + 0.5) / FINEST_OFFSET) * voxel_m
            colours[n, k] = np.rint(total[4 + k] / weight)
    return points, colours, normals


def _guessed(normals: NDArray[np.float32], points: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return normals (N, 3), those that are missing short ones towards the camera."""
    missing = ~normals.any(axis=1)
    ray = points[missing]
    normals[missing] = -GUESSED_NORMAL * ray / np.linalg.norm(ray, axis=1, keepdims=True)
    return normals
