"""Indoor floor: the observed free cells, and unobserved cells within rooms."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.semantics.rooms.settings import RegionSettings
from roomgraph.semantics.rooms.watershed import NEIGHBOURS, BoolImage, RegionImage
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolume

# Minimum hits of a solid cell, and minimum rays per hit that pass through a clear one.
_SOLID, _CLEAR = 2, 2
# Maximum distance of a lintel from its wall, cells.
_HOLD = 2
# A hole in what was seen is room if less of its ring than this is wall.
_OPEN_RING = 0.2
# Raggedness that an edge may have, cells: depth noise, and a wall between two cells.
_RAGGED = 2
# Minimum distance at which something is away from a wall, cells: its noise, and a cell's diagonal.
_AWAY = 2.5


def interior(
    volume: OccupancyVolume, settings: RegionSettings
) -> tuple[BoolImage, BoolImage, BoolImage]:
    """Return the indoor cells, the wall cells and the cells under a lintel, each (R, C).

    Over a table or under a shelf there is room, too: what counts is sight through the column at
    any height.
    """
    hits, passes = volume.hits[1:-1], volume.passes[1:-1]
    clear: BoolImage = passes > _CLEAR * hits.astype(np.int32)
    is_open = np.asarray(clear.any(axis=0), dtype=bool)
    inside = is_open | (volume.hits[0] > 0) | (volume.passes[0] > 0)
    high = volume.layers(settings.lintel_low_m, settings.lintel_high_m)
    below = volume.layers(0.0, settings.lintel_low_m)
    lintel = np.asarray(
        (volume.hits[high] >= _SOLID).any(axis=0) & (volume.passes[below] > 0).any(axis=0)
    )
    wall = np.asarray(((hits >= _SOLID) & ~clear).any(axis=0) & ~is_open)
    inside &= ~wall
    # A lintel hangs between walls; a lamp does not.
    held = ndimage.binary_propagation(
        ndimage.binary_dilation(wall, NEIGHBOURS, iterations=_HOLD) & lintel,
        NEIGHBOURS, mask=lintel,
    )  # fmt: skip
    return _filled(inside, wall), wall, held & inside


def _filled(inside: BoolImage, wall: BoolImage) -> BoolImage:
    """Fill unobserved holes in the middle of a room: those with almost no wall around."""
    holes, count = ndimage.label(~inside & ~wall)
    result = inside.copy()
    for i, window in enumerate(ndimage.find_objects(holes, count), 1):
        window = tuple(slice(max(0, s.start - 1), s.stop + 1) for s in window)
        hole = holes[window] == i
        ring = ndimage.binary_dilation(hole, NEIGHBOURS) & ~hole
        at_border = any(
            s.start == 0 or s.stop >= n for s, n in zip(window, inside.shape, strict=True)
        )
        if not at_border and wall[window][ring].mean() < _OPEN_RING:
            result[window] |= hole
    return result


def bridged(
    inside: BoolImage, width: NDArray[np.float64], gap_m: float, cell_m: float
) -> BoolImage:
    """Fill unobserved gaps away from walls."""
    radius = max(1, round(gap_m / 2 / cell_m))
    padded = np.pad(inside, radius)
    near = ndimage.distance_transform_edt(~padded) <= radius
    closed = ndimage.distance_transform_edt(near) > radius
    closed = closed[radius:-radius, radius:-radius]
    return np.asarray(inside | (closed & (width > _AWAY * cell_m)))


def completed(
    regions: RegionImage, wall: BoolImage, settings: RegionSettings, cell_m: float
) -> RegionImage:
    """Complete each region (R, C) in its rectangle by connected unobserved cells.

    Corners beside a door are seldom looked at. What is neither wall nor another region belongs to
    the room as far as its seen part reaches along both directions of the walls. Shallow blocks at
    the sides of its rectangle are its own: stalls and cupboards up to the ceiling. A region that
    fills nearly all of its rectangle gets the rest, too.
    """
    side = max(1, round(settings.detail_m / cell_m))
    reach = max(1, round(settings.reach_m / cell_m))
    square = np.ones((side, side), dtype=bool)
    result = np.zeros_like(regions)
    for region in (int(r) for r in np.unique(regions) if r):
        seen = ndimage.binary_opening(regions == region, square)
        if not seen.any():
            continue
        window = _firm(seen, wall)
        open_ = ((regions == 0) & ~wall)[window] | seen[window]
        # Through a hole in a wall, narrower than the square, nothing flows.
        open_ = ndimage.binary_opening(open_, square) | seen[window]
        full = ndimage.binary_propagation(seen[window], mask=open_)
        full = ndimage.binary_fill_holes(_corners(full, seen[window]))
        mine = (regions[window] == 0) | (regions[window] == region)
        rest = ndimage.binary_opening(~full & mine, square)
        others = ndimage.binary_dilation(~mine, iterations=reach)
        deepest = round(settings.closet_m / cell_m)
        full |= _closets(rest, others, deepest, settings.squareness)
        # What the fronts of furniture and partitions take up is floor, too.
        if (ndimage.binary_dilation(full, iterations=reach) & mine).mean() >= settings.squareness:
            full = np.ones_like(full)
        result[window][full & mine & (result[window] == 0)] = region
    return result


def _firm(seen: BoolImage, wall: BoolImage) -> tuple[slice, slice]:
    """Return the rectangle around the observed cells, without ragged edges.

    Noise puts a wall a cell or two further out here and there: a line of cells with more of the
    room's wall than of its floor is not the room's. What reaches further is an alcove and stays.
    """
    window = ndimage.find_objects(seen.astype(np.int8))[0]
    own_wall = wall & ndimage.binary_dilation(seen, iterations=_RAGGED)
    is_room = seen[window].astype(np.int8) - own_wall[window]
    rows, columns = (
        _firm_span(is_room.sum(axis=axis) >= 0, span.start)
        for axis, span in zip((1, 0), window, strict=True)
    )
    return rows, columns


def _firm_span(is_room: BoolImage, start: int) -> slice:
    """Return the lines from the first to the last that is the room's, if these are near the ends.

    Where none of the first, or last, few is, none is left out.
    """
    low, high = (int(lines[: _RAGGED + 1].argmax()) for lines in (is_room, is_room[::-1]))
    return slice(start + low, start + len(is_room) - high)


def _closets(rest: BoolImage, others: BoolImage, deepest: int, squareness: float) -> BoolImage:
    """Return the blocks in the rest of a rectangle that are too shallow for a room.

    A block next to another room may be that one's, or the wall between both.
    """
    result = np.zeros_like(rest)
    pieces, count = ndimage.label(rest)
    for i, window in enumerate(ndimage.find_objects(pieces, count), 1):
        piece = pieces[window] == i
        is_block = min(piece.shape) <= deepest and piece.mean() >= squareness
        if is_block and not others[window][piece].any():
            result[window] |= piece
    return result


def _corners(full: BoolImage, seen: BoolImage) -> BoolImage:
    """Return the observed cells with the unobserved pieces of `full` that are only corners.

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
