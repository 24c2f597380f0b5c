"""Floor analysis of the finished map: floor plane, free space and occupancy grid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.floor_plane import (
    FloorPlane,
    FloorPlaneSettings,
    find_floor_plane,
)
from roomgraph.slam.reconstruction.occupancy_grid import OccupancyGrid, occupancy
from roomgraph.slam.reconstruction.occupancy_volume import (
    OccupancyVolume,
    OccupancyVolumeSettings,
    carve,
)

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FloorAnalysis:
    """Floor plane, carved space and occupancy grid of a map, all in the map frame.

    Attributes
    ----------
    floor_plane : FloorPlane
        Where the map frame lies.
    volume : OccupancyVolume
        Hits and passes by column.
    grid : OccupancyGrid
        The same, flattened for robots.
    keyframes : tuple of int
        The keyframes it is made of: those with a place in the world.
    path_map : (N, 3) float64
        Their camera centres in the map frame, metres.
    warnings : tuple of str
        What had to be guessed or left out.
    """

    floor_plane: FloorPlane
    volume: OccupancyVolume
    grid: OccupancyGrid
    keyframes: tuple[int, ...]
    path_map: NDArray[np.float64]
    warnings: tuple[str, ...]


def analyse_floor(
    keyframes: Mapping[int, Keyframe],
    T_world_keyframe: Mapping[int, FloatArray],
    floor_plane_settings: FloorPlaneSettings,
    volume_settings: OccupancyVolumeSettings,
    noise: SensorNoise,
) -> FloorAnalysis | None:
    """Analyse the present map; None if it is empty.

    Parameters
    ----------
    T_world_keyframe : mapping of int to (4, 4) float64
        Of the keyframes that have a place in the world; the others are left out.
    """
    T = T_world_keyframe
    kept = [keyframes[key] for key in sorted(T) if key in keyframes]
    if not kept:
        return None
    floor_plane = find_floor_plane(kept, T, floor_plane_settings)
    volume = carve(kept, T, floor_plane, volume_settings, noise)
    centres = np.array([T[k.id][:3, 3] for k in kept])
    path = se3.transform(floor_plane.T_map_world, centres)
    grid = occupancy(volume, floor_plane.T_map_world, volume_settings, path)
    left_out = len(keyframes) - len(kept)
    warnings = floor_plane.warnings
    if left_out:
        warnings += (
            f"{left_out} of {len(keyframes)} keyframes lie in sub-maps that never met the "
            "map: it is without them",
        )
    return FloorAnalysis(
        floor_plane=floor_plane,
        volume=volume,
        grid=grid,
        keyframes=tuple(k.id for k in kept),
        path_map=path,
        warnings=warnings,
    )
