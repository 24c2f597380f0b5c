"""Walls as seen from inside, the windows in them, the strips that cover them."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.layout import WALL_M, Doorway, FloorPlan, Rectangle, Room
from roomgraph.datasets.synthetic.rendering.mesh import Material, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.structure.faces import Face, room_faces
from roomgraph.datasets.synthetic.structure.shell import raise_wall
from roomgraph.datasets.synthetic.structure.windows import build_window, place_windows
from tests.datasets.synthetic.plans.helpers import FLOORS, KINDS, plan, span

GREY = Material(np.full((64, 64, 3), 128, np.uint8))


def surfaces() -> Surfaces:
    return Surfaces(np.random.default_rng(0))


def two_rooms() -> FloorPlan:
    """A room of 4 x 3 m with another one east of it, and a door between them at y = 1."""
    rooms = (
        Room("hall1", "hall", Rectangle(0, 0, 4, 3)),
        Room("office1", "office", Rectangle(4 + WALL_M, 0, 8, 3)),
    )
    door = Doorway(("hall1", "office1"), (4 + WALL_M / 2, 1.0), "y", 0.9, 2.0)
    return FloorPlan(rooms, (door,))


def normal(face: Face) -> tuple[float, float]:
    origin, inwards = face.stand.world([(0, 0, 0), (0, 1, 0)])[:, :2]
    x, y = np.round(inwards - origin, 9)
    return float(x), float(y)


def test_the_walls_of_a_room_look_inwards_and_know_which_are_outer():
    drawn = two_rooms()
    faces = {normal(face): face for face in room_faces(drawn.rooms[0], drawn, surfaces())}
    lengths = {at: face.length for at, face in faces.items()}
    assert lengths == pytest.approx({(0, 1): 4, (-1, 0): 3, (0, -1): 4, (1, 0): 3})
    outer = {at: face.is_outer for at, face in faces.items()}
    assert outer == {(0, 1): True, (-1, 0): False, (0, -1): True, (1, 0): True}


def test_a_gap_is_where_the_doorway_is_from_both_sides():
    drawn = two_rooms()
    for room, inwards, begin in (
        (drawn.rooms[0], (-1, 0), 3 - 1.45),  # From its left end at y = 3, rightwards down.
        (drawn.rooms[1], (1, 0), 0.55),
    ):
        (face,) = (f for f in room_faces(room, drawn, surfaces()) if f.gaps)
        assert normal(face) == inwards
        (gap,) = face.gaps
        assert (gap.begin, gap.end) == pytest.approx((begin, begin + 0.9))
        assert face.openings == [(gap.begin, gap.end, 2.0)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("floors", FLOORS)
def test_faces_go_round_every_room_and_hold_every_doorway_once(kind, floors):
    for seed in range(4):
        drawn = plan(kind, floors, seed)
        for room in drawn.rooms:
            faces = room_faces(room, drawn, surfaces())
            middle = room.polygon.mean(axis=0)
            round_ = np.roll(room.polygon, -1, axis=0) - room.polygon
            assert [f.length for f in faces] == pytest.approx(np.linalg.norm(round_, axis=1))
            for face in faces:
                left, right = face.stand.world([(0, 0, 0), (face.length, 0, 0)])[:, :2]
                assert np.array(normal(face)) @ (middle - left) > 0
                for end in (left, right):
                    assert np.linalg.norm(room.polygon - end, axis=1).min() < 1e-9
            doors = [gap.doorway for face in faces for gap in face.gaps]
            wanted = [door for door in drawn.doorways if room.key in door.rooms]
            assert sorted(map(id, doors)) == sorted(map(id, wanted))


def behind(face: Face, begin: float, end: float, away_m: float) -> np.ndarray:
    x = np.linspace(begin, end, 12)
    return face.stand.world(np.column_stack([x, np.full(12, -away_m), np.zeros(12)]))[:, :2]


@pytest.mark.parametrize("kind", KINDS)
def test_windows_are_in_walls_with_nothing_of_the_building_behind_them(kind):
    """All along a window, half a metre behind it, there is no other room."""
    count, blind = 0, []
    for seed in range(12):
        drawn = plan(kind, 1, seed)
        for room in drawn.rooms:
            for face in room_faces(room, drawn, surfaces()):
                for window in place_windows(face, 2.6, np.random.default_rng(seed)):
                    if not face.is_outer:
                        continue
                    count += 1
                    points = behind(face, window.begin, window.end, 0.5)
                    cells = [r.floor for r in drawn.rooms if r is not room]
                    if min(cell.distance(points).min() for cell in cells) < 1e-9:
                        blind.append((seed, room.key))
    assert count > 100
    assert blind == []


def test_windows_lie_in_their_wall_beside_each_other_under_the_ceiling():
    drawn = two_rooms()
    faces = room_faces(drawn.rooms[0], drawn, surfaces())
    counts = set()
    for seed in range(40):
        for face in faces:
            windows = place_windows(face, 2.5, np.random.default_rng(seed))
            assert not (windows and face.gaps), "a wall with a door has no window"
            counts.add(len(windows))
            edges = [edge for w in windows for edge in (w.begin, w.end)]
            assert edges == sorted(edges)
            assert all(0 <= edge <= face.length for edge in edges)
            assert all(0.2 < w.sill < w.head <= 2.25 and w.head - w.sill > 0.7 for w in windows)
    assert counts >= {0, 1, 2}
    short = Face(faces[0].stand, 1.5, (), True)
    assert place_windows(short, 2.5, np.random.default_rng(0)) == []


def test_daylight_of_a_window_comes_from_inside_its_opening_and_goes_inwards():
    drawn = two_rooms()
    made = surfaces()
    face = room_faces(drawn.rooms[0], drawn, made)[0]
    (window, *_) = place_windows(face, 2.5, np.random.default_rng(1))
    build_window(face, window, np.random.default_rng(2), power=2.0)
    assert [thing.name for thing in made.things] == ["window"]
    assert len(made.lamps) == 2
    for lamp in made.lamps:
        assert lamp.direction == pytest.approx((*normal(face), 0.0), abs=1e-9)
        assert window.sill < lamp.position[2] < window.head
        assert drawn.rooms[0].floor.distance(np.array([lamp.position[:2]]))[0] == 0


@pytest.mark.parametrize("ceiling", [2.4, 3.3])
def test_a_wall_is_covered_but_for_its_openings(ceiling):
    made = surfaces()
    stand = Stand(made, (1.0, 2.0, 0.5), 0.4)
    raise_wall(stand, 5.0, [(0.5, 1.4, 2.0), (3.0, 5.0, ceiling)], GREY, ceiling)
    area = 0.0
    for quad in made.quads:
        c = quad.corners
        area += float(np.linalg.norm(np.cross(c[1] - c[0], c[3] - c[0])))
        outwards = np.cross(c[3] - c[0], c[1] - c[0])
        assert outwards @ (stand.world([(0, 1, 0)])[0] - stand.origin) > 0
    assert area == pytest.approx(5 * ceiling - 0.9 * 2.0 - 2.0 * ceiling)
    assert {float(q.corners[:, 2].max()) for q in made.quads} == {0.5 + ceiling}


def test_span_of_a_rectangle():
    assert span(Rectangle(0, 1, 2, 5), "x") == (0, 2)
    assert span(Rectangle(0, 1, 2, 5), "y") == (1, 5)
