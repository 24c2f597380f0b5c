"""Temporal model ``vote``: the majority of the frames around."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roomgraph.semantics.temporal.look import Look
from roomgraph.semantics.temporal.temporal_model import Belief, TemporalModel


class Vote(TemporalModel):
    """Each look around votes for its label (Kostavelis & Gasteratos, 2013, section 3.3).

    A tie goes to the label with the larger mean probability.
    """

    name = "vote"
    meaning = "majority of neighbouring frames, as in the paper"

    def advance(self, look: Look) -> None:
        """Forget a look: only those around a frame vote."""

    def belief(self, order: int, looks: Sequence[Look], voters: Sequence[Look]) -> Belief:
        """Return the label that most voters have, and their mean probabilities."""
        mean = np.mean([look.prediction.probabilities for look in voters], axis=0)
        votes = np.bincount([v.prediction.label_id for v in voters], minlength=len(mean))
        return Belief(int(np.lexsort((mean, votes))[-1]), mean)
