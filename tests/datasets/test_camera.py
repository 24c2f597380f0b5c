import json

import numpy as np
import pytest

from roomgraph.datasets.camera import DepthCamera, Intrinsics, read_camera, tum_camera, write_camera
from roomgraph.datasets.errors import DatasetError


def test_projection_undoes_backprojection(rng):
    camera = Intrinsics(640, 480, 520.0, 530.0, 318.0, 243.0)
    pixels, depth = rng.uniform(0, 480, (30, 2)), rng.uniform(0.5, 5, 30)
    points = camera.backproject(pixels, depth)
    assert np.allclose(points[:, 2], depth)
    assert np.allclose(camera.project(points), pixels)


def test_camera_file_round_trip(tmp_path):
    camera = Intrinsics(320, 240, 260.5, 261.5, 160.25, 120.75, (0.1, -0.2, 0.0, 0.001, 0.0))
    write_camera(tmp_path / "camera.json", camera, 5000)
    read = read_camera(tmp_path / "camera.json")
    assert read.intrinsics == camera
    assert read.depth_scale == 5000
    assert read.depth is None


def test_camera_file_keeps_the_depth_camera(tmp_path):
    camera = Intrinsics(640, 480, 520.0, 521.0, 319.5, 239.5)
    T = np.array([[0, -1, 0, 0.025], [1, 0, 0, 0], [0, 0, 1, -0.001], [0, 0, 0, 1.0]])
    own = DepthCamera(Intrinsics(512, 424, 365.1, 365.2, 255.3, 211.4, (0.09, -0.2, 0, 0, 0.1)), T)
    write_camera(tmp_path / "camera.json", camera, 1000, own)
    read = read_camera(tmp_path / "camera.json")
    assert read.intrinsics == camera
    assert read.depth.intrinsics == own.intrinsics
    assert np.array_equal(read.depth.T_colour_depth, T)


def test_open3d_camera_is_column_major(tmp_path):
    path = tmp_path / "camera.json"
    matrix = [525, 0, 0, 0, 526, 0, 319, 239, 1]
    path.write_text(json.dumps({"width": 640, "height": 480, "intrinsic_matrix": matrix}))
    camera = read_camera(path).intrinsics
    assert (camera.fx, camera.fy, camera.cx, camera.cy) == (525, 526, 319, 239)


@pytest.mark.parametrize(
    "text", ["", "[1]", "{}", '{"width": 1}', '{"width":0,"height":1,"fx":1,"fy":1,"cx":0,"cy":0}']
)
def test_bad_camera_file_is_named(tmp_path, text):
    path = tmp_path / "camera.json"
    path.write_text(text)
    with pytest.raises(DatasetError, match=r"camera file.*camera\.json"):
        read_camera(path)


def test_a_depth_camera_of_its_own(tmp_path):
    path = tmp_path / "camera.json"
    values = {"width": 640, "height": 480, "fx": 520, "fy": 521, "cx": 319.5, "cy": 239.5}
    assert _read(path, values).depth is None
    # A motion is not needed, nor a focal length where both cameras see the same.
    small = _read(path, values | {"depth": {"width": 320, "height": 240}}).depth
    assert small.intrinsics == Intrinsics(320, 240, 260, 260.5, 159.5, 119.5)
    assert np.array_equal(small.T_colour_depth, np.eye(4))
    T = np.eye(4)
    T[0, 3] = 0.025
    other = values | {"fx": 585, "T_colour_depth": T.tolist()}
    read = _read(path, values | {"depth": other}).depth
    assert (read.intrinsics.fx, read.T_colour_depth[0, 3]) == (585, 0.025)


@pytest.mark.parametrize(
    ("T", "said"),
    [
        (np.diag([1.0, 1, 1, 25]).tolist(), "motion"),
        ([[1, 0, 0, 25.0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "metres"),
        ([[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "rotation"),
        ([1, 2], "4 x 4"),
        ("near", "invalid camera file"),
    ],
)
def test_a_motion_between_cameras_that_cannot_be(tmp_path, T, said):
    values = {"width": 640, "height": 480, "fx": 520, "fy": 521, "cx": 319.5, "cy": 239.5}
    with pytest.raises(DatasetError, match=said):
        _read(tmp_path / "camera.json", values | {"depth": values | {"T_colour_depth": T}})


def _read(path, values):
    path.write_text(json.dumps(values))
    return read_camera(path)


def test_missing_camera_file_says_what_to_do(tmp_path):
    with pytest.raises(DatasetError, match="--camera"):
        read_camera(tmp_path / "none.json")


@pytest.mark.parametrize(
    ("name", "fx"),
    [
        ("rgbd_dataset_freiburg1_xyz", 517.3),
        ("rgbd_dataset_freiburg2_desk", 520.9),
        ("fr3_office", 535.4),
        ("my_walk", 525.0),
    ],
)
def test_published_calibration_is_chosen_by_name(name, fx):
    camera = tum_camera(name)
    assert camera.intrinsics.fx == fx
    assert camera.depth_scale == 5000
    assert camera.intrinsics.is_distorted == (fx in (517.3, 520.9))
