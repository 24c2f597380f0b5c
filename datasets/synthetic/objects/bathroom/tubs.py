"""Bathtubs and showers."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.bathroom.shared import (
    CHROME,
    DARK,
    WHITE,
    mixer_tap,
    shampoo,
)
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, lathe, loft, ring, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import bathroom, patterns

__all__ = ["bathtub", "shower"]


def bathtub(stand: Stand, look: Look) -> None:
    """Build a bathtub: panelled or on feet, with a rim, a hollow, a tap and a hand shower."""
    rng, free = stand.rng, bool(stand.rng.random() < 0.35)
    long, deep = float(rng.uniform(1.5, 1.75)), float(rng.uniform(0.7, 0.8))
    a, b, y, top = long / 2, deep / 2, deep / 2 + 0.012, float(rng.uniform(0.54, 0.60))
    outside = paint(look.accent) if free and rng.random() < 0.5 else WHITE
    with stand.surfaces.thing("bathtub"):
        if free:
            hull = [(0.12, 0.8 * a, 0.68 * b), (0.3, 0.93 * a, 0.9 * b), (top, a, b)]
            round_ = 0.55
            for x in (-0.6 * a, 0.6 * a):
                for side in (-0.5, 0.5):
                    tube(stand, (x, y + side * b, 0.16), (x, y + 1.2 * side * b, 0), 0.03, CHROME)
        else:
            hull, round_ = [(0.0, a - 0.02, b - 0.01), (top - 0.05, a - 0.02, b - 0.01)], 0.1
        outer = [ring((0, y, z), (p, q), corner=round_) for z, p, q in hull]
        loft(stand, outer, outside, closed=False)
        rim, inner = 0.04 if free else 0.075, max(round_, 0.4)
        lip = [(top - 0.05, a, b), (top, a, b)]
        edge = [ring((0, y, z), (p, q), corner=round_) for z, p, q in lip]
        hollow = [(top, a - rim, b - rim), (top - 0.2, a - rim - 0.05, b - rim - 0.04),
                  (0.17, a - 0.24, b - 0.16)]  # fmt: skip
        edge += [ring((0, y, z), (p, q), corner=inner) for z, p, q in hollow]
        loft(stand, edge, WHITE)
        lathe(stand, (0.62 * a, y), [(0.03, 0.171), (0.028, 0.175)], CHROME, sides=8)
        mixer_tap(stand.at(0.75 * a, 0.02, top + 0.10))
        tube(stand, (0.75 * a, 0.05, top + 0.1), (0.75 * a, 0.05, top + 0.62), 0.009, CHROME)
        tube(stand, (0.75 * a, 0.05, top + 0.6), (0.75 * a, 0.16, top + 0.65), 0.014, CHROME)
        lathe(stand, (0.75 * a, 0.18), [(0.05, top + 0.61), (0.03, top + 0.66)], CHROME, sides=8)
        # A tub on feet has no flat corner to put bottles on.
        for i in range(0 if free else int(rng.integers(0, 4))):
            shampoo(stand.at(-0.85 * a + 0.09 * i, 0.06, top))


def shower(stand: Stand, look: Look) -> None:
    """Build a shower on its tray, in a corner: head on a rail, and a curtain or frosted panes."""
    rng, wide = stand.rng, float(stand.rng.uniform(0.8, 1.0))
    a, metal = wide / 2, CHROME if rng.random() < 0.7 else DARK
    with stand.surfaces.thing("shower"):
        tray = [(0.0, a), (0.09, a), (0.09, a - 0.05), (0.04, a - 0.07)]
        rings = [ring((0, a + 0.012, z), (r, r), corner=0.12) for z, r in tray]
        loft(stand, rings, WHITE)
        lathe(stand, (0, a), [(0.05, 0.041), (0.048, 0.046)], CHROME, sides=8)
        tiles = patterns.tiles(rng, (420, 200), (30, 30), (look.front,), (206, 210, 212))
        stand.picture((-a, a), (0.09, 2.1), 0.014, Material(tiles))
        tube(stand, (0, 0.06, 0.95), (0, 0.06, 2.12), 0.012, metal)
        tube(stand, (0, 0.06, 2.12), (0, 0.36, 2.12), 0.012, metal)
        lathe(stand, (0, 0.36), [(0.13, 2.05), (0.12, 2.065), (0.03, 2.11)], metal, sides=10)
        mixer_tap(stand.at(0, 0.0, 1.05))
        tube(stand, (0.12, 0.05, 1.6), (0.12, 0.14, 1.66), (0.012, 0.03), metal)
        stand.box((0.2, 0.4), (0.02, 0.12), (1.1, 1.115), metal)
        for i in range(2):
            shampoo(stand.at(0.26 + 0.09 * i, 0.07, 1.115))
        front, ends = wide - 0.02, (-a + 0.015, a - 0.015)
        for x in ends:
            tube(stand, (x, front, 0.09), (x, front, 2.0), 0.012, metal, sides=4)
            tube(stand, (x, 0.02, 2.0), (x, front, 2.0), 0.012, metal, sides=4)
        tube(stand, (ends[0], front, 2.0), (ends[1], front, 2.0), 0.012, metal, sides=4)
        if rng.random() < 0.5:
            _curtain(stand, (-a + 0.02, a * float(rng.uniform(-0.3, 0.5))), front)
        else:
            frost = Material(
                patterns.tint((206, 224, 226), 0.1 * patterns.noise(rng, 60, 60, (9, 9)))
            )
            stand.box((ends[0], 0.05), (front - 0.006, front + 0.006), (0.10, 1.25), frost)
            for x in ends:
                stand.box((x - 0.006, x + 0.006), (0.03, front), (0.10, 1.25), frost)
            tube(stand, (0.05, front, 0.09), (0.05, front, 2.0), 0.012, metal, sides=4)


def _curtain(stand: Stand, x: tuple[float, float], y: float) -> None:
    """Hang a curtain in folds."""
    with stand.surfaces.thing("shower_curtain"):
        picture = Material(bathroom.shower_curtain(stand.rng, 400, 260))
        edges = np.linspace(*x, 11)
        for i in range(10):
            (x0, y0), (x1, y1) = ((edges[k], y + 0.025 * (-1) ** k) for k in (i, i + 1))
            top = [(x0, y0, 1.98), (x1, y1, 1.98), (x1, y1 - 0.01, 1.98), (x0, y0 - 0.01, 1.98)]
            share = Material(picture.image[:, 26 * i : 26 * i + 26], abs(x1 - x0), 1.86)
            block(stand, top, [(a, b, 0.12) for a, b, _ in top], share)
