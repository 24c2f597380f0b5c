"""Watershed on an image of widths, flooded from its widest points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

BoolImage = NDArray[np.bool_]
RegionImage = NDArray[np.int32]
NEIGHBOURS = np.ones((3, 3), dtype=bool)


def flood(width: NDArray[np.float64], cell_m: float) -> tuple[RegionImage, dict[int, float]]:
    """Return basins (R, C) around the widest points, and the half width of each there, metres.

    A spot that is not a cell's diagonal wider than the way to a wider one is no basin of its own.
    """
    basins = np.zeros(width.shape, dtype=np.int32)
    peaks: dict[int, float] = {}
    for level in np.arange(width.max(), 0, -cell_m / 2):
        spots, count = ndimage.label(width >= level, NEIGHBOURS)
        for i, window in enumerate(ndimage.find_objects(spots, count), 1):
            here, spot = basins[window], spots[window] == i
            found = [int(b) for b in np.unique(here[spot]) if b]
            if not found:
                found = [len(peaks) + 1]
                peaks[found[0]] = float(level)
                here[spot] = found[0]
                continue
            widest = max(found, key=lambda b: peaks[b])
            for b in found:
                if b != widest and peaks[b] - level < 1.5 * cell_m:
                    here[here == b] = widest
            here[...] = np.where(spot, spread(here * spot, spot), here)
    return basins, peaks


def spread(regions: RegionImage, where: BoolImage) -> RegionImage:
    """Assign each cell of `where` to the nearest region that it is connected to."""
    if not regions.any():
        return np.where(where, regions, 0)
    nearest = ndimage.distance_transform_edt(
        regions == 0, return_distances=False, return_indices=True
    )
    return np.where(where, regions[tuple(nearest)], 0).astype(np.int32)


def borders(regions: RegionImage) -> dict[tuple[int, int], NDArray[np.intp]]:
    """Return, for each two regions that touch, the cells (N, 2) of both on their border."""
    cells: dict[tuple[int, int], list[NDArray[np.intp]]] = {}
    for axis in (0, 1):
        one = np.moveaxis(regions, axis, 0)[:-1]
        other = np.moveaxis(regions, axis, 0)[1:]
        at = np.argwhere((one != other) & (one > 0) & (other > 0))
        a, b = one[tuple(at.T)], other[tuple(at.T)]
        low, high = np.minimum(a, b), np.maximum(a, b)
        for pair in {(int(p), int(q)) for p, q in zip(low, high, strict=True)}:
            here = at[(low == pair[0]) & (high == pair[1])]
            both = np.concatenate([here, here + np.array([1, 0])])
            cells.setdefault(pair, []).append(both if axis == 0 else both[:, ::-1])
    return {pair: np.unique(np.concatenate(found), axis=0) for pair, found in cells.items()}
