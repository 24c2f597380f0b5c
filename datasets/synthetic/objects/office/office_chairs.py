"""Chairs on castors."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.objects.frames import panel, pipe
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import DARK
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["office_chair"]


def desk_chair(stand: Stand, look: Look) -> None:
    """Build an office chair on five castors."""
    rng, fabric = stand.rng, look.woven(stand.rng)
    foot = DARK if rng.random() < 0.7 else paint((186, 188, 190))
    seat, tall = float(rng.uniform(0.46, 0.52)), float(rng.uniform(0.46, 0.66))
    with stand.surfaces.thing("chair"):
        for angle in np.arange(5) * 2 * np.pi / 5 + 0.3:
            x, y = 0.3 * float(np.cos(angle)), 0.3 * float(np.sin(angle))
            tube(stand, (0, 0, 0.12), (x, y, 0.075), (0.028, 0.018), foot, sides=4)
            tube(stand, (x - 0.02, y, 0.03), (x + 0.02, y, 0.03), 0.03, DARK, sides=4)
        stand.footprint((-0.32, 0.32), (-0.32, 0.32))
        tube(stand, (0, 0, 0.08), (0, 0, seat - 0.07), 0.03, DARK, sides=8)
        cushion(stand, (-0.25, 0.25), (-0.22, 0.27), (seat - 0.07, seat + 0.02), fabric)
        tube(stand, (0, -0.1, seat - 0.06), (0, -0.3, seat + 0.22), 0.025, DARK)
        levels = [(0.17, 0.12), (0.23, 0.3), (0.22, 0.75 * tall), (0.17, tall + 0.02)]
        for (half, low), (wide, high) in pairwise(levels):
            rings = []
            for r, z in ((wide, high), (half, low)):
                y = -0.19 - 0.16 * z * z
                ring = ((-r, y), (r, y), (r, y - 0.05), (-r, y - 0.05))
                rings.append([(a, b, seat + z) for a, b in ring])
            block(stand, rings[0], rings[1], fabric)
        if rng.random() < 0.75:
            for x in (-0.29, 0.29):
                tube(stand, (x * 0.8, 0, seat - 0.05), (x, -0.02, seat + 0.2), 0.016, DARK)
                cushion(
                    stand, (x - 0.035, x + 0.035), (-0.13, 0.14), (seat + 0.19, seat + 0.225), DARK
                )


COVERS: tuple[Colour, ...] = (
    (40, 41, 45), (40, 41, 45), (66, 70, 78), (40, 66, 120), (140, 44, 46), (60, 100, 80),
)  # fmt: skip


def office_chair(stand: Stand, look: Look) -> None:
    """Build a swivel chair: star foot on castors, gas lift, seat, arm rests, tilted back."""
    rng, dark = stand.rng, paint((38, 38, 41))
    colour = patterns.pick(rng, COVERS)
    fabric = Material(patterns.cloth(rng, 120, 120, colour))
    metal = paint((170, 173, 177)) if rng.random() < 0.4 else dark
    seat, top = float(rng.uniform(0.43, 0.49)), float(rng.uniform(0.98, 1.16))
    with stand.surfaces.thing("chair"):
        for angle in np.arange(5) * 2 * np.pi / 5 + rng.uniform(0, 1):
            c, s = float(np.cos(angle)), float(np.sin(angle))
            tube(stand, (0, 0, 0.11), (0.30 * c, 0.30 * s, 0.075), (0.028, 0.016), metal, sides=5)
            x, y = 0.29 * c, 0.29 * s
            axle = (0.022 * s, -0.022 * c)
            begin, end = (x - axle[0], y - axle[1], 0.03), (x + axle[0], y + axle[1], 0.03)
            tube(stand, begin, end, 0.03, dark, sides=6)
        lathe(stand, (0, 0), [(0.04, 0.08), (0.03, 0.26)], dark, sides=8)
        tube(stand, (0, 0, 0.26), (0, 0, seat - 0.04), 0.016, paint((150, 152, 155)))
        stand.box((-0.14, 0.14), (-0.14, 0.12), (seat - 0.05, seat), dark)
        cushion(stand, (-0.24, 0.24), (-0.21, 0.25), (seat, seat + 0.08), fabric, bevel=0.04)
        pipe(stand, [(0, -0.1, seat - 0.02), (0, -0.29, seat), (0, -0.29, seat + 0.3)], 0.022, dark)
        levels = [
            (0.19, -0.24, seat + 0.13), (0.235, -0.235, seat + 0.28), (0.22, -0.29, top - 0.06),
            (0.17, -0.32, top),
        ]  # fmt: skip
        panel(stand, levels, 0.05, 0.05, fabric)
        if rng.random() < 0.3:
            levels = [(0.13, -0.31, top + 0.03), (0.13, -0.33, top + 0.18)]
            panel(stand, levels, 0.03, 0.05, fabric)
        if rng.random() < 0.8:
            for x in (-0.28, 0.28):
                line = [(x * 0.5, 0, seat - 0.02), (x, 0, seat), (x, -0.02, seat + 0.2)]
                pipe(stand, line, 0.018, dark)
                arm = (x - 0.035, x + 0.035), (-0.14, 0.13), (seat + 0.2, seat + 0.235)
                cushion(stand, *arm, dark, bevel=0.015)
