"""What is free and what is filled, carved out of the keyframes' depth rays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets import poses
from datasets.settings import Settings
from slam.ground import Ground
from slam.keyframe import Keyframe
from slam.noise import SensorNoise

FloatArray = NDArray[np.float64]


class SpaceSettings(Settings):
    """How finely space is carved, and what is in a robot's way."""

    cell_m: float = Field(0.05, ge=0.01, le=1, description="side of a cell")
    max_cells: int = Field(
        4_000_000, ge=10_000, description="cells of the grid; a larger map gets larger cells"
    )
    min_height_m: float = Field(0.1, ge=0, le=1, description="lower things are floor")
    max_height_m: float = Field(1.8, gt=0, le=4, description="higher things are in nobody's way")
    layer_m: float = Field(0.25, ge=0.05, le=1, description="height of a layer of cells, about")
    ceiling_m: float = Field(3.0, gt=0, le=10, description="higher up nothing is looked at")
    ray_every: int = Field(8, ge=1, le=256, description="of a keyframe's rays, one in so many")


@dataclass(frozen=True, slots=True)
class Space:
    """Columns of cells over the floor, counted by keyframe.

    Layer 0 is the floor, the last one what lies above `SpaceSettings.ceiling_m`. Row and column of
    a cell follow the map frame's y and x.

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
    ground: Ground,
    settings: SpaceSettings,
    noise: SensorNoise,
) -> Space:
    """Follow every keyframe's rays through a grid in the map frame.

    In a keyframe a cell with a surface is hit, not passed, as in OctoMap (Hornung et al., 2013,
    section 5.1). A reading whose noise exceeds a cell's half hits nothing: it only carves, up to
    twice its noise and a cell before where it ends, so that walls stay as thin as they are.
    Hits lie half a cell behind the surface (see `_behind`).

    Parameters
    ----------
    keyframes : iterable of Keyframe
        With their clouds.
    T_world_keyframe : mapping of int to (4, 4) float64
        Their poses.
    ground : Ground
        The map frame.
    settings : SpaceSettings
        Size of the cells.
    noise : SensorNoise
        Of the depth.
    """
    kept = [k for k in keyframes if k.id in T_world_keyframe]
    T_map_keyframe = {k.id: ground.T_map_world @ T_world_keyframe[k.id] for k in kept}
    space = _empty(kept, T_map_keyframe, settings)
    # Who wrote to a cell last: tells, without sorting, which of a keyframe's samples came first.
    last = np.zeros(space.hits.size, dtype=np.int32)
    is_hit = np.zeros(space.hits.size, dtype=bool)
    hits, passes = space.hits.reshape(-1), space.passes.reshape(-1)
    for keyframe in kept:
        T, cloud = T_map_keyframe[keyframe.id], keyframe.cloud
        sigma = noise.depth_sigma(cloud[:, 2])
        sure = cloud[sigma <= space.cell_m / 2]
        hit = _once(_index(space, poses.transform(T, _behind(sure, space.cell_m / 2))), last)
        is_hit[hit] = True
        few = slice(keyframe.id % settings.ray_every, None, settings.ray_every)
        samples = _samples(T, cloud[few], 2 * sigma[few] + space.cell_m, space.cell_m)
        passed = _once(_index(space, samples), last)
        hits[hit] += 1
        passes[passed[~is_hit[passed]]] += 1
        is_hit[hit] = False
    return space


def _empty(
    keyframes: list[Keyframe], T_map_keyframe: Mapping[int, FloatArray], settings: SpaceSettings
) -> Space:
    """Return a grid without counts around all that was seen and all cameras."""
    corners = [
        np.concatenate([poses.transform(T_map_keyframe[k.id], k.cloud[::16]),
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
    return Space(np.zeros(shape, np.uint16), np.zeros(shape, np.uint16), low, cell, heights)


def _bounds(points: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return the lower and the upper corner (2,) around all points."""
    if not points:
        return np.zeros(2), np.zeros(2)
    low = np.min([p.min(axis=0) for p in points], axis=0)
    high = np.max([p.max(axis=0) for p in points], axis=0)
    return np.asarray(low), np.asarray(high)


def _behind(points_camera: NDArray[np.float32], way_m: float) -> NDArray[np.float32]:
    """Move points (N, 3) on along their rays.

    What is solid lies behind the surface: half a cell on is the first cell that is mostly solid,
    and what is left free before it is, on average, as wide as the room.
    """
    length = np.linalg.norm(points_camera, axis=1, keepdims=True)
    return np.asarray(points_camera * (1 + np.float32(way_m) / np.maximum(length, 1e-6)))


def _samples(
    T_map_camera: FloatArray,
    points_camera: NDArray[np.float32],
    margin_m: FloatArray,
    step_m: float,
) -> NDArray[np.float32]:
    """Return points of the map frame (N, 3), a step apart, along the rays to points (M, 3)."""
    length = np.linalg.norm(points_camera, axis=1)
    counts = np.maximum(0, (length - margin_m) / step_m).astype(np.intp)
    rank = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    R, t = T_map_camera[:3, :3].astype(np.float32), T_map_camera[:3, 3].astype(np.float32)
    steps = (points_camera / np.maximum(length, 1e-6)[:, None]) @ R.T * np.float32(step_m)
    along = (rank + 0.5).astype(np.float32)
    return np.asarray(np.repeat(steps, counts, axis=0) * along[:, None] + t)


def _index(space: Space, points_map: NDArray[np.floating]) -> NDArray[np.int32]:
    """Return flat indices of the cells that points (N, 3) lie in; those below the floor are off."""
    layers, rows, columns = space.hits.shape
    low = float(space.heights_m[0])
    height = float(space.heights_m[1]) - low
    # Truncation does for rounding down: what is left of the grid's first cell is off anyway.
    layer = ((points_map[:, 2] - (low - height)) / height).astype(np.int32)
    np.clip(layer, 0, layers - 1, out=layer)
    column = ((points_map[:, 0] - float(space.origin_xy[0])) / space.cell_m).astype(np.int32)
    row = ((points_map[:, 1] - float(space.origin_xy[1])) / space.cell_m).astype(np.int32)
    inside = (points_map[:, 2] > -low) & (row >= 0) & (row < rows)
    inside &= (column >= 0) & (column < columns)
    return np.asarray(((layer * rows + row) * columns + column)[inside])


def _once(index: NDArray[np.int32], last: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return indices without repetition; `last` is scratch of the grid's size."""
    order = np.arange(len(index), dtype=np.int32)
    last[index] = order
    return np.asarray(index[last[index] == order])
