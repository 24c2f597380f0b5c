"""Which place lies under a point."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.semantics.graph.graph import RoomPolygon, SemanticGraph
from roomgraph.semantics.rooms.lookup import places_at
from tests.semantics.helpers import label_space


def rectangle(name, x0, y0, x1, y1):
    polygon = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], dtype=float)
    return RoomPolygon(name, "office", 3, 0.9, polygon, (x1 - x0) * (y1 - y0), polygon.mean(axis=0))


@pytest.fixture
def graph(random_poses):
    rooms = (rectangle("office1", 0, 0, 3, 2), rectangle("office2", 3.14, 0, 6, 2))
    return SemanticGraph(label_space(), (), (), rooms, (), random_poses[0])


def test_points_lie_where_they_do_whatever_the_worlds_frame(graph):
    points_map = np.array([
        [1, 1, 0.5], [1, 1, 2.4], [5, 1, 0], [3.02, 1, 1], [3.12, 1, 1],
        [1, 2.2, 1], [1, 2.6, 1], [40, 40, 0], [-3, 1, 1],
    ])  # fmt: skip
    points_world = se3.transform(se3.inverse(graph.T_map_world), points_map)
    assert places_at(graph, points_world).tolist() == [0, 0, 1, 0, 1, 0, -1, -1, -1]


def test_without_rooms_nothing_lies_anywhere():
    graph = SemanticGraph(label_space(), (), ())
    assert places_at(graph, np.zeros((2, 3))).tolist() == [-1, -1]
