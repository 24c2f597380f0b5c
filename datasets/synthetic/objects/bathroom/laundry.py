"""Washing machines and baskets for laundry."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.bathroom.shared import (
    CHROME,
    DARK,
    TOWELS,
    WHITE,
    shampoo,
)
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import cushion, loft, ring, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import finishes, ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Generator

__all__ = ["laundry_basket", "washing_machine"]


def _machine(rng: Generator) -> Image:
    """Draw a washing machine's front: drawer, dial, display, and the plinth's flap."""
    image = patterns.plain(280, 200, (240, 241, 241))
    cv2.rectangle(image, (0, 0), (199, 44), (228, 230, 232), -1)
    cv2.rectangle(image, (8, 8), (66, 38), (170, 174, 178), 2)
    ink.write(image, ink.word(rng).upper(), (12, 14, 62, 32), (60, 64, 90))
    cv2.circle(image, (100, 23), 15, (150, 154, 158), -1, cv2.LINE_AA)
    cv2.line(image, (100, 23), (108, 12), (30, 30, 34), 3, cv2.LINE_AA)
    cv2.rectangle(image, (128, 12), (166, 34), (20, 24, 28), -1)
    ink.write(image, "1:20", (131, 14, 163, 32), (120, 220, 255))
    for x in (174, 184):
        cv2.circle(image, (x, 23), 4, (120, 124, 130), -1, cv2.LINE_AA)
    cv2.line(image, (0, 45), (199, 45), (130, 134, 138), 2)
    cv2.rectangle(image, (140, 252), (190, 274), (170, 174, 178), 2)
    return image


def washing_machine(stand: Stand, look: Look) -> None:
    """Build a washing machine with its round door; now and then there is a basket on it."""
    rng, y = stand.rng, 0.60
    with stand.surfaces.thing("washing_machine"):
        stand.box((-0.3, 0.3), (0.02, y), (0.02, 0.85), WHITE, front=Material(_machine(rng)))
        rim = CHROME if rng.random() < 0.5 else paint((90, 94, 100))
        tube(stand, (0, y, 0.42), (0, y + 0.035, 0.42), (0.2, 0.185), rim, sides=14)
        glass = Material(patterns.plain(8, 8, (44, 54, 66)), shiny=True)
        tube(stand, (0, y + 0.03, 0.42), (0, y + 0.045, 0.42), (0.145, 0.10), glass, sides=14)
        stand.box((0.15, 0.18), (y, y + 0.05), (0.37, 0.47), DARK)
    for i in range(int(rng.integers(0, 3))):
        shampoo(stand.at(-0.2 + 0.1 * i, 0.2, 0.85))


def laundry_basket(stand: Stand, look: Look) -> None:
    """Build a wicker basket full of washing."""
    rng, corner = stand.rng, float(stand.rng.choice([0.3, 1.0]))
    weave = Material(finishes.cane(rng, 120, 480, (196, 156, 104)))
    r, tall = float(rng.uniform(0.19, 0.25)), float(rng.uniform(0.45, 0.62))
    with stand.surfaces.thing("laundry_basket"):
        rings = [
            ring((0, 0, z), (k, 0.8 * k), corner=corner) for z, k in ((0, 0.85 * r), (tall, r))
        ]
        loft(stand, rings, weave, closed=False)
        heap = [(tall, 0.97 * r), (tall - 0.05, 0.93 * r)]
        loft(stand, [ring((0, 0, z), (k, 0.8 * k), corner=corner) for z, k in heap], weave)
        for x, y in ((-0.35, 0.2), (0.3, -0.1), (0.0, -0.25)):
            cloth = Material(patterns.cloth(rng, 40, 40, patterns.pick(rng, TOWELS, 30)))
            spans = (x * r - 0.09, x * r + 0.09), (y * r - 0.07, y * r + 0.07)
            cushion(stand, *spans, (tall - 0.06, tall + float(rng.uniform(0.02, 0.07))), cloth)
