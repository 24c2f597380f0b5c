"""The suite plan: rooms through rooms, two rows of them beside a hall."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.plans.draft import STAIRS_M, Draft, deal, depth, row
from roomgraph.datasets.synthetic.plans.layout import WALL_M, FloorPlan, Rectangle, Room

NEEDED = ("living_room", "office", "bedroom", "kitchen", "bathroom")
OTHERS = ("dining_room", "meeting_room", "store_room", "bedroom", "office", "laboratory")


def plan(rng: np.random.Generator, levels: int) -> FloorPlan:
    """Draw a hall and two rows of rooms that lead into each other."""
    draft = Draft(rng, levels)
    hall = float(rng.uniform(1.9, 3.2))
    draft.core(-2 * WALL_M - hall - STAIRS_M[0], 0.0, 1)
    first = depth(rng)
    second = max(depth(rng), 7.7 - first - WALL_M)
    wide = float(rng.uniform(10.5, 13.5))
    for level in range(levels):
        _draw_level(draft, level, (first, second), wide, hall)
    return draft.finish("suite")


def _draw_level(
    draft: Draft, level: int, rows: tuple[float, float], wide: float, hall_width: float
) -> None:
    rng, top = draft.rng, rows[0] + WALL_M
    floor = Rectangle(-WALL_M - hall_width, 0, -WALL_M, top + rows[1])
    hall = draft.room("hall", floor, level)
    draft.join_core(level)
    lower = [Rectangle(a, 0, b, rows[0]) for a, b in row(rng, 0, wide, 3)]
    upper = [Rectangle(a, top, b, top + rows[1]) for a, b in row(rng, 0, wide, 3)]
    kinds = deal(rng, NEEDED, OTHERS, len(lower) + len(upper))
    rooms = [draft.room(k, c, level) for k, c in zip(kinds, lower + upper, strict=True)]
    below, above = rooms[: len(lower)], rooms[len(lower) :]
    for rank in (below, above):
        draft.join(hall, rank[0])
        for left, right in pairwise(rank):
            draft.join(left, right)
    _join_rows(draft, below, above)


def _join_rows(draft: Draft, below: list[Room], above: list[Room]) -> None:
    """Open one or two of the walls between the rows: there is more than one way round."""
    pairs = [(a, b) for a in below[1:] for b in above[1:]]
    opened = 0
    for index in draft.rng.permutation(len(pairs)):
        opened += draft.join(*pairs[int(index)])
        if opened == 2:
            return
