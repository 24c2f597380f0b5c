"""Desks with all that one works with."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.objects.office.desk_things import (
    put_keyboard,
    put_lamp,
    put_monitor,
    put_mug,
)
from roomgraph.datasets.synthetic.objects.office.office_chairs import desk_chair
from roomgraph.datasets.synthetic.objects.office.shared import PALE, astray
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink

__all__ = ["desk", "desk_pair"]


def desk(stand: Stand, look: Look) -> None:
    """Build a desk with all that one works with, and its chair, turned a little."""
    rng, half = stand.rng, float(stand.rng.uniform(0.6, 0.85))
    with stand.surfaces.thing("desk"):
        _table(stand, look, half)
        if rng.random() < 0.7:
            put_lamp(stand.at(-half + 0.14, 0.16, 0.74, float(rng.uniform(-0.9, -0.3))), look)
    desk_chair(stand.at(astray(rng, 0.12), 0.95, 0, np.pi + astray(rng, 0.7)), look)


def desk_pair(stand: Stand, look: Look) -> None:
    """Build two desks back to back with a low screen between them, and two chairs."""
    rng, half = stand.rng, float(stand.rng.uniform(0.65, 0.8))
    with stand.surfaces.thing("desk"):
        for turn in (0.0, np.pi):
            _table(stand.at(0, 0, 0, turn), look, half)
        cloth, top = look.woven(rng, second=True), float(rng.uniform(1.05, 1.2))
        stand.box((-half, half), (-0.02, 0.02), (0.62, top), cloth)
        stand.box((-half, half), (-0.025, 0.025), (top, top + 0.02), look.metallic())
    for turn in (0.0, np.pi):
        place = stand.at(0, 0, 0, turn).at(astray(rng, 0.15), 0.97, 0, np.pi + astray(rng, 0.7))
        desk_chair(place, look)


def _table(stand: Stand, look: Look, half: float) -> None:
    """Build a desk's top, legs and drawers, and put screens and small things on it."""
    rng, wood, metal = stand.rng, look.wooden(stand.rng), look.metallic()
    stand.box((-half, half), (0.02, 0.75), (0.71, 0.74), wood)
    stand.box((-half + 0.05, half - 0.05), (0.1, 0.12), (0.42, 0.71), wood)
    side = 1 if rng.random() < 0.5 else -1
    for x in (-half + 0.05, half - 0.05):
        if rng.random() < 0.6:
            for y in (0.06, 0.69):
                stand.box((x - 0.025, x + 0.025), (y, y + 0.05), (0, 0.71), metal)
        else:
            stand.box((x - 0.015, x + 0.015), (0.04, 0.72), (0, 0.71), wood)
    left, count = side * (half - 0.29) - 0.2, int(rng.integers(2, 5))
    stand.box((left, left + 0.4), (0.12, 0.66), (0.05, 0.66), wood)
    for i in range(count):
        z = 0.07 + i * 0.58 / count
        stand.box((left + 0.01, left + 0.39), (0.66, 0.68), (z, z + 0.58 / count - 0.015), wood)
        z += 0.4 / count
        stand.box((left + 0.13, left + 0.27), (0.68, 0.70), (z, z + 0.015), metal)
    screens = int(rng.integers(1, 3)) if half > 0.68 else 1
    for i in range(screens):
        x = (i - (screens - 1) / 2) * 0.6
        put_monitor(stand.at(x, 0.22, 0.74, -0.35 * x + astray(rng, 0.12)))
    put_keyboard(stand.at(astray(rng, 0.05), 0.56, 0.74, astray(rng, 0.08)))
    put_mug(stand.at(-half + 0.2, 0.36 + astray(rng, 0.1), 0.74, astray(rng, 3)))
    for x in (-half + 0.2, half - 0.17):
        papers = stand.at(x, 0.52, 0.74, astray(rng, 0.4))
        top = Material(ink.sheet(rng, 150, 106))
        papers.box((-0.105, 0.105), (-0.148, 0.148), (0, astray(rng, 0.02) + 0.025), PALE, top=top)
