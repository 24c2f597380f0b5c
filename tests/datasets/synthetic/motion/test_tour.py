"""The tour through every room."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.free_space import CLOSEST_M, free_space, is_shaft
from roomgraph.datasets.synthetic.motion.tour import plan_tour
from tests.datasets.synthetic.worlds import TWO_ROOMS, house, suite


def test_a_small_tour_sees_both_rooms_and_returns():
    building = Building(0, TWO_ROOMS, (), np.zeros((0, 4)), ())
    (leg,) = plan_tour(building).legs
    np.testing.assert_allclose(leg[0], leg[-1], atol=0.08)
    np.testing.assert_allclose(leg[0, :2], TWO_ROOMS.rooms[0].floor.centre, atol=0.08)
    assert not leg[:, 2].any()
    for room in TWO_ROOMS.rooms:
        inside = leg[room.floor.distance(leg[:, :2]) == 0]
        # 12 square metres: two places, far from each other.
        assert np.ptp(inside[:, 0]) > 1.8


@pytest.mark.slow
def test_one_floor_is_one_leg_that_closes():
    (leg,) = plan_tour(suite().building).legs
    np.testing.assert_allclose(leg[-1], leg[0], atol=1e-9)
    steps = np.linalg.norm(np.diff(leg, axis=0), axis=1)
    assert steps.max() < 0.15
    assert free_space(suite().building, 0).is_free(leg[:, :2]).all()
    again = plan_tour(suite().building).legs[0]
    assert np.array_equal(again, leg)


@pytest.mark.slow
def test_two_floors_are_two_legs_up_the_stairs_and_from_the_elevator():
    building = house().building
    plan = building.plan
    up, back = plan_tour(building).legs
    np.testing.assert_allclose(up[-1, :2], back[0, :2], atol=1e-9)
    assert plan.lift.floor.distance(up[-1:, :2])[0] == 0
    assert (up[-1, 2], back[0, 2]) == (pytest.approx(plan.storey_m), 0)
    assert (np.diff(up[:, 2]) >= -1e-9).all()
    assert not back[:, 2].any()
    np.testing.assert_allclose(back[-1], up[0], atol=1e-9)
    between = up[(up[:, 2] > 0.01) & (up[:, 2] < plan.storey_m - 0.01)]
    assert len(between)
    assert plan.stairs.floor.distance(between[:, :2]).max() == 0


@pytest.mark.slow
def test_every_room_is_entered_over_free_floor():
    building = house().building
    tour = np.concatenate(plan_tour(building).legs)
    shafts = [building.plan.stairs.floor, building.plan.lift.floor]
    for level in range(2):
        flat = tour[np.abs(tour[:, 2] - level * building.plan.storey_m) < 1e-6]
        # Before and in the doors of the shafts the way is laid without the grid.
        away = np.min([floor.distance(flat[:, :2]) for floor in shafts], axis=0) > 1.3
        space = free_space(building, level)
        assert space.is_free(flat[away, :2], CLOSEST_M - 1e-6).all()
        for room in building.rooms:
            if room.level == level and not is_shaft(room):
                inside = room.floor.distance(flat[:, :2]) == 0
                assert inside.any(), room.key
                assert np.linalg.norm(np.ptp(flat[inside, :2], axis=0)) > 0.5, room.key
