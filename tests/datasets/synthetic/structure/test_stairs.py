"""Stairs: the way up goes over treads and landings, and one can stand upright all along it."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.layout import FloorPlan
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from roomgraph.datasets.synthetic.structure.stairs import RISE_M, build_stairs, steps, way_up
from tests.datasets.synthetic.plans.helpers import plan

pytestmark = pytest.mark.slow

GREY = Material(np.full((64, 64, 3), 128, np.uint8))
HEAD_ROOM_M = 1.9
CASES = [("house", 2, 0), ("suite", 3, 1), ("ring", 3, 2), ("open", 2, 3)]


@cache
def stairs(kind: str, floors: int, seed: int) -> tuple[FloorPlan, Scene]:
    """Return a plan and its stairs alone, with the lowest floor."""
    drawn = plan(kind, floors, seed)
    surfaces = Surfaces(np.random.default_rng(0))
    build_stairs(surfaces, drawn, GREY, GREY)
    r = drawn.stairs.floor
    floor = [(r.x0, r.y1, 0), (r.x1, r.y1, 0), (r.x1, r.y0, 0), (r.x0, r.y0, 0)]
    surfaces.picture(np.array(floor, dtype=float), GREY)
    return drawn, Scene(surfaces.quads)


def dense(way: FloatArray, step_m: float = 0.02) -> FloatArray:
    """Return points (N, 3) all along a way."""
    parts = []
    for a, b in pairwise(way):
        count = max(2, int(np.linalg.norm(b - a) / step_m))
        parts.append(a + np.linspace(0, 1, count)[:, None] * (b - a))
    return np.concatenate(parts)


@pytest.mark.parametrize("case", CASES)
def test_a_way_begins_and_ends_on_the_landing_before_the_doors(case):
    drawn, _ = stairs(*case)
    floor = drawn.stairs.floor
    for level in range(drawn.levels - 1):
        way = way_up(floor, drawn.storey_m, level)
        assert way[0, 2] == pytest.approx(level * drawn.storey_m)
        assert way[-1, 2] == pytest.approx((level + 1) * drawn.storey_m)
        for point in (way[0], way[-1]):
            assert floor.y0 < point[1] < floor.y0 + 1.3
        assert (np.diff(way[:, 2]) >= 0).all()
        assert (way[:, 0] > floor.x0 + 0.3).all()
        assert (way[:, 0] < floor.x1 - 0.3).all()
        assert way[:, 1].max() < floor.y1 - 0.3


@pytest.mark.parametrize("case", CASES)
def test_below_every_point_of_the_way_is_a_tread_or_a_landing(case):
    drawn, scene = stairs(*case)
    rise = drawn.storey_m / 2 / steps(drawn.storey_m)
    for level in range(drawn.levels - 1):
        way = dense(way_up(drawn.stairs.floor, drawn.storey_m, level))
        origin = way + np.array([0, 0, 0.6])
        down = np.tile((0.0, 0.0, -1.0), (len(way), 1))
        ground = origin[:, 2] - scene.distances(origin, down)
        assert np.abs(ground - way[:, 2]).max() < rise + 1e-3
        climbed = np.diff(ground)
        assert climbed.min() > -1e-3, "one only goes up"
        assert climbed.max() < rise + 1e-3, "one riser at a time"


@pytest.mark.parametrize("case", CASES)
def test_nothing_is_in_the_way_of_ones_head(case):
    drawn, scene = stairs(*case)
    for level in range(drawn.levels - 1):
        way = dense(way_up(drawn.stairs.floor, drawn.storey_m, level))
        low = way + np.array([0, 0, 0.25])
        up = np.tile((0.0, 0.0, 1.0), (len(way), 1))
        free = 0.25 + scene.distances(low, up)
        assert free.min() >= HEAD_ROOM_M
        assert np.isfinite(free).any(), "there is a flight above"


@pytest.mark.parametrize("case", CASES)
def test_no_rail_stands_across_the_way(case):
    drawn, scene = stairs(*case)
    for level in range(drawn.levels - 1):
        corners = way_up(drawn.stairs.floor, drawn.storey_m, level) + np.array([0, 0, 0.6])
        for a, b in pairwise(corners):
            assert scene.distances(a[None], (b - a)[None])[0] > 1.0


@pytest.mark.parametrize("storey", [2.7, 3.0, 3.4, 3.8])
def test_risers_are_as_high_as_stairs_are(storey):
    assert storey / 2 / steps(storey) == pytest.approx(RISE_M, abs=0.02)
