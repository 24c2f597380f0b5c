import json

import numpy as np
import pytest

from datasets.camera import Intrinsics, read_camera, tum_camera, write_camera
from datasets.errors import DatasetError


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
