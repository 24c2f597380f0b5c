"""A hidden Markov model of places: one does not step from a kitchen into a bathroom."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

FloatArray = NDArray[np.float64]

# Below this a look would rule a place out for good, whatever comes after.
_LEAST = 1e-3
# Where nobody can say how far the camera went between two looks.
_USUAL_STEP_M = 0.3


class PlaceFilter:
    """Which kind of place the camera is in, from all looks so far.

    The states are the kinds of place. The chance of having left one grows with the way walked
    since the last look, ``1 - exp(-way / change_m)``; where to follows `transitions`, which are
    counted in the walks that the model was learned from: the graph of the places' kinds. Looks at
    nearly the same view are not independent, so each counts for the way that it is away from the
    last one, at most as one.

    Parameters
    ----------
    transitions : (K, K) float64
        Chance of each kind (column) after leaving a kind (row); rows sum to one, the diagonal is
        not used.
    change_m : float
        Metres walked in one kind of place, on average.
    independent_m : float
        Looks this far apart say independent things.
    """

    def __init__(
        self, transitions: FloatArray, change_m: float, independent_m: float = 0.5
    ) -> None:
        self.transitions = _without_staying(transitions)
        self.change_m, self.independent_m = change_m, independent_m
        self._belief: FloatArray | None = None
        self._position: FloatArray | None = None

    def advance(self, position: FloatArray | None, probabilities: FloatArray) -> FloatArray:
        """Take a look for good and return the belief (K,) after it.

        Parameters
        ----------
        position : (3,) float64 or None
            Where the look was taken, metres; None if nobody knows.
        probabilities : (K,) float64
            What the look alone says.
        """
        way = _way(self._position, position)
        self._belief = self._step(self._belief, way, self._evidence(probabilities, way))
        self._position = position
        return np.asarray(np.exp(self._belief))

    def smoothed(
        self, positions: Sequence[FloatArray | None], probabilities: FloatArray
    ) -> FloatArray:
        """Return the beliefs (N, K) at N looks, each given all of them and those taken for good.

        The forward-backward algorithm (Rabiner, 1989); the looks are not taken for good.
        """
        ways = [_way(a, b) for a, b in zip([self._position, *positions], positions, strict=False)]
        evidence = [self._evidence(p, way) for p, way in zip(probabilities, ways, strict=True)]
        forward, belief = [], self._belief
        for way, seen in zip(ways, evidence, strict=True):
            belief = self._step(belief, way, seen)
            forward.append(belief)
        backward = [np.zeros(len(self.transitions))]
        for way, seen in zip(ways[:0:-1], evidence[:0:-1], strict=True):
            move = np.log(self._moves(way))
            message = logsumexp(move + (seen + backward[-1])[None, :], axis=1)
            backward.append(message - logsumexp(message))
        beliefs = np.array(forward) + np.array(backward[::-1])
        return np.asarray(np.exp(beliefs - logsumexp(beliefs, axis=1, keepdims=True)))

    def _step(self, belief: FloatArray | None, way: float, evidence: FloatArray) -> FloatArray:
        """Return the log belief (K,) after walking and looking."""
        if belief is None:
            ahead = np.full(len(self.transitions), -np.log(len(self.transitions)))
        else:
            ahead = np.log(np.exp(belief) @ self._moves(way))
        found = ahead + evidence
        return np.asarray(found - logsumexp(found))

    def _moves(self, way: float) -> FloatArray:
        """Return the chance of each kind (column) after a way from each kind (row)."""
        leave = -np.expm1(-way / self.change_m)
        stay = np.eye(len(self.transitions))
        return np.asarray((1 - leave) * stay + leave * self.transitions)

    def _evidence(self, probabilities: FloatArray, way: float) -> FloatArray:
        weight = min(1.0, max(way, 0.1 * self.independent_m) / self.independent_m)
        return np.asarray(weight * np.log(np.maximum(probabilities, _LEAST)))


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
    return _without_staying(table)


def _without_staying(table: FloatArray) -> FloatArray:
    """Return rows that sum to one with nothing on the diagonal (a single kind can only stay)."""
    if len(table) == 1:
        return np.ones((1, 1))
    moves = np.where(np.eye(len(table), dtype=bool), 0.0, table)
    return np.asarray(moves / np.maximum(moves.sum(axis=1, keepdims=True), 1e-12))


def _way(a: FloatArray | None, b: FloatArray | None) -> float:
    return _USUAL_STEP_M if a is None or b is None else float(np.linalg.norm(b - a))
