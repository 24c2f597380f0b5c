"""Brooms, mops, carts and vacuum cleaners."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.stock import DARK, STEEL, YELLOW, Span, join
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import Point, block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, laboratory, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

__all__ = ["broom", "cleaning_cart", "mop_bucket", "vacuum_cleaner"]


def _bristles(stand: Stand, x: Span, y: Span, z: Span, colour: Colour) -> None:
    """Add a brush: bristles that spread towards the floor."""
    image = patterns.tint(colour, 0.8 * patterns.noise(stand.rng, 40, 90, (40, 1.5)))
    spread = 0.02
    block(stand, [(x[0], y[1], z[1]), (x[1], y[1], z[1]), (x[1], y[0], z[1]), (x[0], y[0], z[1])],
          [(x[0] - spread, y[1] + spread, z[0]), (x[1] + spread, y[1] + spread, z[0]),
           (x[1] + spread, y[0], z[0]), (x[0] - spread, y[0], z[0])],
          Material(image, x[1] - x[0] + spread, z[1] - z[0]))  # fmt: skip


def broom(stand: Stand, look: Look) -> None:
    """Lean a broom on the wall, its dustpan beside it."""
    stand = stand.at(-0.16)
    rng, half = stand.rng, float(stand.rng.uniform(0.13, 0.22))
    colour, wood = pick(rng, ink.VIVID), paint(pick(rng, ((196, 152, 100), (60, 110, 160))))
    with stand.surfaces.thing("broom"):
        _bristles(stand, (-half, half), (0.2, 0.26), (0.0, 0.1), pick(rng, ((40, 40, 44), colour)))
        stand.box((-half, half), (0.19, 0.27), (0.1, 0.135), paint(colour))
        tube(stand, (0.0, 0.23, 0.12), (0.0, 0.02, 1.4), 0.014, wood, sides=8)
    with stand.surfaces.thing("dustpan"):
        x, pan = half + 0.09, paint(patterns.shift(rng, colour, 30))
        block(stand, [(x, 0.1, 0.27), (x + 0.24, 0.1, 0.27), (x + 0.24, 0.02, 0.27),
                      (x, 0.02, 0.27)],
              [(x - 0.01, 0.16, 0.0), (x + 0.25, 0.16, 0.0), (x + 0.25, 0.13, 0.0),
               (x - 0.01, 0.13, 0.0)], pan)  # fmt: skip
        tube(stand, (x + 0.12, 0.06, 0.26), (x + 0.12, 0.02, 0.42), 0.016, pan)
        stand.footprint((x, x + 0.24), (0.0, 0.16))


def _mop(stand: Stand, x: float, y: float, z: float) -> None:
    """Add a mop, its strands hanging from `z`, its handle leaning."""
    cotton = pick(stand.rng, ((226, 222, 210), (150, 190, 220)))
    image = patterns.tint(cotton, 0.9 * patterns.noise(stand.rng, 48, 120, (48, 2.0)))
    lathe(stand, (x, y), [(0.12, z - 0.16), (0.1, z - 0.06), (0.03, z)], Material(image), sides=9)
    tube(stand, (x, y, z - 0.01), (x, y, z + 0.06), (0.035, 0.02), paint((40, 90, 160)))
    tube(stand, (x, y, z + 0.05), (x + 0.12, y - 0.1, z + 0.95), 0.013, paint(STEEL))


def mop_bucket(stand: Stand, look: Look) -> None:
    """Build a bucket on castors with a wringer, and a mop in it."""
    rng = stand.rng
    colour = pick(rng, (YELLOW, YELLOW, (40, 90, 170), (190, 50, 40)))
    body, black = paint(colour), paint(DARK)
    with stand.surfaces.thing("bucket"):
        rim = [(-0.28, 0.2, 0.46), (0.28, 0.2, 0.46), (0.28, -0.2, 0.46), (-0.28, -0.2, 0.46)]
        foot = [(0.82 * x, 0.8 * y, 0.09) for x, y, _ in rim]
        block(stand, rim, foot, body)
        water = plain(40, 60, (96, 112, 116))
        cv2.rectangle(water, (0, 0), (59, 39), (60, 66, 68), 5)
        stand.sheet((-0.25, 0.25), (-0.17, 0.17), 0.463, Material(water))
        for x in (-0.19, 0.19):
            for y in (-0.12, 0.12):
                stand.prism((x, y), (0.0, 0.09), 0.035, black)
        warning = Material(laboratory.warning(rng, 90))
        stand.picture((-0.09, 0.09), (0.2, 0.38), 0.192, warning)
        cage = plain(60, 90, (60, 64, 70))
        cage[:, ::9] = STEEL
        stand.box((-0.27, 0.0), (-0.19, 0.19), (0.46, 0.66), Material(cage, 0.38, 0.2))
        join(stand, [(-0.27, 0.2, 0.6), (-0.37, 0.2, 0.95), (-0.37, 0.08, 0.97)], 0.014, black)
        stand.footprint((-0.3, 0.3), (-0.2, 0.2))
        with stand.surfaces.thing("mop"):
            _mop(stand, 0.13, 0.0, 0.56)


def cleaning_cart(stand: Stand, look: Look) -> None:
    """Build a cleaner's cart: sack, trays with bottles and rolls, buckets, a mop."""
    rng, frame = stand.rng, paint(pick(stand.rng, ((70, 74, 80), (40, 80, 150))))
    sack = Material(patterns.cloth(rng, 64, 64, pick(rng, (YELLOW, (40, 90, 160), (60, 60, 64)))))
    with stand.surfaces.thing("cleaning_cart"):
        for z in (0.12, 0.5, 0.88):
            stand.box((-0.5, 0.12), (-0.24, 0.24), (z, z + 0.04), frame)
        for x in (-0.48, 0.1):
            for y in (-0.22, 0.22):
                tube(stand, (x, y, 0.1), (x, y, 0.95), 0.016, paint(STEEL))
                stand.prism((x, y), (0.0, 0.1), 0.05, paint(DARK))
        stand.box((0.12, 0.56), (-0.2, 0.2), (0.1, 0.13), frame)
        stand.prism((0.52, 0.0), (0.0, 0.1), 0.05, paint(DARK))
        low = [(0.17, 0.16, 0.13), (0.5, 0.16, 0.13), (0.5, -0.16, 0.13), (0.17, -0.16, 0.13)]
        high = [(0.13, 0.22, 0.92), (0.56, 0.22, 0.92), (0.56, -0.22, 0.92), (0.13, -0.22, 0.92)]
        block(stand, high, low, sack)
        stand.box((0.12, 0.57), (-0.23, 0.23), (0.92, 0.95), frame)
        join(stand, [(-0.48, -0.22, 0.9), (-0.6, -0.22, 1.0), (-0.6, 0.22, 1.0),
                      (-0.48, 0.22, 0.9)], 0.016, paint(DARK))  # fmt: skip
        for i in range(4):
            with stand.surfaces.thing("bottle"):
                x, colour = -0.42 + 0.14 * i, paint(pick(rng, ink.VIVID))
                stand.prism((x, 0.1), (0.92, 1.08), 0.04, colour)
                stand.prism((x, 0.1), (1.08, 1.16), (0.025, 0.014), paint((240, 240, 240)))
        for i in range(3):
            lathe(stand, (-0.38 + 0.18 * i, 0.1), [(0.07, 0.54), (0.07, 0.72)],
                  paint((244, 244, 240)), sides=8)  # fmt: skip
        for x, colour_ in ((-0.34, (190, 40, 40)), (-0.05, (40, 90, 170))):
            lathe(stand, (x, 0.05), [(0.1, 0.16), (0.13, 0.38)], paint(colour_), sides=8)
        _mop(stand, -0.62, 0.0, 0.4)


