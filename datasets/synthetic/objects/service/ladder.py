"""Ladders."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.stock import DARK
from roomgraph.datasets.synthetic.rendering.shapes import block, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures.patterns import pick

__all__ = ["ladder"]


def ladder(stand: Stand, look: Look) -> None:
    """Build a ladder that leans on the wall, or open steps in front of it."""
    rng, half = stand.rng, float(stand.rng.uniform(0.2, 0.25))
    metal = paint(pick(rng, ((196, 200, 204), (214, 150, 40), (170, 124, 76))))
    steps = bool(rng.random() < 0.6)
    tall = float(rng.uniform(1.3, 1.8)) if steps else float(rng.uniform(2.0, 2.4))
    foot, head = (0.85, 0.38) if steps else (0.6, 0.04)
    with stand.surfaces.thing("ladder"):
        rails = [(half, foot, head, 0.028)]
        if steps:
            rails.append((half - 0.02, 0.03, 0.32, 0.016))
            stand.box((-half, half), (0.3, 0.5), (tall, tall + 0.03), paint(DARK))
            tube(stand, (-half, 0.07, 0.25), (half, 0.07, 0.25), 0.014, metal)
        for wide, low, high, r in rails:
            for x in (-wide, wide):
                block(stand, [(x - r, high + r, tall), (x + r, high + r, tall),
                              (x + r, high - r, tall), (x - r, high - r, tall)],
                      [(x - r, low + r, 0.0), (x + r, low + r, 0.0), (x + r, low - r, 0.0),
                       (x - r, low - r, 0.0)], metal)  # fmt: skip
        for z in np.arange(0.26, tall - 0.08, 0.26):
            y, up = foot + (head - foot) * float(z) / tall, float(z)
            if steps:
                stand.box((-half, half), (y - 0.06, y + 0.05), (up - 0.025, up), metal)
            else:
                tube(stand, (-half, y, up), (half, y, up), 0.016, metal)
        stand.footprint((-half, half), (0.0, foot))
