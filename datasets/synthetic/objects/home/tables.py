"""Low tables, and the legs of tables."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.home.laid import put_fruit_bowl, put_vase
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink

__all__ = ["coffee_table", "side_table"]


def put_legs(stand: Stand, look: Look, x: float, y: float, height: float, wood: Material) -> None:
    """Put four legs under a table top: square, turned, slanting or frames of metal."""
    kind, metal = int(stand.rng.integers(4)), look.metallic()
    for a in (-x, x):
        for b in (-y, y):
            if kind == 0:
                stand.box((a - 0.035, a + 0.035), (b - 0.035, b + 0.035), (0.0, height), wood)
            elif kind == 1:
                middle = (0.045, 0.3 * height), (0.028, 0.7 * height)
                lathe(stand, (a, b), [(0.025, 0.0), *middle, (0.045, height)], wood, sides=8)
            elif kind == 2:
                tube(stand, (a * 0.92, b * 0.88, height), (a, b, 0.0), (0.035, 0.018), wood)
            else:
                stand.box((a - 0.025, a + 0.025), (b - 0.025, b + 0.025), (0.0, height), metal)
        if kind == 3:
            stand.box((a - 0.025, a + 0.025), (-y, y), (0.0, 0.05), metal)
    if kind < 2:
        for b in (-y, y):
            stand.box((-x, x), (b - 0.012, b + 0.012), (height - 0.09, height), wood)
        for a in (-x, x):
            stand.box((a - 0.012, a + 0.012), (-y, y), (height - 0.09, height), wood)


def coffee_table(stand: Stand, look: Look) -> None:
    """Build a low table with magazines, a bowl or a vase; with a shelf below, or round."""
    rng, wood = stand.rng, look.wooden(stand.rng)
    half, deep, high = (float(v) for v in rng.uniform((0.45, 0.27, 0.36), (0.6, 0.34, 0.45)))
    with stand.surfaces.thing("coffee_table"):
        if rng.random() < 0.3:
            disc = [(half - 0.07, high - 0.03), (half - 0.07, high), (0.004, high + 0.001)]
            lathe(stand, (0, 0), disc, wood, sides=14)
            for x, y in ((-0.25, -0.2), (0.25, -0.2), (0.0, 0.3)):
                tube(stand, (x * 0.8, y * 0.8, high - 0.03), (x, y, 0.0), (0.025, 0.014), wood)
        else:
            stand.box((-half, half), (-deep, deep), (high - 0.035, high), wood)
            put_legs(stand, look, half - 0.05, deep - 0.05, high - 0.035, wood)
            if rng.random() < 0.6:
                stand.box((0.05 - half, half - 0.05), (-0.2, 0.2), (0.12, 0.14), wood)
        (put_vase if rng.random() < 0.4 else put_fruit_bowl)(stand.at(0.12, -0.05, high + 0.002))
        for i in range(int(rng.integers(1, 4))):
            page = stand.at(-0.2, 0.02, high + 0.002, float(rng.uniform(-0.4, 0.4)))
            flat = (-0.1, 0.1), (-0.14, 0.14), (0.012 * i, 0.012 * i + 0.012)
            page.box(*flat, paint((230, 228, 222)), top=Material(ink.poster(rng, 90, 64)))


def side_table(stand: Stand, look: Look) -> None:
    """Build a small table beside a sofa: round or square, with a cup and a book or a vase."""
    rng, wood, radius = stand.rng, look.wooden(stand.rng), float(stand.rng.uniform(0.2, 0.26))
    high = float(rng.uniform(0.48, 0.6))
    with stand.surfaces.thing("side_table"):
        if rng.random() < 0.55:
            disc = [(radius, high - 0.025), (radius, high), (0.004, high + 0.001)]
            lathe(stand, (0, 0), disc, wood, sides=14)
            for angle in np.arange(3) * 2 * np.pi / 3 + 0.3:
                x, y = radius * float(np.cos(angle)), radius * float(np.sin(angle))
                tube(stand, (x * 0.6, y * 0.6, high - 0.02), (x, y, 0.0), (0.022, 0.012), wood)
        else:
            stand.box((-radius, radius), (-radius, radius), (high - 0.03, high), wood)
            put_legs(stand, look, radius - 0.04, radius - 0.04, high - 0.03, wood)
        if rng.random() < 0.5:
            put_vase(stand.at(0.0, -0.04, high + 0.002))
            return
        cover = Material(ink.poster(rng, 80, 56))
        book = stand.at(-0.07, 0.0, high + 0.002)
        book.box((-0.07, 0.07), (-0.1, 0.1), (0.0, 0.03), paint((236, 232, 222)), top=cover)
        mug = [(0.034, 0.0), (0.042, 0.09), (0.036, 0.09), (0.002, 0.02)]
        lathe(stand.at(0.09, 0.06, high + 0.002), (0, 0), mug, paint(look.accent), sides=8)
