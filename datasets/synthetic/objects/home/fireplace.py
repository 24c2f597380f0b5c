"""Fireplaces, burning or not."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.home.bookcases import stand_photo
from roomgraph.datasets.synthetic.objects.home.laid import put_vase
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import finishes, patterns

__all__ = ["fireplace"]

FLAMES = ((1.0, (210, 70, 20)), (0.7, (250, 150, 40)), (0.4, (255, 230, 130)))


def _fire(stand: Stand, half: float, burning: bool) -> None:
    """Lay logs into a fireplace, and perhaps flames over them."""
    rng, bark = stand.rng, Material(patterns.wood(stand.rng, 32, 64, (92, 64, 44), 2.0))
    for y, z, turn in ((0.14, 0.12, 0.03), (0.24, 0.12, -0.03), (0.19, 0.2, 0.06)):
        tube(stand, (-0.6 * half, y - turn, z), (0.6 * half, y + turn, z), 0.045, bark, sides=7)
    if burning:
        image = patterns.plain(90, 120, (24, 18, 16))
        for x, tall, wide in rng.integers((16, 24, 8), (104, 84, 16), (16, 3)):
            for share, colour in FLAMES:
                tip, side = int(x + rng.integers(-5, 6)), int(share * wide)
                flame = np.array([(x - side, 90), (tip, 90 - share * tall), (x + side, 90)])
                cv2.fillPoly(image, [flame.astype(np.int32)], colour, cv2.LINE_AA)
        soft = np.asarray(cv2.GaussianBlur(image, (0, 0), 1.2), dtype=np.uint8)
        flames = Material(soft, glow=(0.8, 0.3, 1.4, 0.9))
        stand.picture((-0.75 * half, 0.75 * half), (0.06, 0.5), 0.075, flames)


def fireplace(stand: Stand, look: Look) -> None:
    """Build a fireplace: surround of brick, marble or wood, mantel, hearth, logs or a fire."""
    rng, kind = stand.rng, int(stand.rng.integers(3))
    half, high, deep = 0.36, float(rng.uniform(1.02, 1.18)), 0.32
    side, lintel = float(rng.uniform(0.22, 0.32)), 0.68
    brick = finishes.bricks(rng, 208, 312, ((150, 74, 54), (132, 62, 48), (168, 92, 66)), 0.0)
    veins = 0.5 * np.abs(patterns.noise(rng, 128, 256, (40, 70))) ** 0.5 - 0.2
    marble = patterns.tint(
        patterns.pick(rng, ((226, 222, 214), (104, 106, 104))), veins.astype(np.float32)
    )
    bricks = Material(brick, 1.3, 0.9)
    wall = (bricks, Material(marble, 1.5, 0.8), look.wooden(rng))[kind]
    soot = Material(
        patterns.tint((52, 44, 40), 0.4 * patterns.noise(rng, 64, 64, (9, 9))), 1.0, 1.0
    )
    out = half + side
    with stand.surfaces.thing("fireplace"):
        stand.box((-half, half), (0.012, 0.05), (0.0, lintel), soot)
        for x in (-out, half):
            stand.box((x, x + side), (0.012, deep), (0.0, high), wall)
            if kind:
                stand.box((x + 0.04, x + side - 0.04), (deep, deep + 0.02), (0.1, high - 0.3), wall)
                stand.box((x - 0.01, x + side + 0.01), (deep, deep + 0.03), (0.0, 0.1), wall)
        stand.box((-half, half), (0.012, deep), (lintel, high), wall)
        if kind == 2:
            stand.box((-half, half), (deep - 0.02, deep + 0.005), (lintel - 0.06, lintel), bricks)
        for grow, low in ((0.04, high - 0.05), (0.08, high)):
            ledge = (-out - grow, out + grow), (0.012, deep + grow + 0.03), (low, low + 0.05)
            stand.box(*ledge, wall if kind else look.wooden(rng))
        stand.box((-out, out), (0.02, deep + 0.35), (0.0, 0.05), bricks if kind == 2 else wall)
        _fire(stand, half, bool(rng.random() < 0.6))
        for x in (0.16 - out, out - 0.16):
            candle = [(0.05, 0.0), (0.015, 0.02), (0.015, 0.1), (0.025, 0.11), (0.018, 0.24)]
            stick = stand.at(x, 0.18, high + 0.05)
            lathe(stick, (0, 0), [*candle, (0.003, 0.25)], paint((232, 224, 200)), sides=8)
        if rng.random() < 0.6:
            stand_photo(stand.at(0.15, 0.12, high + 0.05), 0.12)
        else:
            put_vase(stand.at(-0.1, 0.18, high + 0.05))
