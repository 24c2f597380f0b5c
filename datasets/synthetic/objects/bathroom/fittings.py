"""Dryers, dispensers and shelves on bathroom walls."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.bathroom.shared import CHROME, shampoo
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import bathroom

__all__ = ["bathroom_shelf", "hand_dryer", "paper_dispenser"]


def hand_dryer(stand: Stand, look: Look) -> None:
    """Build a hand dryer with its nozzle."""
    with stand.surfaces.thing("hand_dryer"):
        front = Material(bathroom.dryer(stand.rng, 90, 90))
        stand.box((-0.14, 0.14), (0.012, 0.16), (1.18, 1.46), CHROME, front=front)
        tube(stand, (0, 0.1, 1.19), (0, 0.13, 1.12), (0.05, 0.04), CHROME, sides=8)


def paper_dispenser(stand: Stand, look: Look) -> None:
    """Build a dispenser with a paper towel hanging out."""
    with stand.surfaces.thing("paper_dispenser"):
        front = Material(bathroom.dispenser(stand.rng, 120, 90))
        stand.box((-0.14, 0.14), (0.012, 0.12), (1.2, 1.58), CHROME, front=front)
        sheet = paint((246, 245, 240))
        stand.box((-0.09, 0.09), (0.06, 0.063), (1.1, 1.2), sheet)


def bathroom_shelf(stand: Stand, look: Look) -> None:
    """Build one or two boards with bottles, a beaker and rolled towels."""
    rng, wide = stand.rng, float(stand.rng.uniform(0.45, 0.7))
    wood = look.wooden(rng) if rng.random() < 0.6 else CHROME
    with stand.surfaces.thing("shelf"):
        for z in (1.2, 1.5)[: int(rng.integers(1, 3))]:
            stand.box((-wide / 2, wide / 2), (0.012, 0.15), (z, z + 0.02), wood)
            for k in range(int(wide / 0.1)):
                if rng.random() < 0.5:
                    shampoo(stand.at(-wide / 2 + 0.06 + 0.1 * k, 0.08, z + 0.02))
