"""Temporal model ``filter``: a hidden Markov model of the kind of place."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.recognition.transitions import without_staying
from roomgraph.semantics.temporal.look import Look
from roomgraph.semantics.temporal.odometer import INDEPENDENT_M
from roomgraph.semantics.temporal.temporal_model import Belief, TemporalModel

FloatArray = NDArray[np.float64]

# Below this a look would rule a place out for good, whatever comes after.
_LEAST = 1e-3
# Looks from one spot count a little, so that a long stay says something in the end.
_LEAST_WEIGHT = 0.1


class PlaceFilter(TemporalModel):
    """A hidden Markov model of the kind of place, given all predictions so far.

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
    """

    name = "filter"
    meaning = "hidden Markov model"

    def __init__(
        self, transitions: FloatArray, change_m: float, settings: Settings | None = None
    ) -> None:
        super().__init__(without_staying(transitions), change_m, settings)
        self._belief: FloatArray | None = None

    def advance(self, look: Look) -> None:
        """Add a prediction to the past, for good."""
        probabilities = look.prediction.probabilities[None, 1:]
        (moves,), (seen,) = (
            self._moves([look.way_m]), self._evidence(probabilities, [look.way_m])
        )  # fmt: skip
        self._belief = self._step(self._belief, moves, seen)

    def belief(self, order: int, looks: Sequence[Look], voters: Sequence[Look]) -> Belief:
        """Return the probabilities at the look nearest to a frame, given all looks so far."""
        beliefs = self.smoothed(
            [look.way_m for look in looks],
            np.array([look.prediction.probabilities[1:] for look in looks]),
        )
        nearest = min(range(len(beliefs)), key=lambda i: abs(looks[i].order - order))
        probabilities = np.concatenate([[0.0], beliefs[nearest]])
        return Belief(int(probabilities.argmax()), probabilities)

    def smoothed(self, ways_m: Sequence[float], probabilities: FloatArray) -> FloatArray:
        """Return the beliefs (N, K) at N looks, each given all of them and those taken for good.

        The forward-backward algorithm (Rabiner, 1989); the looks are not taken for good.

        Parameters
        ----------
        ways_m : (N,) sequence of float
            To each look from the one before it, metres.
        probabilities : (N, K) float64
            What each look alone says.
        """
        moves, evidence = self._moves(ways_m), self._evidence(probabilities, ways_m)
        beliefs, belief = np.empty(evidence.shape), self._belief
        for i, seen in enumerate(evidence):
            belief = beliefs[i] = self._step(belief, moves[i], seen)
        backward = np.ones(len(self.transitions))
        for i in range(len(evidence) - 1, 0, -1):
            backward = moves[i] @ (evidence[i] * backward)
            backward /= backward.sum()
            beliefs[i - 1] *= backward
        return np.asarray(beliefs / beliefs.sum(axis=1, keepdims=True))

    def _step(
        self, belief: FloatArray | None, moves: FloatArray, evidence: FloatArray
    ) -> FloatArray:
        """Return the belief (K,) after a step and an observation."""
        found = evidence if belief is None else (belief @ moves) * evidence
        return np.asarray(found / found.sum())

    def _moves(self, ways: Sequence[float]) -> FloatArray:
        """Return the chance (N, K, K) of each kind (column) after each way from each kind (row)."""
        leave = -np.expm1(-np.asarray(ways) / self.change_m)[:, None, None]
        return np.asarray((1 - leave) * np.eye(len(self.transitions)) + leave * self.transitions)

    def _evidence(self, probabilities: FloatArray, ways: Sequence[float]) -> FloatArray:
        """Return how well each look (N, K) fits each kind, given the way to it."""
        weights = np.clip(np.asarray(ways) / INDEPENDENT_M, _LEAST_WEIGHT, 1.0)
        return np.asarray(np.maximum(probabilities, _LEAST) ** weights[:, None])
