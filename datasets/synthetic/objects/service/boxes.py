"""Boxes, crates and pallets on the floor."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.objects.service.stock import put_carton, put_crate
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import cushion
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import pick

__all__ = ["cardboard_boxes", "crates", "pallet"]


def cardboard_boxes(stand: Stand, look: Look) -> None:
    """Pile up cardboard boxes, none quite straight on the other."""
    rng, z, two = stand.rng, 0.0, bool(stand.rng.random() < 0.6)
    for _ in range(int(rng.integers(2, 5))):
        a, b = float(rng.uniform(0.2, 0.3)) - 0.04 * z, float(rng.uniform(0.15, 0.22)) - 0.03 * z
        h, turn = float(rng.uniform(0.2, 0.38)), float(rng.uniform(-0.2, 0.2))
        put_carton(stand.at(-0.22 if two else 0.0, 0.0, 0.0, turn), (-a, a), (-b, b), (z, z + h))
        z += h + 0.002
    if two:
        beside = stand.at(0.3, float(rng.uniform(-0.05, 0.1)), 0.0, float(rng.uniform(-0.4, 0.4)))
        put_carton(beside, (-0.18, 0.18), (-0.15, 0.15), (0.0, float(rng.uniform(0.2, 0.4))))


def pallet(stand: Stand, look: Look) -> None:
    """Build a wooden pallet with boxes or sacks on it."""
    rng, wood = stand.rng, Material(patterns.wood(stand.rng, 96, 160, (190, 152, 104)), 1.0, 0.5)
    with stand.surfaces.thing("pallet"):
        for y in (-0.4, -0.05, 0.3):
            for x in (-0.6, -0.07, 0.46):
                stand.box((x, x + 0.14), (y, y + 0.1), (0.02, 0.1), wood)
            stand.box((-0.6, 0.6), (y, y + 0.1), (0.0, 0.022), wood)
        for y in np.linspace(-0.4, 0.3, 6):
            stand.box((-0.6, 0.6), (float(y), float(y) + 0.1), (0.122, 0.144), wood)
        for x in (-0.6, -0.07, 0.46):
            stand.box((x, x + 0.14), (-0.4, 0.4), (0.1, 0.122), wood)
        sacks, layers = bool(rng.random() < 0.4), int(rng.integers(1, 4))
        linen = Material(patterns.cloth(rng, 96, 96, pick(rng, ((206, 190, 150), (226, 226, 220)))))
        for i in range(layers * 4 - int(rng.integers(0, 3))):
            x, y, z = -0.57 + 0.58 * (i % 2), -0.38 + 0.39 * (i // 2 % 2), 0.146
            if sacks:
                z += 0.15 * (i // 4)
                with stand.surfaces.thing("sack"):
                    cushion(stand, (x, x + 0.56), (y, y + 0.37), (z, z + 0.15), linen)
            else:
                z += 0.28 * (i // 4)
                put_carton(stand, (x, x + 0.56), (y, y + 0.37), (z, z + 0.278))


def crates(stand: Stand, look: Look) -> None:
    """Pile up plastic crates."""
    rng, high = stand.rng, float(stand.rng.uniform(0.2, 0.3))
    columns = int(rng.integers(1, 3))
    for column in range(columns):
        place = stand.at(
            0.47 * column - 0.235 * (columns - 1), 0.0, 0.0, float(rng.uniform(-0.12, 0.12))
        )
        for i in range(int(rng.integers(1, 4))):
            z = i * (high + 0.004)
            put_crate(place, (-0.21, 0.21), (-0.16, 0.16), (z, z + high))
