"""The little statistics that the checks share."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def gain_error(wrong: NDArray[np.float64], counts: NDArray[np.integer[Any]]) -> float:
    """Return the standard error of how much better one explanation fits than another.

    Scores under explanations that are surely wrong tell how much they vary by chance. (A paired
    t test would not do: that some stretches gain much and others little is no doubt about either.)

    Parameters
    ----------
    wrong : (N, M) float64
        Scores of N independent stretches under M wrong explanations, for a single observation
        each; NaN where there is none.
    counts : (N, 2) int
        Observations that the scores of each stretch are means of, under the two explanations.
    """
    variance = float(np.nanvar(wrong)) * float(np.sum(1 / counts))
    return max(float(np.sqrt(variance)) / len(counts), 1e-9)
