"""For sport and on the way: backpacks, treadmills."""

from __future__ import annotations

from itertools import pairwise

import cv2

from roomgraph.datasets.synthetic.objects.decor.colours import DARK
from roomgraph.datasets.synthetic.objects.look import FABRICS, Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import pick, plain

__all__ = ["backpack", "treadmill"]


def backpack(stand: Stand, look: Look) -> None:
    """Build a backpack: body, front pocket, zips, handle, straps."""
    rng = stand.rng
    colour = pick(rng, (*ink.VIVID[:10], *FABRICS[:6]))
    cloth, dark = Material(patterns.cloth(rng, 96, 96, colour)), paint(DARK)
    trim = Material(patterns.cloth(rng, 64, 64, patterns.shift(rng, colour, 50)))
    half, top = float(rng.uniform(0.14, 0.17)), float(rng.uniform(0.4, 0.48))
    with stand.surfaces.thing("backpack"):
        cushion(stand, (-half, half), (-0.1, 0.06), (0.0, top), cloth, bevel=0.06)
        cushion(stand, (-0.8 * half, 0.8 * half), (0.05, 0.12), (0.03, 0.5 * top), trim, bevel=0.03)
        for z, wide in ((0.42 * top, 0.6), (0.62 * top, 0.9)):
            deep = 0.122 if wide < 0.7 else 0.064
            stand.box((-wide * half, wide * half), (0.0, deep), (z, z + 0.01), dark)
        for a, b in (((-0.04, -0.04), (-0.025, 0.02)), ((0.04, -0.04), (0.025, 0.02))):
            tube(stand, (a[0], a[1], top - 0.01), (b[0], -0.04, top + 0.04), 0.01, dark, sides=4)
        tube(stand, (-0.025, -0.04, top + 0.04), (0.025, -0.04, top + 0.04), 0.01, dark, sides=4)
        for x in (-0.6 * half, 0.6 * half):
            for p, q in pairwise(((-0.09, top - 0.06), (-0.15, 0.6 * top), (-0.1, 0.08))):
                tube(stand, (x, p[0], p[1]), (x, q[0], q[1]), 0.016, dark, sides=4)


def treadmill(stand: Stand, look: Look) -> None:
    """Build a treadmill: belt between rails, motor hood, uprights, console, hand bars."""
    rng, grey = stand.rng, paint(pick(stand.rng, ((60, 62, 68), (130, 134, 140), DARK)))
    belt = patterns.tint((44, 44, 48), 0.5 * patterns.noise(rng, 160, 60, (2, 2)))
    cv2.line(belt, (30, 0), (30, 160), (110, 112, 116), 1)
    screen = plain(70, 150, (24, 26, 30))
    cv2.rectangle(screen, (40, 6), (110, 40), (20, 60, 50), -1)
    ink.write(screen, "05:42", (44, 8, 106, 38), (120, 255, 160))
    for i, left in enumerate((10, 22, 118, 130, 50, 68, 86)):
        cv2.circle(
            screen, (left + 5, 54 if i > 3 else 26), 5, pick(rng, ink.VIVID), -1, cv2.LINE_AA
        )
    black, trim = paint(DARK), paint(pick(rng, ink.VIVID))
    with stand.surfaces.thing("treadmill"):
        stand.box((-0.3, 0.3), (-0.55, 0.85), (0.06, 0.15), black, top=Material(belt))
        for x in (-0.38, 0.3):
            stand.box((x, x + 0.08), (-0.6, 0.85), (0.04, 0.165), grey)
            stand.box((x, x + 0.08), (0.78, 0.86), (0.0, 0.17), black)
        cushion(stand, (-0.38, 0.38), (-0.85, -0.5), (0.03, 0.26), grey, bevel=0.07)
        stand.box((-0.2, 0.2), (-0.57, -0.495), (0.16, 0.19), trim)
        for side in (-1, 1):
            x = 0.36 * float(side)
            tube(stand, (x, -0.62, 0.1), (x, -0.45, 1.12), (0.04, 0.032), grey)
            tube(stand, (x, -0.46, 1.04), (x, -0.02, 0.98), 0.025, black)
            tube(stand, (x, -0.02, 0.98), (x, 0.02, 0.88), 0.025, black)
        low = [(-0.4, -0.3, 1.1), (0.4, -0.3, 1.1), (0.4, -0.42, 1.06), (-0.4, -0.42, 1.06)]
        high = [(-0.36, -0.42, 1.36), (0.36, -0.42, 1.36), (0.36, -0.5, 1.34), (-0.36, -0.5, 1.34)]
        block(stand, high, low, grey)
        face = [(0.85 * x, y + 0.005, z) for x, y, z in (high[0], high[1], low[1], low[0])]
        material = Material(screen, glow=(0.4, 0.0, 0.6, 0.9))
        stand.surfaces.picture(stand.world(face), material)
        stand.footprint((-0.4, 0.4), (-0.85, 0.86))
