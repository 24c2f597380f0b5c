"""What the wheels of a robot that carries the camera say about its way.

Wheels know of the plane only: height is always 0, whatever stairs and elevators do, and so are
pitch and roll.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.trajectory import Trajectory

FloatArray = NDArray[np.float64]

# How long a slip lasts, seconds: it is spread over the frames of this time.
SLIP_S = 0.4


@dataclass(frozen=True, slots=True)
class WheelSettings:
    """A small robot with two driven wheels and its errors; all 0 but the base is perfect.

    Attributes
    ----------
    wheel_base_m : float
        Distance between the two wheels.
    scale : float
        Standard deviation of the error of the mean wheel diameter, relative.
    mismatch : float
        The same of each wheel against that mean; it bends straight ways.
    base_error : float
        The same of the wheel base; it changes turns.
    noise_m : float
        Standard deviation of the way of each wheel after 1 m, metres; grows with its square root.
    turn_noise_rad : float
        Standard deviation of the heading after turns of 1 rad; grows with their square root.
    slips : float
        Slips in 100 m of way.
    spin_m : float
        Largest way that one wheel turns without the body.
    push_m, push_rad : float
        Largest shift and turn of the body without the wheels.
    """

    wheel_base_m: float = 0.3
    scale: float = 0.005
    mismatch: float = 0.0002
    base_error: float = 0.01
    noise_m: float = 0.002
    turn_noise_rad: float = 0.01
    slips: float = 3.0
    spin_m: float = 0.03
    push_m: float = 0.06
    push_rad: float = 0.06


def drive(
    trajectory: Trajectory, rng: np.random.Generator, settings: WheelSettings | None = None
) -> Trajectory:
    """Return the odometry of a planar base under the camera, as T_odom_base at the same stamps.

    The base (x forward, y left, z up) stands under the camera and looks where the camera does;
    the odometry begins at the identity. Where the way leads to the side of where the camera
    looks, which two wheels cannot measure, a third one that rolls along is taken to do so.
    """
    settings = settings or WheelSettings()
    true = planar_poses(trajectory)
    if len(true) < 2:
        return Trajectory(trajectory.stamps_s, np.tile(np.eye(4), (len(true), 1, 1)))
    twists = _twists(true)
    # Slips come last: without them the rest of the numbers stays the same.
    twists = _measure(twists, rng, settings)
    twists += _slips(trajectory, true, rng, settings)
    planar = _integrate(twists)
    return Trajectory(trajectory.stamps_s, _lift(planar))


def planar_poses(trajectory: Trajectory) -> FloatArray:
    """Return x, y and heading (N, 3) of the camera on the floor, the heading without jumps.

    The heading is square to the camera's right, which keeps its meaning when it looks down.
    """
    T = trajectory.T_world_camera
    heading = np.unwrap(np.arctan2(T[:, 0, 0], -T[:, 1, 0]))
    return np.column_stack([T[:, 0, 3], T[:, 1, 3], heading])


def _twists(planar: FloatArray) -> FloatArray:
    """Return the way forward, to the left and the turn (N - 1, 3) along an arc of each step."""
    step = np.diff(planar, axis=0)
    # A chord of an arc lies half the turn off its beginning, and is shorter than the arc.
    middle, half = planar[:-1, 2] + step[:, 2] / 2, step[:, 2] / 2
    stretch = 1 / np.sinc(half / np.pi)
    c, s = np.cos(middle) * stretch, np.sin(middle) * stretch
    return np.column_stack(
        [c * step[:, 0] + s * step[:, 1], c * step[:, 1] - s * step[:, 0], step[:, 2]]
    )


def _integrate(twists: FloatArray) -> FloatArray:
    """Return x, y and heading (N + 1, 3) of arcs, from zero."""
    heading = np.append(0.0, np.cumsum(twists[:, 2]))
    half = twists[:, 2] / 2
    shrink = np.sinc(half / np.pi)
    c, s = np.cos(heading[:-1] + half) * shrink, np.sin(heading[:-1] + half) * shrink
    steps = np.column_stack(
        [c * twists[:, 0] - s * twists[:, 1], s * twists[:, 0] + c * twists[:, 1]]
    )
    return np.column_stack([np.vstack([np.zeros(2), np.cumsum(steps, axis=0)]), heading])


def _measure(twists: FloatArray, rng: np.random.Generator, settings: WheelSettings) -> FloatArray:
    """Return the twists that two wheels with errors of scale and noise make of true ones."""
    base = settings.wheel_base_m
    mean = settings.scale * rng.standard_normal()
    scales = 1 + mean + settings.mismatch * rng.standard_normal(2)
    believed_base = base * (1 + settings.base_error * rng.standard_normal())
    wheels = np.column_stack(
        [twists[:, 0] - twists[:, 2] * base / 2, twists[:, 0] + twists[:, 2] * base / 2]
    )
    noise = settings.noise_m * np.sqrt(np.abs(wheels)) * rng.standard_normal(wheels.shape)
    wheels = wheels * scales + noise
    turned = np.sqrt(np.abs(twists[:, 2])) * rng.standard_normal(len(twists))
    side = settings.noise_m * np.sqrt(np.abs(twists[:, 1])) * rng.standard_normal(len(twists))
    return np.column_stack(
        [
            wheels.mean(axis=1),
            twists[:, 1] * (1 + mean) + side,
            (wheels[:, 1] - wheels[:, 0]) / believed_base + settings.turn_noise_rad * turned,
        ]
    )


def _slips(
    trajectory: Trajectory, true: FloatArray, rng: np.random.Generator, settings: WheelSettings
) -> FloatArray:
    """Return what slips add to each step's twist (N - 1, 3)."""
    extra = np.zeros((len(true) - 1, 3))
    arc = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(true[:, :2], axis=0), axis=1)))
    for at in rng.uniform(0, arc[-1], rng.poisson(settings.slips * arc[-1] / 100)):
        begin = min(int(np.searchsorted(arc, at, side="right")) - 1, len(extra) - 1)
        end_s = trajectory.stamps_s[begin] + SLIP_S
        end = max(begin + 1, int(np.searchsorted(trajectory.stamps_s, end_s)))
        slip = _spin(rng, settings) if rng.random() < 0.5 else _push(rng, settings)
        extra[begin:end] += slip / len(extra[begin:end])
    return extra


def _spin(rng: np.random.Generator, settings: WheelSettings) -> FloatArray:
    """Return the twist that the wheels claim when one of them spins."""
    way, side = settings.spin_m * rng.uniform(0.3, 1.0), rng.choice([-1.0, 1.0])
    return np.array([way / 2, 0.0, side * way / settings.wheel_base_m])


def _push(rng: np.random.Generator, settings: WheelSettings) -> FloatArray:
    """Return what the wheels miss of a push, as the twist that it takes from them."""
    shift = settings.push_m * rng.uniform(-1.0, 1.0, 2)
    return np.array([*shift, settings.push_rad * rng.uniform(-1.0, 1.0)])


def _lift(planar: FloatArray) -> FloatArray:
    """Return poses (N, 4, 4) on the plane from x, y and heading (N, 3)."""
    T = np.tile(np.eye(4), (len(planar), 1, 1))
    c, s = np.cos(planar[:, 2]), np.sin(planar[:, 2])
    T[:, 0, 0], T[:, 0, 1], T[:, 1, 0], T[:, 1, 1] = c, -s, s, c
    T[:, :2, 3] = planar[:, :2]
    return T