def vacuum_cleaner(stand: Stand, look: Look) -> None:
    """Build a vacuum cleaner: a drum or a low body on wheels, hose, wand, floor nozzle."""
    # It is built off the middle, so that with its hose it stands centred.
    stand = stand.at(-0.18, -0.11)
    rng, black = stand.rng, paint(DARK)
    colour, drum = paint(pick(rng, ink.VIVID)), bool(rng.random() < 0.5)
    with stand.surfaces.thing("vacuum_cleaner"):
        if drum:
            lathe(stand, (0.0, 0.0), [(0.17, 0.05), (0.18, 0.24)], colour)
            lathe(stand, (0.0, 0.0), [(0.185, 0.24), (0.17, 0.33), (0.09, 0.37)], black)
            join(stand, [(-0.08, 0.0, 0.36), (-0.06, 0.0, 0.42), (0.06, 0.0, 0.42),
                          (0.08, 0.0, 0.36)], 0.014, black)  # fmt: skip
        else:
            cushion(stand, (-0.15, 0.15), (-0.22, 0.2), (0.05, 0.26), colour, bevel=0.07)
            cushion(stand, (-0.1, 0.1), (-0.14, 0.1), (0.24, 0.31), black, bevel=0.03)
        for x in (-0.17, 0.17):
            side = x + 0.04 * float(np.sign(x))
            tube(stand, (x, -0.1, 0.08), (side, -0.1, 0.08), 0.08, black, sides=10)
        mouth = 0.28 if drum else 0.2
        hose: list[Point] = [
            (0.0, 0.17, mouth), (0.1, 0.32, mouth + 0.12), (0.28, 0.38, 0.55), (0.42, 0.3, 0.85),
            (0.46, 0.18, 0.98), (0.45, 0.14, 0.9),
        ]  # fmt: skip
        for a, b in pairwise(hose):
            tube(stand, a, b, 0.022, paint((64, 66, 70)))
        tube(stand, hose[-1], (0.42, 0.36, 0.05), 0.016, paint(STEEL))
        block(stand, [(0.29, 0.43, 0.05), (0.55, 0.43, 0.05), (0.5, 0.33, 0.07),
                      (0.34, 0.33, 0.07)],
              [(0.28, 0.45, 0.0), (0.56, 0.45, 0.0), (0.54, 0.32, 0.0), (0.3, 0.32, 0.0)],
              black)  # fmt: skip
        stand.footprint((-0.2, 0.56), (-0.22, 0.45))
