"""Kitchen islands with their stools."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.kitchen.crockery import cup, fruit_bowl
from roomgraph.datasets.synthetic.objects.kitchen.shared import DARK
from roomgraph.datasets.synthetic.objects.kitchen.units import draw_fit, unit_front
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand

__all__ = ["kitchen_island"]


def kitchen_island(stand: Stand, look: Look) -> None:
    """Build an island with drawers behind, an overhanging top, and bar stools at its front."""
    rng, fit = stand.rng, draw_fit(stand.rng, look)
    stools = int(rng.integers(2, 4))
    a, units = 0.34 * stools + 0.1, stools + 1
    with stand.surfaces.thing("kitchen_counter"):
        stand.box((-a, a), (-0.42, 0.10), (0.0, 0.09), DARK)
        back = stand.at(0, 0, 0, 3.14159265)
        for i in range(units):
            x = -a + 2 * a * i / units
            leaf = unit_front(rng, fit, int(rng.integers(1, 4)))
            back.box((x, x + 2 * a / units), (-0.15, 0.45), (0.09, 0.88), fit.body, front=leaf)
        stand.box((-a - 0.05, a + 0.05), (-0.50, 0.50), (0.88, 0.92), fit.top)
        if rng.random() < 0.7:
            fruit_bowl(stand.at(float(rng.uniform(-0.3, 0.3)), -0.1, 0.92), look)
        cup(stand.at(0.5 * a, 0.3, 0.92), look)
    seat, round_ = look.woven(rng) if rng.random() < 0.5 else look.wooden(rng), rng.random() < 0.5
    for i in range(stools):
        x = (i - (stools - 1) / 2) * 0.68
        _stool(stand.at(x, 0.52, 0, float(rng.uniform(-0.3, 0.3))), look, seat, bool(round_))


def _stool(stand: Stand, look: Look, seat: Material, turned: bool) -> None:
    """Build a bar stool: on a column with a foot ring, or on four legs."""
    metal = look.metallic()
    with stand.surfaces.thing("bar_stool"):
        stand.footprint((-0.18, 0.18), (-0.18, 0.18))
        lathe(stand, (0, 0), [(0.17, 0.64), (0.185, 0.66), (0.17, 0.69)], seat, sides=10)
        if turned:
            lathe(stand, (0, 0), [(0.2, 0.0), (0.19, 0.015), (0.03, 0.03)], metal, sides=10)
            tube(stand, (0, 0, 0.02), (0, 0, 0.65), 0.028, metal)
            tube(stand, (-0.13, 0, 0.28), (0.13, 0, 0.28), 0.012, metal, sides=4)
            return
        feet = [(-0.17, -0.17), (0.17, -0.17), (0.17, 0.17), (-0.17, 0.17)]
        for (x, y), (p, q) in zip(feet, [*feet[1:], feet[0]], strict=True):
            tube(stand, (0.7 * x, 0.7 * y, 0.65), (x, y, 0.0), 0.016, metal, sides=4)
            tube(stand, (0.9 * x, 0.9 * y, 0.22), (0.9 * p, 0.9 * q, 0.22), 0.01, metal, sides=4)
