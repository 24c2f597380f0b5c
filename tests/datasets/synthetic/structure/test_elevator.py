"""The elevator: its doors are open only where the cabin stands, and shut while it goes."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.layout import Doorway, FloorPlan
from roomgraph.datasets.synthetic.rendering.mesh import Surfaces
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from roomgraph.datasets.synthetic.structure.elevator import (
    DOORS_S,
    Ride,
    build_elevator,
    cabin_height,
    doors_opened,
    ride_seconds,
    surround,
)
from roomgraph.datasets.synthetic.structure.moving import Stiff
from tests.datasets.synthetic.plans.helpers import plan

pytestmark = pytest.mark.slow

STOREY_M = 3.0
UP = Ride(0, 2, called_s=10.0, closing_s=20.0, arrived_s=32.0, left_s=40.0)
DOWN = Ride(2, 1, called_s=60.0, closing_s=66.0, arrived_s=75.0, left_s=80.0)
RIDES = (UP, DOWN)
STAMPS = np.arange(0.0, 95.0, 0.1)
CASES = [("house", 3, 0), ("ring", 3, 1)]


def test_the_cabin_goes_from_level_to_level_and_stands_while_doors_are_open():
    assert cabin_height(RIDES, 0.0, STOREY_M) == 0.0
    for ride in RIDES:
        for stamp, level in ((ride.closing_s + DOORS_S, ride.start), (ride.arrived_s, ride.end)):
            assert cabin_height(RIDES, stamp, STOREY_M) == pytest.approx(STOREY_M * level)
    assert cabin_height(RIDES, 59.9, STOREY_M) == pytest.approx(2 * STOREY_M)
    assert cabin_height(RIDES, 95.0, STOREY_M) == pytest.approx(STOREY_M)
    heights = np.array([cabin_height(RIDES, float(s), STOREY_M) for s in STAMPS])
    opened = np.array([doors_opened(RIDES, float(s)) for s in STAMPS])
    assert np.abs(np.diff(heights)).max() < 0.2
    moves = np.abs(np.gradient(heights)) > 1e-9
    assert moves.sum() > 100
    assert (opened[moves] < 0.05).all()
    going = (UP.closing_s + DOORS_S < STAMPS) & (UP.arrived_s > STAMPS)
    assert (opened[going] == 0).all()


def test_doors_of_a_level_are_open_only_while_the_cabin_is_there():
    opened = {k: np.array([doors_opened(RIDES, float(s), k) for s in STAMPS]) for k in range(3)}
    heights = np.array([cabin_height(RIDES, float(s), STOREY_M) for s in STAMPS])
    cabin = np.array([doors_opened(RIDES, float(s)) for s in STAMPS])
    for level, share in opened.items():
        assert share.max() == 1.0
        assert share.min() == 0.0
        away = np.abs(heights - level * STOREY_M) > 1e-6
        assert (share[away] == 0).all()
        np.testing.assert_array_equal(share[share > 0], cabin[share > 0])
        assert np.abs(np.diff(share)).max() < 0.2
    assert (sum(share > 0 for share in opened.values()) <= 1).all()
    for ride in RIDES:
        assert doors_opened(RIDES, ride.called_s + DOORS_S, ride.start) == 1.0
        assert doors_opened(RIDES, ride.closing_s, ride.start) == 1.0
        assert doors_opened(RIDES, ride.arrived_s + DOORS_S, ride.end) == 1.0


def test_without_rides_the_cabin_waits_below_with_its_doors_shut():
    for stamp in (0.0, 50.0):
        assert cabin_height((), stamp, STOREY_M) == 0.0
        assert doors_opened((), stamp) == doors_opened((), stamp, 0) == 0.0


def test_a_longer_ride_takes_longer():
    assert ride_seconds(2, 3.0) == pytest.approx(2 * ride_seconds(1, 3.0))
    assert ride_seconds(1, 3.6) > ride_seconds(1, 3.0) > 1.5


@cache
def elevator(kind: str, floors: int, seed: int) -> tuple[FloorPlan, Surfaces, list[Stiff]]:
    drawn = plan(kind, floors, seed)
    surfaces = Surfaces(np.random.default_rng(0))
    return drawn, surfaces, build_elevator(surfaces, drawn, RIDES, np.random.default_rng(1))


def lift_doors(drawn: FloorPlan) -> list[Doorway]:
    return [door for door in drawn.doorways if door.kind == "lift"]


def passed(bodies: list[Stiff], door: Doorway, side: int, stamp: float) -> float:
    """Return the share of the opening through which one sees, straight, into the shaft."""
    scene = Scene.of(np.concatenate([body.corners(stamp) for body in bodies]))
    y = door.xy[1] + np.linspace(-0.48, 0.48, 40) * door.width_m
    z = door.base_m + np.linspace(0.02, 0.98, 20) * door.height_m
    points = np.array([(door.xy[0] + side, a, b) for a in y for b in z])
    way = np.tile((-float(side), 0.0, 0.0), (len(points), 1))
    return float((scene.distances(points, way) > 1.5).mean())


@pytest.mark.parametrize("case", CASES)
def test_panels_close_the_openings_of_all_levels_and_slide_out_of_them(case):
    drawn, _, bodies = elevator(*case)
    side = drawn.lift.door_side
    landings = bodies[3:]
    assert len(landings) == 2 * drawn.levels
    for door in lift_doors(drawn):
        for stamp in (0.0, 26.0, 50.0, 95.0):
            assert passed(landings, door, side, stamp) == 0.0
    for stamp, level in ((15.0, 0), (36.0, 2), (63.0, 2), (78.0, 1)):
        for door in lift_doors(drawn):
            free = passed(landings, door, side, stamp)
            assert free > 0.98 if door.level == level else free == 0.0
            assert passed(bodies[1:], door, side, stamp) == free


@pytest.mark.parametrize("case", CASES)
def test_the_cabin_takes_its_doors_and_its_floor_along(case):
    drawn, surfaces, bodies = elevator(*case)
    assert surfaces.quads == []
    assert surfaces.footprints == []
    assert {lamp.direction for lamp in surfaces.lamps} == {(0, 0, -1)}
    middle = drawn.lift.floor.centre
    for stamp in (0.0, 26.0, 36.0, 70.0, 90.0):
        height = cabin_height(RIDES, stamp, drawn.storey_m)
        scene = Scene.of(bodies[0].corners(stamp))
        down = np.array([[*middle, height + 1.0]]), np.array([[0.0, 0.0, -1.0]])
        assert scene.distances(*down)[0] == pytest.approx(1.0, abs=1e-3)
        for panel in bodies[1:3]:
            low = float(panel.corners(stamp)[..., 2].min())
            assert low == pytest.approx(height, abs=1e-6)
    inner = np.concatenate([body.corners(26.0) for body in bodies[:3]])[..., :2]
    assert drawn.lift.floor.distance(inner.reshape(-1, 2)).max() < 1e-6


@pytest.mark.parametrize("case", CASES)
def test_from_the_closed_cabin_nothing_else_is_seen(case):
    drawn, _, bodies = elevator(*case)
    scene = Scene.of(np.concatenate([body.corners(26.0) for body in bodies[:3]]))
    way = np.random.default_rng(0).normal(size=(4000, 3))
    eye = (*drawn.lift.floor.centre, cabin_height(RIDES, 26.0, drawn.storey_m) + 1.2)
    seen = np.isinf(scene.distances(np.tile(eye, (len(way), 1)), way))
    assert seen.mean() < 0.01


@pytest.mark.parametrize("case", CASES)
def test_call_buttons_hang_outside_beside_the_doors(case):
    drawn, _, _ = elevator(*case)
    for door in lift_doors(drawn):
        surfaces = Surfaces(np.random.default_rng(0))
        surround(surfaces, door, drawn.lift, surfaces.rng)
        buttons, number = (quad.corners.mean(axis=0) for quad in surfaces.quads)
        assert abs(buttons[1] - door.xy[1]) > door.width_m / 2
        assert 0.9 < buttons[2] - door.base_m < 1.4
        assert number[2] - door.base_m > door.height_m
        for middle in (buttons, number):
            assert (middle[0] - door.xy[0]) * drawn.lift.door_side > 0.07
