"""The 2-D occupancy grid: free, occupied and unknown cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolume, OccupancyVolumeSettings

FREE, OCCUPIED, UNKNOWN = 0, 100, -1
# Log-odds of a cell by keyframe: OctoMap's defaults for a hit and a miss (probabilities 0.7, 0.4).
_HIT, _MISS = 0.85, -0.41
# Keyframes that have to agree on a surface; a single one may be wrong about a cell.
_MIN_HITS = 2
# A surface lies in the cell with the most hits; the noise around it gets this share at most.
_NOISE_SHARE = 0.5
# Who sees through this height, or the floor, knows that nothing stands there: a view over a
# counter does not.
_LOW_M = 0.6
# Half the width of who carries the camera, at least; and the longest step between two keyframes.
_BODY_M = 0.15
_LONGEST_STEP_M = 1.0


@dataclass(frozen=True, slots=True)
class OccupancyGrid:
    """Cells over the floor in the map frame, as ROS's ``nav_msgs/OccupancyGrid`` has them.

    Attributes
    ----------
    cells : (R, C) int8
        0 free, 100 occupied, -1 unknown. Row 0 is at the lowest y, column 0 at the lowest x.
    cell_m : float
        Side of a cell.
    origin_xy : (2,) float64
        Outer corner of cell (0, 0) in the map frame, metres.
    T_map_world : (4, 4) float64
        Maps the run's world to the map frame: z up, floor at 0.
    """

    cells: NDArray[np.int8]
    cell_m: float
    origin_xy: NDArray[np.float64]
    T_map_world: NDArray[np.float64]


def occupancy(
    volume: OccupancyVolume,
    T_map_world: NDArray[np.float64],
    settings: OccupancyVolumeSettings,
    path_map: NDArray[np.float64],
) -> OccupancyGrid:
    """Flatten carved space into an occupancy grid.

    A cell is occupied where, in any layer between the settings' heights, surfaces outweigh sight
    through it; free where the floor was seen, sight went through low above it, or the camera
    itself went; unknown otherwise.

    Parameters
    ----------
    volume : OccupancyVolume
        As carved.
    T_map_world : (4, 4) float64
        Of the floor plane that it was carved over.
    settings : OccupancyVolumeSettings
        Heights of what is in the way.
    path_map : (N, >= 2) float64
        Camera centres in the map frame, metres.
    """
    band = volume.layers(settings.min_height_m, settings.max_height_m)
    hits = volume.hits[band].astype(np.float32)
    passes = volume.passes[band].astype(np.float32)
    solid = (hits >= _MIN_HITS) & (_HIT * hits + _MISS * passes > 0)
    evidence = np.where(solid, hits, 0).sum(axis=0)
    occupied = thinned(evidence)
    low = volume.passes[volume.layers(settings.min_height_m, _LOW_M)]
    seen = low.any(axis=0) | (volume.hits[0] > 0) | (volume.passes[0] > 0)
    seen |= _walked(volume, path_map)
    cells = np.full(seen.shape, UNKNOWN, dtype=np.int8)
    cells[seen & (evidence == 0)] = FREE
    cells[occupied] = OCCUPIED
    return OccupancyGrid(cells, volume.cell_m, volume.origin_xy, T_map_world)


def _walked(volume: OccupancyVolume, path_map: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return the cells (R, C) that the person with the camera walked through."""
    walked = np.zeros(volume.hits.shape[1:], dtype=bool)
    if not len(path_map):
        return walked
    steps = np.linalg.norm(np.diff(path_map[:, :2], axis=0), axis=1)
    # Over a longer step tracking was lost, or the path starts anew.
    steps[steps > _LONGEST_STEP_M] = 0.0
    counts = np.ceil(steps / volume.cell_m).astype(int)
    way = [path_map[-1:, :2]]
    for start, end, count in zip(path_map[:-1, :2], path_map[1:, :2], counts, strict=True):
        share = np.arange(max(1, count))[:, None] / max(1, count)
        way.append(start + share * (end - start) * (count > 0))
    row, column = volume.cells_of(np.concatenate(way)).T
    walked[row, column] = True
    reach = ndimage.distance_transform_edt(~walked) * volume.cell_m
    return np.asarray(reach <= _BODY_M)


def thinned(evidence: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Return the cells (R, C) with evidence that is not just the noise of a stronger neighbour."""
    strongest = ndimage.maximum_filter(evidence, size=3)
    return np.asarray((evidence > 0) & (evidence >= _NOISE_SHARE * strongest))
