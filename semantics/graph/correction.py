"""Corrections of a graph by the user."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.belief import propagate
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.graph.instances import free_name
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.transitions import count_transitions


@dataclass(frozen=True, slots=True)
class Correction:
    """A corrected graph.

    Attributes
    ----------
    graph : SemanticGraph
        With the place renamed.
    place : str
        The place's new name.
    told, inferred : tuple of int
        Nodes that were in the place, and nodes beside it that follow from them.
    """

    graph: SemanticGraph
    place: str
    told: tuple[int, ...]
    inferred: tuple[int, ...]


def correct(graph: SemanticGraph, place: str, label: str, change_m: float) -> Correction:
    """Give a place of the graph another label, and infer its neighbours again.

    The nodes of the place are certain from now on. Beliefs are propagated over the graph from
    them and from what the other nodes looked like; nodes that are connected to the place and
    now believe in the same label belong to it as well.

    Parameters
    ----------
    graph : SemanticGraph
        Of a run.
    place : str
        The place as it is called there (``office2``).
    label : str
        What it is; a new label gets the next id.
    change_m : float
        Metres walked in one kind of place, on average.

    Raises
    ------
    SemanticsError
        The graph has no such place, or the label is no name.
    """
    if place not in graph.places:
        raise SemanticsError("no such place", expected=" or ".join(graph.places), got=place)
    if not label or label == UNKNOWN:
        raise SemanticsError("not a label", expected="the kind of place", got=label or "nothing")
    labels = graph.labels.with_label(label)
    told = [node.id for node in graph.nodes if node.place == place]
    inferred = _neighbours(graph, labels, label, told, change_m)
    name = free_name(label, set(graph.places) - {place})
    label_id = labels.id_of(label)
    nodes = tuple(
        replace(node, label=label, label_id=label_id, place=name, score=1.0)
        if node.id in told
        else replace(node, label=label, label_id=label_id, place=name, score=inferred[node.id])
        if node.id in inferred
        else node
        for node in graph.nodes
    )
    rooms = tuple(
        replace(e, name=name, label=label, label_id=label_id, score=1.0) if e.name == place else e
        for e in graph.rooms
    )
    changed = replace(graph, labels=labels, nodes=nodes, rooms=rooms)
    doorways = tuple(_renamed(doorway, place, name) for doorway in graph.doorways)
    return Correction(
        replace(changed, doorways=doorways), name, tuple(told), tuple(sorted(inferred))
    )


def _neighbours(
    graph: SemanticGraph, labels: LabelSpace, label: str, told: list[int], change_m: float
) -> dict[int, float]:
    """Return the nodes that now belong to the corrected place, with their belief in its label."""
    kinds = len(labels) - 1
    own = np.full((len(graph.nodes), kinds), 1.0 / kinds)
    for i, node in enumerate(graph.nodes):
        if node.label_id:
            own[i] = (1 - node.score) / max(1, kinds - 1)
            own[i, node.label_id - 1] = node.score
    index = {node.id: i for i, node in enumerate(graph.nodes)}
    edges = [(index[e.source], index[e.target], e.length_m) for e in graph.edges]
    wanted = labels.id_of(label) - 1
    even = count_transitions((), labels.names[1:])
    beliefs = propagate(own, edges, even, change_m, {index[i]: wanted for i in told})
    members = {index[i] for i in told}
    while True:
        beside = {b for a, b, _ in edges if a in members} | {a for a, b, _ in edges if b in members}
        fresh = {i for i in beside - members if beliefs[i].argmax() == wanted}
        fresh = {i for i in fresh if graph.nodes[i].label != label}
        if not fresh:
            break
        members |= fresh
    return {
        graph.nodes[i].id: float(beliefs[i, wanted])
        for i in members
        if graph.nodes[i].id not in told
    }


def _renamed(doorway: Any, place: str, name: str) -> Any:
    places = tuple(name if p == place else p for p in doorway.places)
    return replace(doorway, places=places)
