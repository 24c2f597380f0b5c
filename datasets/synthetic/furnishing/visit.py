"""What changes in a room from one visit to the next."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.furnishing.arrange import Arranger
from roomgraph.datasets.synthetic.furnishing.piece import make_piece
from roomgraph.datasets.synthetic.furnishing.plot import Placed
from roomgraph.datasets.synthetic.furnishing.programmes import (
    CHANGES,
    FIXED,
    HEAVY,
    LEFT,
    REPLACED,
    Item,
    Where,
)

REPLACING_TRIES = 5


def change(before: Arranger, after: Arranger, rng: np.random.Generator) -> None:
    """Arrange an empty plot as another one, with the changes that a time brings.

    Pieces are moved, removed and added; what hangs on the walls is changed for others.
    """
    moved: list[Placed] = []
    for placed in before.plot.placed:
        model = placed.piece.model
        kind = "fixed" if model in FIXED else "heavy" if model in HEAVY else "loose"
        move, remove = CHANGES[kind]
        fate = float(rng.random())
        if placed.is_hung and model in REPLACED and fate < 0.6:
            after.plot.put(_replaced(placed, after, rng))
        elif placed.is_hung or fate >= move + remove:
            after.plot.put(placed)
        elif fate < move:
            moved.append(placed)
    for placed in moved:
        where: Where = "wall" if placed.wall >= 0 else "free"
        again = after.somewhere(placed.piece, Item(placed.piece.model, where), rng)
        if again is not None:
            after.plot.put(again)
        elif after.plot.fits(placed.piece, placed.stand):
            after.plot.put(placed)
    if before.plot.room.label in ("stairwell", "elevator"):
        return
    for _ in range(int(rng.integers(0, 3))):
        after.place(Item(LEFT[int(rng.integers(len(LEFT)))], "free"), rng)


def _replaced(placed: Placed, after: Arranger, rng: np.random.Generator) -> Placed:
    """Return another piece of the same model in its place, if one that is no larger is drawn."""
    for _ in range(REPLACING_TRIES):
        other = make_piece(placed.piece.model, rng, after.look)
        grown = np.maximum(placed.piece.low - other.low, other.high - placed.piece.high)
        if float(grown.max()) < 0.03:
            break
    else:
        return placed
    return Placed(other, placed.stand, placed.wall, placed.x)
