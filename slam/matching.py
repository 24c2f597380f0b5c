"""Nearest neighbours among descriptors, with the ratio test."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Matches = NDArray[np.intp]


def match(
    rows: NDArray[Any],
    columns: NDArray[Any],
    ratio: float,
    allowed: NDArray[np.bool_] | None = None,
) -> Matches:
    """Match each of the rows to its nearest column, if it is clearly nearer than the next.

    Lowe's ratio test (2004, section 7.1), among the columns allowed. Several rows may choose the
    same column: then the nearest of them keeps it.

    Parameters
    ----------
    rows : (N, D) float32, or uint8 for binary descriptors
    columns : (M, D) of the same kind
    ratio : float
        Largest distance to the nearest, as a share of the distance to the second nearest.
    allowed : (N, M) bool, optional
        Pairs that may match at all.

    Returns
    -------
    (P, 2) int
        Indices into rows and columns.
    """
    if not len(rows) or not len(columns):
        return np.empty((0, 2), dtype=np.intp)
    distance = squared_distances(rows, columns)
    if allowed is not None:
        distance[~allowed] = np.inf
    every_row = np.arange(len(rows))
    nearest = distance.argmin(axis=1)
    best = distance[every_row, nearest].copy()
    distance[every_row, nearest] = np.inf
    second = distance.min(axis=1)
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
