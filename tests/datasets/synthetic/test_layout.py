"""Floor plans, furniture and the walk through them."""

from __future__ import annotations

from collections import Counter
from functools import lru_cache

import numpy as np
import pytest
from scipy.spatial import cKDTree

from roomgraph.datasets import se3
from roomgraph.datasets.synthetic.building import Building, build
from roomgraph.datasets.synthetic.motion.walk import find_way, walk
from roomgraph.datasets.synthetic.plans.corridor import plan_floor
from roomgraph.datasets.synthetic.plans.layout import WALL_M, Rectangle
from roomgraph.datasets.synthetic.rendering.mesh import Material, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.settings import BuildingSettings
from tests.datasets.synthetic.clearance import clearance

pytestmark = pytest.mark.slow

LABELS = {"corridor", "office", "laboratory", "kitchen", "bathroom", "elevator_area"}
CLEARANCE_M = 0.45
SEEDS = range(10)
GREY = Material(np.full((4, 4, 3), 128, np.uint8))


@lru_cache(maxsize=2)
def building(seed: int) -> Building:
    return build(seed)


@pytest.mark.parametrize("seed", SEEDS)
def test_plan_has_every_label_and_two_offices(seed):
    plan = plan_floor(np.random.default_rng((seed, 0)))
    counts = Counter(room.label for room in plan.rooms)
    assert set(counts) == LABELS
    assert counts["office"] >= 2
    names = [room.name for room in plan.rooms]
    assert len(set(names)) == len(names)
    assert {"office1", "office2", "corridor1"} <= set(names)


@pytest.mark.parametrize("seed", SEEDS)
def test_rooms_do_not_overlap_and_every_room_has_a_doorway(seed):
    plan = plan_floor(np.random.default_rng((seed, 0)))
    for i, a in enumerate(plan.rooms):
        for b in plan.rooms[i + 1 :]:
            gap_x = max(a.floor.x0, b.floor.x0) - min(a.floor.x1, b.floor.x1)
            gap_y = max(a.floor.y0, b.floor.y0) - min(a.floor.y1, b.floor.y1)
            assert max(gap_x, gap_y) > WALL_M - 1e-9, (a.name, b.name)
    assert {door.rooms[1] for door in plan.doorways} == {r.name for r in plan.rooms[1:]}
    for door in plan.doorways:
        distances = [plan.room(name).floor.distance(np.array(door.xy)) for name in door.rooms]
        assert distances == pytest.approx([WALL_M / 2] * 2)
        assert door.width_m >= 0.9


def test_room_at_knows_rooms_and_splits_doorways_in_the_middle():
    plan = building(0).plan
    for room in plan.rooms:
        assert plan.room_at(room.floor.centre) is room
        inside = Rectangle(*(room.floor.polygon[0] + 0.01), *(room.floor.polygon[2] - 0.01))
        assert all(plan.room_at(corner) is room for corner in inside.polygon)
    door = plan.doorways[1]
    step = 0.02 * np.sign(door.xy[1])
    assert plan.room_at((door.xy[0], door.xy[1] - step)).name == door.rooms[0]
    assert plan.room_at((door.xy[0], door.xy[1] + step)).name == door.rooms[1]


def test_same_seed_same_building_other_seed_another():
    first, again, other = build(4), build(4), build(5)
    assert first.plan == again.plan
    assert all(np.array_equal(a.corners, b.corners)
               and np.array_equal(a.material.image, b.material.image)
               for a, b in zip(first.quads, again.quads, strict=True))  # fmt: skip
    assert first.plan != other.plan


def test_offices_of_a_building_look_different():
    means = []
    for name in ("office1", "office2"):
        floor = building(2).plan.room(name).floor
        seen = [
            quad.material.image.mean(axis=(0, 1)) for quad in building(2).quads
            if floor.distance(quad.corners[:, :2].mean(axis=0)[None])[0] == 0
            and np.ptp(quad.corners[:, 2]) < 1e-6 and quad.corners[0, 2] == 0
        ]  # fmt: skip
        means.append(np.mean(seen, axis=0))
    assert np.abs(means[0] - means[1]).max() > 15


