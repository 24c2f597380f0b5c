"""Pairing two lists of time stamps, as the TUM RGB-D benchmark does."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

MAX_DIFFERENCE_S = 0.02


def associate(
    first_s: NDArray[np.float64],
    second_s: NDArray[np.float64],
    max_difference_s: float = MAX_DIFFERENCE_S,
) -> NDArray[np.int64]:
    """Pair stamps one to one, the smallest differences first.

    Parameters
    ----------
    first_s, second_s : (N,), (M,) float64
        Seconds, each list rising.
    max_difference_s : float
        Stamps this far apart or further are never paired.

    Returns
    -------
    (P, 2) int64
        Indices into `first_s` and `second_s`, rising in the first.
    """
    low = np.searchsorted(second_s, first_s - max_difference_s, side="left")
    high = np.searchsorted(second_s, first_s + max_difference_s, side="right")
    candidates = [(i, j) for i in range(len(first_s)) for j in range(low[i], high[i])]
    if not candidates:
        return np.empty((0, 2), dtype=np.int64)
    pairs = np.array(candidates, dtype=np.int64)
    difference = np.abs(first_s[pairs[:, 0]] - second_s[pairs[:, 1]])
    order = np.argsort(difference, kind="stable")
    taken_first, taken_second, chosen = set[int](), set[int](), []
    for k in order[difference[order] < max_difference_s]:
        i, j = int(pairs[k, 0]), int(pairs[k, 1])
        if i not in taken_first and j not in taken_second:
            taken_first.add(i)
            taken_second.add(j)
            chosen.append((i, j))
    return np.array(sorted(chosen), dtype=np.int64).reshape(-1, 2)


def typical_offset(first_s: NDArray[np.float64], second_s: NDArray[np.float64]) -> float:
    """Return by how many seconds the stamps `second_s` (M,) lie after `first_s` (N,), typically.

    Recordings that overlap are compared by nearest stamps, others (of clocks with different
    beginnings) by their beginnings.
    """
    if second_s[0] > first_s[-1] or second_s[-1] < first_s[0]:
        return float(second_s[0] - first_s[0])
    after = np.clip(np.searchsorted(second_s, first_s), 0, len(second_s) - 1)
    gaps = np.column_stack([second_s[np.maximum(after - 1, 0)], second_s[after]]) - first_s[:, None]
    nearest = np.abs(gaps).argmin(axis=1)
    return float(np.median(gaps[np.arange(len(gaps)), nearest]))
