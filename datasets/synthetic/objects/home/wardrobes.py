"""Wardrobes and mirrors to stand before."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.home.chests import front_leaf
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import block, tube
from roomgraph.datasets.synthetic.rendering.stand import Span, Stand
from roomgraph.datasets.synthetic.textures import bathroom, patterns

__all__ = ["standing_mirror", "wardrobe"]


def reflection(rng: np.random.Generator, height: int, width: int) -> Material:
    """Return a mirror that shows, blurred, the other side of a room: wall, door, floor."""
    wall = patterns.pick(rng, ((216, 210, 198), (196, 204, 210), (222, 214, 190)))
    room = patterns.plain(height, width, wall)
    skirting = int(0.72 * height)
    room[skirting:] = patterns.pick(rng, ((150, 116, 80), (120, 112, 104), (176, 150, 116)))
    left = int(rng.uniform(0.1, 0.6) * width)
    cv2.rectangle(
        room, (left, height // 4), (left + width // 3, skirting), (132, 104, 76), cv2.FILLED
    )
    return Material(bathroom.mirror(rng, height, width, room), shiny=True)


def wardrobe(stand: Stand, look: Look) -> None:
    """Build a wardrobe with two to four doors, one of them perhaps a mirror."""
    rng, count = stand.rng, int(stand.rng.integers(2, 5))
    wide, deep, high = (float(v) for v in rng.uniform((0.45, 0.56, 1.95), (0.55, 0.62, 2.25)))
    wood, knob, half = look.wooden(rng), look.metallic(), count * wide / 2
    upright = Material(np.rot90(wood.image).copy(), wood.height_m, 2.4)
    glass = int(rng.integers(count)) if rng.random() < 0.45 else -1
    kind, drawer = int(rng.integers(3)), 0.30 if rng.random() < 0.4 else 0.0
    with stand.surfaces.thing("wardrobe"):
        stand.box((0.02 - half, half - 0.02), (0.03, deep - 0.05), (0.0, 0.08), paint((60, 54, 50)))
        stand.box((-half, half), (0.012, deep - 0.022), (0.08, high), upright)
        stand.box((-half - 0.02, half + 0.02), (0.012, deep + 0.02), (high, high + 0.05), wood)
        for i in range(count):
            x = i * wide - half, (i + 1) * wide - half
            if drawer:
                front_leaf(stand, x, (0.09, 0.09 + drawer), deep - 0.022, wood, knob)
            z, inner = (0.096 + drawer, high - 0.006), (x[0] + 0.005, x[1] - 0.005)
            stand.box(inner, (deep - 0.022, deep), z, upright)
            if i == glass:
                with stand.surfaces.thing("mirror"):
                    pane = reflection(rng, 300, 90)
                    edge = (z[0] + 0.03, z[1] - 0.03)
                    stand.picture((x[0] + 0.035, x[1] - 0.035), edge, deep + 0.003, pane)
            elif kind:
                _panels(stand, inner, z, deep, upright, kind)
            grip = x[1] - 0.04 if i % 2 == 0 else x[0] + 0.04
            bar = (grip, deep + 0.025, 0.98), (grip, deep + 0.025, 1.16)
            tube(stand, *bar, 0.009, knob)
            for _, y, up in bar:
                tube(stand, (grip, deep, up), (grip, y, up), 0.007, knob, sides=4)


def _panels(stand: Stand, x: Span, z: Span, y: float, wood: Material, count: int) -> None:
    """Frame a door with raised rails and stiles around `count` panels."""
    for a, b in ((x[0], x[0] + 0.07), (x[1] - 0.07, x[1])):
        stand.box((a, b), (y, y + 0.012), z, wood)
    for share in np.linspace(0, 1, count + 1):
        low = z[0] + float(share) * (z[1] - z[0] - 0.08)
        stand.box((x[0] + 0.07, x[1] - 0.07), (y, y + 0.012), (low, low + 0.08), wood)


def standing_mirror(stand: Stand, look: Look) -> None:
    """Build a tall mirror: leaning against the wall, or hung between two posts on feet."""
    rng, wood = stand.rng, look.wooden(stand.rng)
    half, high = float(rng.uniform(0.2, 0.29)), float(rng.uniform(1.5, 1.75))
    cheval = bool(rng.random() < 0.5)
    low, base, lean = (0.16, 0.27, 0.19) if cheval else (0.0, 0.30, 0.04)

    def at(x: float, share: float, out: float) -> tuple[float, float, float]:
        return x, base + (lean - base) * share + out, low + share * (high - low)

    with stand.surfaces.thing("mirror"):
        stand.footprint((-half, half), (0.0, 0.4))
        rim = 0.045
        edges = [(-half, half, 0.0, 0.035), (-half, half, 0.965, 1.0)]
        edges += [(-half, rim - half, 0.035, 0.965), (half - rim, half, 0.035, 0.965)]
        for x0, x1, s0, s1 in edges:
            rings = [
                [at(x0, s, 0.03), at(x1, s, 0.03), at(x1, s, 0.0), at(x0, s, 0.0)] for s in (s1, s0)
            ]
            block(stand, rings[0], rings[1], wood)
        inner = half - rim
        corners = [at(-inner, 0.965, 0.012), at(inner, 0.965, 0.012)]
        corners += [at(inner, 0.035, 0.012), at(-inner, 0.035, 0.012)]
        pane: Image = reflection(rng, 260, 90).image
        stand.surfaces.picture(stand.world(corners), Material(pane, shiny=True))
        back = [(-x, y - 0.02, z) for x, y, z in corners]
        stand.surfaces.picture(stand.world(back), paint((90, 76, 60)))
        for x in (-half - 0.03, half + 0.03) if cheval else ():
            tube(stand, (x, 0.23, 0.06), (x, 0.23, 1.15), (0.02, 0.014), wood)
            tube(stand, (x, 0.03, 0.03), (x, 0.45, 0.03), 0.02, wood)
            tube(stand, (x, 0.23, 0.95), (x * 0.85, 0.24, 0.95), 0.012, wood)
