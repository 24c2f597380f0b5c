"""Fitted kitchens along a wall."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.kitchen.appliances import dish_front
from roomgraph.datasets.synthetic.objects.kitchen.cookers import put_hob
from roomgraph.datasets.synthetic.objects.kitchen.shared import DARK, STEEL
from roomgraph.datasets.synthetic.objects.kitchen.units import Fit, draw_fit, unit_front
from roomgraph.datasets.synthetic.objects.kitchen.worktop import draw_things, put_thing
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, loft, ring, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import kitchen
from roomgraph.datasets.synthetic.textures.patterns import Generator

__all__ = ["kitchen_run"]


def kitchen_run(stand: Stand, look: Look, *, width: float = 3.0) -> None:
    """Build a fitted kitchen along a wall: units, cooker, sink, wall units, tiles, things."""
    rng = stand.rng
    fit, count = draw_fit(rng, look), max(2, round(width / 0.6))
    unit, left = width / count, -width / 2
    kinds = _kinds(rng, count)
    with stand.surfaces.thing("kitchen_counter"):
        stand.box((left, -left), (0.012, 0.52), (0.0, 0.10), DARK)
        stand.wall((left, -left), (0.90, 1.45), 0.014, fit.splash)
        things = draw_things(rng)
        for i, kind in enumerate(kinds):
            place = stand.at(left + (i + 0.5) * unit)
            _base(place, fit, unit, kind)
            if kind == "sink":
                _sink(place, fit, unit)
                continue
            place.box((-unit / 2, unit / 2), (0.012, 0.62), (0.86, 0.90), fit.top)
            if kind == "oven":
                put_hob(place, unit)
            elif things:
                put_thing(place.at(0, 0, 0.90), look, unit, things.pop())
        _wall_units(stand, fit, kinds, unit)


def _kinds(rng: Generator, count: int) -> list[str]:
    """Say what stands where: a sink, a cooker if there is room, a dishwasher, cupboards."""
    kinds = [str(rng.choice(["door", "drawers"])) for _ in range(count)]
    places = [(i, k) for i in range(count) for k in range(count) if abs(i - k) >= 2]
    sink = int(rng.integers(count))
    if places:
        cooker, sink = places[int(rng.integers(len(places)))]
        kinds[cooker] = "oven"
    kinds[sink] = "sink"
    beside = [k for k in (sink - 1, sink + 1) if 0 <= k < count and kinds[k] != "oven"]
    if count > 3 and beside and rng.random() < 0.7:
        kinds[beside[0]] = "dish_washer"
    return kinds


def _base(stand: Stand, fit: Fit, unit: float, kind: str) -> None:
    """Build the unit below the worktop."""
    rng, span = stand.rng, (-unit / 2, unit / 2)
    names = {"oven": "oven", "dish_washer": "dish_washer"}
    with stand.surfaces.thing(names.get(kind, "cupboard")):
        if kind == "oven":
            front = Material(kitchen.oven(rng, 200, 150), shiny=True)
            tube(stand, (-0.22, 0.62, 0.69), (0.22, 0.62, 0.69), 0.011, STEEL)
        elif kind == "dish_washer":
            front = Material(dish_front(rng))
        else:
            rows = int(rng.integers(2, 5)) if kind == "drawers" else 1
            front = unit_front(rng, fit, rows)
        if kind == "sink":
            # The bowl hangs into this one: its body ends below it.
            stand.box(span, (0.012, 0.56), (0.10, 0.66), fit.body)
            stand.box(span, (0.56, 0.59), (0.10, 0.86), fit.body, front=front)
        else:
            stand.box(span, (0.012, 0.59), (0.10, 0.86), fit.body, front=front)


def _sink(stand: Stand, fit: Fit, unit: float) -> None:
    """Set a steel or white sink into the worktop, with its tap."""
    a = min(unit / 2, 0.29)
    basin = STEEL if stand.rng.random() < 0.7 else paint((240, 240, 236))
    for y in ((0.012, 0.09), (0.53, 0.62)):
        stand.box((-unit / 2, unit / 2), y, (0.86, 0.90), fit.top)
    for x in ((-unit / 2, -a), (a, unit / 2)):
        if x[1] - x[0] > 0.005:
            stand.box(x, (0.09, 0.53), (0.86, 0.90), fit.top)
    with stand.surfaces.thing("sink"):
        shapes = [
            (0.88, a, 0.235),
            (0.906, a, 0.235),
            (0.906, a - 0.035, 0.19),
            (0.74, a - 0.06, 0.16),
        ]
        rings = [ring((0, 0.31, z), (p, q), sides=8, corner=0.25) for z, p, q in shapes]
        loft(stand, rings, basin)
        lathe(stand, (0, 0.31), [(0.035, 0.741), (0.03, 0.744)], DARK, sides=8)
        tall = 1.20 if stand.rng.random() < 0.6 else 1.08
        tube(stand, (0, 0.07, 0.90), (0, 0.07, tall), 0.017, STEEL, sides=5)
        tube(stand, (0, 0.07, tall), (0, 0.25, tall), 0.014, STEEL)
        tube(stand, (0, 0.25, tall), (0, 0.26, tall - 0.07), 0.014, STEEL)
        tube(stand, (0.02, 0.07, 0.95), (0.09, 0.07, 0.99), 0.008, STEEL, sides=4)


def _wall_units(stand: Stand, fit: Fit, kinds: list[str], unit: float) -> None:
    """Hang cupboards and open shelves above the worktop; leave some places free."""
    rng, left = stand.rng, -unit * len(kinds) / 2
    free = set(rng.permutation(len(kinds))[: int(rng.integers(0, len(kinds) // 2 + 1))].tolist())
    for i, kind in enumerate(kinds):
        place, a = stand.at(left + (i + 0.5) * unit), unit / 2
        if kind == "oven" or (i in free and rng.random() < 0.5):
            continue
        if i not in free:
            with stand.surfaces.thing("cupboard"):
                leaf = unit_front(rng, fit, 1, hung=True)
                place.box((-a, a), (0.012, 0.34), (1.45, 2.15), fit.body, front=leaf)
            continue
        with stand.surfaces.thing("shelf"):
            for z in (1.45, 1.80):
                place.box((-a, a), (0.012, 0.26), (z, z + 0.025), fit.body)
                crockery = Material(kitchen.crockery(rng, 80, int(260 * unit)))
                wide = a - 0.02
                place.box((-wide, wide), (0.02, 0.14), (z + 0.025, z + 0.27), STEEL, front=crockery)
