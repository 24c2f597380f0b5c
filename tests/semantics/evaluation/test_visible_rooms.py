import numpy as np
import pytest

from roomgraph.semantics.evaluation.visible_rooms import RoomIndex

CORRIDOR = np.array([[0.0, 0], [6, 0], [6, 2], [0, 2]])
# An L: its notch belongs to nobody.
OFFICE = np.array([[0.0, 2.14], [4, 2.14], [4, 6], [2, 6], [2, 4], [0, 4]])


@pytest.fixture(scope="module")
def rooms():
    return RoomIndex([CORRIDOR, OFFICE])


def test_points_belong_to_the_room_around_them(rooms):
    assert rooms.at(np.array([[3.0, 1.0], [3.0, 5.0], [1.0, 3.0]])).tolist() == [0, 1, 1]


def test_a_wall_belongs_to_the_side_it_is_seen_from(rooms):
    assert rooms.at(np.array([[1.0, 2.03], [1.0, 2.11]])).tolist() == [0, 1]


def test_points_outside_belong_to_the_nearest_room(rooms):
    assert rooms.at(np.array([[3.0, -50.0], [3.0, 50.0], [1.5, 4.2]])).tolist() == [0, 1, 1]


def test_shares_are_of_all_points(rooms):
    points = np.array([[1.0, 1.0]] * 3 + [[1.0, 3.0]])
    np.testing.assert_allclose(rooms.shares(points), [0.75, 0.25])
    np.testing.assert_array_equal(rooms.shares(np.empty((0, 2))), [0, 0])
