"""Aquaria."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.decor.colours import DARK, GREENS
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Glow, Image, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import pick

__all__ = ["aquarium"]


def _water(rng: np.random.Generator, height: int, width: int) -> Image:
    """Draw the inside of an aquarium: gravel, plants, stones, fish, bubbles."""
    down = np.linspace(0.2, -0.25, height, dtype=np.float32)[:, None]
    image = patterns.tint((70, 160, 190), np.repeat(down, width, axis=1))
    for _ in range(14):
        x, tall = int(rng.integers(width)), int(rng.uniform(0.25, 0.75) * height)
        for k in range(0, tall, 9):
            at = x + int(6 * np.sin(k / 14)), height - 20 - k
            cv2.ellipse(image, at, (9, 4), 50.0 if k % 2 else -50.0, 0, 360, pick(rng, GREENS), -1)
    for _ in range(5):
        at = int(rng.integers(width)), height - 22
        cv2.ellipse(
            image, at, (26, 18), 0, 0, 360, pick(rng, ((110, 104, 100), (140, 120, 96))), -1
        )
    image[height - 24 :] = patterns.tint((206, 176, 126), patterns.noise(rng, 24, width, (4, 4)))
    for _ in range(9):
        x, y = int(rng.integers(20, width - 20)), int(rng.integers(24, height - 44))
        fish, way = (
            pick(rng, ((250, 130, 30), (250, 210, 40), (220, 50, 50))),
            int(rng.choice((-1, 1))),
        )
        tail = np.array([(x - 9 * way, y), (x - 19 * way, y - 7), (x - 19 * way, y + 7)])
        cv2.fillPoly(image, [tail], fish, cv2.LINE_AA)
        cv2.ellipse(image, (x, y), (12, 6), 0, 0, 360, fish, -1, cv2.LINE_AA)
        cv2.line(image, (x, y - 5), (x, y + 5), (250, 250, 250), 2)
        cv2.circle(image, (x + 7 * way, y - 1), 1, (10, 10, 10), -1)
    return image


def aquarium(stand: Stand, look: Look) -> None:
    """Build an aquarium with fish and plants, lit, on a cabinet."""
    rng, half, deep = stand.rng, float(stand.rng.uniform(0.4, 0.6)), 0.4
    low, high = 0.72, 0.72 + float(rng.uniform(0.42, 0.5))
    wood, black = look.wooden(rng), paint(DARK)
    glow: Glow = (0.5, 0.3, 0.9, 0.8)
    front = Material(_water(rng, 190, int(400 * half)), glow=glow, shiny=True)
    side = Material(_water(rng, 190, 160), deep, high - low, glow=glow, shiny=True)
    with stand.surfaces.thing("aquarium"):
        stand.box((-half, half), (0.0, deep), (0.05, low - 0.02), wood)
        stand.box((-half + 0.03, half - 0.03), (0.02, deep - 0.03), (0.0, 0.05), black)
        for x in (-half + 0.02, 0.01):
            door = (x, x + half - 0.03)
            stand.box(door, (deep, deep + 0.016), (0.08, low - 0.05), wood)
            knob = -0.03 if x < 0 else 0.04
            stand.prism((knob, deep + 0.02), (0.45, 0.53), 0.008, look.metallic())
        stand.box((-half, half), (0.0, deep), (low - 0.02, low + 0.02), black)
        stand.box((-half + 0.01, half - 0.01), (0.01, deep - 0.01), (low + 0.02, high), side,
                  front=front)  # fmt: skip
        stand.box((-half, half), (0.0, deep), (high, high + 0.06), black)
