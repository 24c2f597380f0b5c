"""The coloured point map: keyframes fused in voxels at their present poses."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.geometry.voxel_hash import voxels_of
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.dynamic_points import count_visibility
from roomgraph.slam.reconstruction.fusion import Fused, Fusion, Voxels

FloatArray = NDArray[np.float64]


class MapSettings(Settings):
    """How dense the map is."""

    voxel_m: float = Field(
        default=0.02, gt=0, le=1, description="side of a voxel, which holds one point, metres"
    )
    stride: int = Field(
        default=4, ge=1, le=64, description="every n-th pixel of a keyframe is mapped"
    )
    max_depth_m: float = Field(
        default=4.0, gt=0, le=65, description="readings beyond are not mapped, metres"
    )
    remove_dynamic: bool = Field(
        default=True, description="remove dynamic points: those that later keyframes see through"
    )
    sketch_voxels: float = Field(
        default=2.5,
        ge=1,
        le=50,
        description="voxel size of the online map, as a multiple of voxel_m",
    )
    sketch_every: int = Field(
        default=2, ge=1, le=16, description="every n-th keyframe is used for the online map"
    )
    sketch_step: int = Field(
        default=2, ge=1, le=16, description="every n-th mapped pixel is used for the online map"
    )
    sketch_slack: float = Field(
        default=0.5, ge=0, le=10,
        description="a keyframe that moves by this many voxels of the online map is fused again",
    )  # fmt: skip


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
    normals : (N, 3) float32
        Of the surface, unit length, towards the cameras that saw it.
    """

    points_world: NDArray[np.float32]
    colours: NDArray[np.uint8]
    keyframes: NDArray[np.int32]
    normals: NDArray[np.float32]

    def __len__(self) -> int:
        return len(self.points_world)

    @property
    def nbytes(self) -> int:
        """Bytes held."""
        arrays = (self.points_world, self.colours, self.keyframes, self.normals)
        return sum(array.nbytes for array in arrays)

    def surface_m2(self, cell_m: float = 0.1) -> float:
        """Return the area of the surfaces seen, square metres.

        A plane of area A with unit normal n passes through A (|nx| + |ny| + |nz|) / a^2 cells of
        side a, so every cell that holds a point counts for its share, by its points' mean normal.
        """
        if not len(self):
            return 0.0
        _, group = np.unique(voxels_of(self.points_world, cell_m), return_inverse=True)
        sums = np.stack([np.bincount(group, axis) for axis in self.normals.T], axis=-1)
        spread = np.abs(sums).sum(axis=1) / np.maximum(np.linalg.norm(sums, axis=1), 1e-12)
        return float((cell_m**2 / np.maximum(spread, 1.0)).sum())

    def chosen(self, rows: NDArray[Any]) -> PointMap:
        """Return the map of some points only: their numbers, or (N,) bool."""
        return PointMap(
            self.points_world[rows], self.colours[rows], self.keyframes[rows], self.normals[rows]
        )


def build_map(
    keyframes: Iterable[Keyframe],
    T_world_keyframe: Mapping[int, FloatArray],
    settings: MapSettings,
    noise: SensorNoise,
) -> PointMap:
    """Fuse keyframes at their present poses, and remove points that others see through.

    Nothing is kept between calls, so after a loop closure the map is simply built again; memory
    follows the space seen (see `fusion`), not the number of keyframes.
    """
    images = [(keyframe.id, keyframe.image) for keyframe in keyframes]
    voxels = _fused(images, T_world_keyframe, settings.voxel_m, noise)
    points = _as_map(voxels)
    if settings.remove_dynamic and len(points):
        seen = count_visibility(voxels, settings.voxel_m, images, T_world_keyframe, noise)
        points = points.chosen(~seen.is_empty)
    return points


def _fused(
    images: Iterable[tuple[int, RangeImage]],
    T_world_keyframe: Mapping[int, FloatArray],
    voxel_m: float,
    noise: SensorNoise,
) -> Voxels:
    fusion = Fusion(voxel_m, noise)
    for keyframe, image in images:
        fusion.add(keyframe, image, T_world_keyframe[keyframe])
    return fusion.voxels()


class LiveMap:
    """A map that follows the keyframes: fuses new ones, and fuses moved ones again.

    It costs as much as has changed, not as much as there is. Things that have moved away stay in
    it; `build_map` is for keeps.
    """

    def __init__(self, settings: MapSettings, noise: SensorNoise) -> None:
        self.settings = settings
        self._voxel_m = settings.sketch_voxels * settings.voxel_m
        self._noise = noise
        self._fusion = Fusion(self._voxel_m, noise)

    @property
    def nbytes(self) -> int:
        """Bytes held."""
        images = sum(fused.image.nbytes for fused in self._fusion.fused.values())
        return self._fusion.nbytes + images

    def update(
        self, keyframes: Mapping[int, Keyframe], T_world_keyframe: Mapping[int, FloatArray]
    ) -> PointMap:
        """Follow the keyframes to the poses given and return the map."""
        for keyframe, fused in list(self._fusion.fused.items()):
            if keyframe not in keyframes or self._has_moved(fused, T_world_keyframe[keyframe]):
                self._fusion.remove(keyframe)
        if self._fusion.waste > 0.5:
            self._fusion = Fusion(self._voxel_m, self._noise)
        for keyframe in sorted(keyframes.keys() - self._fusion.fused.keys()):
            image = keyframes[keyframe].image.every(self.settings.sketch_step)
            self._fusion.add(keyframe, image, T_world_keyframe[keyframe])
        return _as_map(self._fusion.voxels())

    def _has_moved(self, fused: Fused, now: FloatArray) -> bool:
        """Whether what a keyframe shows has moved by more than the slack."""
        T = se3.inverse(fused.T_world_keyframe) @ now
        moved = np.linalg.norm(T[:3, 3]) + se3.rotation_angle(T) * fused.typical_m
        return bool(moved > self.settings.sketch_slack * self._voxel_m)


def _as_map(voxels: Voxels) -> PointMap:
    return PointMap(voxels.points, voxels.colours, voxels.keyframes, voxels.normals)
