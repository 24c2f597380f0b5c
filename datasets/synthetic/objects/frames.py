"""Bars and bent panels, which chairs and other frames are made of."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import Point, block, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand


def pipe(stand: Stand, points: Sequence[Point], radius: float, material: Material) -> None:
    """Bend a thin bar along some points."""
    for begin, end in pairwise(points):
        tube(stand, begin, end, radius, material, sides=4 if radius < 0.013 else 6)


def panel(
    stand: Stand, levels: Sequence[Point], bend: float, thick: float, material: Material
) -> None:
    """Build a curved back from (half width, y, z) of its levels, bottom to top.

    Its sides come forward by `bend`.
    """
    columns = ((-1.0, bend), (-0.45, 0.0), (0.45, 0.0), (1.0, bend))
    for low, high in pairwise(levels):
        for (left, bend0), (right, bend1) in pairwise(columns):
            top, bottom = (
                [
                    (left * half, y + bend0 + thick, z), (right * half, y + bend1 + thick, z),
                    (right * half, y + bend1, z), (left * half, y + bend0, z),
                ]
                for half, y, z in (high, low)
            )  # fmt: skip
            block(stand, top, bottom, material)
