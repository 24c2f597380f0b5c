"""The house plan: a hall, living room, kitchen, dining room, bedrooms, bathroom."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans.draft import STAIRS_M, Draft, deal, depth, row
from roomgraph.datasets.synthetic.plans.layout import WALL_M, FloorPlan, Rectangle, Room

DOWNSTAIRS: tuple[str, ...] = ("kitchen", "bathroom")
BUNGALOW: tuple[str, ...] = ("kitchen", "bathroom", "bedroom", "bedroom")
UPSTAIRS: tuple[str, ...] = ("bedroom", "bedroom", "bathroom")
OTHERS = ("bedroom", "store_room", "office")


def plan(rng: np.random.Generator, levels: int) -> FloorPlan:
    """Draw a hall with rooms on both sides, living room and dining room at its ends."""
    draft = Draft(rng, levels)
    hall = float(rng.uniform(1.5, 2.6)), float(rng.uniform(7.8, 9.0))
    draft.core(-WALL_M - STAIRS_M[0], 0.0, 1)
    for level in range(levels):
        _draw_level(draft, level, hall)
    return draft.finish("house")


def _draw_level(draft: Draft, level: int, size: tuple[float, float]) -> None:
    rng, (wide, long) = draft.rng, size
    hall = draft.room("hall", Rectangle(0, 0, wide, long), level)
    draft.join_core(level)
    least = len(UPSTAIRS) if level else len(DOWNSTAIRS)
    sides = []
    for a, b in row(rng, 0, long, least):
        sides.append(Rectangle(wide + WALL_M, a, wide + WALL_M + depth(rng), b))
    if draft.levels == 1:
        for a, b in row(rng, 0, long, least):
            sides.append(Rectangle(-WALL_M - depth(rng), a, -WALL_M, b))
    if level == 0:
        day_rooms = _day_rooms(draft, hall)
        needed = BUNGALOW if draft.levels == 1 else DOWNSTAIRS
    else:
        day_rooms, needed = [], UPSTAIRS
    for kind, cell in zip(deal(rng, needed, OTHERS, len(sides)), sides, strict=True):
        room = draft.room(kind, cell, level)
        draft.join(hall, room)
        if kind == "kitchen":
            for day_room in day_rooms:
                draft.join(day_room, room, "passage" if rng.random() < 0.5 else "door")


def _day_rooms(draft: Draft, hall: Room) -> list[Room]:
    """Add living and dining room at the hall's end, side by side; often with no wall between."""
    rng, r = draft.rng, hall.floor
    base = r.y1 + WALL_M
    shift = float(rng.uniform(0.0, 0.5))  # One of the two has all of the hall's end.
    split = r.x0 - shift - WALL_M if rng.random() < 0.5 else r.x1 + shift
    left = r.x0 - shift - float(rng.uniform(2.6, 4.2))
    right = r.x1 + shift + float(rng.uniform(2.6, 4.2))
    is_open = bool(rng.random() < 0.5)
    gap = 0.0 if is_open else WALL_M
    tall = float(rng.uniform(3.2, 5.5))
    other = tall if is_open else float(rng.uniform(3.0, 5.5))
    cells = [
        Rectangle(left, base, split, base + tall), Rectangle(split + gap, base, right, base + other)
    ]  # fmt: skip
    kinds = deal(rng, ("living_room", "dining_room"), (), 2)
    rooms = [draft.room(k, cell, hall.level) for k, cell in zip(kinds, cells, strict=True)]
    wider = max(rooms, key=lambda q: min(q.floor.x1, r.x1) - max(q.floor.x0, r.x0))
    draft.join(hall, wider)
    draft.join(rooms[0], rooms[1], "open" if is_open else "passage")
    return rooms
