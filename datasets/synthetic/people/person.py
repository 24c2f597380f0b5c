"""A person who does one thing after another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.ndimage import gaussian_filter1d

from roomgraph.datasets.synthetic.people.figure import Figure
from roomgraph.datasets.synthetic.people.gait import (
    LEGS,
    PELVIS,
    FloatArray,
    Pose,
    blend,
    part_transforms,
    sitting,
    standing,
    walking,
)  # fmt: skip
from roomgraph.datasets.synthetic.rendering.mesh import Quad

Doing = Literal["walk", "stand", "sit", "away"]

STEP_S = 0.05
TURN_SMOOTHING_S = 0.15
# How long it takes to start or stop walking.
EASE_S = 0.35
PHASES = 96
# Somebody who is away is put this far below the floor.
AWAY_M = -1000.0
# Slower than this is shuffling on the spot, whose direction says nothing.
STILL_MPS = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class Schedule:
    """Where a person is, and what they do in each interval between two stamps.

    Attributes
    ----------
    stamps_s : (K,) float64
        Seconds, rising.
    xy : (K, 2) float64
        Places on the floor, metres; in between the person goes straight.
    heading : (K,) float64
        Where the person faces when not walking, radians from the world's x axis.
    floor_m : (K,) float64
        Height of the floor.
    doing : tuple of {"walk", "stand", "sit", "away"}
        K - 1 of them. Before the first stamp and after the last the person is away.
    seat_m : float
        How high the seat is above the floor.
    """

    stamps_s: FloatArray
    xy: FloatArray
    heading: FloatArray
    floor_m: FloatArray
    doing: tuple[Doing, ...]
    seat_m: float = 0.45

    def __post_init__(self) -> None:
        if len(self.doing) != len(self.stamps_s) - 1:
            raise ValueError(f"{len(self.stamps_s)} stamps but {len(self.doing)} intervals")

    def interval(self, stamp_s: float) -> int:
        """Return in which interval a time lies; the first or the last if in none."""
        index = int(np.searchsorted(self.stamps_s, stamp_s, side="right")) - 1
        return min(max(index, 0), len(self.doing) - 1)


class Person:
    """A figure that follows a schedule.

    Parameters
    ----------
    figure : Figure
        The body.
    schedule : Schedule
        What it does.
    speed : float
        How fast the person usually walks: the faster, the longer the steps.
    """

    radius_m = 1.15

    def __init__(self, figure: Figure, schedule: Schedule, speed: float = 1.1) -> None:
        self.figure, self.schedule = figure, schedule
        self.quads: list[Quad] = figure.quads
        self._speed = speed
        corners = np.array([quad.corners for quad in figure.quads]).reshape(-1, 3)
        self._points = np.concatenate([corners, np.ones((len(corners), 1))], axis=1)
        self._weights = figure.weights.reshape(len(corners), -1)
        self._soles = [_sole(figure, leg[2]) for leg in LEGS]
        self._phase, self._advance = self._strides()
        self._times, self._heading = _headings(schedule)
        steps = np.linalg.norm(np.diff(schedule.xy, axis=0), axis=1)
        self._walked = np.append(0.0, np.cumsum(steps))
        self._edges = _walk_edges(schedule)

    def is_there(self, stamp_s: float) -> bool:
        """Return whether the person is in the building at a time."""
        stamps = self.schedule.stamps_s
        inside = bool(stamps[0] <= stamp_s <= stamps[-1])
        return inside and self.schedule.doing[self.schedule.interval(stamp_s)] != "away"

    def place(self, stamp_s: float) -> FloatArray:
        """Return where on the floor the person is at a time (3,)."""
        s = self.schedule
        columns = (s.xy[:, 0], s.xy[:, 1], s.floor_m)
        place = np.array([np.interp(stamp_s, s.stamps_s, column) for column in columns])
        if not self.is_there(stamp_s):
            place[2] += AWAY_M
        return place

    def centre(self, stamp_s: float) -> FloatArray:
        """Return the middle (3,) of a sphere of `radius_m` round the body at a time."""
        sits = self.schedule.doing[self.schedule.interval(stamp_s)] == "sit"
        up = 0.4 * self.figure.height_m if sits else 0.5 * self.figure.height_m
        return np.asarray(np.add(self.place(stamp_s), (0.0, 0.0, up)))

    def corners(self, stamp_s: float) -> FloatArray:
        """Return the corners (N, 4, 3) of all quads in the world at a time."""
        T = self.parts(stamp_s)
        # Corners at rest are in the body's frame: take them to the parts' frames first.
        T[:, :3, 3] -= np.einsum("pij,pj->pi", T[:, :3, :3], self.figure.joints)
        moves = (self._weights @ T[:, :3].reshape(len(T), 12)).reshape(-1, 3, 4)
        points = np.einsum("nij,nj->ni", moves, self._points)
        return np.asarray(points.reshape(-1, 4, 3))

    def parts(self, stamp_s: float) -> FloatArray:
        """Return the frames (P, 4, 4) of the body's parts in the world at a time."""
        heading = float(np.interp(stamp_s, self._times, self._heading))
        c, s = np.cos(heading), np.sin(heading)
        root = np.eye(4)
        root[:2, :2] = [(c, -s), (s, c)]
        root[:3, 3] = self.place(stamp_s)
        pose = self.pose(stamp_s)
        T = part_transforms(self.figure.joints, pose, root)
        if self.schedule.doing[self.schedule.interval(stamp_s)] == "sit":
            hips = root[2, 3] + self.schedule.seat_m + self.figure.seat_m
            T[:, 2, 3] += hips - T[LEGS[0][0], 2, 3]
            T[:, :2, 3] += root[:2, 3] - T[PELVIS, :2, 3]
        else:
            T[:, 2, 3] += root[2, 3] - self._lowest(T)
        return T

    def pose(self, stamp_s: float) -> Pose:
        """Return the joints' angles at a time."""
        if self.schedule.doing[self.schedule.interval(stamp_s)] == "sit":
            return sitting(stamp_s, self._drop())
        inside = np.interp(stamp_s, *self._edges) if len(self._edges[0]) else 0.0
        if inside <= 0:
            return standing(stamp_s)
        walked = float(np.interp(stamp_s, self.schedule.stamps_s, self._walked))
        phase = float(np.interp(walked % self._advance[-1], self._advance, self._phase))
        stride = walking(phase, self._speed)
        return stride if inside >= 1 else blend(standing(stamp_s), stride, float(inside))

    def _lowest(self, T: FloatArray) -> float:
        """Return the height of the lowest point of the shoes."""
        return min(
            float((sole @ T[leg[2], 2, :3]).min() + T[leg[2], 2, 3])
            for leg, sole in zip(LEGS, self._soles, strict=True)
        )

    def _drop(self) -> float:
        """Return the slope of the thighs that sets the feet of a sitting person on the floor."""
        joints, (thigh, shin, _) = self.figure.joints, LEGS[0]
        below = self.schedule.seat_m + self.figure.seat_m - float(joints[shin, 2])
        length = float(joints[thigh, 2] - joints[shin, 2])
        return float(np.arcsin(np.clip(below / length, -0.5, 0.9)))

    def _resting_soles(self, phase: float) -> FloatArray:
        """Return the corners (2, N, 3) of the shoes at a phase, walking on the spot."""
        T = part_transforms(self.figure.joints, walking(phase, self._speed), np.eye(4))
        feet = [T[leg[2]] for leg in LEGS]
        moved = [s @ F[:3, :3].T + F[:3, 3] for s, F in zip(self._soles, feet, strict=True)]
        return np.array(moved)

    def _strides(self) -> tuple[FloatArray, FloatArray]:
        """Return phases of a stride and how far the body has come by each.

        So far that the foot which carries the body stays where it is.
        """
        phases = np.linspace(0, 1, PHASES + 1)
        soles = np.array([self._resting_soles(phase) for phase in phases])
        both = (soles[:-1] + soles[1:]).reshape(PHASES, -1, 3)
        # The point that lies lowest during a step of the table does not slide in it.
        lowest = np.argmin(both[:, :, 2], axis=1)
        x = soles.reshape(PHASES + 1, -1, 3)[:, :, 0]
        back = x[np.arange(PHASES), lowest] - x[np.arange(1, PHASES + 1), lowest]
        back = gaussian_filter1d(back, 1.5, mode="wrap")
        # Never stands still within a stride: the phase would have to jump.
        back = np.maximum(back, 0.35 * back.mean())
        return phases, np.append(0.0, np.cumsum(back))


