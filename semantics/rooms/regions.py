"""Segmentation of free space into rooms at narrow passages such as doors."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.semantics.rooms.indoors import bridged, completed, interior
from roomgraph.semantics.rooms.settings import RegionSettings
from roomgraph.semantics.rooms.watershed import (
    RegionImage,
    borders,
    flood,
    spread,
)
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolume

Weights = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Regions:
    """The region of each cell, from 1; 0 is none.

    Attributes
    ----------
    seen : (R, C) int32
        As far as it was seen, doorways included: regions touch where one can pass.
    full : (R, C) int32
        The whole rooms, completed where nobody looked.
    """

    seen: RegionImage
    full: RegionImage


def segment(
    volume: OccupancyVolume, votes: Mapping[tuple[int, int], Weights], settings: RegionSettings
) -> Regions:
    """Segment the floor into rooms.

    Free space is flooded from its widest spots downwards (a watershed on the distance transform;
    Bormann et al., 2016, section III-B). Two basins that meet become one unless the passage between
    them is as narrow as a door, or narrower than both by a share that depends on whether the
    labels voted for in them differ. Under a lintel there is always a passage.

    Parameters
    ----------
    volume : OccupancyVolume
        As carved.
    votes : mapping of (row, column) to mapping of str to float
        Labels of the frames taken from a cell, weighed.
    settings : RegionSettings
        What separates rooms.
    """
    inside, wall, lintel = interior(volume, settings)
    # Distance to walls, not to what was not seen: the edge of sight is no wall.
    width = ndimage.distance_transform_edt(~(wall | lintel)) * volume.cell_m
    inside = bridged(inside, width, settings.gap_m, volume.cell_m)
    basins, peaks = flood(width * inside, volume.cell_m)
    basins = spread(basins, inside)
    merged = _merge(basins, peaks, width, votes, settings, volume.cell_m)
    reach = max(1, round(settings.reach_m / volume.cell_m))
    # Up to walls, and not beyond where there is none in sight.
    at_wall = ndimage.binary_dilation(wall, iterations=reach) & ~wall
    grown = spread(merged, ndimage.binary_dilation(inside, iterations=reach, mask=at_wall | inside))
    kept = _without_small(_connected(grown), set(votes), settings, volume.cell_m)
    return Regions(kept, completed(kept, wall, settings, volume.cell_m))


def _merge(
    basins: RegionImage,
    peaks: dict[int, float],
    width: NDArray[np.float64],
    votes: Mapping[tuple[int, int], Weights],
    settings: RegionSettings,
    cell_m: float,
) -> RegionImage:
    """Merge basins that neither a door nor a narrowing separates, the widest passage first."""
    labels = {b: defaultdict[str, float](float) for b in peaks}
    for cell, counts in votes.items():
        if basins[cell]:
            _add(labels[int(basins[cell])], counts)
    passages = [
        (float(width[tuple(cells.T)].max()), pair) for pair, cells in borders(basins).items()
    ]
    into = {b: b for b in peaks}

    def root(b: int) -> int:
        while into[b] != b:
            b = into[b]
        return b

    for half, pair in sorted(passages, reverse=True):
        a, b = (root(p) for p in pair)
        if a == b:
            continue
        differ = _first(labels[a]) != _first(labels[b]) and labels[a] and labels[b]
        share = settings.narrowing_labelled if differ else settings.narrowing
        narrowest = min(peaks[a], peaks[b])
        is_door = (
            2 * half <= settings.door_width_m and half < settings.narrowing_labelled * narrowest
        )
        if is_door or half + cell_m / 2 < share * narrowest:
            continue
        wide, slim = (a, b) if peaks[a] >= peaks[b] else (b, a)
        into[slim] = wide
        _add(labels[wide], labels[slim])
    table = np.zeros(max(peaks, default=0) + 1, dtype=np.int32)
    for b in peaks:
        table[b] = root(b)
    return table[basins]


def _add(total: defaultdict[str, float], weights: Weights) -> None:
    for label, weight in weights.items():
        total[label] += weight


def _first(weights: Weights) -> str | None:
    return max(weights, key=lambda label: weights[label]) if weights else None


def _connected(regions: RegionImage) -> RegionImage:
    """Turn each connected component of a region into a separate region."""
    result = np.zeros_like(regions)
    for region in (int(r) for r in np.unique(regions) if r):
        pieces, _ = ndimage.label(regions == region)
        result[pieces > 0] = pieces[pieces > 0] + result.max()
    return result


def _without_small(
    regions: RegionImage, visited: set[tuple[int, int]], settings: RegionSettings, cell_m: float
) -> RegionImage:
    """Merge small regions into the neighbour with the longest common border; drop isolated ones."""
    regions = regions.copy()
    here = {int(regions[cell]) for cell in visited}
    while True:
        areas = np.bincount(regions.ravel()) * cell_m**2
        least = np.full(len(areas), settings.min_unvisited_m2 if here else settings.min_area_m2)
        least[[r for r in here if r < len(areas)]] = settings.min_area_m2
        small = np.flatnonzero((areas > 0) & (areas < least))
        small = small[small > 0]
        if not len(small):
            return regions
        smallest = int(small[areas[small].argmin()])
        lengths = {
            sum(pair) - smallest: len(cells)
            for pair, cells in borders(regions).items()
            if smallest in pair
        }
        regions[regions == smallest] = max(lengths, key=lambda r: (lengths[r], -r), default=0)
