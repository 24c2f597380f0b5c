"""Whole houses at two visits: the building stays, what is in it changes."""

from __future__ import annotations

from collections import Counter

import cv2
import numpy as np
import pytest

from roomgraph.datasets.synthetic.building import Building, build
from roomgraph.datasets.synthetic.furnishing.furnish import TWINS, circumstances, furnish_room
from roomgraph.datasets.synthetic.motion.free_space import CELL_M, CLOSEST_M, free_space
from roomgraph.datasets.synthetic.plans.layout import Doorway, Rectangle, Room
from roomgraph.datasets.synthetic.plans.registry import PLANS
from roomgraph.datasets.synthetic.rendering.mesh import Surfaces
from tests.datasets.synthetic.furnishing.helpers import building
from tests.datasets.synthetic.plans.helpers import SHAFTS, inside, plan

pytestmark = pytest.mark.slow

SEEDS = (1, 2)


def corners(building: Building, name: str) -> list[np.ndarray]:
    """Return the corners of all things of a class, each as one array."""
    return [
        np.array([quad.corners for quad in building.quads[thing.quads]])
        for thing in building.things
        if thing.name == name
    ]


def walls(building: Building) -> set[bytes]:
    """Return the upright strips of a building that reach the ceiling of their room."""
    tops = {round(room.base_m + room.ceiling_m, 6) for room in building.rooms}
    return {
        np.round(quad.corners, 6).tobytes()
        for quad in building.quads
        if round(float(quad.corners[:, 2].max()), 6) in tops
        and float(np.ptp(quad.corners[:, 2])) > 1.0
    }


def without_states(building: Building) -> list[tuple[object, ...]]:
    return [
        (d.rooms, d.xy, d.along, d.width_m, d.height_m, d.kind, d.is_glass, d.hinge, d.level)
        for d in building.doorways
    ]


