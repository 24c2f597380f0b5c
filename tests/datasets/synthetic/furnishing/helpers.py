"""Furnished rooms to be tested, made without finishes, and what is measured in them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, lru_cache
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.building import Building, build
from roomgraph.datasets.synthetic.furnishing import arrange, furnish
from roomgraph.datasets.synthetic.furnishing.arrange import Arranger
from roomgraph.datasets.synthetic.furnishing.piece import Piece, make_piece, solid_outlines
from roomgraph.datasets.synthetic.furnishing.plot import Placed, Plot, Wall
from roomgraph.datasets.synthetic.objects.look import Look, draw_look
from roomgraph.datasets.synthetic.plans.layout import FloorPlan, Room
from roomgraph.datasets.synthetic.rendering.mesh import Surfaces
from tests.datasets.synthetic.plans.helpers import plan

FloatArray = NDArray[np.float64]
# Buildings whose rooms are looked at one by one: kind of plan, floors, seed.
CASES = [
    *(("house", 1, seed) for seed in range(6)), ("house", 2, 6), ("house", 3, 7),
    *(("suite", 1, seed) for seed in range(5)), *(("open", 1, seed) for seed in range(4)),
    ("ring", 1, 0), ("ring", 2, 1),
]  # fmt: skip
# So many pieces of each model there are; building thousands would take minutes.
POOL = 5


@lru_cache(maxsize=8)
def building(kind: str = "house", floors: int = 1, seed: int = 1, visit: int = 0) -> Building:
    """Build a whole building, once."""
    return build(seed, kind, floors, visit)


def arranger(room: Room, drawn: FloorPlan, seed: int) -> Arranger:
    """Return the arranger of an empty room."""
    rng = np.random.default_rng((seed, len(room.label), room.part))
    return Arranger(
        Plot(room, furnish._walls(room, drawn, Surfaces(rng))), draw_look(rng), (seed, 3)
    )


@cache
def _piece(model: str, number: int, options: tuple[tuple[str, float], ...]) -> Piece:
    look = draw_look(np.random.default_rng(number))
    return make_piece(model, np.random.default_rng((number, 8)), look, **dict(options))


def pooled_piece(model: str, rng: np.random.Generator, look: Look, **options: float) -> Piece:
    """Return one of the few pieces of a model, instead of building another one."""
    rounded = tuple((name, round(value, 1)) for name, value in options.items())
    return _piece(model, int(rng.integers(POOL)), rounded)


@cache
def arranged(kind: str, floors: int, seed: int) -> tuple[tuple[Arranger, tuple[str, ...]], ...]:
    """Return the furnished rooms of a building, each with what it lacks."""
    drawn = plan(kind, floors, seed)
    made = [arranger(room, drawn, seed) for room in drawn.rooms if room.label != "elevator"]
    with patch.object(arrange, "make_piece", pooled_piece):
        return tuple((one, tuple(one.furnish())) for one in made)


def every_room() -> Iterator[tuple[Arranger, tuple[str, ...]]]:
    """Return the furnished rooms of all cases, each with what it lacks."""
    return (pair for case in CASES for pair in arranged(*case))


def standing(plot: Plot) -> list[tuple[Placed, FloatArray]]:
    """Return what takes floor: the pieces, and their rectangles (4, 2)."""
    return [
        (placed, solid)
        for placed in plot.placed
        if not placed.is_hung and placed.stand.origin[2] < plot.room.base_m + 0.3
        for solid in solid_outlines(placed.piece, placed.stand)
    ]


def bounds(placed: Placed) -> tuple[float, float, float, float]:
    """Return what a piece at a wall covers of it: from, to, lowest, highest."""
    low, high = placed.piece.low, placed.piece.high
    return placed.x + float(low[0]), placed.x + float(high[0]), float(low[2]), float(high[2])


def zone(wall: Wall, span: tuple[float, float], deep_m: float) -> FloatArray:
    """Return the corners (4, 2) of the floor before a stretch of a wall."""
    (a, b) = span
    corners = [(a, 0, 0), (b, 0, 0), (b, deep_m, 0), (a, deep_m, 0)]
    return wall.face.stand.world(corners)[:, :2]
