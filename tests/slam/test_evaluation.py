import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.slam.errors import SlamError
from roomgraph.slam.evaluation import compare


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
