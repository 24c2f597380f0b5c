"""Where one can walk, against distances worked out by hand and against rays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.free_space import CELL_M, CLOSEST_M, free_space, is_shaft
from roomgraph.datasets.synthetic.plans.layout import Rectangle
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from tests.datasets.synthetic.worlds import TWO_ROOMS, house

TABLE = Rectangle(1.5, 0.8, 2.5, 1.6)


def two_rooms(*obstacles, plan=TWO_ROOMS):
    return Building(0, plan, (), np.zeros((0, 4)), (), obstacles=obstacles)


def test_clearance_is_the_distance_to_walls_things_and_jambs():
    space = free_space(two_rooms((0, TABLE.polygon)), 0)
    middles = space.middles(np.arange(space.clearance.size))
    clearance = space.clearance.ravel()
    x, y = middles.T
    for room, side in zip((room.floor for room in TWO_ROOMS.rooms), (4.0, 4.14), strict=True):
        inside = room.distance(middles) == 0
        other = np.where(side == 4.0, x - room.x0, room.x1 - x)
        walls = np.min([other, y - room.y0, room.y1 - y], axis=0)
        # The wall with the opening.
        for beside in (Rectangle(side, 0, side, 1.05), Rectangle(side, 1.95, side, 3)):
            walls = np.minimum(walls, beside.distance(middles))
        expected = np.minimum(walls, TABLE.distance(middles))
        # Nobody can stand at the walls: free or not, it matters to no one there.
        inside &= (expected > 0.2) | (clearance > 0)
        assert inside.sum() > 700
        # A grid four times finer than the cells, and OpenCV's approximate distance.
        np.testing.assert_allclose(clearance[inside], expected[inside], atol=0.08)
    outside = np.min([room.floor.distance(middles) for room in TWO_ROOMS.rooms], axis=0) > 0.15
    assert not clearance[outside].any()
    in_door = (np.abs(x - 4.07) < 0.05) & (np.abs(y - 1.5) < 0.05)
    np.testing.assert_allclose(clearance[in_door], 0.45, atol=0.08)


def test_way_goes_through_the_door_and_round_the_table():
    space = free_space(two_rooms((0, TABLE.polygon)), 0)
    begin, end = np.array([0.5, 1.2]), np.array([7.5, 1.2])
    way = space.way(begin, end)
    np.testing.assert_allclose(way[[0, -1]], [begin, end], atol=CELL_M)
    assert np.linalg.norm(np.diff(way, axis=0), axis=1).max() < CELL_M * 1.5
    assert TABLE.distance(way).min() > CLOSEST_M - CELL_M
    passing = way[np.abs(way[:, 0] - 4.07) < 0.07]
    assert len(passing)
    assert np.abs(passing[:, 1] - 1.5).max() < 0.25
    assert space.is_free(way).all()
    assert not space.is_free(np.array([(2.0, 1.2), (4.07, 0.3), (-3, -3), (50, 50)])).any()
    assert space.is_free(np.array([1.0, 2.0]), 0.5).all()
    assert not space.is_free(np.array([1.0, 2.0]), 0.9).any()


def test_what_nobody_can_get_to_is_not_free():
    shelf = Rectangle(6, 0, 8.14, 3)
    space = free_space(two_rooms((0, shelf.polygon), plan=replace(TWO_ROOMS, doorways=())), 0)
    assert space.is_free(np.array([(1.0, 1.0), (3.0, 2.0)])).all()
    # The second room is smaller now, and has no door.
    assert not space.is_free(np.array([(5.0, 1.5)])).any()
    assert np.abs(space.middles(np.array([space.cell(np.array([5.0, 1.5]))])) - 4).min() < 0.5


def test_things_on_another_level_are_not_in_the_way():
    clear = free_space(two_rooms(), 0).clearance
    assert np.array_equal(free_space(two_rooms((1, TABLE.polygon)), 0).clearance, clear)
    assert not np.array_equal(free_space(two_rooms((0, TABLE.polygon)), 0).clearance, clear)


@pytest.mark.slow
@pytest.mark.parametrize("level", [0, 1])
def test_nothing_stands_on_the_free_floor_of_a_furnished_house(level):
    building = house().building
    space, scene = free_space(building, level), Scene(building.quads)
    cells = np.flatnonzero(space.clearance.ravel() > 0.3)
    middles = space.middles(cells)
    shafts = [room.floor for room in building.rooms if is_shaft(room) and room.level == level]
    assert np.min([floor.distance(middles) for floor in shafts], axis=0).min() > 0
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    directions = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    for height in (0.15, 0.6, 1.1):
        z = np.full(len(middles), level * building.plan.storey_m + height)
        origins = np.repeat(np.column_stack([middles, z]), 24, axis=0)
        far = scene.distances(origins, np.tile(directions, (len(middles), 1)))
        assert far.min() > 0.2
