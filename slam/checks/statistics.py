"""The little statistics that the checks share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def paired_t(first: Sequence[float], second: Sequence[float]) -> float:
    """Return Student's t value of the differences of pairs: above 0 where `first` is greater."""
    difference = np.asarray(first, dtype=np.float64) - np.asarray(second, dtype=np.float64)
    error = float(np.std(difference, ddof=1)) / np.sqrt(len(difference))
    return float(np.mean(difference) / max(error, 1e-9))
