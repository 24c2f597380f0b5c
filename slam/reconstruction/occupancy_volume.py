"""The occupancy volume: free and occupied cells from the depth rays of keyframes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.compiled import compiled
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.floor_plane import FloorPlane

FloatArray = NDArray[np.float64]


class OccupancyVolumeSettings(Settings):
    """Resolution of the occupancy volume, and height of obstacles."""

    cell_m: float = Field(default=0.05, ge=0.01, le=1, description="side of a cell, metres")
    max_cells: int = Field(
        default=4_000_000,
        ge=10_000,
        description="maximum number of cells of the grid; larger maps get larger cells",
    )
    min_height_m: float = Field(
        default=0.1, ge=0, le=1, description="lower things belong to the floor, metres"
    )
    max_height_m: float = Field(
        default=1.8, gt=0, le=4, description="higher things are no obstacles, metres"
    )
    layer_m: float = Field(
        default=0.25, ge=0.05, le=1, description="approximate height of a layer of cells, metres"
    )
    ceiling_m: float = Field(
        default=3.0, gt=0, le=10, description="height above which nothing is examined, metres"
    )
    ray_every: int = Field(
        default=8, ge=1, le=256, description="every n-th ray of a keyframe is used"
    )


@dataclass(frozen=True, slots=True)
class OccupancyVolume:
    """Columns of cells over the floor, counted by keyframe.

    Layer 0 is the floor, the last one what lies above
    `OccupancyVolumeSettings.ceiling_m`. Row and column of a cell follow the map frame's y and x.

    Attributes
    ----------
    hits : (L, R, C) uint16
        Keyframes that saw a surface in a cell.
    passes : (L, R, C) uint16
        Keyframes that saw through it, and no surface in it.
    origin_xy : (2,) float64
        Outer corner of cell (0, 0) in the map frame, metres.
    cell_m : float
        Side of a cell.
    heights_m : (L - 1,) float64
        Borders between the layers, above the floor.
    """

    hits: NDArray[np.uint16]
    passes: NDArray[np.uint16]
    origin_xy: FloatArray
    cell_m: float
    heights_m: FloatArray

    def layers(self, low_m: float, high_m: float) -> slice:
        """Return the layers that lie between two heights above the floor."""
        middle = self.heights_m[:-1] + np.diff(self.heights_m) / 2
        inside = np.flatnonzero((middle > low_m) & (middle < high_m)) + 1
        return slice(int(inside[0]), int(inside[-1]) + 1) if len(inside) else slice(0, 0)

    def cells_of(self, points_map: FloatArray) -> NDArray[np.intp]:
        """Return row and column (N, 2) of points (N, >= 2) of the map frame; some may be off it."""
        cells = np.floor((points_map[:, :2] - self.origin_xy) / self.cell_m)
        return cells[:, ::-1].astype(np.intp)


def carve(
    keyframes: Iterable[Keyframe],
    T_world_keyframe: Mapping[int, FloatArray],
    floor_plane: FloorPlane,
    settings: OccupancyVolumeSettings,
    noise: SensorNoise,
) -> OccupancyVolume:
    """Follow every keyframe's rays through a grid in the map frame.

    In a keyframe a cell with a surface is hit, not passed, as in OctoMap (Hornung et al., 2013,
    section 5.1). A reading whose noise exceeds a cell's half hits nothing: it only carves, up to
    twice its noise and a cell before where it ends, so that walls stay as thin as they are.
    Hits lie half a cell and a standard deviation behind the surface, along its normal, but as high
    as it does.

    Parameters
    ----------
    keyframes : iterable of Keyframe
        With their images.
    T_world_keyframe : mapping of int to (4, 4) float64
        Their poses.
    floor_plane : FloorPlane
        The map frame.
    settings : OccupancyVolumeSettings
        Size of the cells.
    noise : SensorNoise
        Of the depth.
    """
    kept = [k for k in keyframes if k.id in T_world_keyframe]
    T_map_keyframe = {k.id: floor_plane.T_map_world @ T_world_keyframe[k.id] for k in kept}
    volume = _empty(kept, T_map_keyframe, settings)
    low, high = volume.heights_m[:2]
    sides = np.array([volume.cell_m, volume.cell_m, high - low])
    corner = np.array([*volume.origin_xy, low])
    # What lies further below the floor than the floor is thick is not there.
    lowest = 1.0 - 2.0 * low / (high - low)
    # Of each cell: twice the number of the keyframe that last saw it, and 1 if that hit it.
    last = np.zeros(volume.hits.shape, dtype=np.int32)
    for number, keyframe in enumerate(kept, 1):
        T, cloud = T_map_keyframe[keyframe.id], keyframe.cloud
        A, start = T[:3, :3] / sides[:, None], (T[:3, 3] - corner) / sides
        start[2] += 1.0  # Below the second layer lies the first.
        _hit(
            A, start, T[2, :3].copy(), cloud, keyframe.image.normals(noise), volume.cell_m / 2,
            noise.coefficients, lowest, 2 * number, last, volume.hits,
        )  # fmt: skip
        rays = np.ascontiguousarray(cloud[keyframe.id % settings.ray_every :: settings.ray_every])
        _pass(
            A, start, rays, volume.cell_m, noise.coefficients, lowest, 2 * number, last,
            volume.passes,
        )  # fmt: skip
    return volume


@compiled
def _hit(
    A: FloatArray,
    start: FloatArray,
    up: FloatArray,
    cloud: NDArray[np.float32],
    normals: NDArray[np.float32],
    behind_m: float,
    noise: FloatArray,
    lowest: float,
    stamp: int,
    last: NDArray[np.int32],
    hits: NDArray[np.uint16],
) -> None:
    """Count the cells that a keyframe sees a surface in, each once.

    Parameters
    ----------
    A, start : (3, 3), (3,) float64
        From the camera's frame, metres, to column, row and layer.
    up : (3,) float64
        In the camera's frame.
    cloud, normals : (N, 3) float32
        The normals look to the camera, or are 0.
    behind_m : float
        Half a cell. What is solid lies behind the surface: that far on is the first cell that is
        mostly solid, and what is left free before it is, on average, as wide as the room.
    noise : (2,) float64
        Standard deviation of a depth: at no distance, and what a square metre adds.
    lowest : float
        The layer, as a fraction, below which nothing is.
    stamp : int
        Even, and larger than any before.
    last : (L, R, C) int32
        `stamp` + 1 where this keyframe has hit.
    hits : (L, R, C) uint16
        Is added to.
    """
    for i in range(len(cloud)):
        x, y, z = cloud[i, 0], cloud[i, 1], cloud[i, 2]
        sigma = noise[0] + noise[1] * z * z
        if sigma > behind_m:
            continue
        # Of readings that noise moves to this side of the surface, a standard deviation more
        # leaves but a few.
        behind = behind_m + sigma
        nx, ny, nz = normals[i, 0], normals[i, 1], normals[i, 2]
        has_normal = nx != 0 or ny != 0 or nz != 0
        slope = up[0] * nx + up[1] * ny + up[2] * nz
        # How high it lies is not moved: what stands on the floor would sink into it.
        height = start[2] + A[2, 0] * x + A[2, 1] * y + A[2, 2] * z
        if not has_normal:
            length = max(np.sqrt(x * x + y * y + z * z), 1e-6)
            nx, ny, nz = -x / length, -y / length, -z / length
        x, y, z = x - behind * nx, y - behind * ny, z - behind * nz
        layer, row, column = _cell(
            start[0] + A[0, 0] * x + A[0, 1] * y + A[0, 2] * z,
            start[1] + A[1, 0] * x + A[1, 1] * y + A[1, 2] * z,
            height, lowest, hits.shape,
        )  # fmt: skip
        if layer == 0 and has_normal and slope * slope < 0.5:
            continue  # What is steeper than 45 degrees, the foot of a wall, is no floor.
        if layer >= 0 and last[layer, row, column] != stamp + 1:
            last[layer, row, column] = stamp + 1
            hits[layer, row, column] += 1


@compiled
def _pass(
    A: FloatArray,
    start: FloatArray,
    cloud: NDArray[np.float32],
    cell_m: float,
    noise: FloatArray,
    lowest: float,
    stamp: int,
    last: NDArray[np.int32],
    passes: NDArray[np.uint16],
) -> None:
    """Count the cells that a keyframe sees through and has not hit, each once.

    Parameters are those of `_hit`; every point is followed from the camera in steps of a cell.
    """
    for i in range(len(cloud)):
        x, y, z = cloud[i, 0], cloud[i, 1], cloud[i, 2]
        length = np.sqrt(x * x + y * y + z * z)
        step = cell_m / length
        dx = step * (A[0, 0] * x + A[0, 1] * y + A[0, 2] * z)
        dy = step * (A[1, 0] * x + A[1, 1] * y + A[1, 2] * z)
        dz = step * (A[2, 0] * x + A[2, 1] * y + A[2, 2] * z)
        margin = 2 * (noise[0] + noise[1] * z * z) + cell_m
        for n in range(int((length - margin) / cell_m)):
            at = n + 0.5
            layer, row, column = _cell(
                start[0] + at * dx, start[1] + at * dy, start[2] + at * dz, lowest, passes.shape
            )
            if layer >= 0 and last[layer, row, column] < stamp:
                last[layer, row, column] = stamp
                passes[layer, row, column] += 1


@compiled
def _cell(
    x: float, y: float, z: float, lowest: float, shape: tuple[int, int, int]
) -> tuple[int, int, int]:
    """Return layer, row and column of a point, given in cells; a layer of -1 is off the grid."""
    if not (z > lowest and 0 <= x < shape[2] and 0 <= y < shape[1]):  # nor where it is NaN
        return -1, 0, 0
    return int(min(max(z, 0.0), shape[0] - 1.0)), int(y), int(x)


def _empty(
    keyframes: list[Keyframe],
    T_map_keyframe: Mapping[int, FloatArray],
    settings: OccupancyVolumeSettings,
) -> OccupancyVolume:
    """Return a grid without counts around all that was seen and all cameras."""
    corners = [
        np.concatenate([se3.transform(T_map_keyframe[k.id], k.cloud[::16]),
                        T_map_keyframe[k.id][None, :3, 3]])[:, :2]
        for k in keyframes
    ]  # fmt: skip
    low, high = _bounds(corners)
    cell = settings.cell_m
    cell = max(cell, float(np.sqrt(np.prod(high - low + 4 * cell) / settings.max_cells)))
    low = np.floor(low / cell - 2) * cell
    columns, rows = (int(n) for n in np.ceil((high - low) / cell) + 2)
    low_m, high_m = settings.min_height_m, settings.max_height_m
    count = max(1, round((high_m - low_m) / settings.layer_m))
    height = (high_m - low_m) / count
    heights = np.arange(low_m, settings.ceiling_m + height, height)
    shape = (len(heights) + 1, rows, columns)
    return OccupancyVolume(
        np.zeros(shape, np.uint16), np.zeros(shape, np.uint16), low, cell, heights
    )


def _bounds(points: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return the lower and the upper corner (2,) around all points."""
    if not points:
        return np.zeros(2), np.zeros(2)
    low = np.min([p.min(axis=0) for p in points], axis=0)
    high = np.max([p.max(axis=0) for p in points], axis=0)
    return np.asarray(low), np.asarray(high)
