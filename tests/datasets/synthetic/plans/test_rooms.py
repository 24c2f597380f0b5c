"""Rooms of all floor plans: where they lie, how they hang together, which there are."""

from __future__ import annotations

from collections import Counter, defaultdict
from itertools import combinations, pairwise

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.layout import WALL_M, FloorPlan, Room
from roomgraph.datasets.synthetic.plans.registry import PLANS
from tests.datasets.synthetic.plans.helpers import FLOORS, KINDS, SHAFTS, gaps, plan, plans

NEEDED = {
    "ring": Counter(corridor=1, office=2, meeting_room=1, kitchen=1, bathroom=1),
    "suite": Counter(hall=1, living_room=1, office=1, bedroom=1, kitchen=1, bathroom=1),
    "open": Counter(office=2, printer_area=1, meeting_room=1, bathroom=1, store_room=1),
    "house": Counter(hall=1, living_room=1, kitchen=1, dining_room=1, bathroom=1, bedroom=2),
}
SMALLEST_M = 1.4


def neighbours(drawn: FloorPlan) -> dict[str, set[str]]:
    """Return what each room can be left for; the parts of a shaft are joined in their order."""
    found: dict[str, set[str]] = defaultdict(set)
    pairs = [door.rooms for door in drawn.doorways]
    for shaft in (drawn.stairs, drawn.lift):
        if shaft is not None:
            pairs += pairwise(room.key for room in drawn.rooms if room.name == shaft.name)
    for a, b in pairs:
        found[a].add(b)
        found[b].add(a)
    return found


def reached(drawn: FloorPlan, begin: str) -> set[str]:
    ways, seen, ahead = neighbours(drawn), {begin}, [begin]
    while ahead:
        new = ways[ahead.pop()] - seen
        seen |= new
        ahead += new
    return seen


@pytest.mark.parametrize("kind", KINDS)
def test_rooms_of_a_level_have_a_wall_between_them_or_an_opening_as_wide(kind):
    for drawn in plans(kind):
        joined = {frozenset(door.rooms) for door in drawn.doorways if door.kind == "open"}
        for a, b in combinations(drawn.rooms, 2):
            if a.level != b.level:
                continue
            x, y = gaps(a.floor, b.floor)
            assert max(x, y) > -1e-9, (a.key, b.key)
            face_each_other = min(x, y) < -1e-9
            if face_each_other and frozenset((a.key, b.key)) not in joined:
                assert max(x, y) > WALL_M - 1e-9, (a.key, b.key)


@pytest.mark.parametrize("kind", KINDS)
def test_every_room_can_be_reached_from_the_first(kind):
    for drawn in plans(kind):
        keys = [room.key for room in drawn.rooms]
        assert len(set(keys)) == len(keys)
        assert reached(drawn, keys[0]) == set(keys)


@pytest.mark.parametrize("kind", KINDS)
def test_a_room_has_its_name_on_one_level_and_heights_that_fit(kind):
    for drawn in plans(kind):
        for room in drawn.rooms:
            assert room.base_m == pytest.approx(room.level * drawn.storey_m)
            if room.label not in SHAFTS:
                assert 2.4 <= room.ceiling_m <= 3.5
                assert room.ceiling_m < drawn.storey_m
        levels = defaultdict(set)
        for room in drawn.rooms:
            levels[room.name].add(room.level)
        shafts = {shaft.name for shaft in (drawn.stairs, drawn.lift) if shaft}
        for name, there in levels.items():
            assert there == set(range(drawn.levels)) if name in shafts else len(there) == 1


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("floors", FLOORS)
def test_shafts_are_the_same_rectangle_on_all_levels(kind, floors):
    drawn = plan(kind, floors, 3)
    assert drawn.levels == floors
    if floors == 1:
        assert drawn.stairs is None
        assert drawn.lift is None
        assert not any(room.label in SHAFTS for room in drawn.rooms)
        return
    for shaft, label in ((drawn.stairs, "stairwell"), (drawn.lift, "elevator")):
        assert shaft is not None
        cells = [room.floor for room in drawn.rooms if room.label == label]
        assert cells == [shaft.floor] * floors


def is_odd(room: Room) -> bool:
    return bool(room.outline)


@pytest.mark.parametrize("kind", KINDS)
def test_outlines_are_convex_counter_clockwise_and_inside_their_cells(kind):
    odd = [room for drawn in plans(kind) for room in drawn.rooms if is_odd(room)]
    assert odd
    for room in odd:
        corners = room.polygon
        side = np.roll(corners, -1, axis=0) - corners
        after = np.roll(side, -1, axis=0)
        assert (side[:, 0] * after[:, 1] - side[:, 1] * after[:, 0] > 0).all()
        assert room.floor.distance(corners).max() < 1e-9
        assert np.linalg.norm(side, axis=1).min() > 0.3


@pytest.mark.parametrize("kind", KINDS)
def test_some_seeds_have_slanting_walls_and_some_have_none(kind):
    share = np.mean([any(is_odd(room) for room in drawn.rooms) for drawn in plans(kind)])
    assert 0.2 < share < 0.7


@pytest.mark.parametrize("kind", KINDS)
def test_the_rooms_that_such_a_building_needs_are_there(kind):
    lacking = []
    for drawn in plans(kind):
        there = Counter(room.label for room in drawn.rooms if not room.part)
        lacking += [NEEDED[kind] - there] if NEEDED[kind] - there else []
    assert lacking == []


@pytest.mark.parametrize("kind", KINDS)
def test_no_room_is_too_narrow_to_be_used(kind):
    for drawn in plans(kind):
        for room in drawn.rooms:
            r = room.floor
            least = SMALLEST_M if room.label in ("corridor", "hall", *SHAFTS) else 2.2
            assert min(r.x1 - r.x0, r.y1 - r.y0) >= least, (room.key, r)


@pytest.mark.parametrize("kind", PLANS)
def test_the_same_seed_gives_the_same_plan_and_another_one_another(kind):
    draw = PLANS[kind]
    for floors in FLOORS if kind != "corridor" else (1,):
        one = draw(np.random.default_rng(5), floors)
        assert one == draw(np.random.default_rng(5), floors)
        assert one != draw(np.random.default_rng(6), floors)
        assert one.kind == kind


def test_room_at_and_level_at_find_the_middle_of_every_room():
    for kind in KINDS:
        drawn = plan(kind, 2, 1)
        for room in drawn.rooms:
            assert drawn.room_at(room.floor.centre, room.level) is room
            assert drawn.level_at(room.base_m + 1.4) == room.level
        assert drawn.level_at(-0.5) == 0
        assert drawn.level_at(99.0) == 1
