import numpy as np
import pytest

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.trajectory import Trajectory, read_kitti, read_tum, write_kitti, write_tum


@pytest.fixture
def trajectory(random_poses):
    return Trajectory(1e9 + np.arange(20) / 30, random_poses)


def test_tum_round_trip(tmp_path, trajectory):
    write_tum(tmp_path / "t.tum", trajectory)
    back = read_tum(tmp_path / "t.tum")
    assert np.allclose(back.stamps_s, trajectory.stamps_s, atol=1e-6)
    assert np.allclose(back.T_world_camera, trajectory.T_world_camera, atol=1e-8)


def test_kitti_round_trip(tmp_path, trajectory):
    write_kitti(tmp_path / "t.txt", trajectory)
    back = read_kitti(tmp_path / "t.txt")
    assert np.allclose(back.T_world_camera, trajectory.T_world_camera, atol=1e-8)


def test_tum_agrees_with_evo(tmp_path, trajectory):
    from evo.tools import file_interface

    write_tum(tmp_path / "t.tum", trajectory)
    theirs = file_interface.read_tum_trajectory_file(str(tmp_path / "t.tum"))
    assert np.allclose(np.array(theirs.poses_se3), trajectory.T_world_camera, atol=1e-8)


def test_empty_trajectory_is_written(tmp_path):
    write_tum(tmp_path / "t.tum", Trajectory(np.empty(0), np.empty((0, 4, 4))))
    with pytest.raises(DatasetError, match="no poses"):
        read_tum(tmp_path / "t.tum")


def test_bad_line_is_named(tmp_path):
    path = tmp_path / "t.tum"
    path.write_text("# stamp\n1 0 0 0 0 0 0 1\n2 0 0 zero 0 0 0 1\n")
    with pytest.raises(DatasetError, match=r"t\.tum:3; expected 8 numbers"):
        read_tum(path)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(DatasetError, match=r"nothing\.tum"):
        read_tum(tmp_path / "nothing.tum")


def test_shapes_must_agree(random_poses):
    with pytest.raises(ValueError, match="3 stamps"):
        Trajectory(np.arange(3.0), random_poses)


def test_length_and_nearest(random_poses):
    line = np.tile(np.eye(4), (4, 1, 1))
    line[:, 0, 3] = [0, 1, 3, 3]
    trajectory = Trajectory(np.array([0.0, 1, 2, 3]), line)
    assert trajectory.length_m == 3
    nearest = trajectory.nearest(np.array([-5, 0.04, 1.96, 2.5, 3.01]), 0.05)
    assert nearest.tolist() == [-1, 0, 2, -1, 3]


def test_nearest_in_a_single_pose():
    trajectory = Trajectory(np.array([1.0]), np.eye(4)[None])
    assert trajectory.nearest(np.array([1.01, 2.0]), 0.05).tolist() == [0, -1]
