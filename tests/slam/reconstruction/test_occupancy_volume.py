"""Free space and the occupancy grid against rooms whose size is known."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.reconstruction.floor_plane import FloorPlane
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OCCUPIED, UNKNOWN, occupancy
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolumeSettings, carve
from tests.slam.scene import NOISE, around, box_room, camera, keyframes

pytestmark = pytest.mark.slow

SETTINGS = OccupancyVolumeSettings()
LEVEL = FloorPlane(np.eye(4), True, True, True)


def grid_of(boxes, cameras, rng=None, settings=SETTINGS):
    """The grid of boxes, in their own frame."""
    made, T_map = keyframes(boxes, cameras, np.eye(4), rng, with_planes=False)
    volume = carve(made, T_map, LEVEL, settings, NOISE)
    path = np.array([T[:3, 3] for T in cameras])
    return occupancy(volume, np.eye(4), settings, path), volume


def state_at(grid, x, y):
    column, row = np.floor((np.array([x, y]) - grid.origin_xy) / grid.cell_m).astype(int)
    return grid.cells[row, column]


@pytest.mark.parametrize("shift", [0.0, 0.013, 0.031])
def test_a_room_is_as_wide_as_it_is_and_its_walls_thin(rng, shift):
    room = box_room(shift, 0, 3 + shift, 2.4)
    cameras = [*around(1, 0.8, count=24), *around(2, 1.6, count=24)]
    grid, _ = grid_of(room, cameras, rng)
    widths, thick = [], []
    for y in np.arange(0.4, 2.0, 0.05):
        row = grid.cells[int((y - grid.origin_xy[1]) / grid.cell_m)]
        walls = np.flatnonzero(row == OCCUPIED)
        middle = int((1.5 - grid.origin_xy[0]) / grid.cell_m)
        left, right = walls[walls < middle], walls[walls > middle]
        widths.append((right.min() - left.max() - 1) * grid.cell_m)
        thick += [len(left), len(right)]
    assert np.median(widths) == pytest.approx(3.0, abs=0.05)
    assert np.percentile(thick, 95) <= 3


def test_rays_carve_and_nothing_else(rng):
    room = box_room(0, 0, 3, 2.4)
    grid, _ = grid_of(room, around(1.5, 1.2), rng)
    # Below the camera nothing was hit, but it stood there; outside nobody looked.
    assert state_at(grid, 1.5, 1.2) == FREE
    assert state_at(grid, 0.6, 0.6) == FREE
    assert (grid.cells[0] == UNKNOWN).all()
    assert (grid.cells[1] != FREE).all()
    assert (grid.cells[1] == OCCUPIED).sum() <= 2  # noise may thicken the wall here and there


def rows_of(grid, low, high):
    """First and last row, that one left out, between two y."""
    return np.floor((np.array([low, high]) - grid.origin_xy[1]) / grid.cell_m).astype(int)


def columns_of(grid, low, high):
    """First and last column, that one left out, between two x."""
    return np.floor((np.array([low, high]) - grid.origin_xy[0]) / grid.cell_m).astype(int)


def width_of(grid, y, middle):
    """Free width of the room across x at a y, from wall to wall."""
    walls = np.flatnonzero(grid.cells[int((y - grid.origin_xy[1]) / grid.cell_m)] == OCCUPIED)
    column = int((middle - grid.origin_xy[0]) / grid.cell_m)
    left, right = walls[walls < column], walls[walls > column]
    return (right.min() - left.max() - 1) * grid.cell_m if len(left) and len(right) else np.nan


@pytest.mark.parametrize("with_normals", [True, False])
def test_a_corridor_seen_along_its_walls_is_as_wide_as_it_is(rng, with_normals, monkeypatch):
    if not with_normals:
        monkeypatch.setattr(
            RangeImage, "normals", lambda image, noise: np.zeros((len(image.points), 3), np.float32)
        )
    corridor = box_room(0, 0, 1.5, 8)
    cameras = [camera(0.75, y, turn) for y in (0.5, 1.5, 2.5) for turn in (85.0, 90.0, 95.0)]
    grid, _ = grid_of(corridor, cameras, rng)
    widths = [width_of(grid, y, 0.75) for y in np.arange(1.5, 5.0, 0.05)]
    assert np.isfinite(widths).mean() > 0.9
    assert np.nanmedian(widths) == pytest.approx(1.5, abs=0.05 if with_normals else 0.1)


def test_what_stands_in_the_way_and_what_does_not(rng):
    room = box_room(0, 0, 3, 2.4)
    things = {
        "box": (0.6, 0.6, 0.0, 0.9, 0.9, 0.6), "carpet": (2.2, 0.5, 0.0, 2.6, 0.9, 0.04),
        "lamp": (2.0, 1.6, 2.0, 2.4, 2.0, 2.2), "shelf": (0.5, 1.5, 1.2, 0.9, 1.9, 1.3),
    }  # fmt: skip
    cameras = [*around(1.5, 1.2, 1.1, 15, 24), *around(1.5, 0.5, 1.4, 20, 24)]
    grid, _ = grid_of(room + list(things.values()), cameras, rng)
    assert OCCUPIED in {state_at(grid, x, 0.75) for x in np.arange(0.6, 1.0, 0.05)}
    assert state_at(grid, 2.4, 0.7) == FREE
    assert state_at(grid, 2.2, 1.8) == FREE
    shelf = {state_at(grid, x, 1.7) for x in np.arange(0.5, 1.0, 0.05)}
    assert OCCUPIED in shelf


def test_what_is_low_or_thin_stands_in_the_way_too(rng):
    things = [
        (0.6, 0.6, 0.0, 0.9, 0.9, 0.14),  # a low box
        (2.0, 1.6, 0.0, 2.04, 1.64, 1.5),  # a post
        (2.4, 0.3, 0.0, 2.44, 1.1, 2.0),  # a door leaf
    ]
    cameras = [*around(1.5, 1.2, 1.1, 15, 24), *around(1.3, 0.9, 1.1, 45, 24)]
    grid, _ = grid_of(box_room(0, 0, 3, 2.4) + things, cameras, rng)
    assert state_at(grid, 0.75, 0.75) != FREE
    post = grid.cells[slice(*rows_of(grid, 1.55, 1.7)), slice(*columns_of(grid, 1.95, 2.1))]
    assert OCCUPIED in post
    leaf = {state_at(grid, x, 0.7) for x in np.arange(2.35, 2.5, 0.05)}
    assert OCCUPIED in leaf


def test_large_cells_leave_the_floor_where_it_is(rng):
    _, volume = grid_of(
        box_room(0, 0, 3, 2.4),
        around(1.5, 1.2, 1.4, 30, 24),
        rng,
        OccupancyVolumeSettings(cell_m=0.2),
    )
    assert volume.hits[0].any()


def test_a_view_over_a_counter_does_not_free_it(rng):
    counter = [(0.0, 0.0, 0.0, 3.0, 0.6, 1.0)]
    grid, _ = grid_of(box_room(0, 0, 3, 2.4) + counter, around(1.5, 1.6, 0.9, 5, 24), rng)
    assert state_at(grid, 1.5, 0.25) != FREE


def test_a_large_map_gets_larger_cells():
    few = OccupancyVolumeSettings(max_cells=10_000)
    grid, volume = grid_of(box_room(0, 0, 3.9, 3.9), around(2, 2), settings=few)
    assert volume.hits[0].size <= 1.2 * few.max_cells
    assert grid.cell_m >= few.cell_m


def test_no_keyframes_make_an_empty_grid():
    volume = carve([], {}, LEVEL, SETTINGS, NOISE)
    grid = occupancy(volume, np.eye(4), SETTINGS, np.empty((0, 3)))
    assert (grid.cells == UNKNOWN).all()


def test_the_map_frame_is_used(rng):
    """A world that lies as the first camera does gives the same grid."""
    room, cameras = box_room(0, 0, 3, 2.4), around(1.5, 1.2)
    made, T_world = keyframes(room, cameras, with_planes=False)
    floor_plane = FloorPlane(cameras[0], True, True, True)
    volume = carve(made, T_world, floor_plane, SETTINGS, NOISE)
    other, T_map = keyframes(room, cameras, np.eye(4), with_planes=False)
    same = carve(other, T_map, LEVEL, SETTINGS, NOISE)
    assert (volume.hits == same.hits).mean() > 0.99
    assert np.allclose(se3.inverse(T_world[0]) @ np.eye(4), np.eye(4))
