"""Evidence for a node's label: other labels, voting frames, visual words."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.temporal.labeller import FrameLabel

TOP, TOP_WORDS = 3, 5
Key = TypeVar("Key", str, int)


@dataclass(frozen=True, slots=True)
class Evidence:
    """The evidence for a label, small enough to keep at every node of a graph.

    Attributes
    ----------
    labels : tuple of (str, float)
        The likeliest labels and their probability.
    voters : tuple of int
        Indices of the frames that voted for the label.
    words : tuple of (int, float)
        Visual words that spoke for it, with their part of the margin.
    voted : str
        The label that they voted for; empty where there were none.
    """

    labels: tuple[tuple[str, float], ...] = ()
    voters: tuple[int, ...] = ()
    words: tuple[tuple[int, float], ...] = ()
    voted: str = ""

    @classmethod
    def of(cls, label: FrameLabel, labels: LabelSpace) -> Evidence:
        """Return the evidence for a frame's label; empty if no frame was classified."""
        if not len(label.probabilities):
            return cls()
        order = np.argsort(-label.probabilities, kind="stable")[:TOP]
        top = tuple((labels.names[i], float(label.probabilities[i])) for i in order)
        return cls(
            tuple(pair for pair in top if pair[1] > 0), label.voters, label.words, label.label
        )

    def content(self) -> dict[str, Any]:
        """Return it as plain values for a JSON file."""
        return {
            "labels": [[name, round(chance, 4)] for name, chance in self.labels],
            "voters": list(self.voters),
            "words": [[word, round(share, 4)] for word, share in self.words],
            "voted": self.voted,
        }

    @classmethod
    def from_content(cls, content: dict[str, Any]) -> Evidence:
        """Return what `content` was made from, to the digits that it kept."""
        return cls(
            tuple((str(name), float(chance)) for name, chance in content["labels"]),
            tuple(int(frame) for frame in content["voters"]),
            tuple((int(word), float(share)) for word, share in content["words"]),
            str(content["voted"]),
        )

    @classmethod
    def gathered(cls, parts: Sequence[Evidence], label: str) -> Evidence:
        """Return the evidence for the label of a place from that of its nodes.

        Probabilities are means over the nodes; frames and words are of the nodes whose frames
        voted for `label`, the words with their mean part.
        """
        known = [part for part in parts if part.voted]
        agreeing = [part for part in known if part.voted == label]
        if not known:
            return cls()
        chances = _means([part.labels for part in known])
        words = _means([part.words for part in agreeing])
        voters = {frame for part in agreeing for frame in part.voters}
        return cls(chances[:TOP], tuple(sorted(voters)), words[:TOP_WORDS], label)


def _means(parts: Sequence[Sequence[tuple[Key, float]]]) -> tuple[tuple[Key, float], ...]:
    """Return the mean of each key's value, the largest first; where it is missing it counts 0."""
    total: defaultdict[Key, float] = defaultdict(float)
    for part in parts:
        for key, value in part:
            total[key] += value
    first = sorted(total.items(), key=lambda item: -item[1])
    return tuple((key, value / len(parts)) for key, value in first)
