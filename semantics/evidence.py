"""Why a node has its label: the runners-up, the frames that voted, the words that spoke."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from semantics.labeller import FrameLabel
from semantics.labels import LabelSpace

TOP = 3


@dataclass(frozen=True, slots=True)
class Evidence:
    """What speaks for a label, small enough to keep at every node of a graph.

    Attributes
    ----------
    labels : tuple of (str, float)
        The likeliest labels and their probability over the frames that voted.
    voters : tuple of int
        Indices of the frames that voted for the label.
    words : tuple of (int, float)
        Visual words that spoke for it, with their part of the margin.
    """

    labels: tuple[tuple[str, float], ...] = ()
    voters: tuple[int, ...] = ()
    words: tuple[tuple[int, float], ...] = ()

    @classmethod
    def of(cls, label: FrameLabel, labels: LabelSpace) -> Evidence:
        """Return the evidence for a frame's label; empty where nothing was looked at."""
        order = np.argsort(-label.probabilities, kind="stable")[:TOP]
        top = tuple((labels.names[i], float(label.probabilities[i])) for i in order)
        return cls(tuple(pair for pair in top if pair[1] > 0), label.voters, label.words)

    def content(self) -> dict[str, Any]:
        """Return it as plain values for a JSON file."""
        return {
            "labels": [[name, round(chance, 4)] for name, chance in self.labels],
            "voters": list(self.voters),
            "words": [[word, round(share, 4)] for word, share in self.words],
        }

    @classmethod
    def from_content(cls, content: dict[str, Any]) -> Evidence:
        """Return what `content` was made from, to the digits that it kept."""
        return cls(
            tuple((str(name), float(chance)) for name, chance in content["labels"]),
            tuple(int(frame) for frame in content["voters"]),
            tuple((int(word), float(share)) for word, share in content["words"]),
        )
