"""Doorways of all floor plans: they lie in the wall between their two rooms, one beside another."""

from __future__ import annotations

from collections import Counter
from itertools import combinations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.draft import JAMB_M, Draft
from roomgraph.datasets.synthetic.plans.layout import WALL_M, Rectangle
from tests.datasets.synthetic.plans.helpers import AXIS, KINDS, SHAFTS, opening, plans, span

# The doors of a shaft are where its landing is: a little nearer to the corner.
SHAFT_JAMB_M = 0.15


@pytest.mark.parametrize("kind", KINDS)
def test_a_doorway_lies_in_the_wall_between_its_rooms(kind):
    for drawn in plans(kind):
        for door in drawn.doorways:
            first, second = (drawn.room(key) for key in door.rooms)
            assert first.level == second.level == door.level
            assert door.base_m == pytest.approx(first.base_m)
            across = 1 - AXIS[door.along]
            across_name = "xy"[across]
            spans = sorted(span(room.floor, across_name) for room in (first, second))
            below, above = spans[0][1], spans[1][0]
            assert (below + above) / 2 == pytest.approx(door.xy[across])
            thick = (0.0, WALL_M) if door.kind == "open" else (WALL_M,)
            assert any(above - below == pytest.approx(t, abs=1e-9) for t in thick)


@pytest.mark.parametrize("kind", KINDS)
def test_a_doorway_is_wide_enough_and_keeps_away_from_the_corners(kind):
    for drawn in plans(kind):
        for door in drawn.doorways:
            assert door.width_m >= 0.8
            assert door.height_m > 1.9
            rooms = [drawn.room(key) for key in door.rooms]
            assert door.height_m <= min(room.ceiling_m for room in rooms) + 1e-9
            is_shaft = any(room.label in SHAFTS for room in rooms)
            jamb = 0.0 if door.kind == "open" else SHAFT_JAMB_M if is_shaft else JAMB_M
            begin, end = opening(door)
            for room in rooms:
                low, high = span(room.floor, door.along)
                assert begin >= low + jamb - 1e-9
                assert end <= high - jamb + 1e-9


@pytest.mark.parametrize("kind", KINDS)
def test_doorways_of_a_wall_do_not_overlap(kind):
    for drawn in plans(kind):
        for a, b in combinations(drawn.doorways, 2):
            across = 1 - AXIS[a.along]
            if (a.level, a.along) == (b.level, b.along) and abs(a.xy[across] - b.xy[across]) < 0.2:
                (begin, end), (other_begin, other_end) = opening(a), opening(b)
                assert end < other_begin + 1e-9 or other_end < begin + 1e-9


@pytest.mark.parametrize("kind", KINDS)
def test_walls_with_openings_are_not_turned(kind):
    """Both ends of an opening lie on a side of its rooms' polygons, wherever walls slant."""
    for drawn in plans(kind):
        for door in drawn.doorways:
            across = 1 - AXIS[door.along]
            for room in (drawn.room(key) for key in door.rooms):
                corners = room.polygon
                begin, end = opening(door)
                on_wall = corners[np.abs(corners[:, across] - door.xy[across]) < WALL_M / 2 + 1e-6]
                assert len(on_wall) == 2, (room.key, door)
                low, high = np.sort(on_wall[:, AXIS[door.along]])
                assert low - 1e-9 <= begin < end <= high + 1e-9


@pytest.mark.parametrize("kind", KINDS)
def test_each_level_has_a_door_to_each_shaft(kind):
    for drawn in plans(kind):
        if drawn.levels == 1:
            continue
        for shaft, door_kind in ((drawn.stairs, "jamb"), (drawn.lift, "lift")):
            keys = {room.key for room in drawn.rooms if room.name == shaft.name}
            doors = [door for door in drawn.doorways if door.rooms[1] in keys]
            assert sorted(door.level for door in doors) == list(range(drawn.levels))
            assert {door.kind for door in doors} == {door_kind}
            assert len({door.xy for door in doors}) == 1


def test_there_are_doors_of_all_kinds():
    seen = Counter(door.kind for kind in KINDS for drawn in plans(kind) for door in drawn.doorways)
    assert set(seen) == {"jamb", "door", "passage", "open", "lift"}
    doors = [d for kind in KINDS for drawn in plans(kind) for d in drawn.doorways if d.state]
    assert doors == [], "how a leaf stands belongs to a visit, not to the plan"
    glass = [d.is_glass for kind in KINDS for p in plans(kind) for d in p.doorways if d.is_glass]
    assert 0.05 < len(glass) / seen["door"] < 0.4
    leaves = [d for kind in KINDS for p in plans(kind) for d in p.doorways if d.kind != "door"]
    assert not any(d.is_glass for d in leaves)


def draft() -> Draft:
    return Draft(np.random.default_rng(0), 1)


def test_rooms_that_share_no_wall_or_too_short_a_one_are_not_joined():
    made = draft()
    here = made.room("office", Rectangle(0, 0, 3, 3), 0)
    far = made.room("office", Rectangle(5, 0, 8, 3), 0)
    short = made.room("office", Rectangle(3 + WALL_M, 2, 6, 5), 0)
    beside = made.room("office", Rectangle(0, 3 + WALL_M, 3, 6), 0)
    assert not made.join(here, far)
    assert not made.join(here, short)
    assert made.doorways == []
    assert made.join(here, beside, "door")
    (door,) = made.doorways
    assert door.rooms == ("office1", "office4")
    assert door.along == "x"
    assert door.xy[1] == pytest.approx(3 + WALL_M / 2)


def test_parts_of_a_room_share_its_name_but_not_its_key():
    made = draft()
    first = made.room("corridor", Rectangle(0, 0, 3, 1), 0)
    second = made.room("corridor", Rectangle(3, 0, 4, 5), 0, of=first)
    assert (first.key, second.key) == ("corridor1", "corridor1.1")
    assert second.name == first.name
    assert made.join(first, second, "open")
    assert made.doorways[0].width_m == pytest.approx(1.0)
