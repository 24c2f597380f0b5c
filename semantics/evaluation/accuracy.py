"""Accuracy of labels and places compared with the true rooms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.places import PlaceTruth
from roomgraph.semantics.graph.graph import SemanticGraph


@dataclass(frozen=True, slots=True)
class LabelAccuracy:
    """Predicted against true labels.

    Attributes
    ----------
    names : tuple of str
        All labels that occur, predicted or true, sorted.
    confusion : (L, L) int64
        Row: true label, column: predicted; both in the order of `names`.
    """

    names: tuple[str, ...]
    confusion: NDArray[np.int64]

    @property
    def count(self) -> int:
        """Number of items whose truth is known."""
        return int(self.confusion.sum())

    @property
    def overall(self) -> float:
        """Share of items labelled correctly, NaN if there are none."""
        return float(np.trace(self.confusion) / self.count) if self.count else float("nan")

    @property
    def per_label(self) -> dict[str, float]:
        """Share of the items of each true label that were labelled correctly."""
        totals = self.confusion.sum(axis=1)
        return {
            name: float(self.confusion[i, i] / totals[i])
            for i, name in enumerate(self.names)
            if totals[i]
        }


@dataclass(frozen=True, slots=True)
class InstanceAccuracy:
    """Places found against true rooms.

    Attributes
    ----------
    matches : dict of str to str
        True room to the place found for it: one to one, the most nodes in common.
    rooms : tuple of str
        All true rooms that have a node.
    places : tuple of str
        All places found.
    recovered : tuple of str
        Rooms most of whose nodes are in the place matched to them.
    purity : float
        Share of nodes that lie in the room most common in their place.
    """

    matches: dict[str, str]
    rooms: tuple[str, ...]
    places: tuple[str, ...]
    recovered: tuple[str, ...]
    purity: float

    @property
    def recall(self) -> float:
        """Share of the true rooms that were found as a place of their own."""
        return len(self.recovered) / len(self.rooms) if self.rooms else float("nan")


def compare_labels(pairs: Iterable[tuple[str, str]]) -> LabelAccuracy:
    """Return the accuracy of (true label, predicted label) pairs."""
    counts = Counter(pairs)
    names = tuple(sorted({name for pair in counts for name in pair}))
    confusion = np.zeros((len(names), len(names)), dtype=np.int64)
    for (true, predicted), count in counts.items():
        confusion[names.index(true), names.index(predicted)] = count
    return LabelAccuracy(names, confusion)


def evaluate_frames(labels: Iterable[tuple[float, str]], truth: PlaceTruth) -> LabelAccuracy:
    """Return the accuracy of (time stamp in seconds, label) pairs of frames, or of anything else.

    Pairs whose truth is not known are left out.
    """
    known = ((truth.at(stamp), label) for stamp, label in labels)
    return compare_labels((place[0], label) for place, label in known if place is not None)


def evaluate_nodes(graph: SemanticGraph, truth: PlaceTruth) -> LabelAccuracy:
    """Return the label accuracy of the graph's nodes."""
    return evaluate_frames(((node.stamp_s, node.label) for node in graph.nodes), truth)


def evaluate_instances(graph: SemanticGraph, truth: PlaceTruth) -> InstanceAccuracy:
    """Match places to true rooms one to one, by the nodes they share (Hungarian method).

    Where the truth has no instances, each label counts as one room.
    """
    shared: Counter[tuple[str, str]] = Counter()
    for node in graph.nodes:
        place = truth.at(node.stamp_s)
        if place is not None:
            shared[place[1] or place[0], node.place] += 1
    rooms = tuple(dict.fromkeys(room for room, _ in shared))
    places = tuple(dict.fromkeys(place for _, place in shared))
    table = np.array([[shared[room, place] for place in places] for room in rooms]).reshape(
        len(rooms), len(places)
    )
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(table, maximize=True)
    pairs = [(r, c) for r, c in zip(rows, columns, strict=True) if table[r, c]]
    return InstanceAccuracy(
        {rooms[r]: places[c] for r, c in pairs},
        rooms,
        places,
        tuple(rooms[r] for r, c in pairs if 2 * table[r, c] > table[r].sum()),
        float(table.max(axis=0).sum() / table.sum()) if len(rooms) else float("nan"),
    )
