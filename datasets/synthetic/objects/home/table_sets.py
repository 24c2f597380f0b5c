"""Tables with the chairs around them."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.home.chairs import (
    DINING,
    MEETING,
    ChairKind,
    draw_chair,
    put_chair,
)
from roomgraph.datasets.synthetic.objects.home.laid import (
    lay_papers,
    lay_plate,
    put_fruit_bowl,
    put_laptop,
    put_vase,
)
from roomgraph.datasets.synthetic.objects.home.tables import put_legs
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Span, Stand
from roomgraph.datasets.synthetic.textures import patterns

__all__ = ["dining_table", "meeting_table", "round_table"]


def _cloth(stand: Stand, look: Look, x: Span, y: Span) -> None:
    """Spread a checked or plain cloth over a table of 0.75 m; it hangs down all around."""
    rng = stand.rng
    image = patterns.cloth(rng, 128, 128, patterns.shift(rng, (232, 226, 212)))
    if rng.random() < 0.6:
        for i in range(0, 128, 32):
            for band in (image[i : i + 16], image[:, i : i + 16]):
                band[:] = (0.55 * band + 0.45 * np.array(look.accent)).astype(np.uint8)
    cloth = Material(image, 0.5, 0.5)
    top = [(x[0], y[1]), (x[1], y[1]), (x[1], y[0]), (x[0], y[0])]
    rim = [(a * 1.02, b * 1.03, 0.50) for a, b in top]
    block(stand, [(a * 1.005, b * 1.01, 0.752) for a, b in top], rim, cloth)
    stand.surfaces.cover(stand.world([(*top[i], 0.754) for i in (3, 2, 1, 0)]), cloth)


def _around(stand: Stand, kind: ChairKind, places: list[tuple[float, float, float]]) -> None:
    """Put chairs at (x, y, turn), each a little moved."""
    for x, y, turn in places:
        dx, dy, dt = stand.rng.uniform(-1, 1, 3) * (0.03, 0.05, 0.12)
        put_chair(stand.at(x + float(dx), y + float(dy), 0.0, turn + float(dt)), kind)


def dining_table(stand: Stand, look: Look) -> None:
    """Build a table for four to six, perhaps laid or with a cloth, and its chairs."""
    rng, wood, pairs = stand.rng, look.wooden(stand.rng), int(stand.rng.integers(1, 3))
    half, deep = 0.62 + 0.22 * (pairs - 1), float(rng.uniform(0.40, 0.47))
    seats = [(0.0 if pairs == 1 else x) for x in (-half / 2, half / 2)][2 - pairs :]
    with stand.surfaces.thing("dining_table"):
        stand.box((-half, half), (-deep, deep), (0.71, 0.75), wood)
        put_legs(stand, look, half - 0.08, deep - 0.08, 0.71, wood)
        if rng.random() < 0.4:
            _cloth(stand, look, (-half, half), (-deep, deep))
        (put_vase if rng.random() < 0.5 else put_fruit_bowl)(stand.at(0.0, 0.0, 0.756))
        if rng.random() < 0.6:
            cup = bool(rng.random() < 0.7)
            for x in seats:
                lay_plate(stand.at(x, deep - 0.17, 0.756), cup)
                lay_plate(stand.at(x, 0.17 - deep, 0.756, np.pi), cup)
    kind = draw_chair(rng, look, DINING)
    places = [(x, side * (deep + 0.16), np.pi * (side > 0)) for x in seats for side in (-1, 1)]
    if pairs == 1 or rng.random() < 0.5:
        places += [(-half - 0.18, 0.0, -np.pi / 2), (half + 0.18, 0.0, np.pi / 2)]
    _around(stand, kind, places)


def meeting_table(stand: Stand, look: Look, length: float = 2.4) -> None:
    """Build a conference table `length` metres long, in use, with chairs along both sides."""
    rng, half, deep = stand.rng, length / 2, float(stand.rng.uniform(0.5, 0.6))
    top, dark, seats = look.wooden(rng), paint((52, 53, 57)), max(2, int(length / 0.75))
    xs = [(i + 0.5) * length / seats - half for i in range(seats)]
    with stand.surfaces.thing("conference_table"):
        stand.box((-half, half), (-deep, deep), (0.71, 0.74), top)
        put_legs(stand, look, half - 0.15, deep - 0.12, 0.71, top)
        stand.box((-0.16, 0.16), (-0.06, 0.06), (0.74, 0.744), dark)
        if rng.random() < 0.7:
            with stand.surfaces.thing("projector"):
                case, lens = paint((226, 226, 224)), paint((30, 32, 38))
                stand.box((0.22, 0.52), (-0.11, 0.11), (0.745, 0.84), case)
                tube(stand, (0.52, 0.05, 0.795), (0.545, 0.05, 0.795), 0.033, lens, sides=8)
        for x in xs:
            for side in (-1, 1):
                place = stand.at(x, side * (deep - 0.22), 0.742, np.pi * (side < 0))
                if (pick := rng.random()) < 0.3:
                    put_laptop(place)
                elif pick < 0.75:
                    lay_papers(place, float(rng.uniform(-0.3, 0.3)))
    kind = draw_chair(rng, look, MEETING)
    places = [(x, side * (deep + 0.2), np.pi * (side > 0)) for x in xs for side in (-1, 1)]
    _around(stand, kind, places)


def round_table(stand: Stand, look: Look) -> None:
    """Build a cafe table on a column, with two or three chairs and cups."""
    rng, radius, metal = stand.rng, float(stand.rng.uniform(0.33, 0.45)), look.metallic()
    top = paint((236, 234, 230)) if rng.random() < 0.3 else look.wooden(rng)
    count, out = int(rng.integers(2, 4)), radius + 0.2
    turns = [2 * np.pi * i / count + 0.5 for i in range(count)]
    with stand.surfaces.thing("table"):
        rim = [(radius, 0.71), (radius, 0.735), (0.004, 0.736)]
        lathe(stand, (0, 0), rim, top, sides=14)
        foot = [(0.24, 0.0), (0.22, 0.025), (0.04, 0.05), (0.035, 0.68), (0.12, 0.71)]
        lathe(stand, (0, 0), foot, metal, sides=10)
        for turn in turns:
            x, y = (0.6 * radius * f for f in (float(np.sin(turn)), -float(np.cos(turn))))
            saucer = [(0.04, 0.0), (0.07, 0.012), (0.03, 0.008)]
            cup = [(0.025, 0.01), (0.04, 0.065), (0.034, 0.065), (0.002, 0.03)]
            for profile in (saucer, cup):
                lathe(stand.at(x, y, 0.737), (0, 0), profile, paint((240, 240, 238)), sides=8)
        if rng.random() < 0.6:
            put_vase(stand.at(0.0, 0.0, 0.737))
    kind = draw_chair(rng, look, DINING)
    _around(stand, kind, [(out * float(np.sin(t)), -out * float(np.cos(t)), t) for t in turns])