@pytest.mark.parametrize("seed", range(12))
def test_walks_through_the_two_offices_stay_far_apart(seed):
    """A topological map opens a second office only more than 5 m from the first."""
    way = find_way(building(seed)).xy[::5]
    names = np.array([building(seed).room_at(xy).name for xy in way])
    nearest, _ = cKDTree(way[names == "office1"]).query(way[names == "office2"])
    assert nearest.min() > 6.0


def test_boxes_and_prisms_face_outwards():
    surfaces = Surfaces(np.random.default_rng(0))
    stand = Stand(surfaces, (1.0, 2.0, 0.5), 0.7)
    for build_solid in (
        lambda: stand.box((-0.2, 0.3), (0.1, 0.5), (0.4, 0.9), GREY),
        lambda: stand.prism((0.0, 0.0), (0.2, 0.8), (0.2, 0.1), GREY),
    ):
        surfaces.quads.clear()
        build_solid()
        middle = np.mean([quad.corners.mean(axis=0) for quad in surfaces.quads], axis=0)
        for quad in surfaces.quads:
            c = quad.corners
            normal = np.cross(c[3] - c[0], c[1] - c[0])
            assert normal @ (c.mean(axis=0) - middle) > 0


@pytest.mark.parametrize("seed", SEEDS)
def test_walk_keeps_clear_of_walls_and_furniture(seed):
    way = find_way(building(seed))
    assert clearance(building(seed), way.xy).min() >= CLEARANCE_M


@pytest.mark.parametrize("seed", [0, 3, 8])
def test_walk_closes_is_smooth_and_visits_every_room(seed):
    settings = BuildingSettings(seed=seed)
    trajectory = walk(building(seed), settings)
    assert 55 < trajectory.length_m < 75
    assert 600 < len(trajectory) < 1000
    np.testing.assert_allclose(
        trajectory.T_world_camera[-1], trajectory.T_world_camera[0], atol=1e-9
    )
    visited = {building(seed).room_at(xy).name for xy in trajectory.positions[:, :2]}
    assert visited == {room.name for room in building(seed).rooms}
    T = trajectory.T_world_camera
    steps = se3.inverse(T[:-1]) @ T[1:]
    assert np.linalg.norm(steps[:, :3, 3], axis=1).max() <= settings.step_m * 1.01
    turns = [np.rad2deg(se3.rotation_angle(step)) for step in steps]
    assert max(turns) <= settings.turn_deg
    assert np.linalg.norm(np.diff(steps[:, :3, 3], axis=0), axis=1).max() < 0.035
    assert np.abs(trajectory.positions[:, 2] - 0.8).max() < 0.01
    # Camera axes: x right and level, y down, z forward.
    assert T[:, 2, 1].max() < -0.99
    assert np.abs(T[:, 2, 0]).max() < 0.02
    np.testing.assert_allclose(np.linalg.det(T[:, :3, :3]), 1.0)


def test_faster_walk_has_fewer_frames_and_two_laps_twice_as_many():
    one = walk(building(0), BuildingSettings())
    fast = walk(building(0), BuildingSettings(step_m=0.16, turn_deg=8))
    twice = walk(building(0), BuildingSettings(laps=2))
    assert len(fast) < 0.6 * len(one)
    assert len(twice) == 2 * len(one) - 1
    np.testing.assert_allclose(twice.T_world_camera[len(one) - 1 :], one.T_world_camera)
    np.testing.assert_allclose(np.diff(one.stamps_s), 1 / 30)


def test_clearance_sees_walls_furniture_and_doorways():
    floor = building(0).plan.room("bathroom1").floor
    near_wall = np.array([[floor.x0 + 0.1, floor.centre[1]]])
    assert clearance(building(0), near_wall)[0] <= 0.1 + 1e-9
    box = building(0).footprints[0]
    assert clearance(building(0), np.array([(box[0] + box[2], box[1] + box[3])]) / 2)[0] == 0
    for door in building(0).doorways:
        here = clearance(building(0), np.array([door.xy]))[0]
        assert here == pytest.approx(door.width_m / 2, abs=0.02)
