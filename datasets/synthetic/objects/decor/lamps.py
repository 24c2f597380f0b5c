"""Lamps for the evening that stand on the floor or hang on a wall."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.lighting import EVENING
from roomgraph.datasets.synthetic.rendering.mesh import Glow, Lamp, Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import plain

__all__ = ["floor_lamp", "wall_lamp"]


def floor_lamp(stand: Stand, look: Look) -> None:
    """Build a lamp on a pole, on three legs or on an arc; it burns in the evening."""
    rng, metal, kind = stand.rng, look.metallic(), int(stand.rng.integers(3))
    image = patterns.cloth(rng, 32, 32, patterns.pick(rng, ((250, 230, 186), (242, 236, 220))))
    shade, top = Material(image, glow=(0.35, 0.2, 1.5, 0.6)), float(rng.uniform(1.45, 1.65))
    wide, x = float(rng.uniform(0.17, 0.23)), 0.3 if kind == 2 else 0.0
    with stand.surfaces.thing("floor_lamp"):
        if kind == 1:
            for angle in np.arange(3) * 2 * np.pi / 3 + np.pi / 2:
                foot = (0.26 * float(np.cos(angle)), 0.26 * float(np.sin(angle)), 0.0)
                tube(stand, (0, 0, top - 0.25), foot, (0.014, 0.018), look.wooden(rng))
        else:
            base = [(0.14, 0.0), (0.14, 0.02), (0.02, 0.035)]
            lathe(stand, (-x, 0), base, metal)
            tube(stand, (-x, 0, 0.03), (-x, 0, top - 0.2), 0.012, metal)
        if kind == 2:
            arc = [
                (-x, top - 0.2),
                (-0.2, top + 0.05),
                (0.0, top + 0.16),
                (0.2, top + 0.14),
                (x, top),
            ]
            for (x0, z0), (x1, z1) in pairwise(arc):
                tube(stand, (x0, 0, z0), (x1, 0, z1), 0.012, metal)
        tube(stand, (x, 0, top - 0.3), (x, 0, top + 0.02), 0.012, metal)
        lathe(stand, (x, 0), [(wide, top - 0.3), (0.7 * wide, top), (0.6 * wide, top)], shade)
    for up, power in ((0.15, 1.4), (-0.36, 0.9)):
        place = [float(v) for v in stand.world([(x, 0, top + up)])[0]]
        lamp = Lamp((place[0], place[1], place[2]), (0, 0, 1 if up > 0 else -1), power, EVENING)
        stand.surfaces.lamps.append(lamp)


SHADE_GLOW: Glow = (0.3, 0.1, 1.4, 0.5)


def wall_lamp(stand: Stand, look: Look) -> None:
    """Hang a lamp with a shade that burns in the evening."""
    rng, z = stand.rng, 1.72
    shade = Material(plain(8, 8, (250, 228, 178)), glow=SHADE_GLOW)
    r0, r1 = ((0.11, 0.07), (0.07, 0.12), (0.09, 0.09))[int(rng.integers(3))]
    with stand.surfaces.thing("lamp"):
        stand.box((-0.045, 0.045), (0.0, 0.02), (z - 0.1, z + 0.06), look.metallic())
        tube(stand, (0.0, 0.02, z - 0.04), (0.0, 0.13, z - 0.04), 0.012, look.metallic())
        stand.prism((0.0, 0.13), (z - 0.06, z + 0.02), 0.018, look.metallic())
        lathe(stand, (0.0, 0.13), [(r0, z), (r1, z + 0.19)], shade)
    for up, power in ((1, 0.9), (-1, 0.6)):
        x, y, h = stand.world([(0.0, 0.16, z + 0.1 + 0.14 * up)])[0]
        place = (float(x), float(y), float(h))
        stand.surfaces.lamps.append(Lamp(place, (0.0, 0.0, float(up)), power, EVENING))
