"""A walk in the hand, against the walk."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from roomgraph.datasets.synthetic.motion.hand import CALM_S, carry_by_hand
from roomgraph.datasets.synthetic.motion.spline import MotionSpline
from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.trajectory import Trajectory

SEEDS = range(6)
BLURRED = {"fast_turn", "shake", "cover"}


def straight(seconds=120.0, rate=30.0, speed=1.0, begin=0.0):
    """A level walk straight ahead, with a rest of 20 s in its middle."""
    times = np.arange(round(seconds * rate) + 1) / rate
    middle, zero = seconds / 2, np.zeros_like(times)
    x = speed * (np.minimum(times, middle - 10) + np.maximum(times - middle - 10, 0))
    T = camera_poses(np.column_stack([x, zero, zero + 1.4]), zero + 0.5, zero, zero)
    return Trajectory(begin + times, T)


def figure_eight(seconds=120.0):
    """Round and round at about a metre a second."""
    times = np.arange(round(seconds * 30) + 1) / 30
    a = times / 5
    xyz = np.column_stack([4 * np.sin(a), 2 * np.sin(2 * a), np.full_like(a, 0.8)])
    heading = np.unwrap(np.arctan2(4 * np.cos(2 * a), 4 * np.cos(a)))
    return Trajectory(times, camera_poses(xyz, heading, 0 * a, 0 * a))


def carry(trajectory, seed):
    return carry_by_hand(trajectory, np.random.default_rng(seed))


def rates(trajectory):
    """Return the angle by which each frame turns the next, by time: degrees a second (N - 1,)."""
    R = Rotation.from_matrix(trajectory.T_world_camera[:, :3, :3])
    return np.rad2deg((R[:-1].inv() * R[1:]).magnitude()) / np.diff(trajectory.stamps_s)


def within(stretch, stamps):
    return (stamps >= stretch.begin_s) & (stamps <= stretch.end_s)


def only(carried, *kinds):
    return [stretch for stretch in carried.stretches if stretch.kind in kinds]


def forward(trajectory):
    """Return heading and pitch (N,) of where the camera looks, degrees."""
    z = trajectory.T_world_camera[:, :3, 2]
    return np.rad2deg(np.arctan2(z[:, 1], z[:, 0])), np.rad2deg(np.arcsin(z[:, 2]))


@pytest.mark.parametrize("seed", SEEDS)
def test_it_keeps_near_the_walk_with_true_rotations(seed):
    trajectory = figure_eight()
    carried = carry(trajectory, seed).trajectory
    np.testing.assert_array_equal(carried.stamps_s, trajectory.stamps_s)
    away = np.linalg.norm(carried.positions - trajectory.positions, axis=1)
    assert 0.03 < away.max() < 0.12
    R = carried.T_world_camera[:, :3, :3]
    np.testing.assert_allclose(R @ np.swapaxes(R, 1, 2), [np.eye(3)] * len(R), atol=1e-9)
    assert np.linalg.det(R).min() > 0


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("seconds", [62.0, 120.0, 300.0])
def test_five_to_ten_stretches_a_minute_are_blurred_or_blank(seed, seconds):
    carried = carry(straight(seconds, begin=1e9), seed)
    minutes = (seconds - CALM_S) / 60
    assert 5 * minutes <= len(only(carried, *BLURRED)) <= 10 * minutes
    counts = Counter(stretch.kind for stretch in carried.stretches)
    assert set(counts) >= BLURRED
    assert counts["fast_turn"] % 2 == 0


def test_every_kind_takes_the_time_it_should_and_none_meets_another():
    limits = {
        "fast_turn": (0.3, 0.5), "shake": (0.4, 0.8), "cover": (0.3, 1.0), "look_down": (2.4, 4.0)
    }  # fmt: skip
    seen = Counter()
    for seed in SEEDS:
        carried = carry(straight(begin=50.0), seed)
        assert carried.stretches[0].begin_s > 50 + CALM_S
        assert carried.stretches[-1].end_s < 170
        for before, after in pairwise(carried.stretches):
            assert after.begin_s - before.end_s > 0.2
        for stretch in carried.stretches:
            low, high = limits[stretch.kind]
            assert low - 1e-6 <= stretch.end_s - stretch.begin_s <= high + 1e-6, stretch
            seen[stretch.kind] += 1
    # Twelve or so slots in each of six walks, and in half of them a look down.
    assert seen["look_down"] > 15


@pytest.mark.parametrize("seed", SEEDS)
def test_fast_turns_look_aside_and_back(seed):
    carried = carry(straight(rate=240), seed)
    trajectory, turned = carried.trajectory, rates(carried.trajectory)
    heading, _ = forward(trajectory)
    turns = only(carried, "fast_turn")
    assert turns
    for there, back in zip(turns[::2], turns[1::2], strict=True):
        assert 0.25 < back.begin_s - there.end_s < 1.05
        for stretch in (there, back):
            begin, end = np.interp([stretch.begin_s, stretch.end_s], trajectory.stamps_s, heading)
            # Drift and tremor take or add a little.
            assert 37 < abs(end - begin) < 93
            # The tremor's own rate comes on top.
            peak = np.percentile(turned[within(stretch, trajectory.stamps_s[1:])], 80)
            assert 140 < peak < 275
        begin, end = np.interp([there.begin_s, back.end_s], trajectory.stamps_s, heading)
        # Meanwhile the drift of up to 2 s went on.
        assert abs(end - begin) < 12


@pytest.mark.parametrize("seed", SEEDS)
def test_looks_down_see_the_floor(seed):
    carried = carry(straight(), seed)
    _, pitch = forward(carried.trajectory)
    stamps = carried.trajectory.stamps_s
    downs = only(carried, "look_down")
    low = np.zeros(len(stamps), dtype=bool)
    for stretch in downs:
        inside = within(stretch, stamps)
        low |= inside
        assert -68 < pitch[inside].min() < -28
        deep = np.ptp(stamps[inside & (pitch < pitch[inside].min() + 6)])
        assert 0.8 < deep < 3.0
    shaken = np.any([within(s, stamps) for s in only(carried, "shake")], axis=0)
    assert np.abs(pitch[~low & ~shaken]).max() < 8


@pytest.mark.parametrize("seed", SEEDS)
def test_shakes_are_quick_and_covers_do_not_move(seed):
    trajectory = straight(rate=240)
    carried = carry(trajectory, seed)
    stamps, turned = carried.trajectory.stamps_s, rates(carried.trajectory)
    for stretch in only(carried, "shake"):
        # 4 to 8 degrees at 5 to 7 Hz.
        assert 100 < turned[within(stretch, stamps[1:])].max() < 400
    for stretch in only(carried, "cover"):
        assert turned[within(stretch, stamps[1:])].max() < 40


@pytest.mark.parametrize("seed", SEEDS)
def test_the_beginning_is_calm_but_not_still(seed):
    trajectory = straight()
    carried = carry(trajectory, seed).trajectory
    calm = carried.stamps_s[1:] <= CALM_S
    turned = rates(carried)[calm]
    assert np.median(turned) > 1
    assert turned.max() < 40
    R = Rotation.from_matrix(trajectory.T_world_camera[0, :3, :3]).inv() * Rotation.from_matrix(
        carried.T_world_camera[:60, :3, :3]
    )
    assert np.rad2deg(R.magnitude()).max() < 11


def spectrum(values, rate):
    """Return frequencies, and the amplitude of a wave at each."""
    window = np.hanning(len(values))
    strength = np.abs(np.fft.rfft((values - values.mean()) * window)) / window.sum() * 2
    return np.fft.rfftfreq(len(values), 1 / rate), strength


def test_steps_are_felt_when_walking_and_not_when_standing():
    trajectory = straight(rate=60)
    carried = carry(trajectory, 0).trajectory
    height = carried.positions[:, 2] - trajectory.positions[:, 2]
    stamps, band = trajectory.stamps_s, {}
    for name, begin in (("walk", 5), ("rest", 52)):
        hertz, strength = spectrum(height[(stamps >= begin) & (stamps < begin + 16)], 60)
        steps = (hertz > 1.5) & (hertz < 2.1)
        tremor = (hertz > 7.9) & (hertz < 10.1)
        band[name] = np.sqrt((strength[steps] ** 2).sum()), strength[tremor].max()
        assert strength[hertz > 10.6].max() < 2e-4
    assert 0.010 < band["walk"][0] < 0.030
    assert band["rest"][0] < 0.001
    for _, tremor in band.values():
        assert 5e-5 < tremor < 8e-4


def test_rotation_is_smooth():
    # Seen four times finer, angular velocity changes by a fourth: it does not jump.
    steps = []
    for rate in (120.0, 480.0):
        R = Rotation.from_matrix(carry(straight(rate=rate), 1).trajectory.T_world_camera[:, :3, :3])
        velocity = (R[:-1].inv() * R[1:]).as_rotvec() * rate
        steps.append(np.linalg.norm(np.diff(velocity, axis=0), axis=1).max())
    assert steps[1] < 0.3 * steps[0]


def test_the_rate_of_frames_does_not_change_what_happens():
    slow, fast = carry(straight(rate=30), 2), carry(straight(rate=60), 2)
    assert slow.stretches == fast.stretches
    apart = slow.trajectory.T_world_camera - fast.trajectory.T_world_camera[::2]
    assert np.abs(apart).max() < 1e-3


def test_the_same_seed_gives_the_same_walk():
    a, b, c = (carry(figure_eight(), seed) for seed in (4, 4, 5))
    assert a.stretches == b.stretches
    np.testing.assert_array_equal(a.trajectory.T_world_camera, b.trajectory.T_world_camera)
    assert a.stretches != c.stretches


@pytest.mark.parametrize("count", [0, 1, 2, 5, 200])
def test_short_walks_have_no_stretches(count):
    trajectory = straight(20)
    trajectory = Trajectory(trajectory.stamps_s[:count], trajectory.T_world_camera[:count])
    carried = carry(trajectory, 0)
    assert len(carried.trajectory) == count
    assert carried.stretches == ()


def test_a_walk_of_ten_seconds_has_one_mishap():
    found = [carry(straight(10.0), seed) for seed in range(20)]
    assert {len({stretch.kind for stretch in only(c, *BLURRED)}) for c in found} == {1}
    assert max(stretch.end_s for c in found for stretch in c.stretches) < 10


def test_a_spline_follows_it():
    carried = carry(figure_eight(), 0).trajectory
    stamps = np.arange(0, 120, 1 / 240)
    motion = MotionSpline(carried)
    assert np.abs(motion.acceleration(stamps)).max() < 60
    turned = np.rad2deg(np.linalg.norm(motion.angular_velocity(stamps), axis=1))
    assert 150 < turned.max() < 600
