"""Explanations of the labels of places, for the report and the viewer."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.graph import GraphNode, SemanticGraph

# Frames closer together than this form a range.
_GAP = 10
_RANGES = 6
_LEAST = 0.005


def place_reasons(graph: SemanticGraph) -> list[dict[str, str]]:
    """Return a row with the evidence for each place whose label was voted for."""
    return [
        _reason(name, [node for node in graph.nodes if node.place == name])
        for name in graph.places
        if any(node.evidence.voted for node in graph.nodes if node.place == name)
    ]


def node_words(node: GraphNode) -> str:
    """Return a node's place and the evidence for its label, on at most two lines."""
    if not node.evidence.voted:
        return node.place
    count = len(node.evidence.voters)
    frames = f"{count} frame{'s' if count != 1 else ''}"
    voted = _spaced(node.evidence.voted)
    return f"{node.place}: {chances(node.evidence)}\n{frames} voted for {voted}"


def chances(evidence: Evidence) -> str:
    """Return the labels with a probability of at least half a percent."""
    known = [(name, chance) for name, chance in evidence.labels if chance >= _LEAST]
    return ", ".join(f"{_spaced(name)} {chance:.0%}" for name, chance in known)


def ranges(frames: Sequence[int]) -> str:
    """Return sorted frame numbers as ranges, ignoring small gaps; further ranges as a count."""
    spans = list(_spans(frames))
    text = ", ".join(f"{a}" if a == b else f"{a}\N{EN DASH}{b}" for a, b in spans[:_RANGES])
    return text + (f" and {len(spans) - _RANGES} more ranges" if len(spans) > _RANGES else "")


def _reason(name: str, nodes: Sequence[GraphNode]) -> dict[str, str]:
    label = nodes[0].label
    parts = [node.evidence for node in nodes]
    found = Evidence.gathered(parts, label)
    voted = [part.voted for part in parts if part.voted]
    return {
        "name": name,
        "chances": chances(found),
        "agreeing": f"{voted.count(label)} of {len(voted)}",
        "count": str(len(found.voters)),
        "frames": ranges(found.voters),
        "words": ", ".join(str(word) for word, _ in found.words),
    }


def _spans(frames: Sequence[int]) -> Iterator[tuple[int, int]]:
    if not frames:
        return
    first = frames[0]
    for before, frame in pairwise(frames):
        if frame - before > _GAP:
            yield first, before
            first = frame
    yield first, frames[-1]


def _spaced(label: str) -> str:
    return label.replace("_", " ")
