"""What is fixed to corridor walls: extinguishers, radiators, switches, rails."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.panels import DARK, STEEL, WHITE, hang_panel
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, signs
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

__all__ = ["fire_extinguisher", "hand_rail", "light_switch", "radiator"]

RED: Colour = (200, 28, 28)


def fire_extinguisher(stand: Stand, look: Look) -> None:
    """Hang a red extinguisher with hose and label, below its sign."""
    rng = stand.rng
    foot, tall, radius = float(rng.uniform(0.12, 0.5)), float(rng.uniform(0.44, 0.56)), 0.085
    print_ = plain(96, 256, pick(rng, (RED, (216, 40, 30)), 8))
    print_[18:80, 160:236] = ink.sheet(rng, 62, 76)
    cv2.rectangle(print_, (160, 18), (236, 34), (40, 70, 150), -1)
    centre, top, black = (0.0, radius + 0.03), foot + tall, paint(DARK)
    with stand.surfaces.thing("fire_extinguisher"):
        body = Material(print_)
        lathe(stand, centre, [(radius, foot), (radius, top - 0.08)], body)
        red = paint((int(print_[0, 0, 0]), 30, 28))
        dome = [(radius, top - 0.08), (0.06, top - 0.03), (0.03, top)]
        lathe(stand, centre, dome, red)
        stand.prism(centre, (top, top + 0.05), 0.022, paint((180, 150, 80)))
        for z in (top + 0.05, top + 0.085):
            block(stand, [(-0.02, 0.13, z + 0.02), (0.11, 0.13, z + 0.02), (0.11, 0.1, z + 0.02),
                          (-0.02, 0.1, z + 0.02)],
                  [(-0.02, 0.13, z), (0.11, 0.13, z - 0.02), (0.11, 0.1, z - 0.02),
                   (-0.02, 0.1, z)], black)  # fmt: skip
        hose = [(-0.02, 0.115, top + 0.03), (-0.1, 0.13, top - 0.02), (-0.125, 0.13, top - 0.18),
                (-0.1, 0.14, top - 0.36)]  # fmt: skip
        for a, b, r in zip(hose, hose[1:], (0.012, 0.012, 0.018), strict=False):
            tube(stand, a, b, r, black)
    sign = plain(150, 150, RED)
    cv2.rectangle(sign, (4, 4), (145, 145), (250, 250, 250), 3)
    cv2.rectangle(sign, (52, 56), (92, 130), (250, 250, 250), -1)
    cv2.rectangle(sign, (64, 36), (80, 58), (250, 250, 250), -1)
    cv2.polylines(sign, [np.array([(72, 36), (112, 40), (118, 90)])], False, (250, 250, 250), 7)
    with stand.surfaces.thing("sign"):
        z = top + float(rng.uniform(0.3, 0.5))
        hang_panel(stand, 0.2, (z, z + 0.2), Material(sign), paint(RED), 0.015)


def radiator(stand: Stand, look: Look) -> None:
    """Build a radiator: columns, or a ribbed panel, with pipe and valve."""
    rng = stand.rng
    half, top = float(rng.uniform(0.35, 0.75)), float(rng.uniform(0.55, 0.85))
    white = paint(pick(rng, ((234, 232, 226), (220, 216, 204)), 6))
    with stand.surfaces.thing("radiator"):
        if rng.random() < 0.5:
            for x in np.arange(-half, half - 0.03, 0.065):
                a = float(x)
                cushion(stand, (a, a + 0.045), (0.03, 0.15), (0.1, top), white, bevel=0.02)
            for z in (0.14, top - 0.07):
                stand.box((-half, half), (0.06, 0.12), (z, z + 0.03), white)
        else:
            face = Material(signs.radiator(200, int(400 * half)))
            grille = plain(24, int(400 * half), (206, 204, 198))
            grille[4:20, ::8] = (90, 90, 90)
            stand.box((-half, half), (0.03, 0.13), (0.12, top), white, front=face,
                      top=Material(grille))  # fmt: skip
        end = half + 0.06
        tube(stand, (half - 0.02, 0.09, 0.16), (end, 0.09, 0.16), 0.012, white)
        tube(stand, (end, 0.09, 0.18), (end, 0.09, 0.0), 0.012, white)
        tube(stand, (half - 0.02, 0.09, top - 0.08), (half + 0.04, 0.09, top - 0.08), 0.012, white)
        tube(stand, (half + 0.03, 0.09, top - 0.08), (half + 0.13, 0.09, top - 0.08), 0.028,
             paint(WHITE), sides=8)  # fmt: skip


def light_switch(stand: Stand, look: Look) -> None:
    """Hang a switch: plate and one or two rockers."""
    rng, count, z = stand.rng, int(stand.rng.integers(1, 3)), float(stand.rng.uniform(1.02, 1.15))
    half, white = 0.042 * count, paint(pick(rng, (WHITE, (226, 218, 200), (70, 70, 74))))
    with stand.surfaces.thing("light_switch"):
        stand.box((-half, half), (0.0, 0.014), (z, z + 0.084), white)
        for i in range(count):
            x, y, middle = -half + 0.084 * i + 0.015, 0.014, z + 0.042
            face = plain(32, 32, (214, 212, 206))
            face[16:] = (244, 242, 238)
            cv2.rectangle(face, (0, 0), (31, 31), (120, 120, 118), 1)
            stand.box((x, x + 0.054), (y, y + 0.008), (middle - 0.027, middle + 0.027), white,
                      front=Material(face))  # fmt: skip


def hand_rail(stand: Stand, look: Look, *, width: float = 2.0) -> None:
    """Hang a round rail on brackets."""
    rail = look.wooden(stand.rng) if stand.rng.random() < 0.6 else look.metallic()
    half, metal = width / 2, paint(STEEL)
    with stand.surfaces.thing("hand_rail"):
        tube(stand, (-half, 0.08, 0.92), (half, 0.08, 0.92), 0.024, rail, sides=10)
        for x in np.linspace(-half + 0.15, half - 0.15, max(2, round(width / 0.9))):
            tube(stand, (float(x), 0.02, 0.84), (float(x), 0.08, 0.9), 0.009, metal)
            stand.box((float(x) - 0.03, float(x) + 0.03), (0.0, 0.02), (0.8, 0.88), metal)
