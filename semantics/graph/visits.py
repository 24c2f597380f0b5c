"""Summary of a graph: its places, their probabilities, and the visits to them."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import groupby

from roomgraph.semantics.graph.graph import SemanticGraph


@dataclass(frozen=True, slots=True)
class Visit:
    """A stay in a place, from its first node to its last, seconds."""

    first_s: float
    last_s: float


@dataclass(frozen=True, slots=True)
class PlaceSummary:
    """A place of a graph.

    Attributes
    ----------
    name, label : str
        ``office2``, ``office``.
    score : float
        Of the label, 0 to 1: the mean over the place's frames where known, else over its nodes.
    nodes : tuple of int
        Ids of the nodes in it.
    area_m2 : float or None
        Of its floor; None where it is not known.
    visits : tuple of Visit
        When the camera was there.
    """

    name: str
    label: str
    score: float
    nodes: tuple[int, ...]
    area_m2: float | None
    visits: tuple[Visit, ...]


def summarise(graph: SemanticGraph) -> tuple[PlaceSummary, ...]:
    """Return the places of a graph, in the order of first passing."""
    stays = [list(group) for _, group in groupby(graph.nodes, key=lambda node: node.place)]
    rooms = {room.name: room for room in graph.rooms}
    found = []
    for name in graph.places:
        inside = [node for node in graph.nodes if node.place == name]
        room = rooms.get(name)
        found.append(
            PlaceSummary(
                name=name,
                label=Counter(node.label for node in inside).most_common(1)[0][0],
                score=room.score if room else sum(node.score for node in inside) / len(inside),
                nodes=tuple(node.id for node in inside),
                area_m2=room.area_m2 if room else None,
                visits=tuple(
                    Visit(s[0].stamp_s, s[-1].stamp_s) for s in stays if s[0].place == name
                ),
            )
        )
    return tuple(found)
