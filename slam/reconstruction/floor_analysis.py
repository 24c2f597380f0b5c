"""What the finished map says of the building: the ground, free space and the occupancy grid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.floor_plane import Ground, GroundSettings, find_ground
from roomgraph.slam.reconstruction.occupancy_grid import OccupancyGrid, occupancy
from roomgraph.slam.reconstruction.occupancy_volume import Space, SpaceSettings, carve

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Survey:
    """Ground, carved space and occupancy grid of a map, all in the map frame.

    Attributes
    ----------
    ground : Ground
        Where the map frame lies.
    space : Space
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

    ground: Ground
    space: Space
    grid: OccupancyGrid
    keyframes: tuple[int, ...]
    path_map: NDArray[np.float64]
    warnings: tuple[str, ...]


def survey(
    keyframes: dict[int, Keyframe],
    T_world_keyframe: Mapping[int, FloatArray],
    ground_settings: GroundSettings,
    space_settings: SpaceSettings,
    noise: SensorNoise,
) -> Survey | None:
    """Look at a map as it is now; None if there is nothing in it.

    Parameters
    ----------
    T_world_keyframe : mapping of int to (4, 4) float64
        Of the keyframes that have a place in the world; the others are left out.
    """
    T = T_world_keyframe
    kept = [keyframes[key] for key in sorted(T) if key in keyframes]
    if not kept:
        return None
    ground = find_ground(kept, T, ground_settings)
    space = carve(kept, T, ground, space_settings, noise)
    centres = np.array([T[k.id][:3, 3] for k in kept])
    path = se3.transform(ground.T_map_world, centres)
    grid = occupancy(space, ground.T_map_world, space_settings, path)
    left_out = len(keyframes) - len(kept)
    warnings = ground.warnings
    if left_out:
        warnings += (
            f"{left_out} of {len(keyframes)} keyframes lie in sub-maps that never met the "
            "map: it is without them",
        )
    return Survey(ground, space, grid, tuple(k.id for k in kept), path, warnings)
