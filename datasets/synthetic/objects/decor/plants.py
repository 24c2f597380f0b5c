"""Plants, large on the floor and small on a shelf."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.decor.colours import GREENS
from roomgraph.datasets.synthetic.objects.decor.leaves import draw_leaf, kite, put_pot, turned
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import pick, plain

__all__ = ["plant", "small_plant"]


def _palm(stand: Stand, z: float, size: float) -> None:
    """Grow a palm: slim stems, arching fronds of narrow leaflets."""
    rng, leaf = stand.rng, draw_leaf(stand.rng, pick(stand.rng, GREENS))
    head, stem = z + 0.3 * size, paint((116, 104, 60))
    tube(stand, (0.0, 0.0, z - 0.02), (0.0, 0.0, head), (0.03, 0.02), paint((120, 92, 62)))
    for i in range(10):
        angle, lift = 2.4 * i + float(rng.uniform(-0.2, 0.2)), float(rng.uniform(0.25, 0.7))
        reach = size * (0.55 - 0.3 * lift)
        path = [turned(angle, reach * s, head + size * (1.1 * lift * s - 0.38 * s**2 + 0.12 * s))
                for s in (0.0, 0.3, 0.55, 0.8, 1.0)]  # fmt: skip
        tube(stand, path[0], path[2], (0.008, 0.005), stem, sides=3)
        for (x, y, up), last in zip(path[1:], (0.3, 0.29, 0.25, 0.18), strict=True):
            for side in (-1, 1):
                out = turned(angle + 0.75 * side, last * size, -0.05 * size)
                tip = (x + out[0], y + out[1], up + out[2])
                kite(stand, (x, y, up), tip, 0.085 * size, leaf)
        kite(stand, path[3], turned(angle, reach * 1.3, path[4][2] - 0.05), 0.06 * size, leaf)


def _rubber(stand: Stand, z: float, size: float) -> None:
    """Grow a rubber plant: stems with large oval leaves, dark and glossy."""
    rng = stand.rng
    leaves = [
        draw_leaf(rng, pick(rng, ((38, 84, 46), (52, 100, 50), (30, 70, 44)))) for _ in range(2)
    ]
    for k in range(int(rng.integers(2, 4))):
        lean = turned(2.1 * k + 0.5, 0.12 * size, z + size * float(rng.uniform(0.75, 1.0)))
        tube(stand, (0.0, 0.0, z - 0.03), lean, (0.014, 0.008), paint((104, 84, 58)), sides=5)
        for i in range(12):
            s = 0.22 + 0.78 * i / 11
            root = (lean[0] * s, lean[1] * s, z + s * (lean[2] - z))
            out = turned(2.4 * i + k, 0.34 * size * (1.1 - 0.45 * s), size * (0.06 + 0.14 * s))
            tip = (root[0] + out[0], root[1] + out[1], root[2] + out[2])
            kite(stand, root, tip, 0.19 * size, leaves[i % 2])


def _cactus(stand: Stand, z: float, size: float) -> None:
    """Grow a cactus: a ribbed column with spines and one to three arms."""
    rng, colour = stand.rng, pick(stand.rng, ((70, 122, 74), (92, 140, 84)))
    image = plain(160, 160, colour)
    image[:, 8::16] = (colour[0] // 2, colour[1] // 2, colour[2] // 2)
    for y in range(4, 160, 9):
        for x in range(0, 160, 16):
            cv2.circle(image, (x, y), 1, (236, 230, 196), -1)
    skin, r = Material(image), 0.11 * size
    column = [(0.85 * r, z - 0.03), (r, z + 0.5 * size), (0.85 * r, z + 0.88 * size),
              (0.4 * r, z + 0.97 * size)]  # fmt: skip
    lathe(stand, (0.0, 0.0), column, skin, sides=10)
    for i in range(int(rng.integers(2, 4))):
        angle, up = 2.6 * i + float(rng.uniform(0, 0.8)), z + size * float(rng.uniform(0.3, 0.5))
        elbow = turned(angle, 0.24 * size, up + 0.04 * size)
        bend = elbow[2]
        tube(stand, turned(angle, 0.05 * size, up), elbow, 0.55 * r, skin, sides=8)
        arm = [(0.6 * r, bend - 0.03 * size), (0.6 * r, bend + 0.25 * size),
               (0.25 * r, bend + 0.31 * size)]  # fmt: skip
        lathe(stand, elbow[:2], arm, skin, sides=8)


def _snake(stand: Stand, z: float, size: float) -> None:
    """Grow a snake plant: upright swords with cross bands and yellow edges."""
    rng = stand.rng
    image = patterns.tint((62, 108, 66), 0.9 * patterns.noise(rng, 160, 32, (7, 20)))
    image[:, :5] = image[:, 27:] = (214, 206, 110)
    sword = Material(image)
    for i in range(16):
        angle, tall = 2.4 * i, size * float(rng.uniform(0.55, 1.0))
        root, top = (
            turned(angle, 0.011 * i * size, z - 0.03),
            turned(angle, 0.02 * i * size, z + tall),
        )
        a, c = np.array(root), np.array(top)
        b = 0.5 * a + 0.5 * c
        face = angle + float(rng.uniform(0.8, 2.2))
        aside = np.array(turned(face, 0.045 * size, 0.0))
        for low, high, w0, w1, window in (
            (a, b, 0.75, 1.0, (0.0, 0.5, 1.0, 1.0)), (b, c, 1.0, 0.12, (0.0, 0.0, 1.0, 0.5)),
        ):  # fmt: skip
            corners = [high - w1 * aside, high + w1 * aside, low + w0 * aside, low - w0 * aside]
            stand.surfaces.quads.append(Quad(stand.world(np.array(corners)), sword, window))


def plant(stand: Stand, look: Look) -> None:
    """Build a house plant in a pot: a palm, a rubber plant, a cactus or a snake plant."""
    rng = stand.rng
    radius, tall = float(rng.uniform(0.15, 0.2)), float(rng.uniform(0.26, 0.36))
    grow, size = ((_palm, 1.1), (_rubber, 1.1), (_cactus, 0.9), (_snake, 0.85))[
        int(rng.integers(4))
    ]
    with stand.surfaces.thing("plant"):
        put_pot(stand, look, radius, tall)
        grow(stand, tall, size * float(rng.uniform(0.8, 1.15)))


def small_plant(stand: Stand, look: Look) -> None:
    """Build a small plant in a pot, for tables and sills."""
    rng, radius, tall = stand.rng, float(stand.rng.uniform(0.05, 0.075)), 0.1
    with stand.surfaces.thing("plant"):
        put_pot(stand, look, radius, tall)
        kind = int(rng.integers(3))
        if kind < 2:
            (_cactus, _snake)[kind](stand, tall, float(rng.uniform(0.2, 0.3)))
            return
        leaves = [draw_leaf(rng, pick(rng, GREENS)) for _ in range(2)]
        bloom = paint(pick(rng, ((240, 90, 130), (250, 210, 60), (250, 246, 240), (220, 50, 50))))
        for i in range(26):
            reach = float(rng.uniform(0.05, 0.14))
            tip = turned(2.4 * i, reach, tall + float(rng.uniform(0.0, 0.16)))
            kite(stand, (0.3 * tip[0], 0.3 * tip[1], tall), tip, 0.055, leaves[i % 2])
        for i in range(6):
            x, y, z = turned(1.05 * i, 0.045, tall + 0.1)
            kite(stand, (x - 0.025, y - 0.01, z), (x + 0.025, y + 0.01, z + 0.015), 0.05, bloom)
