"""Rooms whose walls are not all at right angles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import Doorway, FloatArray, Room

# How often a room keeps its right angles in a building that has others.
STRAIGHT_SHARE = 0.45
# How much is cut off a corner: at least, and at most by the shorter side, metres.
LEAST_CUT_M, CUT_SHARE = 0.5, 0.3
# An opening is at least this far from what is cut.
CLEAR_M = 1.3


def slanted(room: Room, doorways: Sequence[Doorway], rng: np.random.Generator) -> Room:
    """Cut a corner of a room, or turn one of its walls, where no opening is in the way."""
    openings = [door for door in doorways if room.key in door.rooms]
    is_shaft = room.label in ("stairwell", "elevator")
    is_open = any(door.kind == "open" for door in openings)
    if is_shaft or is_open or rng.random() < STRAIGHT_SHARE:
        return room
    corners = [(float(x), float(y)) for x, y in room.floor.polygon]
    first = int(rng.integers(4))
    before, here, after = (np.array(corners[(first + k) % 4]) for k in (-1, 0, 1))
    shorter = min(float(np.linalg.norm(before - here)), float(np.linalg.norm(after - here)))
    cut = float(rng.uniform(LEAST_CUT_M, CUT_SHARE * shorter + 0.3))
    turns_wall = rng.random() >= 0.5
    moved = [_towards(here, after, 0.6 * cut)]
    if not turns_wall:
        moved = [_towards(here, before, cut), _towards(here, after, cut)]
    outline = [
        *corners[:first],
        *((float(p[0]), float(p[1])) for p in moved),
        *corners[first + 1 :],
    ]
    is_near = any(np.linalg.norm(np.array(d.xy) - here) < cut + CLEAR_M for d in openings)
    # A turned wall moves all along: no opening may be in it.
    is_blocked = turns_wall and any(_in_wall(door, here, before) for door in openings)
    return room if is_near or is_blocked else replace(room, outline=tuple(outline))


def _towards(begin: FloatArray, end: FloatArray, length: float) -> FloatArray:
    way = end - begin
    return np.asarray(begin + way / np.linalg.norm(way) * length)


def _in_wall(door: Doorway, a: FloatArray, b: FloatArray) -> bool:
    axis = 0 if abs(a[0] - b[0]) < 1e-6 else 1
    return bool(abs(door.xy[axis] - a[axis]) < 0.2)
