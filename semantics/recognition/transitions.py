"""Transition probabilities between kinds of place, counted along labelled walks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def count_transitions(walks: Iterable[Sequence[str]], names: Sequence[str]) -> FloatArray:
    """Return the chance (K, K) of each kind after leaving a kind, from the labels along walks.

    One transition to every kind is counted beforehand, shared out evenly (Laplace), so that
    nothing is impossible only because it was not seen.
    """
    count = len(names)
    table = np.full((count, count), 1.0 / max(1, count - 1))
    index: Mapping[str, int] = {name: i for i, name in enumerate(names)}
    for walk in walks:
        for a, b in pairwise(walk):
            if a != b and a in index and b in index:
                table[index[a], index[b]] += 1
    return without_staying(table)


def without_staying(table: FloatArray) -> FloatArray:
    """Return rows that sum to one with nothing on the diagonal (a single kind can only stay)."""
    if len(table) == 1:
        return np.ones((1, 1))
    moves = np.where(np.eye(len(table), dtype=bool), 0.0, table)
    return np.asarray(moves / np.maximum(moves.sum(axis=1, keepdims=True), 1e-12))
