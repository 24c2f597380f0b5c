"""Suitcases."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.stock import DARK, STEEL, join
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import cushion, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick

__all__ = ["suitcase"]


def suitcase(stand: Stand, look: Look) -> None:
    """Build one or two suitcases with ribs, wheels and a pulled-out handle."""
    rng, count = stand.rng, int(stand.rng.integers(1, 3))
    for i in range(count):
        turn = float(rng.uniform(-0.3, 0.3))
        place = stand.at(0.55 * i - 0.275 * (count - 1), 0.0, 0.0, turn)
        colour, half = pick(rng, (*ink.VIVID[:10], (120, 124, 130))), float(rng.uniform(0.19, 0.25))
        top, deep = float(rng.uniform(0.52, 0.74)), float(rng.uniform(0.11, 0.14))
        shell, black = paint(colour), paint(DARK)
        with stand.surfaces.thing("suitcase"):
            cushion(place, (-half, half), (-deep, deep), (0.06, top), shell, bevel=0.04)
            front = Material(_ribs(colour))
            place.picture((-half + 0.02, half - 0.02), (0.1, top - 0.05), deep + 0.004, front)
            for x in (-half + 0.05, half - 0.05):
                for y in (-deep + 0.04, deep - 0.04):
                    tube(place, (x - 0.015, y, 0.03), (x + 0.015, y, 0.03), 0.03, black)
            up = top + (0.38 if rng.random() < 0.7 else 0.03)
            join(place, [(-0.09, -0.08, top - 0.02), (-0.09, -0.08, up), (0.09, -0.08, up),
                          (0.09, -0.08, top - 0.02)], 0.01, paint(STEEL))  # fmt: skip
            place.box((-0.09, 0.09), (-0.1, -0.06), (up - 0.015, up + 0.02), black)


def _ribs(colour: Colour) -> Image:
    """Draw a suitcase's ribbed shell with its zip."""
    across = 0.22 * np.sin(np.arange(120, dtype=np.float32) * (6.28 / 15))
    image = patterns.tint(colour, np.repeat(across[None], 160, axis=0))
    cv2.rectangle(image, (1, 1), (118, 158), (30, 30, 34), 2)
    cv2.rectangle(image, (44, 14), (76, 26), (210, 212, 216), -1)
    return image
