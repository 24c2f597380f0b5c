from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.synthetic.people.crowd import Seat, crowd
from roomgraph.datasets.synthetic.people.person import Person
from roomgraph.datasets.synthetic.people.scenes import DoorSpot
from roomgraph.datasets.trajectory import Trajectory

HALF_M = 6.0
FLOOR_M = 0.5
TABLE = np.array([(-1.0, 3.2), (1.0, 4.2)])
SEATS = (Seat(np.array([4.8, 0.0]), FLOOR_M, 0.46, np.pi),)
DOORS = (DoorSpot(np.array([0.0, -3.8]), FLOOR_M, np.pi / 2),)


def camera() -> Trajectory:
    """Walk a figure of eight in a big room for two minutes."""
    stamps = np.arange(0, 120, 1 / 15)
    turn = 2 * np.pi * stamps / 40
    xy = np.column_stack([3.2 * np.cos(turn), 1.9 * np.sin(2 * turn)])
    step = np.gradient(xy, axis=0)
    heading = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    level = np.zeros(len(stamps))
    positions = np.column_stack([xy, level + FLOOR_M + 1.1])
    return Trajectory(stamps, camera_poses(positions, heading, level - 0.05, level))


def is_free(points: NDArray[np.float64], floor_m: float) -> NDArray[np.bool_]:
    on_table = ((points > TABLE[0]) & (points < TABLE[1])).all(axis=1)
    return (np.abs(points) < HALF_M).all(axis=1) & ~on_table & (abs(floor_m - FLOOR_M) < 0.1)


def draw(seed: int, count: int = 5) -> list[Person]:
    walk = camera()
    floor_m = np.full(len(walk), FLOOR_M)
    return crowd(np.random.default_rng(seed), count, walk, is_free, SEATS, DOORS, floor_m)


@pytest.fixture(scope="module", params=[0, 1, 2])
def people(request: pytest.FixtureRequest) -> list[Person]:
    return draw(request.param)


def seen(person: Person, walk: Trajectory) -> NDArray[np.bool_]:
    """Whether the middle of the body is in a picture of 57 x 44 degrees, less than 7.8 m away."""
    result = []
    for stamp, T in zip(walk.stamps_s, walk.T_world_camera, strict=True):
        x, y, z = T[:3, :3].T @ (person.centre(stamp) - T[:3, 3])
        inside = abs(x) < z * np.tan(np.deg2rad(28.5)) and abs(y) < z * np.tan(np.deg2rad(22))
        near = z > 0.3 and np.hypot(x, z) < 7.8
        result.append(bool(inside and near and person.is_there(stamp)))
    return np.array(result)


def test_as_many_as_wanted(people: list[Person]) -> None:
    assert len(people) == 5


def test_each_is_seen_for_some_seconds(people: list[Person]) -> None:
    walk = camera()
    for person in people:
        assert seen(person, walk).sum() / 15 > 3.0


def test_the_camera_meets_them_near_by_and_again(people: list[Person]) -> None:
    walk = camera()
    for person in people:
        gaps = [
            np.linalg.norm(person.centre(stamp)[:2] - position[:2])
            for stamp, position in zip(walk.stamps_s, walk.positions, strict=True)
        ]
        assert np.min(np.array(gaps)[seen(person, walk)]) < 4.5
        doing = person.schedule.doing
        assert "sit" in doing or doing.count("away") >= 2


def test_nobody_comes_too_near(people: list[Person]) -> None:
    walk = camera()
    for person in people:
        for stamp in np.arange(0.0, walk.stamps_s[-1], 0.03):
            if person.is_there(stamp):
                axes = [np.interp(stamp, walk.stamps_s, walk.positions[:, a]) for a in (0, 1)]
                assert np.linalg.norm(person.centre(stamp)[:2] - axes) >= 0.5


def test_they_walk_on_free_floor_only(people: list[Person]) -> None:
    for person in people:
        if "sit" in person.schedule.doing:
            continue
        for stamp in np.arange(0.0, 120.0, 0.05):
            if person.is_there(stamp):
                place = person.place(stamp)
                assert place[2] == pytest.approx(FLOOR_M)
                assert is_free(place[None, :2], FLOOR_M).all()


def test_nobody_is_faster_than_a_brisk_walk(people: list[Person]) -> None:
    for person in people:
        s = person.schedule
        speed = np.linalg.norm(np.diff(s.xy, axis=0), axis=1) / np.diff(s.stamps_s)
        assert speed[np.array(s.doing) != "away"].max() <= 2.0


def test_nobody_appears_or_vanishes_in_the_picture(people: list[Person]) -> None:
    walk = camera()
    for person in people:
        there = np.array([person.is_there(stamp) for stamp in walk.stamps_s])
        changes = np.flatnonzero(there[1:] != there[:-1])
        in_picture = seen(person, walk)
        assert not in_picture[changes].any()
        assert not in_picture[changes + 1].any()


def test_people_do_not_walk_through_each_other(people: list[Person]) -> None:
    for stamp in np.arange(0.0, 120.0, 0.1):
        places = np.array([p.place(stamp)[:2] for p in people if p.is_there(stamp)])
        gaps = np.linalg.norm(places[:, None] - places[None], axis=2)
        assert (gaps + 9 * np.eye(len(places)) > 0.5).all()


def test_they_do_many_things() -> None:
    doing = {what for seed in range(3) for person in draw(seed) for what in person.schedule.doing}
    assert doing == {"walk", "stand", "sit", "away"}


def test_same_seed_same_crowd() -> None:
    first, second, other = draw(7, 2), draw(7, 2), draw(8, 2)
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a.schedule.xy, b.schedule.xy)
        np.testing.assert_array_equal(a.corners(20.0), b.corners(20.0))
    assert any(
        a.schedule.xy.shape != b.schedule.xy.shape or (a.schedule.xy != b.schedule.xy).any()
        for a, b in zip(first, other, strict=True)
    )


def test_where_there_is_no_floor_there_is_nobody() -> None:
    walk = camera()

    def nowhere(points: NDArray[np.float64], floor_m: float) -> NDArray[np.bool_]:
        return np.zeros(len(points), dtype=bool)

    floor_m = np.full(len(walk), FLOOR_M)
    assert crowd(np.random.default_rng(0), 3, walk, nowhere, (), (), floor_m) == []
