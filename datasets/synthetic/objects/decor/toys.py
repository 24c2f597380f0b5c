"""Toys and games."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.decor.colours import DARK
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import Point, block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

__all__ = ["box_game", "teddy", "toys"]

FURS: tuple[Colour, ...] = ((168, 116, 68), (206, 170, 120), (110, 72, 46), (226, 216, 200))


def _ball(stand: Stand, x: float, y: float, z: float, r: Point, fur: Material, sides: int) -> None:
    """Add a round body: half widths across, deep and high."""
    levels = ((0.55, -0.85), (1.0, -0.1), (0.75, 0.65), (0.2, 1.0))
    profile = [(wide * r[0], z + high * r[2]) for wide, high in levels]
    lathe(stand, (x, y), profile, fur, sides=sides, stretch=r[1] / r[0])


def teddy(stand: Stand, look: Look) -> None:
    """Build a sitting teddy bear: belly, head with ears and muzzle, arms and legs."""
    rng, colour, s = stand.rng, pick(stand.rng, FURS), float(stand.rng.uniform(0.8, 1.3))
    fur = Material(patterns.tint(colour, 0.5 * patterns.noise(rng, 48, 96, (3, 3))))
    pale, black = paint(patterns.shift(rng, (226, 200, 160), 10)), paint(DARK)
    with stand.surfaces.thing("teddy_bear"):
        _ball(stand, 0.0, 0.0, 0.09 * s, (0.075 * s, 0.065 * s, 0.1 * s), fur, 8)
        _ball(stand, 0.0, 0.01 * s, 0.235 * s, (0.07 * s, 0.062 * s, 0.068 * s), fur, 8)
        stand.box((-0.03 * s, 0.03 * s), (0.06 * s, 0.085 * s), (0.2 * s, 0.235 * s), pale)
        stand.box((-0.012 * s, 0.012 * s), (0.085 * s, 0.09 * s), (0.222 * s, 0.236 * s), black)
        for side in (-1, 1):
            x = side * s
            stand.box((x * 0.028 - 0.008 * s, x * 0.028 + 0.008 * s), (0.062 * s, 0.07 * s),
                      (0.25 * s, 0.266 * s), black)  # fmt: skip
            ear = (0.055 * x, 0.0, 0.295 * s)
            tube(stand, ear, (ear[0], 0.025 * s, ear[2]), 0.03 * s, fur)
            tube(stand, (0.06 * x, 0.0, 0.15 * s), (0.125 * x, 0.06 * s, 0.09 * s),
                 (0.028 * s, 0.024 * s), fur, sides=5)  # fmt: skip
            tube(stand, (0.04 * x, 0.03 * s, 0.035 * s), (0.08 * x, 0.15 * s, 0.035 * s),
                 (0.035 * s, 0.034 * s), fur, sides=5)  # fmt: skip
            tube(stand, (0.08 * x, 0.15 * s, 0.035 * s), (0.081 * x, 0.154 * s, 0.035 * s),
                 0.024 * s, pale, sides=5)  # fmt: skip


def box_game(stand: Stand, look: Look) -> None:
    """Pile up boxes of board games."""
    rng, z = stand.rng, 0.0
    for _ in range(int(rng.integers(1, 4))):
        colour, tall = pick(rng, ink.VIVID), float(rng.uniform(0.04, 0.07))
        lid, side = ink.photo(rng, 140, 190), plain(34, 190, colour)
        title = f"{ink.word(rng)} game".upper()
        cv2.rectangle(lid, (0, 0), (190, 42), colour, -1)
        ink.write(lid, title, (8, 4, 182, 40), (250, 246, 230), thickness=2)
        ink.write(side, title, (8, 4, 182, 30), (250, 246, 230), thickness=2)
        turned = stand.at(0.0, 0.0, z, float(rng.uniform(-0.15, 0.15)))
        with stand.surfaces.thing("toy"):
            turned.box((-0.19, 0.19), (-0.135, 0.135), (0.0, tall), paint(colour),
                       front=Material(side), top=Material(lid))  # fmt: skip
        z += tall


def toys(stand: Stand, look: Look) -> None:
    """Build a toy: a pile of letter blocks, a car or a ring tower."""
    rng, kind = stand.rng, int(stand.rng.integers(3))
    with stand.surfaces.thing("toy"):
        if kind == 0:
            for i, (x, y, z) in enumerate(((-0.055, 0.0, 0), (0.05, 0.02, 0), (0.0, -0.01, 0.09))):
                face, colour = plain(48, 48, (240, 226, 190)), pick(rng, ink.VIVID)
                cv2.rectangle(face, (2, 2), (45, 45), colour, 4)
                ink.write(face, "ABC"[i], (8, 8, 40, 40), colour, thickness=3)
                turned = stand.at(x, y, z, float(rng.uniform(-0.4, 0.4)))
                letter = Material(face, 0.09, 0.09)
                turned.box((-0.045, 0.045), (-0.045, 0.045), (0.0, 0.09), letter)
        elif kind == 1:
            body, glass, tyre = paint(pick(rng, ink.VIVID[:6])), paint((150, 200, 226)), paint(DARK)
            cushion(stand, (-0.15, 0.15), (-0.065, 0.065), (0.03, 0.09), body, bevel=0.02)
            low = [(-0.1, 0.06, 0.09), (0.07, 0.06, 0.09), (0.07, -0.06, 0.09), (-0.1, -0.06, 0.09)]
            high = [(0.7 * x - 0.005, 0.8 * y, 0.14) for x, y, _ in low]
            block(stand, high, low, glass)
            stand.box((-0.075, 0.045), (-0.048, 0.048), (0.14, 0.148), body)
            for x in (-0.09, 0.09):
                for y in (-0.075, 0.05):
                    tube(stand, (x, y, 0.035), (x, y + 0.025, 0.035), 0.035, tyre, sides=8)
        else:
            for i in range(5):
                r, z = 0.08 - 0.012 * i, 0.036 * i
                ring = [(0.8 * r, z), (r, z + 0.018), (0.8 * r, z + 0.036)]
                lathe(stand, (0.0, 0.0), ring, paint(ink.VIVID[i]), sides=8)
            _ball(stand, 0.0, 0.0, 0.205, (0.028, 0.028, 0.03), paint((230, 170, 40)), 6)
