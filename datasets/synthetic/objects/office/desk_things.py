"""What stands on desks: screens, keyboards, mugs, lamps, computers."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.objects.look import SCREEN_GLOW, Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import DARK, PALE
from roomgraph.datasets.synthetic.rendering.lighting import EVENING
from roomgraph.datasets.synthetic.rendering.mesh import Lamp, Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import office, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["computer_tower", "laptop"]


def put_monitor(stand: Stand) -> None:
    half = float(stand.rng.uniform(0.24, 0.31))
    case = DARK if stand.rng.random() < 0.8 else PALE
    picture = Material(office.screen(stand.rng, 150, 256), glow=SCREEN_GLOW)
    with stand.surfaces.thing("monitor"):
        stand.box((-0.12, 0.12), (-0.1, 0.09), (0, 0.015), case)
        stand.box((-0.03, 0.03), (-0.06, -0.03), (0.015, 0.3), case)
        z = (0.13, 0.13 + 1.17 * half)
        stand.box((-half, half), (-0.03, 0.01), z, case, front=picture)


def put_keyboard(stand: Stand) -> None:
    """Lay a keyboard and a mouse down."""
    with stand.surfaces.thing("keyboard"):
        keys = Material(office.keyboard(stand.rng, 90, 270))
        stand.box((-0.22, 0.22), (-0.07, 0.07), (0, 0.02), DARK, top=keys)
    with stand.surfaces.thing("mouse"):
        cushion(stand, (0.29, 0.355), (-0.05, 0.06), (0, 0.035), DARK, bevel=0.018)


def put_mug(stand: Stand) -> None:
    with stand.surfaces.thing("cup"):
        glaze = paint(patterns.pick(stand.rng, VIVID, 30))
        outside = [(0.036, 0.0), (0.042, 0.095), (0.036, 0.095)]
        lathe(stand, (0, 0), [*outside, (0.035, 0.075)], glaze, sides=8)
        stand.sheet((-0.024, 0.024), (-0.024, 0.024), 0.078, paint((54, 34, 22)))
        rim = [(0.038, 0.075), (0.068, 0.07), (0.066, 0.035), (0.036, 0.02)]
        for (x, z), (x1, z1) in pairwise(rim):
            tube(stand, (x, 0, z), (x1, 0, z1), 0.006, glaze, sides=4)


def put_lamp(stand: Stand, look: Look) -> None:
    """Build a lamp with a jointed arm; it burns in the evening."""
    colour = paint(look.accent)
    shade = Material(patterns.plain(8, 8, (250, 226, 170)), glow=(0.3, 0.1, 1.4, 0.5))
    with stand.surfaces.thing("lamp"):
        lathe(stand, (0, 0), [(0.08, 0), (0.075, 0.02)], colour)
        tube(stand, (0, 0, 0.02), (0, -0.05, 0.26), 0.009, colour)
        tube(stand, (0, -0.05, 0.26), (0, 0.14, 0.43), 0.009, colour)
        tube(stand, (0, 0.12, 0.45), (0, 0.2, 0.35), (0.03, 0.075), colour, sides=10)
        tube(stand, (0, 0.197, 0.354), (0, 0.202, 0.348), 0.066, shade, sides=8)
    x, y, z = (float(value) for value in stand.world([(0, 0.21, 0.33)])[0])
    stand.surfaces.lamps.append(Lamp((x, y, z), (0, 0, -1), 0.5, EVENING))


def computer_tower(stand: Stand, look: Look) -> None:
    """Stand a computer's case up."""
    half, tall = float(stand.rng.uniform(0.085, 0.105)), float(stand.rng.uniform(0.36, 0.46))
    case = DARK if stand.rng.random() < 0.7 else PALE
    front = patterns.plain(200, 90, (30, 31, 34) if case is DARK else (206, 206, 200))
    for row in (14, 36):
        front[row : row + 18, 8:82], front[row + 8, 14:70] = (70, 72, 78), (20, 20, 22)
        front[row + 12 : row + 15, 72:78] = (180, 182, 186)
    front[64:76, 38:52], front[68:72, 42:48] = (170, 172, 176), (80, 200, 250)
    front[82:88, 20:32], front[82:88, 36:48] = (14, 14, 16), (14, 14, 16)
    front[104:190:6, 14:76] = (12, 12, 14)
    with stand.surfaces.thing("computer"):
        stand.box((-half, half), (-0.2, 0.2), (0.012, tall), case)
        z = (0.02, tall - 0.008)
        stand.box((-half, half), (0.2, 0.215), z, case, front=Material(front))
        for y in (-0.17, 0.14):
            stand.box((-half + 0.01, half - 0.01), (y, y + 0.03), (0, 0.012), DARK)
        vent = patterns.plain(40, 40, (24, 24, 26))
        vent[::5] = (80, 82, 86)
        side = np.array([(half + 0.002, 0.06, 0.25), (half + 0.002, -0.1, 0.25),
                         (half + 0.002, -0.1, 0.12), (half + 0.002, 0.06, 0.12)])  # fmt: skip
        stand.surfaces.picture(stand.world(side), Material(vent))


def laptop(stand: Stand, look: Look) -> None:
    """Put an open laptop down."""
    rng, half = stand.rng, float(stand.rng.uniform(0.15, 0.18))
    grey: Colour = (184, 186, 190) if rng.random() < 0.6 else (50, 52, 56)
    base = patterns.plain(140, 210, grey)
    base[12:82, 12:198] = office.keyboard(rng, 70, 186)
    base[94:132, 72:138] = patterns.shift(rng, (120, 122, 126), 20)
    deep, lean = 1.3 * half, float(rng.uniform(0.04, 0.1))
    with stand.surfaces.thing("laptop"):
        y = (-deep / 2, deep / 2)
        stand.box((-half, half), y, (0, 0.018), paint(grey), top=Material(base))
        rings = []
        for back, z in ((y[0] - lean, 0.02 + 0.95 * deep), (y[0], 0.02)):
            ring = (
                (-half, back + 0.004),
                (half, back + 0.004),
                (half, back - 0.004),
                (-half, back - 0.004),
            )
            rings.append([(a, b, z) for a, b in ring])
        block(stand, rings[0], rings[1], paint(grey))
        (left, right), (low, high) = rings[0][:2], rings[1][:2]
        corners = np.add([left, right, high, low], (0, 0.003, 0))
        picture = Material(office.screen(rng, 130, 210), glow=SCREEN_GLOW)
        stand.surfaces.picture(stand.world(corners), picture)
