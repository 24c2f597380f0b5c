import numpy as np
import pytest

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.geometry.range_image import RangeImage, range_image_of, thumbnail_of
from tests.slam.helpers import CAMERA, NOISE


def _plane_depth(normal, distance):
    """Return the depth image of the plane normal . p = distance."""
    columns, rows = np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height))
    rays = CAMERA.backproject(
        np.stack([columns, rows], axis=-1).reshape(-1, 2), np.ones(columns.size)
    )
    return (distance / (rays @ normal)).reshape(columns.shape).astype(np.float32)


def _frame(depth, rng):
    colour = rng.integers(0, 256, (*depth.shape, 3), dtype=np.uint8)
    return Frame(0, 0.0, colour, depth, CAMERA)


def test_cells_are_the_middles_of_a_planes_pixels_to_half_a_millimetre(rng):
    normal = np.array([0.2, 0.1, 1.0])
    frame = _frame(_plane_depth(normal, 2.0), rng)
    image = range_image_of(frame, 4, 5.0)
    assert image.points.shape == (120 * 160, 3)
    assert np.abs(image.points @ normal - 2.0).max() < 0.0006
    rows, columns = (grid.ravel() for grid in np.mgrid[1.5:480:4, 1.5:640:4])
    pixels = CAMERA.project(image.points)
    assert np.allclose(pixels, np.column_stack([columns, rows]), atol=1e-3)
    means = frame.colour.reshape(120, 4, 160, 4, 3).mean(axis=(1, 3)).reshape(-1, 3)
    assert np.abs(image.colours - means).max() <= 0.51
    assert image.nbytes == 5 * 120 * 160


def test_thumbnails_are_some_eighty_cells_wide_whatever_they_are_made_of(rng):
    frame = _frame(_plane_depth(np.array([0.2, 0.1, 1.0]), 2.0), rng)
    small, thinned = thumbnail_of(frame), range_image_of(frame, 4, 5.0).thumbnail
    assert small.depth_mm.shape == thinned.depth_mm.shape == (60, 80)
    means = frame.colour.reshape(60, 8, 80, 8, 3).mean(axis=(1, 3))
    for image in (small, thinned):
        assert np.abs(image.colour - means).max() <= 1.0
        assert np.abs(image.points @ np.array([0.2, 0.1, 1.0]) - 2.0).max() < 0.001


def test_the_mean_of_a_cell_is_less_noisy_than_a_reading(rng):
    depth = np.full((480, 640), 2.0) + 0.02 * rng.normal(size=(480, 640))
    cells = range_image_of(_frame(depth.astype(np.float32), rng), 4, 5.0)
    assert 0.0045 < np.std(cells.depth[cells.depth > 0]) < 0.0065


def test_thinning_twice_is_thinning_once_more(rng):
    frame = _frame(_plane_depth(np.array([0.0, 0.3, 1.0]), 2.0), rng)
    image = range_image_of(frame, 4, 5.0)
    thinner = image.every(2)
    assert thinner.depth_mm.shape == (60, 80)
    points = image.points.reshape(120, 160, 3)[1::2, 1::2].reshape(-1, 3)
    assert np.allclose(thinner.points, points, atol=1e-5)


def test_edges_holes_and_what_is_far_are_left_out(rng):
    depth = np.full((480, 640), 2.0, np.float32)
    depth[:, :100] = 0
    depth[:, 300:] = 3.0
    depth[:, 500:] = 5.0
    image = range_image_of(_frame(depth, rng), 1, 4.0)
    seen = np.flatnonzero(image.depth_mm[200])
    assert seen.tolist() == [*range(100, 299), *range(301, 499)]


def test_a_cell_needs_readings_in_half_of_its_pixels(rng):
    depth = np.full((480, 640), 2.0, np.float32)
    depth[:, ::2] = 0
    depth[0, 4:8] = depth[2, 4:8] = depth[240:] = 0
    image = range_image_of(_frame(depth, rng), 4, 5.0)
    assert image.depth_mm[0, 0] == 2000 and image.depth_mm[0, 1] == 0
    assert not image.depth_mm[60:].any()


def test_a_camera_that_no_stride_divides_keeps_its_scale(rng):
    camera = Intrinsics(101, 75, 80.0, 80.0, 50.0, 37.0)
    colour = np.zeros((75, 101, 3), np.uint8)
    frame = Frame(0, 0.0, colour, np.full((75, 101), 2.0, np.float32), camera)
    image = range_image_of(frame, 4, 5.0)
    assert image.depth_mm.shape == (18, 25) == (image.intrinsics.height, image.intrinsics.width)
    assert np.allclose(camera.project(image.points)[0], 1.5)


@pytest.mark.parametrize("normal", [(0, 0, 1), (0.5, 0, 1), (0, -0.8, 0.6), (0.3, 0.4, 0.7)])
def test_normals_of_a_plane_point_to_the_camera(normal, rng):
    normal = np.array(normal, float) / np.linalg.norm(normal)
    depth = _plane_depth(normal, 1.5)
    depth[(depth < 0.5) | (depth > 4)] = 0
    found = range_image_of(_frame(depth, rng), 4, 5.0).normals(NOISE)
    assert len(found) > 2000
    known = found.any(axis=1)
    assert known.mean() > 0.95
    # Whole millimetres are all that is lost.
    assert np.degrees(np.arccos(np.clip(found[known] @ -normal, -1, 1))).max() < 3.0


def test_no_normal_is_made_up_across_an_edge_or_for_a_lone_reading(rng):
    depth = np.zeros((24, 32), np.uint16)
    depth[:, :8], depth[:, 8:16] = 1000, 2000
    depth[12, 25] = 1500
    image = RangeImage(depth, np.zeros((24, 32, 3), np.uint8), CAMERA)
    normals = np.zeros((24, 32, 3))
    normals[depth > 0] = image.normals(NOISE)
    known = normals.any(axis=2)[12]
    assert known[2:6].all() and known[10:14].all()
    assert not known[6:10].any() and not known[25]
