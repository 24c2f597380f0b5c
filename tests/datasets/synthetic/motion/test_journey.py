"""The journey frame by frame: rooms, clearance, speed, stairs, elevator."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from roomgraph.datasets.synthetic.motion.free_space import free_space, is_shaft
from roomgraph.datasets.synthetic.motion.journey import travel
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.structure.elevator import DOORS_S
from tests.datasets.synthetic.worlds import HOUSE, SMALL, house, suite, turns_deg

pytestmark = pytest.mark.slow

ROBOT = BuildingSettings(seed=3, plan="suite", **SMALL)
CLEAR_M = 0.12


@pytest.fixture(scope="module")
def journeys():
    """The house's journey, and a robot's through the suite, with their buildings and settings."""
    building = suite().building
    return [
        (house().building, house().journey, HOUSE),
        (building, travel(building, ROBOT), ROBOT),
    ]


def places_of(building, journey):
    """The room of each frame, by name and level."""
    levels = np.rint(journey.floor_m / building.plan.storey_m).astype(int)
    return [
        building.room_at(xy, int(level))
        for xy, level in zip(journey.trajectory.positions[:, :2], levels, strict=True)
    ]


def test_every_room_of_every_level_is_visited(journeys):
    for building, journey, _ in journeys:
        visited = {(room.name, room.level) for room in places_of(building, journey)}
        assert visited == {(room.name, room.level) for room in building.rooms}


def test_no_frame_is_too_far_from_the_one_before(journeys):
    for _, journey, settings in journeys:
        T = journey.trajectory.T_world_camera
        assert len(T) > 1000
        np.testing.assert_allclose(np.diff(journey.trajectory.stamps_s), 1 / settings.rate_hz)
        np.testing.assert_allclose(T[-1], T[0], atol=1e-9)
        steps = np.linalg.norm(np.diff(T[:, :3, 3], axis=0), axis=1)
        assert steps.max() <= 1.05 * settings.step_m
        # It does use what it may.
        assert np.percentile(steps, 75) > 0.4 * settings.step_m
        assert turns_deg(T).max() <= settings.turn_deg
        height = T[:, 2, 3] - journey.floor_m
        assert np.abs(height - settings.camera_height_m).max() < 0.01
        assert T[:, 2, 1].max() < -0.99


def test_the_grid_says_that_it_keeps_clear(journeys):
    for building, journey, _ in journeys:
        rooms = places_of(building, journey)
        for level in range(building.plan.levels):
            on = np.array([room.level == level and not is_shaft(room) for room in rooms])
            xy = journey.trajectory.positions[on, :2]
            # The grid ends at the doors of stairs and elevators.
            for door in building.doorways:
                if is_shaft(building.plan.room(door.rooms[1])):
                    xy = xy[np.linalg.norm(xy - door.xy, axis=1) > 0.25]
            free = free_space(building, level).is_free(xy, CLEAR_M)
            assert free.all(), xy[~free][:3]


def test_rays_say_that_it_keeps_clear(journeys):
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    around = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    for building, journey, _ in journeys:
        scene, positions = Scene(building.quads), journey.trajectory.positions[::3].copy()
        for height in (0.3, 0.8, 1.3):
            positions[:, 2] = journey.floor_m[::3] + height
            origins = np.repeat(positions, 24, axis=0)
            far = scene.distances(origins, np.tile(around, (len(positions), 1)))
            assert far.min() >= CLEAR_M


def test_doors_that_move_never_touch_the_camera():
    world, angles = house(), np.linspace(0, 2 * np.pi, 24, endpoint=False)
    around = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    trajectory, met = world.trajectory, 0
    for index in range(0, len(trajectory), 6):
        stamp, eye = float(trajectory.stamps_s[index]), trajectory.positions[index]
        for body in world.animation.bodies:
            if np.linalg.norm(body.centre(stamp) - eye) < 1.5:
                met += 1
                scene = Scene.of(body.corners(stamp))
                assert scene.distances(np.tile(eye, (24, 1)), around).min() > CLEAR_M
    assert met > 50


def test_stairs_lead_up_one_storey():
    world = house()
    storey, floor_m = world.building.plan.storey_m, world.journey.floor_m
    (ride,) = world.journey.rides
    before = floor_m[: int(ride.closing_s * world.settings.rate_hz)]
    assert (np.diff(before) >= -1e-9).all()
    assert (before[0], before[-1]) == (0, pytest.approx(storey))
    climbing = np.flatnonzero((before > 0.01) & (before < storey - 0.01))
    assert len(climbing) > 40
    inside = world.building.plan.stairs.floor.distance(world.trajectory.positions[climbing, :2])
    assert inside.max() == 0
    # The treads are where the feet are: nearly half a metre above the lowest, never through them.
    scene = Scene(world.building.quads)
    eyes = world.trajectory.positions[climbing]
    down = scene.distances(eyes, np.tile([0.0, 0.0, -1.0], (len(eyes), 1)))
    assert np.abs(down - world.settings.camera_height_m).max() < 0.25


def test_the_camera_stands_still_in_a_closed_cabin_that_goes_down():
    world = house()
    plan, trajectory, floor_m = world.building.plan, world.trajectory, world.journey.floor_m
    (ride,) = world.journey.rides
    stamps = trajectory.stamps_s
    riding = (stamps >= ride.closing_s) & (stamps <= ride.arrived_s + DOORS_S - 0.05)
    xy = trajectory.positions[riding, :2]
    assert np.abs(xy - xy[0]).max() < 1e-9
    assert plan.lift.floor.distance(xy).max() == 0
    names = np.array(world.animation.names)
    cabin = world.animation.bodies[int(np.flatnonzero(names == "elevator")[0])]
    panels = world.animation.bodies[int(np.flatnonzero(names == "elevator")[0]) + 1 :][:2]
    moved = 0
    for stamp, floor in zip(stamps[riding], floor_m[riding], strict=True):
        assert cabin.corners(stamp)[..., 2].min() == pytest.approx(floor, abs=1e-6)
        if 0.001 < floor < plan.storey_m - 0.001:
            moved += 1
            assert gap(panels, stamp) < 0.01
            assert all(ride.opened(stamp, level) == 0 for level in range(plan.levels))
    assert moved > 60
    assert gap(panels, ride.closing_s) > 0.7
    assert gap(panels, ride.arrived_s + DOORS_S) > 0.7
    # It goes without a jerk, at the speed of an elevator.
    speed = np.abs(np.diff(floor_m[riding])) * world.settings.rate_hz
    assert 1.0 < speed.max() < 2.0
    assert np.abs(np.diff(speed)).max() < 0.25


def gap(panels, stamp_s):
    """How far the two halves of a sliding door are apart, along y."""
    low, high = sorted(panels, key=lambda panel: panel.centre(stamp_s)[1])
    return low.corners(stamp_s)[..., 1].max() * -1 + high.corners(stamp_s)[..., 1].min()


def test_the_elevator_is_open_when_one_goes_in_or_out():
    world = house()
    (ride,), trajectory = world.journey.rides, world.trajectory
    doors = {door.level: door for door in world.building.doorways if door.kind == "lift"}
    passed = set()
    for index, (stamp, xy) in enumerate(
        zip(trajectory.stamps_s, trajectory.positions[:, :2], strict=True)
    ):
        level = world.level_of(index)
        if (np.abs(xy - doors[level].xy) < (0.1, doors[level].width_m / 2)).all():
            passed.add(level)
            assert ride.opened(stamp, level) == 1
            assert ride.opened(stamp) == 1
    assert passed == {0, 1}


def test_frames_give_the_beginning(journeys):
    building, whole, settings = journeys[1]
    short = travel(building, settings.model_copy(update={"frames": 40}))
    assert len(short.trajectory) == len(short.floor_m) == 40
    np.testing.assert_allclose(
        short.trajectory.T_world_camera, whole.trajectory.T_world_camera[:40], atol=1e-9
    )


def test_laps_repeat_the_way(journeys):
    building, once, settings = journeys[0]
    twice = travel(building, settings.model_copy(update={"laps": 2}))
    first, second = twice.rides
    count = len(once.trajectory)
    # The end of a lap is the beginning of the next.
    assert len(twice.trajectory) == 2 * count - 1
    np.testing.assert_allclose(
        twice.trajectory.positions[count - 1 :, :2], once.trajectory.positions[:, :2], atol=1e-6
    )
    np.testing.assert_allclose(twice.floor_m[:count], once.floor_m, atol=1e-9)
    np.testing.assert_allclose(twice.floor_m[count - 1 :], once.floor_m, atol=1e-3)
    assert second.called_s - first.called_s == pytest.approx((count - 1) / settings.rate_hz)
    times = [first.called_s, first.closing_s, first.arrived_s, first.left_s + DOORS_S]
    assert all(a < b for a, b in pairwise([*times, second.called_s]))
    T = twice.trajectory.T_world_camera
    np.testing.assert_allclose(T[-1], T[0], atol=1e-9)
    assert turns_deg(T).max() <= settings.turn_deg


def test_larger_steps_make_fewer_frames(journeys):
    building, once, settings = journeys[1]
    fast = travel(building, settings.model_copy(update={"step_m": 0.2, "turn_deg": 12.0}))
    assert len(fast.trajectory) < 0.5 * len(once.trajectory)
    steps = np.linalg.norm(np.diff(fast.trajectory.positions, axis=0), axis=1)
    assert steps.max() <= 1.05 * 0.2
    assert turns_deg(fast.trajectory.T_world_camera).max() <= 12
