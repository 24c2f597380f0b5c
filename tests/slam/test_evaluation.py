import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.slam.errors import SlamError
from roomgraph.slam.evaluation import compare, surface_distance


@pytest.fixture
def pair(random_poses, rng):
    """A random truth, and an estimate that is moved as a whole and noisy."""
    stamps = np.arange(20) / 30
    noise = np.array([se3.exponential(0.03 * rng.normal(size=6)) for _ in range(20)])
    return Trajectory(stamps, random_poses[5] @ random_poses @ noise), Trajectory(
        stamps, random_poses
    )


def test_errors_agree_with_evo(pair):
    from evo.core import metrics, sync
    from evo.core.trajectory import PoseTrajectory3D

    estimate, truth = (
        PoseTrajectory3D(poses_se3=list(t.T_world_camera), timestamps=t.stamps_s) for t in pair
    )
    ours = compare(*pair)
    rotation = metrics.RPE(metrics.PoseRelation.rotation_angle_deg, 1, metrics.Unit.frames)
    translation = metrics.RPE(metrics.PoseRelation.translation_part, 1, metrics.Unit.frames)
    truth, estimate = sync.associate_trajectories(truth, estimate)
    for metric in (rotation, translation):
        metric.process_data((truth, estimate))
    estimate.align(truth)
    absolute = metrics.APE(metrics.PoseRelation.translation_part)
    absolute.process_data((truth, estimate))
    rmse = metrics.StatisticsType.rmse
    assert np.isclose(ours.ate_rmse_m, absolute.get_statistic(rmse))
    assert np.isclose(ours.rpe_trans_rmse_m, translation.get_statistic(rmse))
    assert np.isclose(ours.rpe_rot_rmse_deg, rotation.get_statistic(rmse))


def test_a_rigid_move_is_no_error(random_poses):
    truth = Trajectory(np.arange(20.0), random_poses)
    moved = Trajectory(np.arange(20.0), random_poses[3] @ random_poses)
    error = compare(moved, truth)
    assert error.ate_rmse_m < 1e-9
    assert error.rpe_trans_rmse_m < 1e-9


def test_scale_is_an_error(random_poses):
    wrong = random_poses.copy()
    wrong[:, :3, 3] *= 1.1
    truth = Trajectory(np.arange(20.0), random_poses)
    assert compare(Trajectory(np.arange(20.0), wrong), truth).ate_rmse_m > 0.05


def test_no_common_time_is_said(random_poses):
    truth = Trajectory(np.arange(20.0), random_poses)
    with pytest.raises(SlamError, match="0 of 20"):
        compare(Trajectory(np.arange(20.0) + 0.5, random_poses), truth)


def test_surface_distance_is_that_to_the_nearest_triangle(rng):
    vertices = np.array([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0.0)])
    triangles = np.array([(0, 1, 2), (0, 2, 3)])
    heights = np.linspace(-0.1, 0.1, 201)
    points = np.column_stack([rng.uniform(0, 4, (201, 2)), heights])
    found = surface_distance(points, vertices, triangles)
    assert np.allclose(found.distances_m, np.abs(heights), atol=1e-6)
    assert found.median_m == pytest.approx(0.05, abs=1e-3)
    assert found.p95_m == pytest.approx(0.095, abs=1e-3)
    beside = surface_distance(np.array([(7.0, 8.0, 0.0)]), vertices, triangles)
    assert beside.median_m == pytest.approx(5.0)


def test_no_points_are_infinitely_far():
    none = surface_distance(np.empty((0, 3)), np.eye(3), np.array([(0, 1, 2)]))
    assert none.median_m == none.p95_m == np.inf and len(none.distances_m) == 0
