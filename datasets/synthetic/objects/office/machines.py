"""Shredders and dispensers of water."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import DARK, PALE
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns

__all__ = ["paper_shredder", "water_dispenser"]


def paper_shredder(stand: Stand, look: Look) -> None:
    """Build a shredder: a bin with a window full of strips, and a head with a slot."""
    rng, half, tall = stand.rng, float(stand.rng.uniform(0.17, 0.22)), 0.42
    strips = patterns.plain(90, 120, (30, 32, 36))
    for _ in range(120):
        column, row = int(rng.integers(0, 112)), int(rng.integers(30, 80))
        strips[row : row + 3, column : column + 16] = patterns.shift(rng, (226, 224, 216), 26)
    with stand.surfaces.thing("paper_shredder"):
        stand.box((-half, half), (0.03, 0.29), (0.03, tall), DARK)
        stand.box((-half + 0.02, half - 0.02), (0.29, 0.3), (0.06, 0.36), paint((66, 68, 74)))
        stand.picture((-0.1, 0.1), (0.1, 0.26), 0.303, Material(strips))
        stand.picture((-0.06, 0.06), (0.31, 0.335), 0.303, paint((20, 20, 22)))
        for x in (-half + 0.04, half - 0.04):
            tube(stand, (x - 0.01, 0.27, 0.02), (x + 0.01, 0.27, 0.02), 0.022, DARK)
        head = PALE if rng.random() < 0.5 else paint((96, 98, 104))
        cushion(stand, (-half - 0.02, half + 0.02), (0.01, 0.32), (tall, tall + 0.14), head)
        z, sheet = tall + 0.142, Material(ink.sheet(rng, 70, 100))
        stand.sheet((-half + 0.05, half - 0.05), (0.14, 0.18), z, paint((14, 14, 16)))
        stand.box((-0.1, 0.1), (0.158, 0.162), (z, z + 0.13), PALE, front=sheet)
        for i, colour in enumerate(((70, 220, 90), (230, 60, 50), (60, 120, 200))):
            left = half - 0.13 + 0.04 * i
            stand.picture((left, left + 0.025), (tall + 0.03, tall + 0.055), 0.323, paint(colour))


def water_dispenser(stand: Stand, look: Look) -> None:
    """Build a water cooler with its bottle, two taps in a recess and a stack of cups."""
    rng, tall = stand.rng, float(stand.rng.uniform(0.92, 1.02))
    case = PALE if rng.random() < 0.7 else paint((150, 154, 158))
    with stand.surfaces.thing("water_dispenser"):
        stand.box((-0.155, 0.155), (0.03, 0.34), (0.02, 0.6), case)
        stand.box((-0.155, 0.155), (0.03, 0.2), (0.6, 0.84), case)
        stand.picture((-0.125, 0.125), (0.6, 0.84), 0.203, paint((70, 74, 80)))
        for x in (-0.155, 0.125):
            stand.box((x, x + 0.03), (0.2, 0.33), (0.6, 0.84), case)
        stand.box((-0.155, 0.155), (0.03, 0.34), (0.84, tall), case)
        stand.box((-0.12, 0.12), (0.2, 0.35), (0.6, 0.615), DARK)
        stand.box((-0.125, 0.125), (0.34, 0.346), (0.07, 0.55), paint((196, 198, 200)))
        for x, colour in ((-0.06, (40, 90, 200)), (0.06, (210, 40, 40))):
            tube(stand, (x, 0.2, 0.78), (x, 0.27, 0.78), 0.02, paint(colour))
            tube(stand, (x, 0.26, 0.78), (x, 0.26, 0.73), 0.012, PALE)
            stand.picture((x - 0.02, x + 0.02), (0.86, 0.875), 0.343, paint(colour))
        water = patterns.plain(80, 96, (110, 164, 214))
        water[:18], water[36:40], water[56:60] = (170, 204, 232), (84, 136, 190), (84, 136, 190)
        water[:, 20:26] = (206, 228, 244)
        levels = [(0.06, 0.0), (0.07, 0.05), (0.135, 0.09), (0.135, 0.17), (0.128, 0.18),
                  (0.135, 0.19), (0.135, 0.34), (0.11, 0.38)]  # fmt: skip
        lathe(stand, (0, 0.185), [(r, tall + z) for r, z in levels], Material(water, shiny=True))
        tube(stand, (0.19, 0.2, 0.55), (0.19, 0.2, 0.9), 0.034, paint((240, 240, 238)), sides=8)
