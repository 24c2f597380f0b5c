"""The ring plan: a corridor around a core, rooms outside and inside."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans.draft import STAIRS_M, Draft, deal, depth, row
from roomgraph.datasets.synthetic.plans.layout import WALL_M, FloorPlan, Rectangle, Room

NEEDED = ("office", "office", "meeting_room", "kitchen", "bathroom")
OTHERS = ("laboratory", "store_room", "printer_area", "office", "living_room", "meeting_room")


def plan(rng: np.random.Generator, levels: int) -> FloorPlan:
    """Draw a ring of corridors with rooms on both sides."""
    draft = Draft(rng, levels)
    corridor = float(rng.uniform(1.6, 2.3))
    size = float(rng.uniform(5.6, 7.4)), float(rng.uniform(7.6, 8.4) if levels > 1 else depth(rng))
    draft.core(0.0, 0.0, -1)
    for level in range(levels):
        _draw_level(draft, level, size, corridor)
    return draft.finish("ring")


def _draw_level(draft: Draft, level: int, core: tuple[float, float], corridor: float) -> None:
    rng, (wide, deep) = draft.rng, core
    x0, x1, y0, y1 = -WALL_M - corridor, wide + WALL_M + corridor, -WALL_M, deep + WALL_M
    south = draft.room("corridor", Rectangle(x0, y0 - corridor, x1, y0), level)
    west, north, east = (
        draft.room("corridor", floor, level, of=south)
        for floor in (
            Rectangle(x0, y0, -WALL_M, y1),
            Rectangle(x0, y1, x1, y1 + corridor),
            Rectangle(wide + WALL_M, y0, x1, y1),
        )
    )
    for side in (south, north):
        draft.join(side, west, "open")
        draft.join(side, east, "open")
    draft.join_core(level)
    cells = _inner_cells(draft, core)
    sides = [[south, north, east, west]] * len(cells)
    for side, is_high in ((south, False), (north, True)):
        for a, b in row(rng, x0, x1):
            edge = side.floor.y1 + WALL_M if is_high else side.floor.y0 - WALL_M
            far = edge + (1 if is_high else -1) * depth(rng)
            cells.append(Rectangle(a, min(edge, far), b, max(edge, far)))
            sides.append([side])
    outer, sign = (east, 1) if rng.random() < 0.5 else (west, -1)
    for a, b in row(rng, outer.floor.y0, outer.floor.y1):
        edge = x1 + WALL_M if sign > 0 else x0 - WALL_M
        far = edge + sign * depth(rng)
        cells.append(Rectangle(min(edge, far), a, max(edge, far), b))
        sides.append([outer])
    kinds = deal(rng, NEEDED, OTHERS, len(cells))
    for kind, cell, near in zip(kinds, cells, sides, strict=True):
        _add(draft, draft.room(kind, cell, level), near)


def _inner_cells(draft: Draft, core: tuple[float, float]) -> list[Rectangle]:
    wide, deep = core
    start = STAIRS_M[0] + WALL_M if draft.levels > 1 else 0.0
    return [Rectangle(start, a, wide, b) for a, b in row(draft.rng, 0.0, deep)]


def _add(draft: Draft, room: Room, corridors: list[Room]) -> None:
    """Join a room to the first corridor that it can be joined to."""
    order = draft.rng.permutation(len(corridors))
    any(draft.join(corridors[int(i)], room) for i in order)
