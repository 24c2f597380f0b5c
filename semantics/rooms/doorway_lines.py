"""Doorways as lines on the floor plan."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.graph.graph import Doorway, RoomPolygon, SemanticGraph

FloatArray = NDArray[np.float64]
# Of a doorway that nobody looked through; and how far around one its wall is looked for.
_USUAL_WIDTH_M, _AROUND_M = 0.8, 0.8
_STEP_M = 0.05


def doorway_ends(graph: SemanticGraph, door: Doorway) -> FloatArray:
    """Return the ends (2, 2) of a doorway in the map frame, metres.

    Its wall runs as the outlines of its places do around it. Directions have no sign, so their
    mean is that of the doubled angles.
    """
    outlines = [e for e in graph.rooms if e.name in door.places] or list(graph.rooms)
    spots, steps = _along(outlines)
    near = np.linalg.norm(spots - door.position_map, axis=1) < _AROUND_M
    angle = np.arctan2(steps[near, 1], steps[near, 0])
    wall = np.arctan2(np.sin(2 * angle).sum(), np.cos(2 * angle).sum()) / 2
    half = (door.width_m or _USUAL_WIDTH_M) / 2
    along = np.array([np.cos(wall), np.sin(wall)])
    return np.stack([door.position_map - half * along, door.position_map + half * along])


def _along(rooms: list[RoomPolygon]) -> tuple[FloatArray, FloatArray]:
    """Return spots (N, 2) evenly along outlines, and the direction (N, 2) of the edge of each."""
    spots, steps = [np.empty((0, 2))], [np.empty((0, 2))]
    for room in rooms:
        starts = room.polygon_map
        for start, edge in zip(starts, np.roll(starts, -1, axis=0) - starts, strict=True):
            count = int(np.ceil(np.linalg.norm(edge) / _STEP_M))
            share = (np.arange(count)[:, None] + 0.5) / max(count, 1)
            spots.append(start + share * edge)
            steps.append(np.repeat(edge[None], count, axis=0))
    return np.concatenate(spots), np.concatenate(steps)
