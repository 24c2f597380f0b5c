"""A smooth motion through poses."""

from __future__ import annotations

import time

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from roomgraph.datasets.synthetic.motion.spline import MotionSpline
from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.trajectory import Trajectory

RADIUS, RATE = 1.5, 0.6


def circle(stamps, begin=0.0):
    """Laps of a circle, looking along the way; the height swings."""
    angle = RATE * (stamps - begin)
    xyz = np.column_stack([RADIUS * np.cos(angle), RADIUS * np.sin(angle), 0.1 * np.sin(3 * angle)])
    zero = np.zeros_like(angle)
    return Trajectory(stamps, camera_poses(xyz, angle + np.pi / 2, zero - 0.1, zero))


def frames(seconds, begin=0.0):
    return begin + np.arange(round(seconds * 30) + 1) / 30


def angles(A, B):
    R = Rotation.from_matrix(A[:, :3, :3]).inv() * Rotation.from_matrix(B[:, :3, :3])
    return R.magnitude()


@pytest.mark.parametrize("begin", [0.0, 1.7e9])
def test_it_passes_through_every_pose(begin):
    trajectory = circle(frames(25, begin), begin)
    motion = MotionSpline(trajectory)
    assert (motion.begin_s, motion.end_s) == (trajectory.stamps_s[0], trajectory.stamps_s[-1])
    np.testing.assert_allclose(
        motion.poses(trajectory.stamps_s), trajectory.T_world_camera, atol=1e-9
    )


def test_between_poses_it_follows_the_circle_and_its_derivatives():
    motion = MotionSpline(circle(frames(25)))
    stamps = np.linspace(0.5, 24.5, 1999)
    true = circle(stamps).T_world_camera
    got = motion.poses(stamps)
    assert np.abs(got[:, :3, 3] - true[:, :3, 3]).max() < 1e-6
    assert angles(got, true).max() < 1e-6
    angle = RATE * stamps
    swing = -0.1 * 9 * RATE**2 * np.sin(3 * angle)
    inwards = -RADIUS * RATE**2 * np.column_stack([np.cos(angle), np.sin(angle)])
    acceleration = np.column_stack([inwards, swing])
    np.testing.assert_allclose(motion.acceleration(stamps), acceleration, atol=1e-4)
    # The world turns about its z, which the camera sees upwards and, pitched down, backwards.
    expected = RATE * np.array([0.0, -np.cos(0.1), -np.sin(0.1)])
    np.testing.assert_allclose(
        motion.angular_velocity(stamps), np.tile(expected, (len(stamps), 1)), atol=1e-5
    )


def rough(seed=0):
    """Poses that shake about all axes."""
    rng = np.random.default_rng(seed)
    trajectory = circle(frames(6))
    T = trajectory.T_world_camera.copy()
    shake = Rotation.from_rotvec(0.05 * rng.standard_normal((len(T), 3)))
    T[:, :3, :3] = (Rotation.from_matrix(T[:, :3, :3]) * shake).as_matrix()
    T[:, :3, 3] += 0.01 * rng.standard_normal((len(T), 3))
    return Trajectory(trajectory.stamps_s, T)


def test_derivatives_are_those_of_the_poses():
    motion = MotionSpline(rough())
    stamps, h = np.random.default_rng(1).uniform(0.1, 5.9, 500), 1e-5
    before, after = motion.poses(stamps - h), motion.poses(stamps + h)
    slope = (after[:, :3, 3] - before[:, :3, 3]) / (2 * h)
    np.testing.assert_allclose(motion.velocity(stamps), slope, atol=1e-4)
    slope = (motion.velocity(stamps + h) - motion.velocity(stamps - h)) / (2 * h)
    np.testing.assert_allclose(motion.acceleration(stamps), slope, rtol=1e-4, atol=1e-2)
    turn = Rotation.from_matrix(before[:, :3, :3]).inv() * Rotation.from_matrix(after[:, :3, :3])
    np.testing.assert_allclose(motion.angular_velocity(stamps), turn.as_rotvec() / 2 / h, atol=1e-4)


def test_rates_do_not_jump_at_the_poses():
    trajectory = rough()
    motion, knots, h = MotionSpline(trajectory), trajectory.stamps_s[1:-1], 1e-6
    for rate in (motion.acceleration, motion.angular_velocity):
        jump = np.abs(rate(knots + h) - rate(knots - h)).max()
        assert jump < 1e-3 * np.abs(rate(knots)).max()


def test_acceleration_has_no_kinks():
    trajectory = rough()
    motion, knots, h = MotionSpline(trajectory), trajectory.stamps_s[4:-4], 1e-4
    before, at, after = (motion.acceleration(knots + shift) for shift in (-h, 0.0, h))
    slope = (after - before) / (2 * h)
    assert np.abs((after - at) / h - slope).max() < 0.05 * np.abs(slope).max()


@pytest.mark.parametrize("count", range(1, 8))
def test_few_poses_are_enough(count):
    trajectory = circle(frames((count - 1) / 30))
    motion = MotionSpline(trajectory)
    np.testing.assert_allclose(
        motion.poses(trajectory.stamps_s), trajectory.T_world_camera, atol=1e-9
    )
    middle = np.array([motion.end_s / 2])
    assert angles(motion.poses(middle), circle(middle).T_world_camera).max() < 1e-4
    assert motion.acceleration(middle).shape == motion.angular_velocity(middle).shape == (1, 3)


def test_it_stands_still():
    T = np.repeat(circle(np.array([1.0])).T_world_camera, 90, axis=0)
    motion = MotionSpline(Trajectory(frames(89 / 30), T))
    stamps = np.linspace(0, 2.9, 77)
    np.testing.assert_allclose(motion.poses(stamps), T[:77], atol=1e-12)
    for rate in (motion.velocity, motion.acceleration, motion.angular_velocity):
        np.testing.assert_allclose(rate(stamps), 0, atol=1e-9)


def test_stamps_outside_are_clipped():
    trajectory = circle(frames(3))
    motion = MotionSpline(trajectory)
    outside = motion.poses(np.array([-5.0, 99.0]))
    np.testing.assert_allclose(outside, trajectory.T_world_camera[[0, -1]], atol=1e-9)


@pytest.mark.parametrize("stamps", [[], [0.0, 0.0], [0.0, 2.0, 1.0]])
def test_no_motion_without_rising_stamps(stamps):
    with pytest.raises(ValueError, match=r"pose|rise"):
        MotionSpline(circle(np.array(stamps, dtype=float)))


def test_a_long_walk_does_not_take_long():
    trajectory = circle(frames(100))
    begin = time.process_time()
    MotionSpline(trajectory)
    assert time.process_time() - begin < 2
