"""Probabilities from margins."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import expit


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
    result = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=[(0, None), (None, None)])
    return float(result.x[0]), float(result.x[1])
