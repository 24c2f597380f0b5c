"""The floor of a mapped walk against the building it was rendered from."""

import json

import numpy as np
import pytest

from roomgraph.app.storage.occupancy import read_occupancy
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.trajectory import read_tum
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.slam.evaluation import compare
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OCCUPIED


@pytest.fixture(scope="module")
def floor(mapped, rendered_walk):
    """The run's grid, its T_truth_map, and the true rooms' rectangles by name."""
    grid = read_occupancy(RunFolder(mapped[1]).occupancy)
    truth = read_tum(rendered_walk / "groundtruth.txt")
    T_truth_world = compare(RunFolder(mapped[1]).read_trajectory(), truth).T_truth_estimate
    rooms = json.loads((rendered_walk / "building.json").read_text())["rooms"]
    rectangles = {room["name"]: np.array(room["polygon"]) for room in rooms}
    return grid, T_truth_world @ se3.inverse(grid.T_map_world), rectangles


def states_at(grid, T_truth_map, points_truth):
    """States of the cells over points (N, 2) of the building; -1 off the grid."""
    points = np.column_stack([points_truth, np.zeros(len(points_truth))])
    xy = se3.transform(se3.inverse(T_truth_map), points)[:, :2]
    column, row = np.floor((xy - grid.origin_xy) / grid.cell_m).astype(int).T
    inside = (row >= 0) & (column >= 0)
    inside &= (row < grid.cells.shape[0]) & (column < grid.cells.shape[1])
    states = np.full(len(xy), -1)
    states[inside] = grid.cells[row[inside], column[inside]]
    return states


def test_the_map_is_upright_on_the_floor(floor):
    _, T_truth_map, _ = floor
    assert np.degrees(np.arccos(T_truth_map[2, 2])) < 1.0
    assert T_truth_map[2, 3] == pytest.approx(0.0, abs=0.05)


def test_the_corridor_is_as_wide_as_it_is_and_its_walls_thin(floor):
    grid, T_truth_map, rooms = floor
    (x0, y0), (x1, y1) = rooms["corridor1"].min(axis=0), rooms["corridor1"].max(axis=0)
    across = np.arange(y0 - 0.3, y1 + 0.3, 0.01)
    middle = (y0 + y1) / 2
    widths, thick = [], []
    for x in np.arange(x0 + 0.2, x1 - 0.2, 0.05):
        line = np.column_stack([np.full(len(across), x), across])
        walls = across[states_at(grid, T_truth_map, line) == OCCUPIED]
        low = walls[(walls < middle) & (walls < y0 + 0.12)]
        high = walls[(walls > middle) & (walls > y1 - 0.12)]
        if len(low) and len(high):
            widths.append(high.min() - low.max())
            thick += [len(low) * 0.01 / grid.cell_m, len(high) * 0.01 / grid.cell_m]
    assert len(widths) >= 10
    assert np.median(widths) == pytest.approx(y1 - y0, abs=0.05)
    assert np.percentile(thick, 90) <= 3.5


def test_the_way_walked_is_free(floor, rendered_walk):
    grid, T_truth_map, _ = floor
    walked = read_tum(rendered_walk / "groundtruth.txt").positions[:, :2]
    assert (states_at(grid, T_truth_map, walked) == FREE).mean() > 0.98


def test_nothing_is_free_inside_walls(floor):
    grid, T_truth_map, rooms = floor
    rows, columns = np.nonzero(grid.cells == FREE)
    cells = (np.column_stack([columns, rows]) + 0.5) * grid.cell_m + grid.origin_xy
    xy = se3.transform(T_truth_map, np.column_stack([cells, np.zeros(len(cells))]))[:, :2]
    outside = np.ones(len(xy), dtype=bool)
    for polygon in rooms.values():
        low, high = polygon.min(axis=0) - 0.2, polygon.max(axis=0) + 0.2
        outside &= ~np.all((xy > low) & (xy < high), axis=1)
    assert outside.mean() < 0.005


def test_places_lie_in_the_rooms_that_were_walked_through(mapped, floor):
    _, T_truth_map, rooms = floor
    graph = read_graph_json(RunFolder(mapped[1]).graph_json)
    assert graph.rooms
    for room in graph.rooms:
        x, y = se3.transform(T_truth_map, np.array([[*room.centre_map, 0.0]]))[0, :2]
        assert any(
            np.all((p.min(axis=0) < (x, y)) & ((x, y) < p.max(axis=0))) for p in rooms.values()
        )
