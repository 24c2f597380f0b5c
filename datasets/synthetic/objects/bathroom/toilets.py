"""Toilets, stalls and urinals."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.bathroom.shared import CHROME, PALE, WHITE
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, lathe, loft, ring, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import bathroom, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["toilet", "toilet_stall", "urinal"]

BOARDS: tuple[Colour, ...] = ((90, 130, 150), (206, 170, 110), (170, 110, 100), (214, 218, 220))


def toilet(stand: Stand, look: Look) -> None:
    """Build a toilet with its cistern or, hung on the wall, with a plate to flush."""
    rng, hung = stand.rng, bool(stand.rng.random() < 0.3)
    is_open = bool(rng.random() < 0.5)
    seat = look.wooden(rng) if rng.random() < 0.12 else paint((232, 235, 236))
    low, back = (0.14, 0.30) if hung else (0.0, 0.36)
    with stand.surfaces.thing("toilet"):
        shapes = [
            (low, 0.11, 0.19, back), (0.22, 0.125, 0.21, 0.38), (0.35, 0.18, 0.245, 0.44),
            (0.40, 0.185, 0.25, 0.45), (0.40, 0.13, 0.18, 0.46), (0.24, 0.06, 0.08, 0.42),
        ]  # fmt: skip
        loft(stand, [ring((0, y, z), (a, b)) for z, a, b, y in shapes], WHITE)
        loft(stand, [ring((0, 0.42, 0.27), (0.075, 0.1))], paint((176, 200, 208)))
        stand.box((-0.12, 0.12), (0.012, 0.30), (low + 0.02, 0.39), WHITE)
        stand.box((-0.17, 0.17), (0.16, 0.28), (0.37, 0.405), WHITE)
        shapes = [(0.405, 0.188, 0.25, 0.45), (0.425, 0.188, 0.25, 0.45), (0.43, 0.12, 0.17, 0.46)]
        loft(stand, [ring((0, y, z), (a, b)) for z, a, b, y in shapes], seat, closed=False)
        if is_open:
            # A lid that stands upright: a lying one with depth and height swapped.
            plates = [ring((0, 0.64, y), (0.185, 0.24))[::-1, [0, 2, 1]] for y in (0.20, 0.225)]
            loft(stand, plates, seat)
        else:
            lid = [(0.43, 0.186), (0.448, 0.18), (0.452, 0.15)]
            loft(stand, [ring((0, 0.45, z), (a, a + 0.065)) for z, a in lid], seat)
        if hung:
            stand.box((-0.13, 0.13), (0.012, 0.03), (1.0, 1.17), CHROME)
            stand.box((-0.10, 0.02), (0.03, 0.036), (1.03, 1.14), PALE)
            return
        cistern = [
            (0.39, 0.18, 0.08),
            (0.74, 0.205, 0.092),
            (0.74, 0.215, 0.098),
            (0.775, 0.21, 0.095),
        ]
        rings = [ring((0, 0.112, z), (a, b), corner=0.3) for z, a, b in cistern]
        loft(stand, rings, WHITE)
        lathe(stand, (0, 0.1), [(0.03, 0.775), (0.026, 0.785)], CHROME, sides=8)


def toilet_stall(stand: Stand, look: Look, *, count: int = 2) -> None:
    """Build cabins of boards side by side, some of them open, with toilets inside."""
    rng, wide, deep = stand.rng, 0.92, 1.45
    colour = patterns.pick(rng, BOARDS)
    board, start, shown = paint(colour), -count * wide / 2, int(rng.integers(count))
    for i in range(count):
        cabin = stand.at(start + (i + 0.5) * wide)
        with stand.surfaces.thing("toilet_stall"):
            for x in (-wide / 2, wide / 2 - 0.02) if i == count - 1 else (-wide / 2,):
                cabin.box((x, x + 0.02), (0.012, deep), (0.12, 2.0), board)
                tube(cabin, (x + 0.01, deep - 0.03, 0.12), (x + 0.01, deep - 0.03, 0), 0.02, CHROME)
            for x in (-wide / 2, wide / 2 - 0.14):
                cabin.box((x, x + 0.14), (deep - 0.02, deep), (0.12, 2.0), board)
            toilet(cabin, look)
            roll = cabin.at(-wide / 2 + 0.02, 0.65, 0.7)
            tube(roll, (0.06, -0.05, 0), (0.06, 0.05, 0), 0.055, paint((246, 246, 242)), sides=8)
            leaf = Material(bathroom.partition(rng, 400, 150, colour))
            turn = float(rng.uniform(1.1, 1.5)) if i == shown or rng.random() < 0.3 else 0.0
            door = cabin.at(-wide / 2 + 0.14, deep - 0.01, 0, -turn)
            door.box((0.0, wide - 0.28), (-0.01, 0.012), (0.14, 1.98), board, front=leaf)
    stand.box((start, -start), (deep - 0.03, deep + 0.01), (2.0, 2.05), CHROME)


def urinal(stand: Stand, look: Look) -> None:
    """Build a urinal with its flush pipe."""
    with stand.surfaces.thing("urinal"):
        z = float(stand.rng.uniform(-0.04, 0.04))
        shapes = [(0.48, 0.07, 0.06), (0.56, 0.15, 0.14), (0.66, 0.17, 0.165), (0.66, 0.13, 0.125),
                  (0.56, 0.07, 0.07)]  # fmt: skip
        loft(stand, [ring((0, b + 0.012, h + z), (a, b), corner=0.8) for h, a, b in shapes], WHITE)
        stand.box((-0.16, 0.16), (0.012, 0.05), (0.62 + z, 1.12 + z), PALE)
        for x0, x1 in ((-0.18, -0.14), (0.14, 0.18)):
            top, low = 1.14 + z, 0.60 + z
            upper = [(x0, 0.13, top), (x1, 0.13, top), (x1, 0.012, top), (x0, 0.012, top)]
            lower = [(x0, 0.24, low), (x1, 0.24, low), (x1, 0.012, low), (x0, 0.012, low)]
            block(stand, upper, lower, WHITE)
        cushion(stand, (-0.18, 0.18), (0.012, 0.14), (1.08 + z, 1.17 + z), WHITE, bevel=0.03)
        tube(stand, (0, 0.06, 1.16 + z), (0, 0.06, 1.42 + z), 0.014, CHROME)
        tube(stand, (0, 0.02, 1.38 + z), (0, 0.12, 1.38 + z), 0.035, CHROME, sides=8)
