"""A world as a whole: what is recorded of it, and that it is the same every time."""

from __future__ import annotations

import numpy as np
import pytest
from pydantic import ValidationError

from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.world import make_world
from tests.datasets.synthetic.worlds import SUITE, house, suite


@pytest.mark.slow
def test_the_number_of_frames_only_cuts_the_recording():
    whole, short = suite(), make_world(SUITE.model_copy(update={"frames": 5}))
    assert len(short.trajectory) == 5
    assert np.array_equal(short.journey.trajectory.T_world_camera,
                          whole.journey.trajectory.T_world_camera)  # fmt: skip
    assert short.stretches == whole.stretches
    assert len(whole.trajectory) == len(whole.journey.trajectory)
    for one, other in zip(short.animation.people, whole.animation.people, strict=True):
        assert np.array_equal(one.corners(7.3), other.corners(7.3))
    for a, b in zip(short.building.quads, whole.building.quads, strict=True):
        assert np.array_equal(a.corners, b.corners)


@pytest.mark.slow
def test_a_hand_stays_near_the_planned_way_and_has_its_mishaps():
    world = suite()
    off = world.journey.trajectory.positions - world.planned.positions
    assert 0.005 < np.linalg.norm(off, axis=1).max() < 0.13
    assert {stretch.kind for stretch in world.stretches} == {
        "fast_turn", "look_down", "shake", "cover",
    }  # fmt: skip
    assert not house().stretches
    assert house().journey.trajectory is house().planned


@pytest.mark.slow
def test_motion_and_levels_are_those_of_the_frames():
    for world in (suite(), house()):
        T = world.trajectory.T_world_camera[10:400:13]
        stamps = world.trajectory.stamps_s[10:400:13]
        np.testing.assert_allclose(world.motion.poses(stamps), T, atol=1e-9)
    world = house()
    z, storey = world.trajectory.positions[:, 2], world.building.plan.storey_m
    levels = np.array([world.level_of(index) for index in range(len(z))])
    assert set(levels) == {0, 1}
    # Half a storey above the camera's height on the lower floor is where the levels change.
    middle = world.settings.camera_height_m + storey / 2
    clear = np.abs(z - middle) > 0.02
    assert np.array_equal(levels[clear], (z > middle)[clear])


@pytest.mark.slow
def test_closed_doors_are_open_while_the_camera_is_in_them():
    world = house()
    trajectory, checked = world.trajectory, 0
    bodies = iter(world.animation.bodies)
    for number in world.building.leaves:
        door = world.building.doorways[number]
        if door.state != "closed":
            continue
        leaf = next(bodies)
        near = np.linalg.norm(trajectory.positions[:, :2] - door.xy, axis=1) < 0.3
        near &= np.abs(world.journey.floor_m - door.base_m) < 0.5
        across = 1 if door.along == "x" else 0
        for stamp in trajectory.stamps_s[near][::2]:
            # An open leaf sticks out of the wall by most of its width.
            assert np.ptp(leaf.corners(stamp)[..., across]) > 0.7 * door.width_m
            checked += 1
        assert np.ptp(leaf.corners(0.0)[..., across]) < 0.2
    assert checked > 25


def test_a_corridor_has_one_floor_and_one_visit():
    for wrong in ({"floors": 2}, {"visit": 1}, {"floors": 3, "visit": 2}):
        with pytest.raises(ValidationError, match="corridor"):
            BuildingSettings(**wrong)
        assert BuildingSettings(plan="ring", **wrong)
    for wrong in ({"plan": "tower"}, {"floors": 0}, {"people": -1}, {"sensor": "sonar"}):
        with pytest.raises(ValidationError):
            BuildingSettings(**wrong)


def test_a_hand_walks_slower_unless_told_otherwise():
    robot, hand = BuildingSettings(plan="suite"), BuildingSettings(plan="suite", hand=True)
    assert (robot.step_m, robot.turn_deg, robot.camera_height_m) == (0.08, 4.1, 0.8)
    assert (hand.step_m, hand.turn_deg, hand.camera_height_m) == (0.035, 2.5, 1.4)
    given = BuildingSettings(plan="suite", hand=True, step_m=0.06)
    assert (given.step_m, given.turn_deg) == (0.06, 2.5)
    assert BuildingSettings(plan="suite", hand=True, step_m=0.08).step_m == 0.08


def test_who_has_real_optics():
    cases = (
        ({}, False), ({"hand": True}, True), ({"sensor": "stereo"}, True),
        ({"sensor": "tof"}, True), ({"sensor": "clean"}, False),
        ({"hand": True, "optics": "ideal"}, False), ({"optics": "real"}, True),
    )  # fmt: skip
    for changes, real in cases:
        assert BuildingSettings(**changes).has_real_optics is real
        assert BuildingSettings(**changes).is_plain is (changes == {})
    assert BuildingSettings(seed=9, light="night", step_m=0.2, laps=2).is_plain
