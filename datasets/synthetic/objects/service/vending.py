"""Vending machines."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.panels import DARK, SIGN_GLOW, WHITE
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink
from roomgraph.datasets.synthetic.textures.kitchen import packet
from roomgraph.datasets.synthetic.textures.patterns import pick, plain

__all__ = ["vending_machine"]


def _goods(rng: np.random.Generator, drinks: bool) -> Image:
    """Draw the lit window of a vending machine: rows of packets or of bottles, with prices."""
    image = plain(380, 250, (226, 232, 238))
    for row in range(5):
        floor = 74 * row + 62
        for x in range(8, 230, 48 if not drinks else 34):
            colour = pick(rng, ink.VIVID)
            if drinks:
                cv2.rectangle(image, (x + 9, floor - 58), (x + 17, floor - 38), (250, 250, 250), -1)
                cv2.rectangle(image, (x, floor - 44), (x + 26, floor), colour, -1)
                cv2.rectangle(image, (x, floor - 30), (x + 26, floor - 14), (244, 240, 230), -1)
                ink.write(image, ink.word(rng), (x, floor - 30, x + 26, floor - 14), colour)
            else:
                image[floor - 54 : floor, x : x + 40] = packet(rng, 54, 40)
        cv2.rectangle(image, (0, floor), (250, floor + 11), (60, 62, 68), -1)
        for x in range(14, 240, 48):
            cv2.rectangle(image, (x, floor + 2), (x + 20, floor + 9), (250, 240, 170), -1)
    return image


def vending_machine(stand: Stand, look: Look) -> None:
    """Build a vending machine: a lit window with goods, keys, a flap."""
    rng, drinks, half = (
        stand.rng,
        bool(stand.rng.random() < 0.5),
        float(stand.rng.uniform(0.4, 0.5)),
    )
    brand = pick(rng, ((190, 30, 36), (30, 70, 150), (40, 42, 48), (40, 120, 80)))
    keys = plain(300, 90, (44, 46, 52))
    cv2.rectangle(keys, (10, 12), (80, 44), (20, 60, 40), -1)
    ink.write(keys, "1.50", (14, 14, 76, 42), (130, 255, 150))
    for i in range(12):
        x, y = 12 + 24 * (i % 3), 60 + 26 * (i // 3)
        cv2.rectangle(keys, (x, y), (x + 18, y + 19), (206, 208, 212), -1)
        ink.write(keys, "123456789*0#"[i], (x + 2, y + 2, x + 16, y + 17), (20, 20, 24))
    cv2.rectangle(keys, (20, 190), (70, 200), (10, 10, 12), -1)
    cv2.rectangle(keys, (16, 220), (74, 282), (190, 192, 196), 3)
    title = plain(60, 300, brand)
    ink.write(title, "COLD DRINKS" if drinks else "SNACKS", (20, 6, 280, 54), WHITE, thickness=2)
    body, split = paint(brand), half - 0.26
    with stand.surfaces.thing("vending_machine"):
        stand.box((-half, half), (0.0, 0.78), (0.06, 1.83), body)
        stand.box((-half + 0.04, half - 0.04), (0.05, 0.74), (0.0, 0.06), paint(DARK))
        goods = Material(_goods(rng, drinks), glow=(0.4, 0.3, 1.1, 0.9))
        stand.box((-half + 0.04, split), (0.78, 0.8), (0.5, 1.6), paint(DARK), front=goods)
        stand.box((split + 0.03, half - 0.03), (0.78, 0.795), (0.7, 1.55), body,
                  front=Material(keys))  # fmt: skip
        stand.box((-half + 0.03, half - 0.03), (0.78, 0.79), (1.64, 1.79), body,
                  front=Material(title, glow=SIGN_GLOW))  # fmt: skip
        stand.box((-half + 0.06, split - 0.02), (0.78, 0.81), (0.2, 0.42), paint(DARK))
        stand.box((-half + 0.1, split - 0.06), (0.81, 0.82), (0.24, 0.36), paint((88, 90, 96)))
