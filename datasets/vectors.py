"""Lengths: of vectors, and along a way."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def unit(vector: NDArray[Any]) -> NDArray[np.float64]:
    """Return a vector (D,) at unit length; zeros stay zeros."""
    length = float(np.linalg.norm(vector))
    return np.asarray(vector / length if length > 0 else vector, dtype=np.float64)


def arc_lengths(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how long the way through positions (N, D) is up to each of them (N,); N > 0."""
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])
