"""The open plan: one large office with areas that no walls part, and a row of closed rooms."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans.draft import STAIRS_M, Draft, deal, depth, row
from roomgraph.datasets.synthetic.plans.layout import WALL_M, FloorPlan, Rectangle

AREAS = ("office", "office", "printer_area")
MORE_AREAS = ("meeting_room", "living_room", "kitchen")
NEEDED = ("meeting_room", "bathroom", "store_room")
OTHERS = ("office", "laboratory", "kitchen", "meeting_room")


def plan(rng: np.random.Generator, levels: int) -> FloorPlan:
    """Draw a hall of four areas with a row of rooms along it."""
    draft = Draft(rng, levels)
    size = float(rng.uniform(8.5, 12.5)), float(rng.uniform(7.8, 9.5))
    draft.core(-WALL_M - STAIRS_M[0], 0.0, 1)
    for level in range(levels):
        _draw_level(draft, level, size)
    return draft.finish("open")


def _draw_level(draft: Draft, level: int, size: tuple[float, float]) -> None:
    rng, (wide, deep) = draft.rng, size
    x, y = (float(rng.uniform(0.38, 0.62)) * length for length in size)
    cells = [
        Rectangle(0, 0, x, y), Rectangle(x, 0, wide, y),
        Rectangle(0, y, x, deep), Rectangle(x, y, wide, deep),
    ]  # fmt: skip
    areas = [
        draft.room(kind, cell, level)
        for kind, cell in zip(deal(rng, AREAS, MORE_AREAS, 4), cells, strict=True)
    ]
    for a, b in ((0, 1), (0, 2), (1, 3), (2, 3)):
        draft.join(areas[a], areas[b], "open")
    draft.join_core(level)
    rooms = [
        Rectangle(a, deep + WALL_M, b, deep + WALL_M + depth(rng))
        for a, b in row(rng, 0, wide, len(NEEDED))
    ]
    kinds = deal(rng, NEEDED, OTHERS, len(rooms))
    for kind, cell in zip(kinds, rooms, strict=True):
        room = draft.room(kind, cell, level)
        if not draft.join(areas[2], room):
            draft.join(areas[3], room)
