"""Accuracy of rooms and doorways compared with the true floor plan."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from roomgraph.semantics.graph.graph import SemanticGraph


@dataclass(frozen=True, slots=True)
class Matching:
    """Detections matched to true items.

    Attributes
    ----------
    found, true, right : int
        How many were found, how many there are, and how many of those found are.
    """

    found: int
    true: int
    right: int

    @property
    def precision(self) -> float:
        """Share of the found that is true, NaN if nothing was found."""
        return self.right / self.found if self.found else float("nan")

    @property
    def recall(self) -> float:
        """Share of the true that was found, NaN if there is nothing."""
        return self.right / self.true if self.true else float("nan")


def evaluate_rooms(
    graph: SemanticGraph, areas_m2: Mapping[str, float], matches: Mapping[str, str]
) -> tuple[Matching, dict[str, float]]:
    """Compare places with true rooms, and their areas.

    Parameters
    ----------
    graph : SemanticGraph
        With rooms.
    areas_m2 : mapping of str to float
        True area of each room.
    matches : mapping of str to str
        True room to the place found for it, by the nodes they share.

    Returns
    -------
    Matching
        Of places: one is right if it is matched to a room.
    dict of str to float
        For each room with a place that has an room: the area found by the true one, less 1.
    """
    found = {room.name: room.area_m2 for room in graph.rooms}
    errors = {
        room: found[matches[room]] / area - 1
        for room, area in areas_m2.items()
        if matches.get(room) in found
    }
    return Matching(len(found), len(areas_m2), len(errors)), errors


def evaluate_doorways(
    graph: SemanticGraph, doorways: Iterable[tuple[str, str]], matches: Mapping[str, str]
) -> Matching:
    """Compare the edges between places with the true doorways between rooms.

    Two places joined by several doorways count once, as do two rooms.
    """
    rooms = {place: room for room, place in matches.items()}
    found = {frozenset(door.places) for door in graph.doorways}
    true = {frozenset(pair) for pair in doorways}
    named = {frozenset(rooms.get(place, place) for place in pair) for pair in found}
    return Matching(len(found), len(true), len(named & true))


def largest_error(errors: Mapping[str, float]) -> float:
    """Return the largest relative error, NaN if there is none."""
    return max((abs(error) for error in errors.values()), default=float(np.nan))
