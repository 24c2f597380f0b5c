"""Probabilities from margins."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit, log_softmax
from scipy.special import softmax as _softmax

# How strongly the offsets of `fit_softmax` are held at zero, against the whole likelihood.
_HOLD = 1.0


def sigmoid(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return 1 / (1 + exp(-x)), elementwise."""
    return np.asarray(expit(x))


def fit_sigmoid(
    decisions: NDArray[np.float64], is_positive: NDArray[np.bool_]
) -> tuple[float, float]:
    """Return slope and offset of the probability ``sigmoid(slope * decision + offset)``.

    Maximum likelihood on Platt's (1999) smoothed targets, which keep the slope finite where the
    classes are separable. A slope below zero (margins that say the opposite) becomes zero.

    Parameters
    ----------
    decisions : (N,) float64
        Margins of samples that the machine was not trained on.
    is_positive : (N,) bool
        Whether each sample is of the class.
    """
    n_positive = int(is_positive.sum())
    n_negative = len(is_positive) - n_positive
    targets = np.where(is_positive, (n_positive + 1) / (n_positive + 2), 1 / (n_negative + 2))

    def loss(parameters: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        z = parameters[0] * decisions + parameters[1]
        slope = expit(z) - targets
        value = np.logaddexp(0, z) - targets * z
        return float(value.sum()), np.array([slope @ decisions, slope.sum()])

    start = np.array([1.0, np.log((n_positive + 1) / (n_negative + 1))])
    from scipy.optimize import minimize  # A third of a second that only training needs.

    result = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=[(0, None), (None, None)])
    return float(result.x[0]), float(result.x[1])


def softmax(scores: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return scores (N, K) as probabilities that sum to one."""
    return np.asarray(_softmax(scores, axis=-1))


def fit_softmax(
    decisions: NDArray[np.float64], index: NDArray[np.integer[Any]]
) -> NDArray[np.float64]:
    """Return slope and offsets (K + 1,) so that ``softmax(slope * decisions + offsets)`` is fair.

    Maximum likelihood with one slope for all classes and an offset for each, held near zero
    (temperature scaling with a bias; Guo et al., 2017). A slope below zero becomes zero.

    Parameters
    ----------
    decisions : (N, K) float64
        Margins of samples that the machines were not trained on.
    index : (N,) int
        The class of each sample.
    """
    target = np.eye(decisions.shape[1])[index]

    def loss(parameters: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        log_p = log_softmax(parameters[0] * decisions + parameters[1:], axis=1)
        slope = np.exp(log_p) - target
        offsets = parameters[1:]
        value = -float((log_p * target).sum()) + 0.5 * _HOLD * float(offsets @ offsets)
        by_offset = slope.sum(axis=0) + _HOLD * offsets
        return value, np.concatenate([[float((slope * decisions).sum())], by_offset])

    start = np.concatenate([[1.0], np.zeros(decisions.shape[1])])
    bounds = [(0, None)] + [(None, None)] * decisions.shape[1]
    from scipy.optimize import minimize

    return np.asarray(minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds).x)
