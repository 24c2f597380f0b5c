"""Bookcases and sideboards with what stands on them."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.home.laid import GLAZES, put_fruit_bowl, put_vase
from roomgraph.datasets.synthetic.objects.look import FABRICS, Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Span, Stand
from roomgraph.datasets.synthetic.textures import ink, kitchen, office, patterns

__all__ = ["bookcase", "sideboard"]


def stand_photo(stand: Stand, half: float) -> None:
    """Stand a framed photograph up."""
    rim = patterns.pick(stand.rng, ((40, 36, 34), (220, 214, 200), (150, 110, 60)))
    image = ink.framed(ink.photo(stand.rng, 80, 64), rim, 7)
    with stand.surfaces.thing("photo"):
        box = (-half, half), (-0.012, 0.012), (0.0, 2.5 * half)
        stand.box(*box, paint(rim), front=Material(image))


def slanting_legs(stand: Stand, half: float, deep: float, height: float, wood: Material) -> None:
    """Put four slanting legs under a low cupboard."""
    for x in (0.08 - half, half - 0.08):
        for y in (0.06, deep - 0.07):
            tube(stand, (x, y, height), (x * 1.04, y, 0.0), (0.024, 0.014), wood)


def book_row(stand: Stand, x: Span, z: Span, front: float) -> None:
    """Fill a bay with a row of books or two of unequal height, perhaps with a gap."""
    rng, begin, taste = stand.rng, x[0], (*FABRICS, (170, 40, 40), (230, 220, 200))
    while begin < x[1] - 0.05:
        wide = min(float(rng.uniform(0.14, 0.4)), x[1] - begin)
        tall = float(rng.uniform(0.62, 0.9)) * (z[1] - z[0])
        image = office.books(rng, 110, max(24, int(420 * wide)), taste)
        # The spines' upper ends are uneven; what lies behind them is dark, as in a shelf.
        row = (
            (begin, begin + wide),
            (0.05, front - float(rng.uniform(0, 0.03))),
            (z[0], z[0] + tall),
        )
        stand.box(*row, paint((196, 186, 166)), front=Material(image[18:]))
        begin += wide + (float(rng.uniform(0.03, 0.14)) if rng.random() < 0.5 else 0.004)


def _globe(stand: Stand) -> None:
    """Build a small globe on a foot."""
    image = patterns.plain(48, 96, (70, 120, 170))
    land = patterns.noise(stand.rng, 48, 96, (12, 16)) > 0.06
    image[land] = (150, 150, 84)
    profile = [(0.02, 0.05), (0.07, 0.08), (0.09, 0.13), (0.07, 0.19), (0.02, 0.22), (0.002, 0.22)]
    with stand.surfaces.thing("globe"):
        lathe(stand, (0, 0), [(0.06, 0.0), (0.015, 0.02), (0.01, 0.05)], paint((110, 80, 50)))
        lathe(stand, (0, 0), profile, Material(image), sides=10)


def _ornament(stand: Stand) -> None:
    """Put something small into a shelf: a jar, a photograph, a globe."""
    kind = int(stand.rng.integers(3))
    if kind == 0:
        profile = [(0.04, 0.0), (0.075, 0.08), (0.03, 0.17), (0.045, 0.2), (0.002, 0.19)]
        lathe(stand, (0, 0), profile, paint(patterns.pick(stand.rng, GLAZES)), sides=9)
    elif kind == 1:
        stand_photo(stand, 0.075)
    else:
        _globe(stand)


def bookcase(stand: Stand, look: Look, width: float = 0.9) -> None:
    """Build a bookcase `width` metres wide with books and some ornaments in its bays."""
    rng, wood, half = stand.rng, look.wooden(stand.rng), width / 2
    deep, high = float(rng.uniform(0.27, 0.33)), float(rng.uniform(1.5, 2.15))
    shelves, bays = max(4, round(high / 0.37)), max(1, round(width / 0.85))
    doors = rng.random() < 0.3
    edges = np.linspace(-half, half - 0.022, bays + 1)
    levels = np.linspace(0.07, high - 0.025, shelves + 1)
    with stand.surfaces.thing("bookcase"):
        stand.box((-half, half), (0.012, 0.03), (0.0, high), wood)
        stand.box((-half, half), (0.03, deep - 0.02), (0.0, 0.07), wood)
        for x in edges:
            stand.box((float(x), float(x) + 0.022), (0.012, deep), (0.0, high), wood)
        for z in levels:
            stand.box((-half, half), (0.012, deep - 0.004), (float(z), float(z) + 0.022), wood)
        for i in range(bays):
            x = float(edges[i]) + 0.028, float(edges[i + 1]) - 0.006
            for k in range(shelves):
                z = float(levels[k]) + 0.022, float(levels[k + 1])
                if doors and k == 0:
                    stand.box(x, (deep - 0.02, deep), z, paint(look.front))
                    grip = x[1] - 0.06, deep + 0.01, (z[0] + z[1]) / 2 + 0.06
                    lathe(stand, grip[:2], [(0.014, grip[2]), (0.014, grip[2] + 0.03)], wood)
                    continue
                if rng.random() < 0.35:
                    _ornament(stand.at(x[1] - 0.13, 0.6 * deep, z[0]))
                    book_row(stand, (x[0], x[1] - 0.26), z, deep - 0.03)
                else:
                    book_row(stand, x, z, deep - 0.03)


def sideboard(stand: Stand, look: Look) -> None:
    """Build a sideboard with doors and a stack of drawers; a vase, photographs, a bowl on it."""
    rng, wood, count = stand.rng, look.wooden(stand.rng), int(stand.rng.integers(3, 5))
    half, deep, high = 0.24 * count, 0.43, float(rng.uniform(0.74, 0.9))
    low, handle = float(rng.uniform(0.1, 0.2)), int(rng.integers(3))
    colour = look.front if rng.random() < 0.4 else look.wood
    face = (
        patterns.wood(rng, 150, 120, colour) if look.grained else patterns.plain(150, 120, colour)
    )
    stack = int(rng.integers(count))
    with stand.surfaces.thing("sideboard"):
        slanting_legs(stand, half, deep, low, wood)
        stand.box((-half, half), (0.012, deep - 0.02), (low, high), wood)
        stand.box((-half - 0.015, half + 0.015), (0.012, deep + 0.01), (high, high + 0.025), wood)
        for i in range(count):
            x = 0.48 * i - half + 0.006, 0.48 * (i + 1) - half - 0.006
            shown = kitchen.drawers(face, 3) if i == stack else kitchen.cupboard(rng, face, handle)
            front = (deep - 0.02, deep), (low + 0.01, high - 0.008)
            stand.box(x, *front, Material(face, 0.6, 0.6), front=Material(shown))
        top = high + 0.025
        put_vase(stand.at(0.2 - half, 0.2, top))
        put_fruit_bowl(stand.at(0.08, 0.2, top))
        for right in (half - 0.2, half - 0.38)[: int(rng.integers(1, 3))]:
            stand_photo(stand.at(right, 0.14, top, 0.15), float(rng.uniform(0.06, 0.09)))
