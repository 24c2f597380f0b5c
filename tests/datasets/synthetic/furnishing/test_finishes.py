"""What rooms are covered with, and pieces that are set down."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from roomgraph.datasets.synthetic.furnishing.finishes import GROUPS, WALLS, draw_finish
from roomgraph.datasets.synthetic.furnishing.piece import (
    make_piece,
    outline,
    set_down,
    solid_outlines,
)
from roomgraph.datasets.synthetic.furnishing.plot import Placed, Plot, Wall, free_spans
from roomgraph.datasets.synthetic.objects.look import draw_look
from roomgraph.datasets.synthetic.plans.layout import WALL_M, Doorway, FloorPlan, Rectangle, Room
from roomgraph.datasets.synthetic.rendering.mesh import Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import PIXELS_PER_M, STRIP_M
from roomgraph.datasets.synthetic.structure.faces import room_faces
from roomgraph.datasets.synthetic.structure.windows import Window
from tests.datasets.synthetic.plans.helpers import depth


@pytest.mark.parametrize("label", ["bathroom", "kitchen", "office", "corridor", "bedroom"])
def test_finishes_are_as_large_as_the_room_is_high_and_vary(label):
    finishes = [draw_finish(label, 2.5, False, np.random.default_rng(seed)) for seed in range(3)]
    for finish in finishes:
        assert finish.wall.shape == (int(2.5 * PIXELS_PER_M), int(STRIP_M * PIXELS_PER_M), 3)
        assert finish.wall.dtype == np.uint8
    assert len({finish.wall.tobytes() for finish in finishes}) == 3
    assert len({finish.floor.image.tobytes() for finish in finishes}) == 3


def test_the_same_seed_gives_the_same_finish():
    one, again = (draw_finish("hall", 2.4, True, np.random.default_rng(4)) for _ in range(2))
    np.testing.assert_array_equal(one.wall, again.wall)
    np.testing.assert_array_equal(one.floor.image, again.floor.image)
    np.testing.assert_array_equal(one.ceiling.image, again.ceiling.image)


def test_no_group_of_rooms_has_a_wall_of_its_own():
    """A finish alone must not give a kind of room away."""
    for kind in {kind for odds in WALLS.values() for kind in odds}:
        assert sum(kind in odds for odds in WALLS.values()) > 1
    assert {*GROUPS.values(), "home"} == set(WALLS)


def piece(model: str):
    return make_piece(model, np.random.default_rng(1), draw_look(np.random.default_rng(2)))


def test_a_piece_that_is_set_down_is_where_its_outline_says():
    made = piece("desk")
    target = Surfaces(np.random.default_rng(0))
    stand = Stand(target, (5.0, -2.0, 3.0), 0.7)
    set_down(made, stand)
    points = np.concatenate([quad.corners for quad in target.quads])
    assert len(target.quads) == len(made.surfaces.quads)
    c, s = np.cos(0.7), np.sin(0.7)
    own = (points - stand.origin) @ np.array([(-s, c, 0), (c, s, 0), (0, 0, 1)]).T
    np.testing.assert_allclose(own.min(axis=0), made.low, atol=1e-9)
    np.testing.assert_allclose(own.max(axis=0), made.high, atol=1e-9)
    corners = outline(made, stand)
    assert np.ptp(corners, axis=0).min() > 0.5
    for solid in solid_outlines(made, stand):
        assert depth(solid, corners) > 0
    names = [thing.name for thing in target.things]
    assert names == [thing.name for thing in made.surfaces.things]


def test_quads_that_are_set_down_still_face_outwards():
    made = piece("desk")
    for facing in (0.0, 2.0):
        target = Surfaces(np.random.default_rng(0))
        set_down(made, Stand(target, (1.0, 2.0, 0.0), facing))
        for before, after in zip(made.surfaces.quads, target.quads, strict=True):
            a, b = before.corners, after.corners
            up = [float(np.cross(c[3] - c[0], c[1] - c[0])[2]) for c in (a, b)]
            assert up[0] == pytest.approx(up[1], abs=1e-9)


def empty_room(windows: bool = False) -> Plot:
    """A room of 4 x 3 m with a door in the middle of its wall at y = 0."""
    rooms = (
        Room("hall1", "hall", Rectangle(0, -3, 4, -WALL_M)),
        Room("bedroom1", "bedroom", Rectangle(0, 0, 4, 3)),
    )
    door = Doorway(("hall1", "bedroom1"), (2.0, -WALL_M / 2), "x", 0.9, 2.0)
    faces = room_faces(rooms[1], FloorPlan(rooms, (door,)), Surfaces(np.random.default_rng(0)))
    there = [Window(0.5, 3.5, 0.9, 2.1)] if windows else []
    return Plot(rooms[1], [Wall(f, [] if f.gaps else there) for f in faces])


def test_a_plot_keeps_the_floor_before_its_door_free():
    plot, made = empty_room(), piece("wardrobe")
    door_wall = next(k for k, wall in enumerate(plot.walls) if wall.face.gaps)
    assert not plot.fits_at_wall(made, door_wall, 2.0)
    opposite = (door_wall + 2) % 4
    assert plot.fits_at_wall(made, opposite, 2.0)
    plot.put(Placed(made, plot.wall_stand(opposite, 2.0), opposite, 2.0))
    assert not plot.fits_at_wall(made, opposite, 2.2), "there is one already"
    assert plot.free_share < 1
    assert all(b - a < 2.0 for a, b in free_spans(plot.walls[opposite]))
    assert free_spans(plot.walls[(door_wall + 1) % 4]) == [(0.06, pytest.approx(2.94))]


def test_what_is_high_does_not_fit_before_a_window():
    for windows, fits in ((False, True), (True, False)):
        plot = empty_room(windows)
        far = (next(k for k, wall in enumerate(plot.walls) if wall.face.gaps) + 2) % 4
        assert plot.fits_at_wall(piece("wardrobe"), far, 2.0) == fits
        assert not plot.fits_at_wall(piece("wardrobe"), far, 0.1), "it would be in the wall"


def test_a_piece_that_parts_the_room_in_two_does_not_fit():
    rooms = [Room(f"{k}1", k, Rectangle(5 * i, 0, 5 * i + 5 - WALL_M, 1.1)) for i, k in enumerate(
        ("hall", "corridor", "office")
    )]  # fmt: skip
    doors = tuple(
        Doorway((a.key, b.key), (b.floor.x0 - WALL_M / 2, 0.55), "y", 0.8, 2.0)
        for a, b in pairwise(rooms)
    )
    faces = room_faces(rooms[1], FloorPlan(tuple(rooms), doors), Surfaces(np.random.default_rng(0)))
    plot = Plot(rooms[1], [Wall(face, []) for face in faces])
    long = next(k for k, wall in enumerate(plot.walls) if wall.face.length > 2)
    assert not plot.fits_at_wall(piece("wardrobe"), long, 2.4)
    assert plot.fits_at_wall(piece("picture"), long, 2.4)
