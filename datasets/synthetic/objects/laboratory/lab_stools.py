"""Stools of laboratories."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, STEEL
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand

__all__ = ["lab_stool"]


def lab_stool(stand: Stand, look: Look) -> None:
    """Build a round stool on five feet, with a ring to rest one's feet on."""
    rng, seat = stand.rng, float(stand.rng.uniform(0.56, 0.72))
    cover = DARK if rng.random() < 0.5 else paint(look.accent)
    metal = STEEL if rng.random() < 0.6 else DARK
    with stand.surfaces.thing("stool"):
        angles = np.arange(6) * 2 * np.pi / 5
        for a in angles[:5]:
            x, y = 0.26 * float(np.cos(a)), 0.26 * float(np.sin(a))
            tube(stand, (0, 0, 0.11), (x, y, 0.04), (0.024, 0.016), metal, sides=4)
            tube(stand, (x, y, 0.05), (x, y, 0), 0.022, DARK, sides=4)
        stand.footprint((-0.27, 0.27), (-0.27, 0.27))
        tube(stand, (0, 0, 0.08), (0, 0, seat), 0.024, metal, sides=8)
        ring = np.arange(11) * np.pi / 5
        points = [(0.19 * float(np.cos(a)), 0.19 * float(np.sin(a)), 0.27) for a in ring]
        for a, b in pairwise(points):
            tube(stand, a, b, 0.01, metal, sides=4)
        for x, y, z in points[:10:5]:
            tube(stand, (0, 0, z), (x, y, z), 0.009, metal, sides=4)
        r = float(rng.uniform(0.16, 0.19))
        levels = [(0.8 * r, seat - 0.03), (r, seat), (r, seat + 0.04), (0.85 * r, seat + 0.065)]
        lathe(stand, (0, 0), levels, cover)
