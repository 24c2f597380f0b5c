"""Washbasins with mirrors and what stands on them."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.bathroom.shared import (
    CHROME,
    DARK,
    TOWELS,
    WHITE,
    shampoo,
)
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, loft, ring, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import bathroom, ink, kitchen, patterns

__all__ = ["double_basin", "washbasin"]


def _basin(stand: Stand, wide: float, deep: float, z: float, corner: float) -> None:
    """Set a basin with its tap on a stand's back; its rim is at height z."""
    y, a, b = deep / 2 + 0.012, wide / 2, deep / 2
    with stand.surfaces.thing("sink"):
        shapes = [
            (z - 0.16, 0.5 * a, 0.5 * b, 0.0), (z - 0.05, 0.96 * a, 0.96 * b, 0.0),
            (z, a, b, 0.0), (z, 0.84 * a, 0.68 * b, 0.16 * b),
            (z - 0.11, 0.4 * a, 0.34 * b, 0.1 * b),
        ]  # fmt: skip
        loft(stand, [ring((0, y + s, h), (p, q), corner=corner) for h, p, q, s in shapes], WHITE)
        lathe(stand, (0, y + 0.1 * b), [(0.022, z - 0.109), (0.02, z - 0.106)], DARK, sides=6)
        back = 0.15 * deep
        tube(stand, (0, back, z), (0, back, z + 0.15), 0.018, CHROME)
        tube(stand, (0, back, z + 0.12), (0, back + 0.13, z + 0.10), 0.014, CHROME)
        tube(stand, (0, back, z + 0.15), (0, back + 0.07, z + 0.19), 0.008, CHROME, sides=4)


def _mirror(stand: Stand, wide: float, z: tuple[float, float], look: Look) -> None:
    rng = stand.rng
    tiles = patterns.tiles(rng, (220, 300), (32, 32), ((222, 232, 234),), (150, 158, 162), 0.06)
    glass = Material(bathroom.mirror(rng, 200, int(220 * wide), tiles), shiny=True)
    thick = 0.13 if rng.random() < 0.3 else 0.03
    with stand.surfaces.thing("mirror"):
        rim = paint(look.metal) if rng.random() < 0.6 else look.wooden(rng)
        stand.box((-wide / 2, wide / 2), (0.012, thick), z, rim)
        stand.picture(
            (0.02 - wide / 2, wide / 2 - 0.02), (z[0] + 0.02, z[1] - 0.02), thick + 0.003, glass
        )


def _brushes(stand: Stand) -> None:
    """Put down a beaker with tooth brushes."""
    with stand.surfaces.thing("toothbrush"):
        lathe(
            stand,
            (0, 0),
            [(0.03, 0), (0.034, 0.09)],
            paint(patterns.pick(stand.rng, TOWELS)),
            sides=8,
        )
        for x in (-0.035, 0.03):
            colour = paint(patterns.pick(stand.rng, ink.VIVID))
            tube(stand, (0, 0, 0.05), (x, 0, 0.19), 0.005, colour, sides=4)


def washbasin(stand: Stand, look: Look) -> None:
    """Build a washbasin on a pedestal or on a cabinet, with a mirror above."""
    rng = stand.rng
    wide, corner = float(rng.uniform(0.52, 0.64)), float(rng.choice([0.35, 0.6, 0.9]))
    if rng.random() < 0.5:
        _vanity(stand, look, wide + 0.06, 1)
    else:
        _basin(stand, wide, 0.46, 0.85, corner)
        foot = [(0.0, 0.11), (0.2, 0.085), (0.55, 0.09), (0.74, 0.13)]
        loft(stand, [ring((0, 0.16, z), (r, 0.8 * r)) for z, r in foot], WHITE, closed=False)
        if rng.random() < 0.6:
            shampoo(stand.at(0.38 * wide, 0.06, 0.85))
    _mirror(stand, wide, (1.08, float(rng.uniform(1.7, 1.95))), look)


def double_basin(stand: Stand, look: Look) -> None:
    """Build two basins on one cabinet, with a long mirror above."""
    _vanity(stand, look, float(stand.rng.uniform(1.4, 1.6)), 2)
    _mirror(stand, 1.36, (1.08, float(stand.rng.uniform(1.75, 1.95))), look)


def _vanity(stand: Stand, look: Look, wide: float, count: int) -> None:
    rng, a = stand.rng, wide / 2
    body = look.wooden(rng) if rng.random() < 0.5 else paint(look.front)
    face = np.resize(body.image, (100, 150, 3)) if body.width_m > 2 else body.image[:100, :150]
    with stand.surfaces.thing("cupboard"):
        low, units = float(rng.choice([0.08, 0.30])), 2 * count
        stand.box((-a, a), (0.012, 0.44), (low, 0.72), body)
        for i in range(units):
            x = -a + i * wide / units
            front = Material(kitchen.drawers(face, int(rng.integers(1, 3))))
            stand.picture((x + 0.01, x + wide / units - 0.01), (low + 0.02, 0.71), 0.445, front)
        for x in (-a + 0.03, a - 0.03) if low < 0.2 else ():
            tube(stand, (x, 0.4, low), (x, 0.4, 0), 0.018, CHROME)
    stand.box((-a - 0.01, a + 0.01), (0.012, 0.47), (0.72, 0.75), WHITE)
    corner = float(rng.choice([0.3, 0.6, 1.0]))
    for i in range(count):
        x = (i - (count - 1) / 2) * wide / count
        _basin(stand.at(x, 0.015), min(0.5, wide - 0.08), 0.42, 0.87, corner)
    _brushes(stand.at(a - 0.05 if count == 1 else 0.0, 0.1, 0.75))
    if count == 2:
        shampoo(stand.at(0.09, 0.12, 0.75))
