"""Bottles of gas."""

from __future__ import annotations

from itertools import pairwise

from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, PALE, STEEL
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["gas_cylinders"]

GASES: tuple[Colour, ...] = ((40, 90, 60), (60, 70, 110), (130, 40, 40), (90, 94, 98), (30, 30, 34))


def gas_cylinders(stand: Stand, look: Look) -> None:
    """Build two steel bottles of gas, chained to a rail on the wall, with gauges."""
    rng, tall = stand.rng, float(stand.rng.uniform(1.2, 1.4))
    stand.box((-0.34, 0.34), (0.012, 0.05), (0.86, 0.94), STEEL)
    for x in (-0.16, 0.16):
        skin = patterns.plain(120, 96, patterns.pick(rng, GASES))
        skin[: 120 * 1 // 3] = patterns.pick(rng, (*VIVID, (226, 228, 226)))
        skin[64:84, 14:46] = (240, 238, 230)
        ink.write(
            skin, str(rng.choice(["N2", "AR", "HE", "O2", "CO2"])), (16, 65, 44, 83), (20, 20, 24)
        )
        with stand.surfaces.thing("gas_cylinder"):
            levels = [
                (0.11, 0),
                (0.115, 0.02),
                (0.115, tall),
                (0.095, tall + 0.07),
                (0.035, tall + 0.13),
            ]
            lathe(stand, (x, 0.18), levels, Material(skin))
            z = tall + 0.13
            tube(stand, (x, 0.18, z), (x, 0.18, z + 0.1), 0.02, paint((186, 150, 70)))
            lathe(stand, (x, 0.18), [(0.035, z + 0.1), (0.035, z + 0.125)], DARK, sides=8)
            tube(stand, (x, 0.18, z + 0.05), (x, 0.3, z + 0.05), 0.016, paint((186, 150, 70)))
            for side in (-0.045, 0.045):
                a, b = (x + side, 0.27, z + 0.09), (x + side, 0.305, z + 0.09)
                tube(stand, a, b, 0.036, PALE, sides=8)
                tube(stand, (x, 0.27, z + 0.05), a, 0.008, STEEL, sides=4)
        chain = [(-0.14, 0.05), (-0.125, 0.2), (-0.05, 0.305), (0.05, 0.305), (0.125, 0.2),
                 (0.14, 0.05)]  # fmt: skip
        for (x0, y0), (x1, y1) in pairwise(chain):
            tube(stand, (x + x0, y0, 0.9), (x + x1, y1, 0.89), 0.009, STEEL, sides=4)
