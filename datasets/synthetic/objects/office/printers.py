"""Copiers, and printers on tables."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import SCREEN_GLOW, Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import DARK, PALE, astray
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, office, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID

__all__ = ["printer", "printer_table"]


def printer(stand: Stand, look: Look) -> None:
    """Build a floor-standing copier: paper trays, a gap for the prints, scanner, lid, panel."""
    rng, half = stand.rng, float(stand.rng.uniform(0.27, 0.33))
    case, trays = (PALE, DARK) if rng.random() < 0.7 else (DARK, PALE)
    with stand.surfaces.thing("printer"):
        stand.box((-half, half), (0.04, 0.6), (0.03, 0.66), case)
        count = int(rng.integers(2, 5))
        for i in range(count):
            z, tall = 0.06 + i * 0.44 / count, 0.44 / count
            stand.box((-half + 0.01, half - 0.01), (0.6, 0.615), (z, z + tall - 0.012), case)
            stand.picture((-0.09, 0.09), (z + 0.5 * tall, z + 0.75 * tall), 0.617, trays)
        stand.box((-half, half), (0.6, 0.61), (0.52, 0.65), trays)
        stand.box((-half, half), (0.04, 0.16), (0.66, 0.86), case)
        stand.box((half - 0.1, half), (0.16, 0.58), (0.66, 0.86), case)
        stand.picture((-half, half - 0.1), (0.66, 0.86), 0.163, DARK)
        prints = Material(ink.sheet(rng, 110, 150))
        stand.box((-0.22, 0.08), (0.2, 0.5), (0.67, 0.69), PALE, top=prints)
        stand.box((-half, half), (0.04, 0.6), (0.86, 0.96), case)
        stand.box((-half + 0.02, half - 0.02), (0.05, 0.56), (0.96, 1.0), trays)
        stand.box((-half + 0.04, half - 0.16), (0.06, 0.5), (1.0, 1.1), case)
        _slope(stand, (-half + 0.06, half - 0.3), (0.08, 0.46), 1.1, 0.07, trays)
        _slope(stand, (half - 0.28, half), (0.6, 0.72), 0.9, 0.07, trays)
        panel = Material(office.screen(rng, 60, 110), glow=SCREEN_GLOW)
        slant = np.array([(half - 0.25, 0.602, 0.976), (half - 0.07, 0.602, 0.976),
                          (half - 0.07, 0.70, 0.92), (half - 0.25, 0.70, 0.92)])  # fmt: skip
        stand.surfaces.picture(stand.world(slant), panel)
        block(stand, [(-half, 0.5, 0.56), (-half, 0.5, 0.5), (-half, 0.2, 0.5), (-half, 0.2, 0.56)],
              [(-half - 0.2, 0.5, 0.66), (-half - 0.2, 0.5, 0.64), (-half - 0.2, 0.2, 0.64),
               (-half - 0.2, 0.2, 0.66)], trays)  # fmt: skip


def _slope(
    stand: Stand, x: tuple[float, float], y: tuple[float, float], z: float, rise: float,
    material: Material,
) -> None:  # fmt: skip
    """Add a wedge that falls towards the viewer."""
    corners = [(x[0], y[1]), (x[1], y[1]), (x[1], y[0]), (x[0], y[0])]
    top = [(a, b, z + (rise if b == y[0] else 0.01)) for a, b in corners]
    block(stand, top, [(a, b, z) for a, b in corners], material)


def printer_table(stand: Stand, look: Look) -> None:
    """Build a small table with a desktop printer on it and packs of paper below."""
    rng, wood = stand.rng, look.wooden(stand.rng)
    with stand.surfaces.thing("table"):
        for z in (0.18, 0.62):
            stand.box((-0.33, 0.33), (0.02, 0.5), (z - 0.02, z), wood)
        for x in (-0.31, 0.28):
            for y in (0.04, 0.45):
                stand.box((x, x + 0.03), (y, y + 0.03), (0, 0.6), look.metallic())
        brand = patterns.pick(rng, VIVID)
        label = patterns.plain(40, 120, (238, 238, 232))
        label[:, 70:] = brand
        ink.write(label, "PAPER A4", (6, 8, 66, 32), brand)
        for i in range(int(rng.integers(2, 6))):
            x, z = -0.15 + 0.3 * (i % 2), 0.18 + 0.055 * (i // 2)
            pack = paint((238, 238, 232))
            stand.box((x - 0.13, x + 0.13), (0.1, 0.4), (z, z + 0.055), pack, front=Material(label))
        with stand.surfaces.thing("printer"):
            _desktop_printer(stand.at(astray(rng, 0.05), 0.25, 0.62))


def _desktop_printer(stand: Stand) -> None:
    """Build a printer with a lid, a gap for the prints, a panel and a sheet coming out."""
    case, other = (PALE, DARK) if stand.rng.random() < 0.6 else (DARK, PALE)
    deep, tall = 0.17, float(stand.rng.uniform(0.2, 0.3))
    stand.box((-0.22, 0.22), (-deep, deep), (0, 0.09), case)
    stand.box((-0.22, 0.22), (-deep, -0.02), (0.09, tall - 0.08), case)
    for x in (-0.22, 0.16):
        stand.box((x, x + 0.06), (-0.02, deep), (0.09, tall - 0.08), case)
    stand.picture((-0.16, 0.16), (0.09, tall - 0.08), -0.017, DARK)
    stand.box((-0.22, 0.22), (-deep, deep), (tall - 0.08, tall - 0.02), other)
    stand.box((-0.21, 0.21), (-deep, deep - 0.02), (tall - 0.02, tall), case)
    stand.box((-0.13, 0.13), (0.0, deep + 0.12), (0.095, 0.105), other)
    stand.sheet((-0.1, 0.1), (-0.01, deep + 0.09), 0.11, Material(ink.sheet(stand.rng, 110, 90)))
    screen = Material(office.screen(stand.rng, 40, 70), glow=SCREEN_GLOW)
    stand.picture((0.06, 0.15), (tall - 0.075, tall - 0.025), deep + 0.003, screen)
