"""What an IMU in the camera measures, and its EuRoC file.

The axes of the IMU are the camera's (x right, y down, z forward) and it sits at the camera's
centre: T_camera_imu is the identity.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.files import write_text
from roomgraph.datasets.synthetic.motion.spline import MotionSpline

FloatArray = NDArray[np.float64]

GRAVITY = np.array([0.0, 0.0, -9.81])
HEADER = (
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
    "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]"
)
COLUMNS = 7


@dataclass(frozen=True, slots=True)
class ImuNoise:
    """Rate and noise of an IMU; the defaults are those of a phone.

    The densities are the typical ones of the BMI160's data sheet (7 mdps and 180 ug by square
    root of hertz), the random walks those published with the TUM-VI data set, which has that
    chip. The constant biases are what is left when a phone has calibrated itself.

    Attributes
    ----------
    rate_hz : float
        Readings a second.
    gyro_density, accel_density : float
        White noise, rad/s/sqrt(Hz) and m/s^2/sqrt(Hz).
    gyro_walk, accel_walk : float
        Random walk of the biases, rad/s^2/sqrt(Hz) and m/s^3/sqrt(Hz).
    gyro_bias, accel_bias : float
        Standard deviation of each axis' first bias, rad/s and m/s^2.
    """

    rate_hz: float = 200.0
    gyro_density: float = 1.22e-4
    accel_density: float = 1.77e-3
    gyro_walk: float = 2.2e-5
    accel_walk: float = 8.6e-4
    gyro_bias: float = 5e-3
    accel_bias: float = 5e-2


@dataclass(frozen=True, slots=True, eq=False)
class ImuReadings:
    """Readings of an IMU, in its own axes.

    Attributes
    ----------
    stamps_s : (N,) float64
        Seconds, rising.
    angular_velocity : (N, 3) float64
        Of the gyroscope, rad/s.
    specific_force : (N, 3) float64
        Of the accelerometer, m/s^2: acceleration less gravity.
    gyro_bias, accel_bias : (N, 3) float64
        What the readings hold of biases; zeros if not known.
    """

    stamps_s: FloatArray
    angular_velocity: FloatArray
    specific_force: FloatArray
    gyro_bias: FloatArray
    accel_bias: FloatArray


def measure_imu(
    motion: MotionSpline,
    begin_s: float,
    end_s: float,
    rng: np.random.Generator,
    noise: ImuNoise | None = None,
) -> ImuReadings:
    """Measure from `begin_s` to `end_s`, the last reading at or just before `end_s`.

    Raises
    ------
    ValueError
        The time is not within the motion's (half a reading of leave is given), or runs backwards.
    """
    noise = noise or ImuNoise()
    leave = 0.5 / noise.rate_hz
    if not motion.begin_s - leave <= begin_s <= end_s <= motion.end_s + leave:
        raise ValueError(
            f"{begin_s} s to {end_s} s is not within the motion's "
            f"{motion.begin_s} s to {motion.end_s} s"
        )
    # A little more than the quotient, which rounding may have put below a whole number.
    count = int((end_s - begin_s) * noise.rate_hz + 1e-6) + 1
    stamps = begin_s + np.arange(count) / noise.rate_hz
    R_camera_world = np.swapaxes(motion.poses(stamps)[:, :3, :3], 1, 2)
    force = np.einsum("nij,nj->ni", R_camera_world, motion.acceleration(stamps) - GRAVITY)
    # All draws in a fixed order, so that one setting does not change another's numbers.
    first_gyro, first_accel = rng.standard_normal((2, 3))
    walk_gyro, walk_accel, white_gyro, white_accel = rng.standard_normal((4, count, 3))
    step, root = noise.rate_hz**-0.5, noise.rate_hz**0.5
    gyro_bias = noise.gyro_bias * first_gyro + noise.gyro_walk * step * _walk(walk_gyro)
    accel_bias = noise.accel_bias * first_accel + noise.accel_walk * step * _walk(walk_accel)
    return ImuReadings(
        stamps,
        motion.angular_velocity(stamps) + gyro_bias + noise.gyro_density * root * white_gyro,
        force + accel_bias + noise.accel_density * root * white_accel,
        gyro_bias,
        accel_bias,
    )


def _walk(steps: FloatArray) -> FloatArray:
    """Return a random walk (N, 3) that begins at zero."""
    walk = np.zeros_like(steps)
    walk[1:] = np.cumsum(steps[1:], axis=0)
    return walk


def write_imu(path: Path, readings: ImuReadings) -> None:
    """Write ``timestamp [ns], angular velocity, specific force`` as EuRoC's ``data.csv`` does."""
    rows = np.column_stack([readings.angular_velocity, readings.specific_force])
    lines = [HEADER]
    for stamp, row in zip(readings.stamps_s, rows, strict=True):
        lines.append(f"{round(float(stamp) * 1e9)}," + ",".join(f"{value:.12g}" for value in row))
    write_text(path, "\n".join(lines) + "\n")


def read_imu(path: Path) -> ImuReadings:
    """Read readings in EuRoC's layout; their biases are not known and given as zeros.

    Raises
    ------
    DatasetError
        The file is missing or empty, a line does not hold a stamp and six finite numbers, or the
        stamps do not rise.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError("IMU readings cannot be read", where=path, got=str(error)) from error
    stamps: list[int] = []
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        stamp, row = _parse(line, f"{path}:{number}")
        if stamps and stamp <= stamps[-1]:
            raise DatasetError(
                "IMU stamps do not rise", where=f"{path}:{number}",
                expected=f"more than {stamps[-1]}", got=str(stamp),
            )  # fmt: skip
        stamps.append(stamp)
        rows.append(row)
    if not rows:
        raise DatasetError("file holds no IMU readings", where=path)
    values = np.array(rows)
    zero = np.zeros((len(values), 3))
    return ImuReadings(np.array(stamps) / 1e9, values[:, :3], values[:, 3:], zero, zero.copy())


def _parse(line: str, where: str) -> tuple[int, list[float]]:
    """Return the stamp of a line, nanoseconds, and its six numbers."""
    words = line.split(",")
    try:
        stamp, row = int(words[0]), [float(word) for word in words[1:]]
    except ValueError:
        stamp, row = 0, []
    if len(row) != COLUMNS - 1 or not np.all(np.isfinite(row)):
        raise DatasetError(
            "invalid line of IMU readings", where=where,
            expected="whole nanoseconds and six numbers", got=repr(line[:60]),
        )  # fmt: skip
    return stamp, row
