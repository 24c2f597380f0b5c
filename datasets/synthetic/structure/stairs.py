"""Stairs of two flights with a landing between, and the way up them."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans.draft import LANDING_M
from roomgraph.datasets.synthetic.plans.layout import FloorPlan, Rectangle
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand

RISE_M = 0.175
WELL_M = 0.12
RAIL_M = 0.95
SLAB_M = 0.16


def steps(storey_m: float) -> int:
    """Return the number of risers of one flight: half a storey."""
    return max(2, round(storey_m / 2 / RISE_M))


def build_stairs(surfaces: Surfaces, plan: FloorPlan, tread: Material, rail: Material) -> None:
    """Build the flights between all levels, and the landings with their rails."""
    assert plan.stairs is not None
    r = plan.stairs.floor
    # The stand's x is the world's; y grows from the far end towards the landing at the doors.
    stand = Stand(surfaces, (r.centre[0], r.y1, 0.0), -np.pi / 2)
    wide, long = r.x1 - r.x0, r.y1 - r.y0
    for level in range(plan.levels):
        base = stand.at(0, 0, level * plan.storey_m)
        if level > 0:
            _slab(base, (-wide / 2, wide / 2), (long - LANDING_M, long), 0.0, tread)
        if level == plan.levels - 1:
            # Nothing goes up from here: a rail keeps people from the flight that comes up.
            _railing(
                base, (-wide / 2, long - LANDING_M, 0), (-WELL_M / 2, long - LANDING_M, 0), rail
            )
            continue
        _flights(base, wide, long, plan.storey_m, tread, rail)


def _flights(
    base: Stand, wide: float, long: float, storey: float, tread: Material, rail: Material
) -> None:
    """Build the flight up at small x to the half landing, and the one back at large x."""
    count = steps(storey)
    rise, run = storey / 2 / count, (long - 2 * LANDING_M) / (count - 1)
    up, back = (-wide / 2, -WELL_M / 2), (WELL_M / 2, wide / 2)
    for i in range(count - 1):
        y1 = long - LANDING_M - i * run
        top = (i + 1) * rise
        base.box(up, (y1 - run, y1), (max(0.0, top - rise - SLAB_M), top), tread)
        y0 = LANDING_M + i * run
        top = storey / 2 + (i + 1) * rise
        base.box(back, (y0, y0 + run), (top - rise - SLAB_M, top), tread)
    _slab(base, (-wide / 2, wide / 2), (0, LANDING_M), storey / 2, tread)
    near, far = long - LANDING_M, LANDING_M
    _railing(base, (-WELL_M / 2, near, 0.05), (-WELL_M / 2, far, storey / 2), rail)
    _railing(base, (WELL_M / 2, far, storey / 2), (WELL_M / 2, near, storey), rail)


def _slab(
    base: Stand, x: tuple[float, float], y: tuple[float, float], top: float, tread: Material
) -> None:
    base.box(x, y, (top - SLAB_M, top), tread)
    # The underside is seen from the flight below.
    corners = [
        (x[0], y[1], top - SLAB_M),
        (x[1], y[1], top - SLAB_M),
        (x[1], y[0], top - SLAB_M),
        (x[0], y[0], top - SLAB_M),
    ]
    base.surfaces.cover(base.world(corners), tread)


def _railing(
    base: Stand, begin: tuple[float, float, float], end: tuple[float, float, float], rail: Material
) -> None:
    """Join two points of the floor by a hand rail on balusters."""
    a, b = np.array(begin), np.array(end)
    up = np.array([0, 0, RAIL_M])
    tube(base, _point(a + up), _point(b + up), 0.03, rail)
    for share in np.linspace(0.03, 0.97, max(3, int(np.linalg.norm(b[:2] - a[:2]) / 0.25))):
        foot = a + share * (b - a)
        tube(base, _point(foot), _point(foot + up), 0.011, rail, sides=4)


def _point(p: FloatArray) -> tuple[float, float, float]:
    return float(p[0]), float(p[1]), float(p[2])


def way_up(floor: Rectangle, storey_m: float, level: int) -> FloatArray:
    """Return the corners (N, 3) of the way from a level's landing to the next level's landing.

    The last coordinate is the height of what is walked on.
    """
    x0, x1, y0, y1 = floor.x0, floor.x1, floor.y0, floor.y1
    base, half = level * storey_m, storey_m / 2
    quarter = (x1 - x0 - WELL_M) / 4
    up, back = x0 + quarter, x1 - quarter
    near, far = y0 + LANDING_M, y1 - LANDING_M
    turn = y1 - LANDING_M / 2
    return np.array([
        (up, near - 0.35, base), (up, near, base), (up, far, base + half), (up, turn, base + half),
        (back, turn, base + half), (back, far, base + half), (back, near, base + storey_m),
        (back, near - 0.35, base + storey_m),
    ])  # fmt: skip
