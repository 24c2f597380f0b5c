"""Clocks."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.decor.colours import DARK
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import kitchen
from roomgraph.datasets.synthetic.textures.patterns import pick

__all__ = ["clock"]


def clock(stand: Stand, look: Look) -> None:
    """Hang a round clock: a dial in strips, behind a rim that hides their steps."""
    radius, z = float(stand.rng.uniform(0.13, 0.19)), 2.0
    face = kitchen.clock(160)
    for hour in range(12):
        c, s = float(np.cos(hour * np.pi / 6)), float(np.sin(hour * np.pi / 6))
        start = 62 if hour % 3 else 56
        ends = [(int(80 + r * c), int(80 + r * s)) for r in (start, 70)]
        cv2.line(face, ends[0], ends[1], DARK, 3, cv2.LINE_AA)
    dial, rim = Material(face), paint(pick(stand.rng, (DARK, look.metal, look.wood)))
    angles = np.linspace(-np.pi / 2, np.pi / 2, 9)
    inner, reach = radius / 1.17, radius / 1.17
    with stand.surfaces.thing("clock"):
        for a, b in pairwise(angles):
            wide = reach * float(max(np.cos(a), np.cos(b)))
            low, high = reach * float(np.sin(a)), reach * float(np.sin(b))
            x, y = 0.5 * wide / inner, (0.5 - 0.5 * high / inner, 0.5 - 0.5 * low / inner)
            flat = [(-wide, 0.022, z + high), (wide, 0.022, z + high), (wide, 0.022, z + low),
                    (-wide, 0.022, z + low)]  # fmt: skip
            window = (0.5 - x, y[0], 0.5 + x, y[1])
            stand.surfaces.quads.append(Quad(stand.world(flat), dial, window))
        around = [(float(np.cos(t)), float(np.sin(t))) for t in np.linspace(0, 2 * np.pi, 17)]
        for (c, s), (d, t) in pairwise(around):
            ring = [[(k * radius * p, y, z + k * radius * q) for p, q in ((c, s), (d, t))]
                    for k, y in ((0.84, 0.025), (1.0, 0.028), (1.0, 0.0))]  # fmt: skip
            for (a1, b1), (a2, b2) in pairwise(ring):
                stand.surfaces.quads.append(Quad(stand.world([a1, a2, b2, b1]), rim))