def _sole(figure: Figure, shoe: int) -> FloatArray:
    """Return the corners (N, 3) of a shoe in its own frame."""
    mine = figure.weights[:, :, shoe] > 0.99
    points = np.array([quad.corners for quad in figure.quads])[mine] - figure.joints[shoe]
    return np.asarray(np.unique(points, axis=0))


def _headings(schedule: Schedule) -> tuple[FloatArray, FloatArray]:
    """Return times and the heading at each, without jumps."""
    stamps = schedule.stamps_s
    times = np.linspace(stamps[0], stamps[-1], max(2, int(np.ptp(stamps) / STEP_S)) + 1)
    index = np.clip(np.searchsorted(stamps, times, side="right") - 1, 0, len(stamps) - 2)
    heading = np.interp(times, stamps, np.unwrap(schedule.heading))
    way = np.diff(schedule.xy, axis=0)
    moves = np.linalg.norm(way, axis=1) > STILL_MPS * np.diff(stamps)
    walks = moves & (np.array(schedule.doing) == "walk")
    heading = np.where(walks[index], np.arctan2(way[index, 1], way[index, 0]), heading)
    smooth = gaussian_filter1d(np.unwrap(heading), TURN_SMOOTHING_S / STEP_S, mode="nearest")
    return times, smooth


def _walk_edges(schedule: Schedule) -> tuple[FloatArray, FloatArray]:
    """Return times and how much the person walks at each: 0 stands, 1 walks."""
    walks = np.array([doing == "walk" for doing in schedule.doing])
    bounded = np.concatenate([[False], walks, [False]])
    begin = schedule.stamps_s[np.flatnonzero(bounded[1:] & ~bounded[:-1])]
    end = schedule.stamps_s[np.flatnonzero(~bounded[1:] & bounded[:-1])]
    ease = np.minimum(EASE_S, (end - begin) / 2)
    times = np.column_stack([begin, begin + ease, end - ease, end]).ravel()
    return times, np.tile([0.0, 1.0, 1.0, 0.0], len(begin))
