"""Nearest neighbours among descriptors, with the ratio test."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Matches = NDArray[np.intp]

# Height of the strips that guided matching goes by, in search radii.
STRIP_RADII = 3.0


def match(rows: NDArray[Any], columns: NDArray[Any], ratio: float) -> Matches:
    """Match each of the rows to its nearest column, if it is clearly nearer than the next.

    Lowe's ratio test (2004, section 7.1). Several rows may choose the same column: then the
    nearest of them keeps it.

    Parameters
    ----------
    rows : (N, D) float32, or uint8 for binary descriptors
    columns : (M, D) of the same kind
    ratio : float
        Largest distance to the nearest, as a share of the distance to the second nearest.

    Returns
    -------
    (P, 2) int
        Indices into rows and columns.
    """
    if not len(rows) or not len(columns):
        return np.empty((0, 2), dtype=np.intp)
    return _chosen(*_two_nearest(squared_distances(rows, columns)), ratio)


def match_near(
    rows: NDArray[Any],
    columns: NDArray[Any],
    predicted: FloatArray,
    pixels: FloatArray,
    radius: float,
    ratio: float,
) -> Matches:
    """Match as `match` does, but only among columns near to where each row is predicted.

    Parameters
    ----------
    predicted, pixels : (N, 2), (M, 2) float64
        Where the rows should be and where the columns are.
    radius : float
        Largest difference in x and in y, pixels.
    """
    if not len(rows) or not len(columns):
        return np.empty((0, 2), dtype=np.intp)
    nearest = np.zeros(len(rows), dtype=np.intp)
    best, second = np.full((2, len(rows)), np.inf, dtype=np.float32)
    # By horizontal strips, so that most pairs that are too far apart are never compared.
    by_y, heights = np.argsort(pixels[:, 1]), np.sort(pixels[:, 1])
    strips = np.floor(predicted[:, 1] / (STRIP_RADII * radius)).astype(np.intp)
    for strip in np.unique(strips):
        mine = np.flatnonzero(strips == strip)
        y = predicted[mine, 1]
        first, last = np.searchsorted(heights, (y.min() - radius, y.max() + radius))
        near_by = by_y[first:last]
        if not len(near_by):
            continue
        distance = squared_distances(rows[mine], columns[near_by])
        distance[~near(predicted[mine], pixels[near_by], radius)] = np.inf
        found, best[mine], second[mine] = _two_nearest(distance)
        nearest[mine] = near_by[found]
    return _chosen(nearest, best, second, ratio)


def _two_nearest(
    distance: NDArray[np.float32],
) -> tuple[Matches, NDArray[np.float32], NDArray[np.float32]]:
    """Return the nearest column (N,), its distance, and that of the next; changes `distance`."""
    every_row = np.arange(len(distance))
    nearest = distance.argmin(axis=1)
    best = distance[every_row, nearest].copy()
    distance[every_row, nearest] = np.inf
    return nearest, best, distance.min(axis=1)


def _chosen(
    nearest: Matches, best: NDArray[np.float32], second: NDArray[np.float32], ratio: float
) -> Matches:
    """Return the rows that pass the ratio test, each with its column; the nearest keeps it."""
    good = np.flatnonzero((best < ratio**2 * second) & np.isfinite(best))
    good = good[np.argsort(best[good], kind="stable")]
    _, first = np.unique(nearest[good], return_index=True)
    kept = np.sort(good[first])
    return np.column_stack([kept, nearest[kept]])


def squared_distances(rows: NDArray[Any], columns: NDArray[Any]) -> NDArray[np.float32]:
    """Return squared Euclidean (or, for uint8, squared Hamming) distances (N, M)."""
    if rows.dtype == np.uint8:
        bits = [np.unpackbits(side, axis=1).astype(np.float32) for side in (rows, columns)]
        # Of bit vectors, the squared Euclidean distance is the Hamming distance.
        return squared_distances(*bits) ** 2
    product = rows @ columns.T
    product *= -2
    product += np.einsum("nd,nd->n", rows, rows)[:, None]
    product += np.einsum("md,md->m", columns, columns)
    return np.asarray(np.maximum(product, 0, out=product))


def near(
    predicted: NDArray[np.float64], pixels: NDArray[np.float64], radius: float
) -> NDArray[np.bool_]:
    """Return which pixels (M, 2) lie within `radius` of which predicted positions (N, 2)."""
    allowed = np.ones((len(predicted), len(pixels)), dtype=bool)
    gap = np.empty(allowed.shape, dtype=np.float32)
    for axis in (0, 1):
        np.subtract.outer(
            predicted[:, axis].astype(np.float32), pixels[:, axis].astype(np.float32), out=gap
        )
        allowed &= np.abs(gap, out=gap) < radius
    return allowed
