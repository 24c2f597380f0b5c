"""What the wheels say about the way, against the way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.synthetic.motion.wheels import WheelSettings, drive, planar_poses
from roomgraph.datasets.trajectory import Trajectory, read_tum, write_tum

PERFECT = WheelSettings(0.3, 0, 0, 0, 0, 0, 0)
# Camera x right, y down, z forward, in a base whose x is forward and z up.
R_BASE_CAMERA = np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]])


def way(xyz, heading, pitch=0.0):
    zero = np.zeros(len(heading))
    return Trajectory(np.arange(len(xyz)) / 30, camera_poses(xyz, heading, zero + pitch, zero))


def figure_eight(laps=2, aside=0.3):
    """Laps of 23 m that also climb, looking `aside` of the way."""
    a = np.linspace(0, 2 * np.pi * laps, 600 * laps)
    xyz = np.column_stack([5 + 4 * np.sin(a), 2 * np.sin(2 * a), 0.8 + 0.2 * a])
    heading = np.unwrap(np.arctan2(4 * np.cos(2 * a), 4 * np.cos(a)))
    return way(xyz, heading + aside)


def straight(length):
    x = np.arange(0, length + 0.02, 0.04)
    zero = np.zeros_like(x)
    return way(np.column_stack([x, zero, zero + 0.8]), zero)


def ends(trajectory, settings, seeds=150):
    """Return the last x, y and heading (N, 3) of many drives."""
    drives = (drive(trajectory, np.random.default_rng(s), settings) for s in range(seeds))
    last = np.array([driven.T_world_camera[-1] for driven in drives])
    heading = np.arctan2(last[:, 1, 0], last[:, 0, 0])
    return np.column_stack([last[:, 0, 3], last[:, 1, 3], heading])


@pytest.mark.parametrize("pitch", [0.0, -1.5, -1.7])
def test_perfect_wheels_tell_the_truth_on_the_plane(pitch):
    level = figure_eight()
    tilted = way(level.positions, planar_poses(level)[:, 2], pitch)
    driven = drive(tilted, np.random.default_rng(0), PERFECT)
    np.testing.assert_array_equal(driven.stamps_s, tilted.stamps_s)
    np.testing.assert_array_equal(driven.T_world_camera[0], np.eye(4))
    T_world_base = level.T_world_camera @ se3.pose(R_BASE_CAMERA.T)
    T_world_base[:, 2, 3] = 0
    true = se3.inverse(T_world_base[0]) @ T_world_base
    np.testing.assert_allclose(driven.T_world_camera, true, atol=1e-9)


def test_real_wheels_stay_on_the_plane():
    T = drive(figure_eight(), np.random.default_rng(0)).T_world_camera
    np.testing.assert_array_equal(T[:, 2], np.tile([0.0, 0, 1, 0], (len(T), 1)))
    np.testing.assert_array_equal(T[:, :2, 2], 0)
    np.testing.assert_allclose(
        T[:, :3, :3] @ np.swapaxes(T[:, :3, :3], 1, 2)[:], [np.eye(3)] * len(T), atol=1e-12
    )


def test_drift_of_a_walk_is_what_such_robots_have():
    trajectory = figure_eight(4)
    true = drive(trajectory, np.random.default_rng(0), PERFECT).positions
    length = np.linalg.norm(np.diff(true, axis=0), axis=1).sum()
    assert 80 < length < 120
    largest = [
        np.linalg.norm(drive(trajectory, np.random.default_rng(s)).positions - true, axis=1).max()
        for s in range(40)
    ]
    assert 0.005 * length < np.median(largest) < 0.05 * length
    assert 0.001 * length < min(largest)
    assert max(largest) < 0.15 * length


def test_noise_grows_with_the_root_of_the_way():
    settings = replace(PERFECT, noise_m=0.002)
    for length in (4.0, 36.0):
        trajectory = straight(length)
        drives = [drive(trajectory, np.random.default_rng(s), settings) for s in range(150)]
        lengths = np.array([driven.length_m for driven in drives])
        # Two wheels: their mean has a sigma less by the root of two, their difference more.
        sigma = 0.002 * np.sqrt(length)
        assert lengths.std() == pytest.approx(sigma / np.sqrt(2), rel=0.25)
        heading = ends(trajectory, settings)[:, 2]
        assert heading.std() == pytest.approx(sigma * np.sqrt(2) / 0.3, rel=0.25)


def test_scales_and_base_change_way_and_turn_in_proportion():
    x, _, heading = ends(straight(20.0), replace(PERFECT, scale=0.005)).T
    assert (x - 20).std() == pytest.approx(0.1, rel=0.25)
    np.testing.assert_allclose(heading, 0, atol=1e-12)
    _, _, heading = ends(straight(20.0), replace(PERFECT, mismatch=0.0003)).T
    assert heading.std() == pytest.approx(20 * 0.0003 * np.sqrt(2) / 0.3, rel=0.25)
    spot = way(np.zeros((61, 3)), np.linspace(0, 2.0, 61))
    _, _, heading = ends(spot, replace(PERFECT, base_error=0.01)).T
    assert (heading - 2).std() == pytest.approx(0.02, rel=0.25)
    _, _, heading = ends(spot, replace(PERFECT, turn_noise_rad=0.01)).T
    assert (heading - 2).std() == pytest.approx(0.01 * np.sqrt(2), rel=0.25)


def test_slips_are_as_many_as_wanted_and_short():
    trajectory, counts, frames = straight(200.0), [], []
    for seed in range(60):
        settings = replace(PERFECT, slips=3.0)
        T = drive(trajectory, np.random.default_rng(seed), settings).T_world_camera
        turned = np.abs(np.diff(np.arctan2(T[:, 1, 0], T[:, 0, 0]))) > 1e-9
        edges = np.diff(np.concatenate([[False], turned, [False]]).astype(int))
        counts.append(np.count_nonzero(edges == 1))
        frames += list(np.flatnonzero(edges == -1) - np.flatnonzero(edges == 1))
    # Poisson of 6 in 200 m: the mean of 60 scatters by 0.3.
    assert np.mean(counts) == pytest.approx(6, abs=1.0)
    # 0.4 s at 30 Hz; now and then two of them meet.
    assert np.median(frames) == pytest.approx(12, abs=1)


def test_the_same_seed_drives_the_same_way():
    a, b, c = (drive(figure_eight(), np.random.default_rng(seed)) for seed in (4, 4, 5))
    np.testing.assert_array_equal(a.T_world_camera, b.T_world_camera)
    assert np.abs(a.positions - c.positions).max() > 0.01


@pytest.mark.parametrize("count", [0, 1, 2])
def test_short_ways(count):
    trajectory = way(np.zeros((count, 3)), np.zeros(count))
    driven = drive(trajectory, np.random.default_rng(0))
    np.testing.assert_array_equal(driven.T_world_camera, np.tile(np.eye(4), (count, 1, 1)))


def test_it_can_be_written_and_read(tmp_path):
    driven = drive(figure_eight(), np.random.default_rng(0))
    write_tum(tmp_path / "odometry.txt", driven)
    back = read_tum(tmp_path / "odometry.txt")
    np.testing.assert_allclose(back.T_world_camera, driven.T_world_camera, atol=1e-8)