@pytest.mark.parametrize("seed", SEEDS)
def test_rooms_doorways_walls_and_windows_stay(seed):
    first, second = building(seed=seed), building(seed=seed, visit=1)
    assert first.rooms == second.rooms
    assert without_states(first) == without_states(second)
    assert first.leaves.keys() == second.leaves.keys()
    assert len(walls(first)) > 30
    assert walls(first) == walls(second)
    windows = corners(first, "window"), corners(second, "window")
    assert windows[0]
    for one, other in zip(*windows, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("seed", SEEDS)
def test_pieces_were_moved_and_pictures_changed(seed):
    first, second = building(seed=seed), building(seed=seed, visit=1)
    places = [Counter(np.round(o, 3).tobytes() for _, o in b.obstacles) for b in (first, second)]
    gone, new = places[0] - places[1], places[1] - places[0]
    assert gone.total() + new.total() >= 1
    assert (places[0] & places[1]).total() > 0.2 * places[0].total(), "most is where it was"
    assert not np.array_equal(first.sun, second.sun)


def test_door_states_pictures_and_lamps_change_between_the_visits_of_some_houses():
    states, pictures = [], []
    for seed in SEEDS:
        pair = building(seed=seed), building(seed=seed, visit=1)
        states.append(len({tuple(d.state for d in one.doorways) for one in pair}))
        images = [
            {
                quad.material.image.tobytes()
                for thing in one.things if thing.name == "picture"
                for quad in one.quads[thing.quads]
            }
            for one in pair
        ]  # fmt: skip
        pictures.append(bool(images[0] ^ images[1]))
    assert max(states) == 2
    assert any(pictures)


def test_the_same_visit_twice_is_the_same():
    one, again = building(seed=1, visit=1), build(1, "house", 1, 1)
    assert one.plan == again.plan
    assert one.things == again.things
    assert one.missing == again.missing
    for a, b in zip(one.quads, again.quads, strict=True):
        assert np.array_equal(a.corners, b.corners)
        assert a.window == b.window
        assert np.array_equal(a.material.image, b.material.image)
    np.testing.assert_array_equal(one.tint, again.tint)


def test_other_seeds_are_other_houses():
    one, other = (building(seed=seed) for seed in SEEDS)
    assert one.plan != other.plan
    assert Counter(t.name for t in one.things) != Counter(t.name for t in other.things)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("visit", [0, 1])
def test_all_doors_of_a_house_are_joined_by_free_floor(seed, visit):
    """Filled from the finished obstacles, leaves of doors among them."""
    made = building(seed=seed, visit=visit)
    space = free_space(made, 0)
    _, part = cv2.connectedComponents((space.clearance > CLOSEST_M).astype(np.uint8))
    found = set()
    for door in made.doorways:
        column, row = ((np.array(door.xy) - space.origin) / CELL_M).astype(int)
        found.add(int(part[row - 1 : row + 2, column - 1 : column + 2].max()))
    assert len(found) == 1
    assert found != {0}


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("visit", [0, 1])
def test_a_house_is_what_it_says(seed, visit):
    made = building(seed=seed, visit=visit)
    names = Counter(thing.name for thing in made.things)
    assert names["door"] == sum(made.doorways[k].state != "closed" for k in made.leaves)
    assert {d.kind for k, d in enumerate(made.doorways) if k in made.leaves} <= {"door"}
    assert {d.state for d in made.doorways if d.kind == "door"} <= {"open", "half", "closed"}
    assert {d.state for d in made.doorways if d.kind != "door"} <= {""}
    assert names["lamp"] >= len(made.rooms)
    leaves = len(made.leaves)
    rooms = [room.polygon for room in made.rooms]
    for level, outline in made.obstacles[: len(made.obstacles) - leaves]:
        assert level == 0
        assert max(inside(polygon, outline) for polygon in rooms) > -0.06
    for seat in made.seats:
        at = np.array([seat.origin[:2]])
        assert any(inside(polygon, at) > 0 for polygon in rooms)
    for quad in made.quads:
        assert np.isfinite(quad.corners).all()


def mean_looks(seed: int, has_twins: bool) -> list[np.ndarray]:
    """Return the walls' colours of the two bedrooms of a house whose seed is chosen so."""
    drawn = plan("house", 1, seed)
    now = circumstances(seed, 0, drawn)
    assert now.has_twins == has_twins
    bedrooms = [room for room in drawn.rooms if room.label == "bedroom"][:2]
    surfaces = Surfaces(np.random.default_rng(0))
    return [furnish_room(room, drawn, surfaces, now).finish.wall[:600] for room in bedrooms]


def seed_with(has_twins: bool) -> int:
    return next(
        seed for seed in range(40)
        if circumstances(seed, 0, plan("house", 1, seed)).has_twins == has_twins
        and sum(room.label == "bedroom" for room in plan("house", 1, seed).rooms) > 1
    )  # fmt: skip


def test_rooms_of_a_kind_look_alike_in_some_buildings_only():
    one, other = mean_looks(seed_with(True), True)
    rows = min(len(one), len(other))
    assert np.abs(one[:rows].mean((0, 1)) - other[:rows].mean((0, 1))).max() < 3
    one, other = mean_looks(seed_with(False), False)
    rows = min(len(one), len(other))
    assert not np.array_equal(one[:rows], other[:rows])


def test_twins_share_their_streams_and_others_do_not():
    shares = []
    for seed in range(40):
        now = circumstances(seed, 0, plan("house", 1, 0))
        shares.append(now.has_twins)
        here, there = (Room(f"{k}1", k, Rectangle(0, 0, 3, 3)) for k in ("bedroom", "kitchen"))
        for room, label in ((here, "bedroom"), (there, "kitchen")):
            twin = Room(f"{label}2", label, Rectangle(4, 0, 7, 3))
            is_same = now.stream(room, 2) == now.stream(twin, 2)
            assert is_same == (now.has_twins and label in TWINS)
            assert now.stream(room, 2) != now.stream(room, 3)
            later = circumstances(seed, 1, plan("house", 1, 0))
            assert later.stream(room, 2) == now.stream(room, 2)
            assert later.stream(room, 3, by_visit=True) != now.stream(room, 3, by_visit=True)
    assert 0.2 < np.mean(shares) < 0.8


def test_there_are_homes_and_offices():
    homes = {
        kind: np.mean([circumstances(seed, 0, plan(kind, 1, 0)).is_home for seed in range(40)])
        for kind in ("house", "suite", "open", "ring")
    }
    assert homes["house"] == 1
    assert 0.3 < homes["suite"] < 0.9
    assert homes["open"] == homes["ring"] == 0


def test_the_corridor_plan_is_built_as_it_always_was():
    made = building(kind="corridor", seed=3)
    assert made.plan == PLANS["corridor"](np.random.default_rng((3, 0)), 1)
    assert len(made.footprints) > 20
    assert list(made.obstacles) == []
    assert made.leaves == {}
    assert not any(room.label in SHAFTS for room in made.rooms)
    assert isinstance(made.doorways[0], Doorway)
