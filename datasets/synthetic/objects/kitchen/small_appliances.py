"""Small machines for the worktop."""

from __future__ import annotations

from itertools import pairwise

import cv2

from roomgraph.datasets.synthetic.objects.kitchen.crockery import cup
from roomgraph.datasets.synthetic.objects.kitchen.shared import CASES, DARK, STEEL
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, loft, ring, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns

__all__ = ["coffee_machine", "kettle", "microwave", "toaster"]


def microwave(stand: Stand, look: Look) -> None:
    """Build a microwave oven: dark window, keys, clock, handle."""
    rng, colour = stand.rng, patterns.pick(stand.rng, CASES[:3])
    image = patterns.plain(100, 160, colour)
    cv2.rectangle(image, (8, 10), (112, 90), (24, 24, 27), -1)
    cv2.rectangle(image, (20, 22), (98, 78), (52, 54, 58), -1)
    for x in range(22, 98, 4):
        cv2.line(image, (x, 22), (x, 78), (36, 36, 40), 1)
    cv2.rectangle(image, (122, 10), (154, 24), (10, 12, 12), -1)
    ink.write(image, f"{int(rng.integers(10, 24))}:30", (124, 11, 152, 23), (110, 255, 140))
    for i in range(12):
        x, y = 123 + 11 * (i % 3), 32 + 11 * (i // 3)
        cv2.rectangle(image, (x, y), (x + 8, y + 7), (128, 130, 136), -1)
    cv2.circle(image, (138, 86), 8, (150, 152, 158), -1, cv2.LINE_AA)
    with stand.surfaces.thing("microwave"):
        stand.box((-0.25, 0.25), (-0.18, 0.18), (0.01, 0.29), paint(colour), front=Material(image))
        tube(stand, (0.115, 0.20, 0.05), (0.115, 0.20, 0.25), 0.01, STEEL, sides=4)


def kettle(stand: Stand, look: Look) -> None:
    """Build an electric kettle on its base: body, lid, spout, handle."""
    rng, case = stand.rng, paint(patterns.pick(stand.rng, CASES))
    tall, r = float(rng.uniform(0.19, 0.23)), float(rng.uniform(0.07, 0.08))
    with stand.surfaces.thing("kettle"):
        lathe(stand, (0, 0), [(1.05 * r, 0), (r, 0.02)], DARK, sides=10)
        body = [(r, 0.022), (0.95 * r, 0.5 * tall), (0.7 * r, 0.96 * tall)]
        lathe(stand, (0, 0), body, case, sides=10)
        lathe(
            stand,
            (0, 0),
            [(0.66 * r, 0.96 * tall), (0.2 * r, tall), (0.18 * r, 1.1 * tall)],
            DARK,
            sides=8,
        )
        tube(stand, (-0.5 * r, 0, 0.78 * tall), (-1.25 * r, 0, 0.95 * tall), (0.028, 0.014), case)
        arc = [
            (0.6 * r, 0.95 * tall),
            (1.55 * r, 0.92 * tall),
            (1.6 * r, 0.35 * tall),
            (0.9 * r, 0.2 * tall),
        ]
        for (x0, z0), (x1, z1) in pairwise(arc):
            tube(stand, (x0, 0, z0), (x1, 0, z1), 0.012, DARK, sides=4)


def toaster(stand: Stand, look: Look) -> None:
    """Build a toaster: rounded body, two slots with bread at times, lever and dial."""
    rng, case = stand.rng, paint(patterns.pick(stand.rng, CASES))
    with stand.surfaces.thing("toaster"):
        shapes = [(0.0, 0.14, 0.08), (0.03, 0.145, 0.085), (0.15, 0.14, 0.08), (0.18, 0.115, 0.06)]
        loft(stand, [ring((0, 0, z), (a, b), corner=0.4) for z, a, b in shapes], case)
        stand.box((-0.146, 0.146), (-0.086, 0.086), (0.0, 0.025), DARK)
        bread = rng.random() < 0.5
        for y in (-0.025, 0.025):
            stand.sheet((-0.09, 0.09), (y - 0.014, y + 0.014), 0.182, DARK)
            if bread:
                stand.box(
                    (-0.06, 0.06), (y - 0.008, y + 0.008), (0.18, 0.235), paint((206, 150, 84))
                )
        stand.box((0.14, 0.165), (-0.02, 0.02), (0.11, 0.125), DARK)
        tube(stand, (0.07, 0.08, 0.06), (0.07, 0.097, 0.06), 0.018, DARK, sides=8)
        stand.box((-0.1, 0.02), (0.08, 0.087), (0.055, 0.065), STEEL)


def coffee_machine(stand: Stand, look: Look) -> None:
    """Build a coffee machine: tank, head with buttons, and a jug or a cup on the drip tray."""
    rng, case = stand.rng, paint(patterns.pick(stand.rng, CASES))
    image = patterns.plain(60, 120, (52, 52, 56))
    ink.write(image, ink.word(rng).upper(), (40, 38, 80, 52), (200, 202, 206))
    for x in (20, 44, 76, 100):
        cv2.circle(image, (x, 20), 8, (214, 216, 218), -1, cv2.LINE_AA)
        cv2.circle(image, (x, 20), 3, patterns.pick(rng, ink.VIVID), -1, cv2.LINE_AA)
    with stand.surfaces.thing("coffee_machine"):
        stand.box((-0.12, 0.12), (-0.16, -0.02), (0.0, 0.34), case)
        stand.box((-0.12, 0.12), (-0.02, 0.15), (0.0, 0.035), DARK)
        stand.box((-0.12, 0.12), (-0.02, 0.14), (0.24, 0.34), case, front=Material(image))
        tube(stand, (0, 0.07, 0.24), (0, 0.07, 0.20), (0.035, 0.02), STEEL, sides=8)
        if rng.random() < 0.5:
            jug = [(0.06, 0.036), (0.075, 0.09), (0.05, 0.16), (0.055, 0.18)]
            lathe(stand, (0, 0.07), jug, paint((58, 36, 26)), sides=10)
            tube(stand, (0.055, 0.09, 0.16), (0.10, 0.13, 0.08), 0.01, DARK, sides=4)
        else:
            cup(stand.at(0, 0.07, 0.036), look)
        stand.box((-0.09, 0.09), (-0.15, -0.03), (0.34, 0.36), STEEL)
