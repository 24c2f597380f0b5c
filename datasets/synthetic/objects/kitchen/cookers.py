"""Cookers, hobs and pots."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.kitchen.shared import CASES, DARK, STEEL
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, kitchen, patterns

__all__ = ["free_cooker"]


def put_hob(stand: Stand, unit: float) -> None:
    """Lay a hob on the worktop, with a pot on it at times, and hang a hood above."""
    rng, a = stand.rng, unit / 2
    with stand.surfaces.thing("hob"):
        picture = Material(kitchen.hob(rng, 130, 150))
        stand.box((-a + 0.02, a - 0.02), (0.06, 0.56), (0.90, 0.91), DARK, top=picture)
    if rng.random() < 0.6:
        put_pot(stand.at(a * float(rng.choice([-0.45, 0.45])), 0.22, 0.91))
    hood_z, slim = 1.55, bool(rng.random() < 0.5)
    with stand.surfaces.thing("cooker_hood"):
        upper, lower = [], []
        for x, y in ((-1, 0.5), (1, 0.5), (1, 0.012), (-1, 0.012)):
            upper.append((x * 0.14, 0.5 * y + 0.03 if y > 0.1 else y, hood_z + 0.28))
            lower.append((x * (a - 0.005), y, hood_z + 0.05))
        if slim:
            upper = [(0.98 * x, 0.9 * y, hood_z + 0.12) for x, y, _ in lower]
        steel = Material(patterns.steel(rng, 120, 160), 1.0, 1.0)
        stand.box((-a + 0.005, a - 0.005), (0.012, 0.5), (hood_z, hood_z + 0.05), steel)
        block(stand, upper, lower, steel)
        stand.box((-0.14, 0.14), (0.012, 0.28), (hood_z + 0.12, 2.4), steel)


def put_pot(stand: Stand) -> None:
    colour = paint(patterns.pick(stand.rng, (*ink.VIVID[:4], (180, 182, 186), (50, 50, 54))))
    r = float(stand.rng.uniform(0.08, 0.11))
    with stand.surfaces.thing("pot"):
        profile = [(r, 0), (r, 0.11), (1.04 * r, 0.115), (0.3 * r, 0.135), (0.18 * r, 0.165)]
        lathe(stand, (0, 0), profile, colour, sides=10)
        for x in (-r - 0.03, r - 0.005):
            stand.box((x, x + 0.035), (-0.03, 0.03), (0.08, 0.095), DARK)


def free_cooker(stand: Stand, look: Look) -> None:
    """Build a cooker that stands by itself: oven, hob, a panel at the back."""
    rng, body = stand.rng, paint(patterns.pick(stand.rng, CASES[:3]))
    with stand.surfaces.thing("oven"):
        front = Material(kitchen.oven(rng, 200, 150), shiny=True)
        stand.box((-0.3, 0.3), (0.02, 0.60), (0.14, 0.89), body, front=front)
        stand.box((-0.3, 0.3), (0.02, 0.595), (0.02, 0.135), DARK)
        tube(stand, (-0.24, 0.64, 0.69), (0.24, 0.64, 0.69), 0.012, STEEL)
        for x in (-0.22, 0.22):
            tube(stand, (x, 0.60, 0.69), (x, 0.64, 0.69), 0.01, STEEL, sides=4)
        with stand.surfaces.thing("hob"):
            plates = Material(kitchen.hob(rng, 130, 150))
            stand.box((-0.3, 0.3), (0.05, 0.61), (0.89, 0.91), DARK, top=plates)
        stand.box((-0.3, 0.3), (0.02, 0.05), (0.89, float(rng.choice([0.96, 1.06]))), body)
    if rng.random() < 0.6:
        put_pot(stand.at(float(rng.choice([-0.13, 0.13])), 0.24, 0.91))
