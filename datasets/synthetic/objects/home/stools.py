"""Stools and benches."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.frames import pipe
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.shapes import cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand

__all__ = ["bench", "stool"]


def stool(stand: Stand, look: Look) -> None:
    """Build a stool: round seat, wooden or padded, on four legs with a foot ring or on a column."""
    rng, kind = stand.rng, int(stand.rng.integers(3))
    height = float(rng.uniform(0.44, 0.50) if kind == 0 else rng.uniform(0.58, 0.76))
    wood, metal, radius = look.wooden(rng), look.metallic(), float(rng.uniform(0.16, 0.19))
    seat = look.woven(rng, second=True) if rng.random() < 0.5 else wood
    with stand.surfaces.thing("stool"):
        rim = [
            (radius, height - 0.045),
            (radius, height - 0.012),
            (0.9 * radius, height),
            (0.004, height),
        ]
        lathe(stand, (0, 0), rim, seat)
        if kind == 2:
            tube(stand, (0, 0, 0.04), (0, 0, height - 0.04), 0.025, metal, sides=8)
            lathe(stand, (0, 0), [(0.21, 0.0), (0.20, 0.02), (0.03, 0.05)], metal)
        ring, level = (0.14, 0.30) if kind == 2 else (radius * 0.93, 0.36 * height)
        angles = np.arange(9) * np.pi / 4 + np.pi / 4
        around = [(ring * float(np.cos(a)), ring * float(np.sin(a)), level) for a in angles]
        pipe(stand, around, 0.009, metal if kind else wood)
        for x, y, z in around[:8:2]:
            if kind == 2:
                pipe(stand, [(0, 0, z), (x, y, z)], 0.008, metal)
                continue
            foot = (1.16 * x, 1.16 * y, 0.0)
            begin = (0.72 * x, 0.72 * y, height - 0.04)
            tube(stand, begin, foot, 0.017, metal if kind and seat is not wood else wood)


def bench(stand: Stand, look: Look) -> None:
    """Build a bench: wooden slats on two frames, with or without a back, or a padded one."""
    rng, wood = stand.rng, look.wooden(stand.rng)
    half, padded = float(rng.uniform(0.55, 0.9)), bool(rng.random() < 0.35)
    back, metal = bool(rng.random() < 0.6), look.metallic()
    depth = 0.46 if back else 0.40
    with stand.surfaces.thing("bench"):
        for x in (-half + 0.12, half - 0.12):
            for y in (0.06, depth - 0.03):
                stand.box((x - 0.02, x + 0.02), (y - 0.02, y + 0.02), (0.0, 0.41), metal)
            stand.box((x - 0.02, x + 0.02), (0.04, depth - 0.01), (0.38, 0.42), metal)
            if back:
                pipe(stand, [(x, 0.08, 0.41), (x, 0.03, 0.84)], 0.016, metal)
        if padded:
            cushion(stand, (-half, half), (0.03, depth), (0.42, 0.50), look.woven(rng), bevel=0.03)
        else:
            for y in np.arange(4) * (depth - 0.04) / 4 + 0.045:
                slat = float(y), float(y) + (depth - 0.04) / 4 - 0.016
                stand.box((-half, half), slat, (0.42, 0.448), wood)
        for low in (0.55, 0.66, 0.77) if back else ():
            lean = 0.07 - 0.12 * (low - 0.45)
            stand.box((-half, half), (lean, lean + 0.022), (low, low + 0.085), wood)
