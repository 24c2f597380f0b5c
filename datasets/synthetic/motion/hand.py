"""A walk as a person carries the camera: tremor, steps, looks aside and down, shakes, a finger."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from roomgraph.datasets.trajectory import Trajectory

FloatArray = NDArray[np.float64]
StretchKind = Literal["fast_turn", "look_down", "shake", "cover"]

CALM_S = 2.0
# Mishaps a minute. A fast turn blurs twice, there and back, so that three mishaps (one of each
# kind) are four stretches.
MISHAPS = (5.2, 6.5)
LOOK_DOWN_CHANCE = 0.5
# Between two stretches, seconds.
GAP_S = 0.25
STEP_HZ = 1.8
# From this speed on, m/s, the steps are felt in full.
FULL_SPEED = 0.7
# From the wrist, about which the camera turns, to the camera, metres.
WRIST_M = 0.03
# Share of a fast turn that speeds up, and that slows down.
RAMP = 0.25


@dataclass(frozen=True, slots=True)
class Stretch:
    """A time in which the camera is not simply carried along.

    Attributes
    ----------
    kind : {"fast_turn", "look_down", "shake", "cover"}
        Turning aside or back again, looking at the floor (the way down and up included),
        shaking, or a covered lens, whose image is blank.
    begin_s, end_s : float
        Stamps, seconds.
    """

    kind: StretchKind
    begin_s: float
    end_s: float


@dataclass(frozen=True, slots=True, eq=False)
class Carried:
    """A walk in the hand.

    Attributes
    ----------
    trajectory : Trajectory
        Poses at the stamps of the walk.
    stretches : tuple of Stretch
        In the order of time; they do not overlap.
    """

    trajectory: Trajectory
    stretches: tuple[Stretch, ...]


class _Hand:
    """What the hand does to the walk: angles and shifts at each stamp, and the stretches."""

    def __init__(self, stamps_s: FloatArray, rng: np.random.Generator) -> None:
        self.times = stamps_s
        self.rng = rng
        self.yaw = np.zeros(len(stamps_s))
        self.pitch = np.zeros(len(stamps_s))
        # Rotation vectors in the camera's frame, radians, and shifts, metres.
        self.wobble = np.zeros((len(stamps_s), 3))
        self.shift = np.zeros((len(stamps_s), 3))
        self.stretches: list[Stretch] = []

    def note(self, kind: StretchKind, begin_s: float, end_s: float) -> None:
        """Remember a stretch."""
        self.stretches.append(Stretch(kind, float(begin_s), float(end_s)))

    def waves(self, low_hz: float, high_hz: float) -> FloatArray:
        """Return three random waves (N, 3) in a band of frequencies, each within -1 and 1."""
        hertz = self.rng.uniform(low_hz, high_hz, (3, 3))
        phase = self.rng.uniform(0, 2 * np.pi, (3, 3))
        weight = self.rng.dirichlet([6.0] * 3, 3)
        times = (self.times - self.times[0])[:, None, None]
        return np.asarray((weight * np.sin(2 * np.pi * hertz * times + phase)).sum(axis=2))


def carry_by_hand(trajectory: Trajectory, rng: np.random.Generator) -> Carried:
    """Carry the camera of a level walk by hand.

    The position stays within 0.12 m of the walk. For the first two seconds there
    are only tremor, steps and a slow drift. The same generator gives the same result, and the
    choices do not depend on the rate of the frames. Walks below 7 s have no stretches.
    """
    if len(trajectory) < 2:
        return Carried(trajectory, ())
    hand = _Hand(np.asarray(trajectory.stamps_s, dtype=np.float64), rng)
    _hold(hand)
    _step(hand, trajectory)
    _disturb(hand)
    base = Rotation.from_matrix(trajectory.T_world_camera[:, :3, :3])
    zero = np.zeros_like(hand.yaw)
    turn = Rotation.from_rotvec(np.column_stack([zero, zero, hand.yaw]))
    tilt = Rotation.from_rotvec(np.column_stack([hand.pitch, zero, zero]))
    R = turn * base * tilt * Rotation.from_rotvec(hand.wobble)
    lever = np.array([0.0, 0.0, WRIST_M])
    T = trajectory.T_world_camera.copy()
    T[:, :3, :3] = R.as_matrix()
    T[:, :3, 3] += base.apply(hand.shift) + R.apply(lever) - base.apply(lever)
    stretches = tuple(sorted(hand.stretches, key=lambda stretch: stretch.begin_s))
    return Carried(Trajectory(trajectory.stamps_s, T), stretches)


def _hold(hand: _Hand) -> None:
    """Add the tremor and the slow drift of the hand and of where it points."""
    hand.wobble += np.deg2rad(0.3) * hand.waves(8.0, 10.0)
    # 1.6 mm from end to end: more would shake the accelerometer harder than a hand does.
    hand.shift += 0.0008 * hand.waves(8.0, 10.0)
    drift = hand.waves(0.06, 0.25)
    hand.yaw += np.deg2rad(6.0) * drift[:, 0]
    hand.pitch += np.deg2rad(6.0) * drift[:, 1]
    hand.wobble[:, 2] += np.deg2rad(3.0) * drift[:, 2]
    hand.shift += 0.015 * hand.waves(0.1, 0.3)


def _step(hand: _Hand, trajectory: Trajectory) -> None:
    """Add the bob of each step and the sway of every second one, as far as the camera moves."""
    speed = np.linalg.norm(np.gradient(trajectory.positions, hand.times, axis=0), axis=1)
    frame_s = (hand.times[-1] - hand.times[0]) / (len(hand.times) - 1)
    share = np.clip(gaussian_filter1d(speed, 0.25 / frame_s, mode="nearest") / FULL_SPEED, 0, 1)
    # A second time, for the clipping has left kinks.
    share = gaussian_filter1d(share, 0.15 / frame_s, mode="nearest")
    pace = STEP_HZ * hand.rng.uniform(0.95, 1.05)
    phase = 2 * np.pi * (pace * (hand.times - hand.times[0]) + hand.rng.random())
    phase += 0.4 * hand.waves(0.1, 0.3)[:, 0]
    hand.shift[:, 1] += share * hand.rng.uniform(0.015, 0.025) * np.sin(phase)
    hand.shift[:, 0] += share * hand.rng.uniform(0.015, 0.025) * np.sin(phase / 2)
    hand.pitch += share * np.deg2rad(0.6) * np.sin(phase + 1.0)


def _disturb(hand: _Hand) -> None:
    """Divide the walk into slots, each with one mishap and perhaps a look down."""
    rng = hand.rng
    first = hand.times[0] + CALM_S
    available = hand.times[-1] - first
    slots = max(1, int(available / 60 * rng.uniform(*MISHAPS)))
    if available < 5:
        return
    slot_s = available / slots
    kinds: list[StretchKind] = []
    for slot in range(slots):
        if not kinds:
            kinds = ["fast_turn", "shake", "cover"]
            rng.shuffle(kinds)
        halves = first + slot_s * (slot + np.array([0.0, 0.5]))
        mishap = int(rng.random() < 0.5)
        _mishap(hand, kinds.pop(), halves[mishap], slot_s / 2)
        if rng.random() < LOOK_DOWN_CHANCE:
            _look_down(hand, halves[1 - mishap], slot_s / 2)


def _mishap(hand: _Hand, kind: StretchKind, begin_s: float, room_s: float) -> None:
    """Add a mishap at a random time of `room_s` from `begin_s`."""
    {"fast_turn": _fast_turn, "shake": _shake, "cover": _cover}[kind](hand, begin_s, room_s)


def _place(hand: _Hand, begin_s: float, room_s: float, length_s: float) -> float:
    """Return a random begin for something of this length, off the ends of its room."""
    return begin_s + GAP_S / 2 + hand.rng.random() * max(0.0, room_s - length_s - GAP_S)


def _fast_turn(hand: _Hand, begin_s: float, room_s: float) -> None:
    """Turn aside, hold, and turn back: two stretches, for the image is sharp in between."""
    angle, peak = np.deg2rad(hand.rng.uniform((40, 150), (90, 250)))
    turn_s = float(np.clip(angle / (1 - RAMP) / peak, 0.3, 0.5))
    hold_s = hand.rng.uniform(0.3, 1.0)
    begin_s = _place(hand, begin_s, room_s, 2 * turn_s + hold_s)
    back_s = begin_s + turn_s + hold_s
    there = _sweep((hand.times - begin_s) / turn_s)
    back = _sweep((hand.times - back_s) / turn_s)
    hand.yaw += hand.rng.choice([-1.0, 1.0]) * angle * (there - back)
    hand.note("fast_turn", begin_s, begin_s + turn_s)
    hand.note("fast_turn", back_s, back_s + turn_s)


def _look_down(hand: _Hand, begin_s: float, room_s: float) -> None:
    """Look at the floor, if there is time for it."""
    angle = np.deg2rad(hand.rng.uniform(35, 60))
    down_s, hold_s, up_s = hand.rng.uniform((0.7, 1.0, 0.7), (1.0, 2.0, 1.0))
    length_s = down_s + hold_s + up_s
    if length_s + GAP_S > room_s:
        return
    begin_s = _place(hand, begin_s, room_s, length_s)
    down = _ease((hand.times - begin_s) / down_s)
    up = _ease((hand.times - begin_s - down_s - hold_s) / up_s)
    hand.pitch -= angle * (down - up)
    hand.note("look_down", begin_s, begin_s + length_s)


def _shake(hand: _Hand, begin_s: float, room_s: float) -> None:
    """Shake the camera."""
    rng = hand.rng
    length_s, hertz, degrees = rng.uniform((0.4, 5.0, 4.0), (0.8, 7.0, 8.0))
    begin_s = _place(hand, begin_s, room_s, length_s)
    axis, way = rng.standard_normal((2, 3))
    times = hand.times - begin_s
    # Rises and falls within a quarter of its length each.
    strength = _ease(4 * times / length_s) - _ease(4 * times / length_s - 3)
    wave = strength * np.sin(2 * np.pi * hertz * times)
    hand.wobble += np.deg2rad(degrees) * wave[:, None] * axis / np.linalg.norm(axis)
    hand.shift += 0.008 * wave[:, None] * way / np.linalg.norm(way)
    hand.note("shake", begin_s, begin_s + length_s)


def _cover(hand: _Hand, begin_s: float, room_s: float) -> None:
    """Cover the lens; the motion goes on."""
    length_s = hand.rng.uniform(0.3, 1.0)
    begin_s = _place(hand, begin_s, room_s, length_s)
    hand.note("cover", begin_s, begin_s + length_s)


def _ease(share: FloatArray) -> FloatArray:
    """Rise smoothly (twice differentiable) from 0 to 1 while `share` does, and stay there."""
    u = np.clip(share, 0.0, 1.0)
    return np.asarray(u**3 * (10 - 15 * u + 6 * u * u))


def _sweep(share: FloatArray) -> FloatArray:
    """Rise from 0 to 1 at a constant rate between two short ramps, with a continuous rate."""
    u = np.clip(share, 0.0, 1.0)
    near = np.minimum(u, 1 - u)
    ramp = near / 2 - RAMP / (2 * np.pi) * np.sin(np.pi * near / RAMP)
    rise = np.where(near < RAMP, ramp, near - RAMP / 2) / (1 - RAMP)
    return np.where(u < 0.5, rise, 1 - rise)
