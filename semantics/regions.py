"""Rooms as regions of the floor: free space cut where it is narrow, as doors are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy import ndimage

from datasets.settings import Settings
from semantics.watershed import (
    NEIGHBOURS,
    BoolImage,
    RegionImage,
    borders,
    flood,
    spread,
)
from slam.space import Space


class RegionSettings(Settings):
    """What is taken for a room of its own."""

    door_width_m: float = Field(
        1.3, gt=0, le=5, description="a passage no wider parts rooms, whatever lies behind it"
    )
    narrowing: float = Field(
        0.8, gt=0, le=1, description="a passage parts rooms if it is narrower than this share"
    )
    narrowing_labelled: float = Field(
        0.95, gt=0, le=1, description="the same between places of different labels"
    )
    min_area_m2: float = Field(1.0, ge=0, description="a smaller region is part of its neighbour")
    min_unvisited_m2: float = Field(
        3.0, ge=0, description="the same of a region that the camera never was in"
    )
    lintel_low_m: float = Field(1.8, gt=0, description="height from which a lintel may hang")
    lintel_high_m: float = Field(2.35, gt=0, description="height above which it is the ceiling")
    reach_m: float = Field(
        0.15, ge=0, le=1, description="from the last free cell to the wall behind it, at most"
    )
    gap_m: float = Field(
        0.6, ge=0, le=3, description="unseen stretches up to this wide between seen ones are room"
    )
    detail_m: float = Field(
        0.4, ge=0, le=2, description="narrower bulges of a region are holes in its wall"
    )
    squareness: float = Field(
        0.9, gt=0, le=1, description="a region that fills this share of its rectangle is all of it"
    )


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


def interior(space: Space, settings: RegionSettings) -> tuple[BoolImage, BoolImage, BoolImage]:
    """Return which cells (R, C) are indoors, which solid from floor to top, which under a lintel.

    Over a table or under a shelf there is room, too: what counts is sight through the column at
    any height.
    """
    hits, passes = space.hits[1:-1], space.passes[1:-1]
    clear: BoolImage = passes > 2 * hits.astype(np.int32)
    is_open = np.asarray(clear.any(axis=0), dtype=bool)
    inside = is_open | (space.hits[0] > 0) | (space.passes[0] > 0)
    high = space.layers(settings.lintel_low_m, settings.lintel_high_m)
    below = space.layers(0.0, settings.lintel_low_m)
    lintel = np.asarray((space.hits[high] >= 2).any(axis=0) & (space.passes[below] > 0).any(axis=0))
    wall = np.asarray(((hits >= 2) & ~clear).any(axis=0) & ~is_open)
    inside &= ~wall
    # A lintel hangs between walls; a lamp does not.
    held = ndimage.binary_propagation(
        ndimage.binary_dilation(wall, NEIGHBOURS, iterations=2) & lintel,
        NEIGHBOURS, mask=lintel,
    )  # fmt: skip
    return _filled(inside, wall), wall, held & inside


def _filled(inside: BoolImage, wall: BoolImage) -> BoolImage:
    """Fill what nobody looked at in the middle of a room: holes with next to no wall around."""
    holes, count = ndimage.label(~inside & ~wall)
    result = inside.copy()
    for i, window in enumerate(ndimage.find_objects(holes, count), 1):
        window = tuple(slice(max(0, s.start - 1), s.stop + 1) for s in window)
        hole = holes[window] == i
        ring = ndimage.binary_dilation(hole, NEIGHBOURS) & ~hole
        at_border = any(
            s.start == 0 or s.stop >= n for s, n in zip(window, inside.shape, strict=True)
        )
        if not at_border and wall[window][ring].mean() < 0.2:
            result[window] |= hole
    return result


def segment(
    space: Space, votes: Mapping[tuple[int, int], Counter[str]], settings: RegionSettings
) -> Regions:
    """Cut the floor into rooms.

    Free space is flooded from its widest spots downwards (a watershed on the distance transform;
    Bormann et al., 2016, section III-B). Two basins that meet become one unless the passage between
    them is as narrow as a door, or narrower than both by a share that depends on whether the
    labels voted for in them differ. Under a lintel there is always a passage.

    Parameters
    ----------
    space : Space
        As carved.
    votes : mapping of (row, column) to Counter
        Labels of the frames taken from a cell, weighed.
    settings : RegionSettings
        What parts rooms.
    """
    inside, wall, lintel = interior(space, settings)
    # Distance to walls, not to what was not seen: the edge of sight is no wall.
    width = ndimage.distance_transform_edt(~(wall | lintel)) * space.cell_m
    inside = _bridged(inside, width, settings.gap_m, space.cell_m)
    basins, peaks = flood(width * inside, space.cell_m)
    basins = spread(basins, inside)
    merged = _merge(basins, peaks, width, votes, settings, space.cell_m)
    reach = max(1, round(settings.reach_m / space.cell_m))
    # Up to walls, and not beyond where there is none in sight.
    at_wall = ndimage.binary_dilation(wall, iterations=reach) & ~wall
    grown = spread(merged, ndimage.binary_dilation(inside, iterations=reach, mask=at_wall | inside))
    kept = _without_small(_connected(grown), set(votes), settings, space.cell_m)
    return Regions(kept, _completed(kept, wall, settings, space.cell_m))


def _bridged(
    inside: BoolImage, width: NDArray[np.float64], gap_m: float, cell_m: float
) -> BoolImage:
    """Close gaps of sight that lie away from walls."""
    radius = max(1, round(gap_m / 2 / cell_m))
    padded = np.pad(inside, radius)
    near = ndimage.distance_transform_edt(~padded) <= radius
    closed = ndimage.distance_transform_edt(near) > radius
    closed = closed[radius:-radius, radius:-radius]
    return np.asarray(inside | (closed & (width > 2.5 * cell_m)))


def _completed(
    regions: RegionImage, wall: BoolImage, settings: RegionSettings, cell_m: float
) -> RegionImage:
    """Complete each region (R, C) within its rectangle by what hangs together with it unseen.

    Corners beside a door are seldom looked at. What is neither wall nor another region belongs to
    the room as far as its seen part reaches along both directions of the walls. A region that
    fills nearly all of its rectangle gets the rest, too: that is a cupboard up to the ceiling.
    """
    side = max(1, round(settings.detail_m / cell_m))
    reach = max(1, round(settings.reach_m / cell_m))
    square = np.ones((side, side), dtype=bool)
    result = np.zeros_like(regions)
    for region in (int(r) for r in np.unique(regions) if r):
        seen = ndimage.binary_opening(regions == region, square)
        if not seen.any():
            continue
        window = ndimage.find_objects(seen.astype(np.int8))[0]
        open_ = ((regions == 0) & ~wall)[window] | seen[window]
        # Through a hole in a wall, narrower than the square, nothing flows.
        open_ = ndimage.binary_opening(open_, square) | seen[window]
        full = ndimage.binary_propagation(seen[window], mask=open_)
        full = ndimage.binary_fill_holes(_corners(full, seen[window]))
        mine = (regions[window] == 0) | (regions[window] == region)
        # What the fronts of furniture and partitions take up is floor, too.
        if (ndimage.binary_dilation(full, iterations=reach) & mine).mean() >= settings.squareness:
            full = np.ones_like(full)
        result[window][full & mine & (result[window] == 0)] = region
    return result


def _corners(full: BoolImage, seen: BoolImage) -> BoolImage:
    """Return what was seen with those unseen pieces of `full` that are no more than corners of it.

    Cut off by a straight edge of sight, a corner's area is a quarter of the edge's square at most;
    what is larger than the square is a room of its own behind a gap.
    """
    pieces, _ = ndimage.label(full & ~seen, NEIGHBOURS)
    contact = ndimage.binary_dilation(seen, NEIGHBOURS) & (pieces > 0)
    areas = np.bincount(pieces.ravel())
    edges = np.bincount(pieces[contact], minlength=len(areas))
    is_corner = areas <= edges**2
    is_corner[0] = False
    return np.asarray(seen | is_corner[pieces])


def _merge(
    basins: RegionImage,
    peaks: dict[int, float],
    width: NDArray[np.float64],
    votes: Mapping[tuple[int, int], Counter[str]],
    settings: RegionSettings,
    cell_m: float,
) -> RegionImage:
    """Join basins, the widest passage first, that no door and no narrowing parts."""
    labels: dict[int, Counter[str]] = {b: Counter() for b in peaks}
    for cell, counts in votes.items():
        if basins[cell]:
            labels[int(basins[cell])].update(counts)
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
        labels[wide].update(labels[slim])
    table = np.zeros(max(peaks, default=0) + 1, dtype=np.int32)
    for b in peaks:
        table[b] = root(b)
    return table[basins]


def _first(counts: Counter[str]) -> str | None:
    return counts.most_common(1)[0][0] if counts else None


def _connected(regions: RegionImage) -> RegionImage:
    """Make a region of its own of every part of a region that hangs together."""
    result = np.zeros_like(regions)
    for region in (int(r) for r in np.unique(regions) if r):
        parts, _ = ndimage.label(regions == region)
        result[parts > 0] = parts[parts > 0] + result.max()
    return result


def _without_small(
    regions: RegionImage, visited: set[tuple[int, int]], settings: RegionSettings, cell_m: float
) -> RegionImage:
    """Give small regions to the neighbour with the longest common border; drop lone ones."""
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
