"""What the finished map says of the building: the ground, free space and the occupancy grid."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from datasets import poses
from slam.ground import Ground, GroundSettings, find_ground
from slam.keyframe import Keyframe
from slam.noise import SensorNoise
from slam.occupancy import OccupancyGrid, occupancy
from slam.pose_graph import PoseGraph
from slam.space import Space, SpaceSettings, carve


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
        The keyframes it is made of: those of the largest sub-map.
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
    graph: PoseGraph,
    ground_settings: GroundSettings,
    space_settings: SpaceSettings,
    noise: SensorNoise,
) -> Survey | None:
    """Look at a map as it is now; None if there is nothing in it.

    Sub-maps that no link joins lie anywhere to each other: only the largest is surveyed.
    """
    parts = Counter(graph.component_of(key) for key in keyframes if key in graph)
    if not parts:
        return None
    largest = max(parts, key=lambda part: (parts[part], -part))
    T = {key: pose for key, pose in graph.poses.items() if graph.component_of(key) == largest}
    kept = [keyframes[key] for key in sorted(T) if key in keyframes]
    ground = find_ground(kept, T, ground_settings)
    space = carve(kept, T, ground, space_settings, noise)
    centres = np.array([T[k.id][:3, 3] for k in kept])
    path = poses.transform(ground.T_map_world, centres)
    grid = occupancy(space, ground.T_map_world, space_settings, path)
    left_out = sum(parts.values()) - parts[largest]
    warnings = ground.warnings
    if left_out:
        warnings += (
            f"{left_out} of {sum(parts.values())} keyframes lie in sub-maps that never met the "
            "largest: the floor plan is without them",
        )
    return Survey(ground, space, grid, tuple(k.id for k in kept), path, warnings)
