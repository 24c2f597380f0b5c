"""Smooth motion through a trajectory's poses, for sensors that measure between the frames."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import Rotation, RotationSpline

from roomgraph.datasets.trajectory import Trajectory

FloatArray = NDArray[np.float64]

# Degree of the positions' spline: its acceleration has no kinks.
DEGREE = 5


class MotionSpline:
    """A motion that passes exactly through the poses of a trajectory at their stamps.

    Positions are a quintic spline (of a lower degree below six frames), orientations a cubic one
    with continuous angular acceleration. Two poses in a row must differ by less than half a turn.
    Stamps outside the trajectory are clipped to it.

    Raises
    ------
    ValueError
        The trajectory is empty, or its stamps do not rise.
    """

    def __init__(self, trajectory: Trajectory) -> None:
        stamps = np.asarray(trajectory.stamps_s, dtype=np.float64)
        if not len(stamps):
            raise ValueError("a motion needs at least one pose")
        if np.any(np.diff(stamps) <= 0):
            raise ValueError("the stamps of a motion must rise from each pose to the next")
        # Times count from the first stamp: the powers of a time since 1970 would lose digits.
        self._begin = float(stamps[0])
        self._duration = float(stamps[-1] - stamps[0])
        times = stamps - stamps[0]
        R = Rotation.from_matrix(trajectory.T_world_camera[:, :3, :3])
        positions = trajectory.positions
        if len(times) == 1:
            # A camera that stands still: the same pose again, one second later.
            times = np.array([0.0, 1.0])
            R, positions = Rotation.concatenate([R, R]), np.repeat(positions, 2, axis=0)
        self._rotation = RotationSpline(times, R)
        self._position = make_interp_spline(times, positions, k=min(DEGREE, len(times) - 1))
        self._velocity = self._position.derivative(1)
        self._acceleration = self._position.derivative(2) if len(times) > 2 else None

    @property
    def begin_s(self) -> float:
        """The first stamp, seconds."""
        return self._begin

    @property
    def end_s(self) -> float:
        """The last stamp, seconds."""
        return self._begin + self._duration

    def poses(self, stamps_s: FloatArray) -> FloatArray:
        """Return T_world_camera (N, 4, 4) at stamps (N,)."""
        times = self._times(stamps_s)
        T = np.tile(np.eye(4), (len(times), 1, 1))
        T[:, :3, :3] = self._rotation(times).as_matrix()
        T[:, :3, 3] = self._position(times)
        return T

    def velocity(self, stamps_s: FloatArray) -> FloatArray:
        """Return the velocity in the world (N, 3) at stamps (N,), m/s."""
        return np.asarray(self._velocity(self._times(stamps_s)), dtype=np.float64)

    def acceleration(self, stamps_s: FloatArray) -> FloatArray:
        """Return the acceleration in the world (N, 3) at stamps (N,), m/s^2, without gravity."""
        times = self._times(stamps_s)
        if self._acceleration is None:
            return np.zeros((len(times), 3))
        return np.asarray(self._acceleration(times), dtype=np.float64)

    def angular_velocity(self, stamps_s: FloatArray) -> FloatArray:
        """Return the angular velocity in the camera's frame (N, 3) at stamps (N,), rad/s."""
        return np.asarray(self._rotation(self._times(stamps_s), 1), dtype=np.float64)

    def _times(self, stamps_s: FloatArray) -> FloatArray:
        """Return the times since the first pose, clipped to the trajectory."""
        times = np.asarray(stamps_s, dtype=np.float64) - self._begin
        return np.clip(times, 0.0, self._duration)
