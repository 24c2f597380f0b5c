"""The coloured map: every keyframe's points, one a voxel."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets import poses
from datasets.settings import Settings
from slam.keyframe import Keyframe


class MapSettings(Settings):
    """How dense the map is."""

    voxel_m: float = Field(0.02, gt=0, le=1, description="one point a cube of this size")
    stride: int = Field(4, ge=1, le=64, description="every n-th pixel of a keyframe is mapped")
    max_depth_m: float = Field(4.0, gt=0, le=100, description="readings beyond are not mapped")


@dataclass(frozen=True, slots=True)
class PointMap:
    """Points in the world.

    Attributes
    ----------
    points_world : (N, 3) float32
        Metres.
    colours : (N, 3) uint8
        Red, green, blue.
    keyframes : (N,) int32
        The keyframe that saw each point best (from nearest): labels are looked up by it.
    """

    points_world: NDArray[np.float32]
    colours: NDArray[np.uint8]
    keyframes: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.points_world)


def build_map(
    keyframes: Iterable[Keyframe],
    T_world_keyframe: Mapping[int, NDArray[np.float64]],
    voxel_m: float,
    every: int = 1,
) -> PointMap:
    """Fuse keyframes' clouds at their present poses: the mean point and colour of each voxel.

    Nothing is kept between calls, so after a loop closure the map is simply built again.
    `every` thins the clouds beforehand.
    """
    points, colours, owners, depths = [], [], [], []
    for keyframe in keyframes:
        cloud = keyframe.cloud[::every]
        points.append(poses.transform(T_world_keyframe[keyframe.id], cloud))
        colours.append(keyframe.colours[::every])
        owners.append(np.full(len(cloud), keyframe.id, dtype=np.int32))
        depths.append(cloud[:, 2])
    if not points or not sum(map(len, points)):
        empty = np.empty((0, 3))
        return PointMap(empty.astype(np.float32), empty.astype(np.uint8), np.empty(0, np.int32))
    return _one_a_voxel(
        np.concatenate(points), np.concatenate(colours), np.concatenate(owners),
        np.concatenate(depths), voxel_m,
    )  # fmt: skip


def _one_a_voxel(
    points: NDArray[np.float64],
    colours: NDArray[np.uint8],
    owners: NDArray[np.int32],
    depths: NDArray[np.float32],
    voxel_m: float,
) -> PointMap:
    cells = np.floor((points - points.min(axis=0)) / voxel_m).astype(np.int64)
    size = cells.max(axis=0) + 1
    key = (cells[:, 0] * size[1] + cells[:, 1]) * size[2] + cells[:, 2]
    # Within a voxel the nearest view comes first.
    order = np.lexsort((depths, key))
    key = key[order]
    first = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    count = np.diff(np.r_[first, len(key)])[:, None]
    mean_points = np.add.reduceat(points[order], first) / count
    mean_colours = np.add.reduceat(colours[order].astype(np.float64), first) / count
    return PointMap(
        mean_points.astype(np.float32),
        np.rint(mean_colours).astype(np.uint8),
        owners[order][first],
    )
