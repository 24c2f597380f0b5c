"""The plan of a floor: names stand clear of the way walked where there is room for that."""

import tracemalloc

import numpy as np
import pytest

from roomgraph.app.report.floor_plan import draw_floor_plan
from roomgraph.semantics.graph.graph import GraphNode, RoomPolygon, SemanticGraph
from roomgraph.semantics.labels import LabelSpace
from roomgraph.slam.reconstruction.occupancy_grid import OccupancyGrid

pytestmark = pytest.mark.slow

LABELS = LabelSpace.of(["office"])


def plan(outline, path_map):
    outline = np.array(outline, dtype=float)
    middle = outline.mean(axis=0)
    room = RoomPolygon("office1", "office", 1, 0.9, outline, 16.0, middle)
    node = GraphNode(0, 0, 0.0, np.array(path_map[0]), "office", 1, "office1", 0.9, np.empty(0))
    graph = SemanticGraph(LABELS, (node,), (), (room,), (), np.eye(4))
    grid = OccupancyGrid(np.zeros((100, 100), np.int8), 0.05, np.zeros(2), np.eye(4))
    figure = draw_floor_plan(graph, grid, np.array(path_map))
    figure.canvas.draw()
    (axes,) = figure.axes
    (name,) = (text for text in axes.texts if text.get_text().startswith("office1"))
    box = name.get_window_extent().transformed(axes.transData.inverted())
    return name.get_position(), box


@pytest.mark.parametrize("turned", [False, True])
def test_a_name_stands_clear_of_the_way_near_the_middle(turned):
    across = np.column_stack([np.linspace(0, 4, 200), np.full(200, 2.0), np.full(200, 1.5)])
    way = across[:, [1, 0, 2]] if turned else across
    (x, y), box = plan([(0, 0), (4, 0), (4, 4), (0, 4)], way)
    crossed = (box.x0 < way[:, 0]) & (way[:, 0] < box.x1)
    crossed &= (box.y0 < way[:, 1]) & (way[:, 1] < box.y1)
    assert not crossed.any()
    assert box.x0 > 0 and box.x1 < 4 and box.y0 > 0 and box.y1 < 4
    assert (y if turned else x) == pytest.approx(2.0, abs=0.1)


def test_without_room_for_that_it_stands_in_the_middle():
    back_and_forth = [(x, y, 1.5) for x in np.linspace(0, 4, 40) for y in np.linspace(0, 4, 40)]
    (x, y), _ = plan([(0, 0), (4, 0), (4, 4), (0, 4)], back_and_forth)
    assert (x, y) == pytest.approx((2.0, 2.0), abs=0.1)
    narrow = [(x, 0.05, 1.5) for x in np.linspace(0, 4, 40)]
    (x, y), _ = plan([(0, 0), (4, 0), (4, 0.1), (0, 0.1)], narrow)
    assert (x, y) == pytest.approx((2.0, 0.05), abs=0.1)


def test_in_a_low_room_it_stands_on_one_line_beside_the_way():
    way = [(x, 0.4, 1.5) for x in np.linspace(0, 4, 40)]
    _, box = plan([(0, 0), (4, 0), (4, 0.8), (0, 0.8)], way)
    assert box.y0 >= 0.4 or box.y1 <= 0.4
    assert box.y0 >= 0 and box.y1 <= 0.8


def test_a_long_way_through_a_large_hall_takes_little_memory(rng):
    way = np.column_stack([rng.uniform(0, 40, (20_000, 2)), np.full(20_000, 1.5)])
    tracemalloc.start()
    plan([(0, 0), (40, 0), (40, 40), (0, 40)], way)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 500e6
