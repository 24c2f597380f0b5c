"""Bicycles."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.stock import DARK
from roomgraph.datasets.synthetic.rendering.mesh import Quad
from roomgraph.datasets.synthetic.rendering.shapes import block, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink
from roomgraph.datasets.synthetic.textures.patterns import pick

__all__ = ["bicycle"]


def _wheel(stand: Stand, x: float, y: float, radius: float) -> None:
    """Add a bicycle's wheel in the plane of `y`: tyre, rim and spokes."""
    black, rim, hub = paint(DARK), paint((206, 208, 212)), (x, y, radius)
    at = [2 * np.pi * i / 12 for i in range(13)]
    rings = [[(x + r * float(np.cos(a)), radius + r * float(np.sin(a))) for a in at]
             for r in (radius, radius - 0.035, radius - 0.055)]  # fmt: skip
    for (a, b, t), (c, d, u) in pairwise(zip(*rings, strict=True)):
        tread = [(a[0], y - 0.02, a[1]), (c[0], y - 0.02, c[1]), (c[0], y + 0.02, c[1]),
                 (a[0], y + 0.02, a[1])]  # fmt: skip
        stand.surfaces.quads.append(Quad(stand.world(tread), black))
        for side in (-0.02, 0.02):
            for p, q, r, s, paint_ in ((a, c, d, b, black), (b, d, u, t, rim)):
                ring = [(v[0], y + side, v[1]) for v in (p, q, r, s)]
                # Outside is towards the viewer on one side of the wheel, away on the other.
                corners = stand.world(ring[::-1] if side > 0 else ring)
                stand.surfaces.quads.append(Quad(corners, paint_))
    for i in range(0, 12, 2):
        # A spoke is a thin blade: it is seen from both sides.
        (u, w), (v, t) = rings[2][i], rings[2][i + 1]
        blade = [hub, hub, (0.96 * u + 0.04 * v, y, 0.96 * w + 0.04 * t), (u, y, w)]
        stand.surfaces.quads.append(Quad(stand.world(blade), rim))
    tube(stand, (x, y - 0.05, radius), (x, y + 0.05, radius), 0.02, rim)


def bicycle(stand: Stand, look: Look) -> None:
    """Build a bicycle along the wall: wheels, frame, fork, handlebar, saddle, cranks."""
    rng, radius, y = stand.rng, float(stand.rng.uniform(0.31, 0.345)), 0.3
    frame, black, bright = paint(pick(rng, ink.VIVID)), paint(DARK), paint((200, 202, 206))
    rear, front, crank = (-0.52, y, radius), (0.53, y, radius), (-0.1, y, 0.29)
    seat, saddle, head, neck = (-0.25, y, 0.8), (-0.29, y, 0.93), (0.3, y, 0.82), (0.34, y, 0.68)
    low = bool(rng.random() < 0.4)
    with stand.surfaces.thing("bicycle"):
        _wheel(stand, rear[0], y, radius)
        _wheel(stand, front[0], y, radius)
        top = (-0.19, y, 0.55) if low else (-0.235, y, 0.76)
        for a, b in ((head, top), (neck, crank), (seat, crank), (head, neck)):
            tube(stand, a, b, 0.021, frame, sides=4)
        for a, b in ((rear, crank), (rear, (-0.235, y, 0.74)), (neck, front)):
            for side in (-0.045, 0.045):
                ends = [(p[0], y + (side if p in (rear, front) else side / 3), p[2])
                        for p in (a, b)]  # fmt: skip
                tube(stand, ends[0], ends[1], 0.011, frame, sides=4)
        tube(stand, seat, saddle, 0.014, bright, sides=5)
        x, z = saddle[0], saddle[2]
        block(stand, [(x - 0.12, y + 0.09, z + 0.05), (x + 0.16, y + 0.02, z + 0.04),
                      (x + 0.16, y - 0.02, z + 0.04), (x - 0.12, y - 0.09, z + 0.05)],
              [(x - 0.1, y + 0.07, z - 0.01), (x + 0.15, y + 0.02, z + 0.01),
               (x + 0.15, y - 0.02, z + 0.01), (x - 0.1, y - 0.07, z - 0.01)], black)  # fmt: skip
        stem = (0.27, y, 0.97)
        tube(stand, head, stem, 0.016, bright, sides=5)
        for side in (-1, 1):
            grip = (0.24, y + 0.27 * side, 1.0)
            tube(stand, stem, (0.31, y + 0.17 * side, 1.0), 0.013, bright, sides=5)
            tube(stand, (0.31, y + 0.17 * side, 1.0), grip, 0.017, black, sides=5)
            foot = (crank[0] + 0.12 * side, y + 0.07 * side, crank[2] - 0.12 * side)
            tube(stand, (crank[0], y + 0.07 * side, crank[2]), foot, 0.011, bright, sides=4)
            stand.box((foot[0] - 0.05, foot[0] + 0.05), (foot[1] - 0.02, foot[1] + 0.06),
                      (foot[2] - 0.012, foot[2] + 0.012), black)  # fmt: skip
        tube(stand, (crank[0], y + 0.045, crank[2]), (crank[0], y + 0.055, crank[2]), 0.09, bright,
             sides=10)  # fmt: skip
        stand.footprint((-0.87, 0.88), (0.0, 0.58))
