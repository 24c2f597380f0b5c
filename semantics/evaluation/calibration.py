"""Calibration of probabilities, and detection of novel places."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BINS = 10


def reliability(
    confidence: FloatArray, is_right: NDArray[np.bool_], bins: int = BINS
) -> FloatArray:
    """Return, for each bin of confidence, the mean confidence, the share right, the count.

    Parameters
    ----------
    confidence : (N,) float64
        Probability of the label given, 0 to 1.
    is_right : (N,) bool
        Whether it was right.
    bins : int
        Of equal width.

    Returns
    -------
    (bins, 3) float64
        Zeros where nothing falls.
    """
    index = np.minimum((confidence * bins).astype(np.intp), bins - 1)
    count = np.bincount(index, minlength=bins).astype(np.float64)
    known = np.maximum(count, 1)
    mean = np.bincount(index, confidence, minlength=bins) / known
    share = np.bincount(index, is_right.astype(np.float64), minlength=bins) / known
    return np.column_stack([mean, share, count])


def expected_calibration_error(
    confidence: FloatArray, is_right: NDArray[np.bool_], bins: int = BINS
) -> float:
    """Return the mean gap between confidence and share right (Naeini et al., 2015)."""
    table = reliability(confidence, is_right, bins)
    return float((np.abs(table[:, 0] - table[:, 1]) * table[:, 2]).sum() / table[:, 2].sum())


def brier_score(probabilities: FloatArray, index: NDArray[np.integer]) -> float:
    """Return the mean squared distance of probabilities (N, K) to the truth (N,), 0 to 2."""
    truth = np.eye(probabilities.shape[1])[index]
    return float(np.mean(((probabilities - truth) ** 2).sum(axis=1)))


def auroc(known: FloatArray, novel: FloatArray) -> float:
    """Return the chance that something known scores higher than something novel.

    The area under the curve of the rates of acceptance, by ranks (Mann-Whitney); ties count half.
    """
    from scipy.stats import rankdata

    ranks = rankdata(np.concatenate([known, novel]))[: len(known)]
    return float((ranks.sum() - len(known) * (len(known) + 1) / 2) / (len(known) * len(novel)))


def rejection_curve(confidence: FloatArray, is_right: NDArray[np.bool_]) -> FloatArray:
    """Return (N, 2): the share of items kept, and the share right of them, least sure first out."""
    order = np.argsort(-confidence, kind="stable")
    kept = np.arange(1, len(order) + 1)
    return np.column_stack([kept / len(order), np.cumsum(is_right[order]) / kept])
