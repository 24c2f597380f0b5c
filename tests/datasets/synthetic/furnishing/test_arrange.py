"""Furnished rooms: nothing stands in anything, in a doorway, in a wall or before a window."""

from __future__ import annotations

from itertools import combinations
from unittest.mock import patch

import numpy as np
import pytest

from roomgraph.datasets.synthetic.furnishing import arrange
from roomgraph.datasets.synthetic.furnishing.plot import DOOR_ZONE_M, Plot
from roomgraph.datasets.synthetic.furnishing.programmes import PROGRAMMES
from tests.datasets.synthetic.furnishing.helpers import (
    bounds,
    every_room,
    pooled_piece,
    standing,
    zone,
)
from tests.datasets.synthetic.plans.helpers import KINDS, depth, inside, plans

pytestmark = pytest.mark.slow

# The floor is looked at in cells of 5 cm.
CELL_M = 0.05
MOST_MISSING = 0.05


@pytest.fixture(scope="module")
def plots() -> list[Plot]:
    return [made.plot for made, _ in every_room()]


def test_every_kind_of_room_has_a_programme():
    labels = {room.label for kind in KINDS for drawn in plans(kind) for room in drawn.rooms}
    assert labels - set(PROGRAMMES) == {"elevator"}


def test_hardly_any_room_lacks_what_it_needs():
    rooms = list(every_room())
    lacking = [(made.plot.room.key, missing) for made, missing in rooms if missing]
    assert len(rooms) > 60
    assert len(lacking) / len(rooms) < MOST_MISSING, lacking


def test_what_is_not_missing_is_there():
    for made, missing in every_room():
        there = {placed.piece.model for placed in made.plot.placed}
        items = PROGRAMMES[made.plot.room.label]
        needed = [item for item in items if item.chance >= 1]
        for item in needed:
            is_there = item.model in there or item.instead in there
            assert is_there != (item.model in missing)
        single = {item.model for item in items if item.most == 1}
        assert there <= {item.model for item in items} | {item.instead for item in items}
        for model in single - {item.instead for item in items}:
            named = sum(item.model == model for item in items)
            assert sum(placed.piece.model == model for placed in made.plot.placed) <= named


def test_solids_do_not_stand_in_each_other(plots):
    pairs = 0
    for plot in plots:
        for (one, a), (other, b) in combinations(standing(plot), 2):
            if one is not other:
                pairs += 1
                reach = depth(a, b)
                assert reach < CELL_M, (plot.room.key, one.piece.model, other.piece.model, reach)
    assert pairs > 1000


def test_solids_stand_inside_their_room(plots):
    for plot in plots:
        for placed, solid in standing(plot):
            reach = inside(plot.room.polygon, solid)
            assert reach > -2 * CELL_M, (plot.room.key, placed.piece.model, reach)


def test_nothing_stands_before_a_door(plots):
    for plot in plots:
        for wall in plot.walls:
            for gap in wall.face.gaps:
                deep = 0.4 if gap.doorway.kind == "open" else DOOR_ZONE_M
                before = zone(wall, (gap.begin, gap.end), deep)
                for placed, solid in standing(plot):
                    reach = depth(before, solid)
                    assert reach < CELL_M, (plot.room.key, placed.piece.model, reach)


def test_what_is_at_a_wall_is_beside_its_openings_and_under_its_ceiling(plots):
    for plot in plots:
        for placed in (p for p in plot.placed if p.wall >= 0):
            wall = plot.walls[placed.wall]
            begin, end, foot, head = bounds(placed)
            assert begin > 0
            assert end < wall.face.length
            assert head < plot.room.ceiling_m
            for gap in wall.face.gaps:
                is_beside = end <= gap.begin or begin >= gap.end
                assert is_beside or foot > gap.doorway.height_m, placed.piece.model


def test_nothing_at_a_wall_is_before_a_window(plots):
    windows = 0
    for plot in plots:
        for placed in (p for p in plot.placed if p.wall >= 0):
            begin, end, foot, head = bounds(placed)
            for window in plot.walls[placed.wall].windows:
                windows += 1
                is_beside = end <= window.begin or begin >= window.end
                assert is_beside or head <= window.sill or foot >= window.head
    assert windows > 100


def test_things_at_a_wall_do_not_cover_each_other(plots):
    for plot in plots:
        for one, other in combinations([p for p in plot.placed if p.wall >= 0], 2):
            if one.wall != other.wall:
                continue
            a, b = np.array(bounds(one)), np.array(bounds(other))
            common = np.minimum(a[[1, 3]], b[[1, 3]]) - np.maximum(a[[0, 2]], b[[0, 2]])
            assert common.min() < 0.01, (plot.room.key, one.piece.model, other.piece.model)


def test_a_piece_that_is_high_fits_under_the_ceiling_wherever_it_stands(plots):
    for plot in plots:
        top = plot.room.base_m + plot.room.ceiling_m
        for placed in plot.placed:
            head = placed.stand.origin[2] + float(placed.piece.high[2])
            assert head <= top, (plot.room.key, placed.piece.model, head - top)


def test_same_seed_same_room_other_seed_another(plots):
    drawn = {}
    for made, _ in every_room():
        key = (made.plot.room.label, made.seed)
        drawn.setdefault(key, [p.piece.model for p in made.plot.placed])
    for label in ("bathroom", "kitchen", "living_room"):
        kinds = {tuple(models) for (of, _), models in drawn.items() if of == label}
        assert len(kinds) > 1
    first, _ = next(every_room())
    again = type(first)(Plot(first.plot.room, first.plot.walls), first.look, first.seed)
    for wall in again.plot.walls:
        wall.standing.clear()
        wall.hanging.clear()
    with patch.object(arrange, "make_piece", pooled_piece):
        again.furnish()
    for one, other in zip(first.plot.placed, again.plot.placed, strict=True):
        assert one.piece.model == other.piece.model
        assert one.stand.origin == other.stand.origin
        np.testing.assert_array_equal(one.piece.high, other.piece.high)


def test_small_things_lie_on_tops(plots):
    count = 0
    for made, _ in every_room():
        if made.plot.room.label not in ("kitchen", "living_room", "office"):
            continue
        before = len(made.plot.placed)
        furniture = list(made.plot.placed)
        made.scatter(np.random.default_rng(5), 3.0)
        added = made.plot.placed[before:]
        del made.plot.placed[before:]
        for small in added:
            count += 1
            x, y, z = small.stand.origin
            height = z - made.plot.room.base_m
            assert 0.35 < height < 1.2
            below = [
                p for p in furniture
                if depth(
                    np.array([(x, y), (x + 0.01, y), (x + 0.01, y + 0.01), (x, y + 0.01)]),
                    p.stand.world([
                        (p.piece.low[0], p.piece.low[1], 0), (p.piece.high[0], p.piece.low[1], 0),
                        (p.piece.high[0], p.piece.high[1], 0), (p.piece.low[0], p.piece.high[1], 0),
                    ])[:, :2],
                ) > 0
                and p.piece.high[2] > height - 0.01
            ]  # fmt: skip
            assert below, small.piece.model
    assert count > 20
