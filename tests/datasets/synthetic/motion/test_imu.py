"""What the IMU measures, against the motion it was made from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.synthetic.building import build
from roomgraph.datasets.synthetic.motion.hand import carry_by_hand
from roomgraph.datasets.synthetic.motion.imu import (
    GRAVITY,
    HEADER,
    ImuNoise,
    measure_imu,
    read_imu,
    write_imu,
)
from roomgraph.datasets.synthetic.motion.spline import MotionSpline
from roomgraph.datasets.synthetic.motion.walk import camera_poses, walk
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.trajectory import Trajectory

SILENT = ImuNoise(200.0, 0, 0, 0, 0, 0, 0)
WHITE = replace(SILENT, gyro_density=1.22e-4, accel_density=1.77e-3)


def figure_eight(seconds=20.0):
    stamps = np.arange(round(seconds * 30) + 1) / 30
    a = 2 * np.pi * stamps / 10
    xyz = np.column_stack([2 * np.sin(a), np.sin(2 * a), 1.2 + 0.05 * np.sin(5 * a)])
    heading = np.unwrap(np.arctan2(2 * np.cos(2 * a), 2 * np.cos(a)))
    pitch, roll = 0.3 * np.sin(3 * a), 0.1 * np.cos(4 * a)
    return Trajectory(stamps, camera_poses(xyz, heading, pitch, roll))


def standing(seconds, pitch=-0.4, roll=0.1):
    count = round(seconds * 30) + 1
    ones = np.ones(count)
    T = camera_poses(np.zeros((count, 3)), 0.7 * ones, pitch * ones, roll * ones)
    return Trajectory(np.arange(count) / 30, T)


def integrate(readings, T, velocity):
    """Carry a pose and a velocity through readings, with the mean of both ends of each step."""
    steps, w, f = np.diff(readings.stamps_s), readings.angular_velocity, readings.specific_force
    turns = Rotation.from_rotvec((w[:-1] + w[1:]) / 2 * steps[:, None]).as_matrix()
    R, p, v = T[:3, :3], T[:3, 3], velocity
    for step, turn, before, after in zip(steps, turns, f[:-1], f[1:], strict=True):
        acceleration = (R @ before + R @ turn @ after) / 2 + GRAVITY
        p = p + v * step + acceleration * step**2 / 2
        v = v + acceleration * step
        R = R @ turn
    return R, p, v


def errors(motion, readings):
    """Return the errors (3,) of rotation, position and velocity at the end of the readings."""
    ends = readings.stamps_s[[0, -1]]
    T, velocity = motion.poses(ends), motion.velocity(ends)
    R, p, v = integrate(readings, T[0], velocity[0])
    turn = Rotation.from_matrix(T[1, :3, :3].T @ R)
    return turn.as_rotvec(), p - T[1, :3, 3], v - velocity[1]


def corridor():
    return walk(build(0), BuildingSettings(step_m=0.04, frames=600))


def carried():
    return carry_by_hand(corridor(), np.random.default_rng(3)).trajectory


# The quick shakes of a hand are too much for steps of 5 ms: its error falls with their square.
@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "rate_hz"), [(figure_eight, 200.0), (corridor, 200.0), (carried, 800.0)]
)
def test_readings_without_noise_lead_along_the_true_motion(make, rate_hz):
    motion, noise = MotionSpline(make()), replace(SILENT, rate_hz=rate_hz)
    for begin in np.arange(0.0, 18.5, 1.37):
        readings = measure_imu(motion, begin, begin + 1, np.random.default_rng(0), noise)
        turn, shift, _ = errors(motion, readings)
        assert np.linalg.norm(shift) < 1e-3
        assert np.linalg.norm(turn) < np.deg2rad(0.02)


def test_white_noise_spreads_as_the_densities_say():
    motion, rng = MotionSpline(standing(2.0)), np.random.default_rng(5)
    found = np.array(
        [errors(motion, measure_imu(motion, 0.5, 1.5, rng, WHITE)) for _ in range(150)]
    )
    turn, shift, speed = found.transpose(1, 0, 2)
    gyro, accel, g = WHITE.gyro_density, WHITE.accel_density, 9.81
    # One second. A tilt, which is only about the level axes, turns gravity into acceleration.
    level = np.array([1.0, 1.0, 0.0])
    expected = {
        "turn": (turn, np.full(3, gyro)),
        "speed": (speed, np.sqrt(accel**2 + level * (g * gyro) ** 2 / 3)),
        "shift": (shift, np.sqrt(accel**2 / 3 + level * (g * gyro) ** 2 / 20)),
    }
    for name, (values, sigma) in expected.items():
        # Standard deviations of 150 draws scatter by 6 %; their means by 8 % of one.
        np.testing.assert_allclose(values.std(axis=0), sigma, rtol=0.25, err_msg=name)
        assert np.all(np.abs(values.mean(axis=0)) < 0.35 * sigma), name


def test_biases_are_in_the_readings_and_wander_as_they_should():
    motion, noise = MotionSpline(standing(20.0)), ImuNoise(gyro_density=0, accel_density=0)
    silent = measure_imu(motion, 0, 20, np.random.default_rng(0), SILENT)
    firsts, wanders = [], []
    for seed in range(60):
        readings = measure_imu(motion, 0, 20, np.random.default_rng(seed), noise)
        gyro, accel = readings.gyro_bias, readings.accel_bias
        np.testing.assert_allclose(
            readings.angular_velocity, silent.angular_velocity + gyro, atol=1e-12
        )
        np.testing.assert_allclose(
            readings.specific_force, silent.specific_force + accel, atol=1e-12
        )
        firsts.append([gyro[0], accel[0]])
        wanders.append([gyro[-1] - gyro[0], accel[-1] - accel[0]])
    # 180 draws each: standard deviations within 5 %.
    spread = np.sqrt(np.mean(np.square(firsts), axis=(0, 2)))
    np.testing.assert_allclose(spread, [noise.gyro_bias, noise.accel_bias], rtol=0.25)
    spread = np.sqrt(np.mean(np.square(wanders), axis=(0, 2)))
    expected = np.sqrt(20) * np.array([noise.gyro_walk, noise.accel_walk])
    np.testing.assert_allclose(spread, expected, rtol=0.25)


def test_standing_it_feels_only_gravity_upwards():
    motion = MotionSpline(standing(2.0, pitch=0.0, roll=0.0))
    readings = measure_imu(motion, 0, 2, np.random.default_rng(0), SILENT)
    # The camera's y points down, and what it feels is the floor that holds it up.
    np.testing.assert_allclose(readings.specific_force, np.tile([0, -9.81, 0], (401, 1)), atol=1e-9)
    np.testing.assert_allclose(readings.angular_velocity, 0, atol=1e-9)
    motion = MotionSpline(standing(2.0, pitch=-np.pi / 6, roll=0.0))
    tilted = measure_imu(motion, 0, 2, np.random.default_rng(0), SILENT).specific_force[0]
    # Looking down by 30 degrees, the floor is partly ahead: upwards is partly backwards.
    np.testing.assert_allclose(tilted, 9.81 * np.array([0, -np.sqrt(3) / 2, -0.5]), atol=1e-9)


def test_stamps_and_same_seed():
    motion = MotionSpline(figure_eight())
    a, b = (measure_imu(motion, 1.0, 3.3, np.random.default_rng(7)) for _ in range(2))
    np.testing.assert_allclose(a.stamps_s, 1.0 + np.arange(461) / 200, atol=1e-9)
    np.testing.assert_array_equal(a.angular_velocity, b.angular_velocity)
    np.testing.assert_array_equal(a.specific_force, b.specific_force)
    other = measure_imu(motion, 1.0, 3.3, np.random.default_rng(8))
    assert not np.allclose(a.specific_force, other.specific_force)


@pytest.mark.parametrize(("begin", "end"), [(-1, 2), (5, 21), (3, 2)])
def test_nothing_is_measured_outside_the_motion(begin, end):
    motion = MotionSpline(figure_eight())
    with pytest.raises(ValueError, match="not within"):
        measure_imu(motion, begin, end, np.random.default_rng(0))


def test_a_file_gives_the_readings_back(tmp_path):
    motion = MotionSpline(figure_eight())
    readings = measure_imu(motion, 2, 4, np.random.default_rng(1))
    write_imu(tmp_path / "imu.csv", readings)
    lines = (tmp_path / "imu.csv").read_text().splitlines()
    assert lines[0] == HEADER
    assert lines[1].startswith("2000000000,")
    assert len(lines) == 1 + 401
    back = read_imu(tmp_path / "imu.csv")
    np.testing.assert_allclose(back.stamps_s, readings.stamps_s, atol=1e-9)
    np.testing.assert_allclose(back.angular_velocity, readings.angular_velocity, atol=1e-10)
    np.testing.assert_allclose(back.specific_force, readings.specific_force, atol=1e-10)
    assert not back.gyro_bias.any()
    assert back.accel_bias.shape == (401, 3)


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ("20,1,2,3,4,5", "invalid line"),
        ("20,1,2,3,4,5,6,7", "invalid line"),
        ("20,1,2,three,4,5,6", "invalid line"),
        ("20,1,2,nan,4,5,6", "invalid line"),
        ("0.02,1,2,3,4,5,6", "invalid line"),
        ("10,1,2,3,4,5,6", "do not rise"),
    ],
)
def test_a_bad_line_is_named(tmp_path, row, told):
    path = tmp_path / "imu.csv"
    path.write_text(f"{HEADER}\n10,0,0,0,0,-9.81,0\n\n{row}\n")
    with pytest.raises(DatasetError, match=told) as error:
        read_imu(path)
    assert error.value.where == f"{path}:4"


@pytest.mark.parametrize("text", [None, "", HEADER + "\n"])
def test_no_file_or_an_empty_one_is_an_error(tmp_path, text):
    path = tmp_path / "imu.csv"
    if text is not None:
        path.write_text(text)
    with pytest.raises(DatasetError) as error:
        read_imu(path)
    assert error.value.where == path
