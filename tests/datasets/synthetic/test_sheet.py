"""Pages of pictures: every room once, from inside, and the levels from above."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.sheet import (
    PLAN_PX_PER_M,
    draw_page,
    from_above,
    make_renderer,
    room_views,
)
from roomgraph.datasets.synthetic.world import make_world

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def world():
    return make_world(BuildingSettings(seed=2, plan="house"))


@pytest.fixture(scope="module")
def renderer(world):
    return make_renderer(world)


def test_every_room_is_seen_once_and_night_is_darker(world, renderer):
    views = list(room_views(world, renderer))
    assert [view.room.name for view in views] == [room.name for room in world.building.rooms]
    for view in views:
        day, night = (picture.astype(float).mean() for picture in view.pictures)
        assert day > night
        assert view.pictures[0].std() > 15, f"{view.room.name}: nothing to be seen"


def test_the_level_is_drawn_to_scale_and_dark_outside(world, renderer):
    image = from_above(world, renderer, 0)
    corners = np.concatenate([room.floor.polygon for room in world.building.rooms])
    size = (corners.max(axis=0) - corners.min(axis=0) + 0.6) * PLAN_PX_PER_M
    assert np.abs(np.array(image.shape[1::-1]) - size).max() <= 1
    assert tuple(image[2, 2]) == (52, 52, 56)
    for room in world.building.rooms:
        x, y = room.floor.x0 + 0.4, room.floor.y1 - 0.4
        column = int((x - corners[:, 0].min() + 0.3) * PLAN_PX_PER_M)
        line = int((corners[:, 1].max() + 0.3 - y) * PLAN_PX_PER_M)
        assert tuple(image[line, column]) != (52, 52, 56), room.name


def test_the_page_shows_progress_and_holds_all_rooms(world):
    told = []
    page = draw_page(world, lambda done, total: told.append((done, total)))
    count = len(world.building.rooms)
    assert told == [(i + 1, count) for i in range(count)]
    assert page.shape[2] == 3
    assert page.shape[1] > 2000
