"""The journey: a tour walked frame by frame, with its rides in the elevator."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import BSpline
from scipy.ndimage import gaussian_filter1d

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.tour import BEFORE_DOOR_M, BEHIND_M, Tour, plan_tour
from roomgraph.datasets.synthetic.motion.walk import SAMPLE_M, Way, camera_poses, pace, walk
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.structure.elevator import DOORS_S, Ride, ride_seconds
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.datasets.vectors import arc_lengths

CONTROL_M = 0.3
HEADING_SMOOTHING_M, HEADING_LAG_M = 0.5, 0.3
# The elevator comes this long before one is there, and its doors close so long after one left.
EARLY_S, LATE_S = 0.4, 0.6


@dataclass(frozen=True, slots=True, eq=False)
class Journey:
    """The camera's true motion, and what it does to the building.

    Attributes
    ----------
    trajectory : Trajectory
        T_world_camera by frame.
    floor_m : (N,) float64
        Height of the floor under the camera.
    rides : tuple of Ride
        In the elevator.
    """

    trajectory: Trajectory
    floor_m: FloatArray
    rides: tuple[Ride, ...]


@dataclass(slots=True)
class _Frames:
    """Places (N, 3) on the floor and headings (N,) of frames, piece by piece."""

    places: list[FloatArray]
    headings: list[FloatArray]

    @property
    def count(self) -> int:
        return sum(len(part) for part in self.headings)

    def add(self, places: FloatArray, headings: FloatArray) -> None:
        self.places.append(np.asarray(places))
        self.headings.append(np.asarray(headings))

    def turn(self, heading: float, most: float) -> None:
        """Turn on the spot to a heading, the shorter way, by at most so much a frame."""
        begin, place = float(self.headings[-1][-1]), self.places[-1][-1]
        turn = (heading - begin + np.pi) % (2 * np.pi) - np.pi
        count = int(np.ceil(1.6 * abs(turn) / most))
        share = np.linspace(0, 1, count + 1)[1:]
        self.add(np.tile(place, (count, 1)), begin + turn * share**2 * (3 - 2 * share))


def travel(building: Building, settings: BuildingSettings) -> Journey:
    """Walk through a building: every room of every level, and back to the start.

    The last pose is the first one again. A frame moves the camera by at most `step_m`, and turns
    it by at most about `turn_deg`, but in the elevator it stands still.
    """
    if building.plan.kind == "corridor":
        trajectory = walk(building, settings)
        return Journey(trajectory, np.zeros(len(trajectory)), ())
    frames, rides = _Frames([], []), []
    tour = plan_tour(building)
    for _ in range(settings.laps):
        rides += _walk_once(tour, frames, building.plan.storey_m, settings)
    places, heading = np.concatenate(frames.places), np.concatenate(frames.headings)
    index = np.arange(len(heading))[: settings.frames]
    T = _poses(places, heading, settings)[index]
    places = places[index]
    return Journey(Trajectory(index / settings.rate_hz, T), places[:, 2], tuple(rides))


def _walk_once(
    tour: Tour, frames: _Frames, storey_m: float, settings: BuildingSettings
) -> list[Ride]:
    """Walk the legs of a tour, with a ride between them, and turn to where one looked at first."""
    rides: list[Ride] = []
    headings_before: list[float] = []
    for leg in tour.legs:
        way, xyz = _smooth(leg)
        arc = pace(way, settings, is_closed=False)
        places = np.column_stack([np.interp(arc, way.arc_m, xyz[:, k]) for k in range(3)])
        headings = np.interp(arc, way.arc_m, way.heading)
        if headings_before:
            rides.append(_ride(frames, places[0], float(headings[0]), storey_m, settings))
        headings_before.append(float(headings[0]))
        # A leg begins where the last one, or the last lap, has ended.
        begin = 1 if frames.count else 0
        frames.add(places[begin:], headings[begin:])
    frames.turn(headings_before[0], np.deg2rad(settings.turn_deg) * 0.9)
    return [replace(ride, left_s=_left(ride, frames, settings.rate_hz)) for ride in rides]


def _left(ride: Ride, frames: _Frames, rate_hz: float) -> float:
    """Return when an elevator's doors may close behind one who has got out."""
    xy = np.concatenate(frames.places)[:, :2]
    out = int(np.ceil(ride.arrived_s * rate_hz))
    far = np.linalg.norm(xy[out:] - xy[out], axis=1) > BEFORE_DOOR_M + BEHIND_M + 0.5
    return (out + int(np.argmax(far))) / rate_hz + LATE_S


def _ride(
    frames: _Frames, end: FloatArray, heading: float, storey_m: float, settings: BuildingSettings
) -> Ride:
    """Turn to the doors, wait until they are closed, ride, and wait until they are open."""
    rate, begin = settings.rate_hz, frames.places[-1][-1]
    way = np.linalg.norm(frames.places[-1][:, :2] - begin[:2], axis=1)
    there = int(np.argmax(way[::-1] > BEFORE_DOOR_M + 0.6)) or len(way)
    called_s = (frames.count - there) / rate - DOORS_S - EARLY_S
    frames.turn(heading, np.deg2rad(settings.turn_deg) * 0.9)
    levels = [round(float(place[2]) / storey_m) for place in (begin, end)]
    closing_s = frames.count / rate
    arrived_s = closing_s + DOORS_S + ride_seconds(abs(levels[0] - levels[1]), storey_m)
    ride = Ride(levels[0], levels[1], called_s, closing_s, arrived_s, np.inf)
    count = int(np.ceil((arrived_s + DOORS_S - closing_s) * rate))
    stamps = (frames.count + np.arange(count)) / rate
    places = np.tile(end, (count, 1))
    places[:, 2] = [ride.height(float(stamp), storey_m) for stamp in stamps]
    frames.add(places, np.full(count, float(frames.headings[-1][-1])))
    return ride


def _smooth(corners: FloatArray) -> tuple[Way, FloatArray]:
    """Round a way's corners (N, 3); return it with its places (M, 3), a sample a centimetre."""
    steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    corners = corners[np.append(True, steps > 1e-6)]
    arc = arc_lengths(corners)
    count = max(4, int(arc[-1] / CONTROL_M))
    even = np.linspace(0, arc[-1], count)
    controls = np.column_stack([np.interp(even, arc, corners[:, k]) for k in range(3)])
    controls = np.concatenate([controls[:1], controls[:1], controls, controls[-1:], controls[-1:]])
    total = len(controls)
    knots = np.arange(-3, total + 1, dtype=np.float64)
    spline = BSpline(knots, controls, 3, extrapolate=False)
    fine = spline(np.linspace(0, total - 3, total * 60) * (1 - 1e-12))
    arc = arc_lengths(fine)
    samples = np.linspace(0, arc[-1], max(2, int(arc[-1] / SAMPLE_M)))
    xyz = np.column_stack([np.interp(samples, arc, fine[:, k]) for k in range(3)])
    return Way(xyz[:, :2], _heading(xyz), samples), xyz


def _heading(xyz: FloatArray) -> FloatArray:
    """Return where the camera looks on an open way: where it goes, smoothed, a little late."""
    steps = np.diff(xyz[:, :2], axis=0)
    tangent = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    tangent = np.append(tangent, tangent[-1])
    lag = min(round(HEADING_LAG_M / SAMPLE_M), len(tangent) - 1)
    late = np.concatenate([np.full(lag, tangent[0]), tangent[: len(tangent) - lag]])
    return np.asarray(gaussian_filter1d(late, HEADING_SMOOTHING_M / SAMPLE_M, mode="nearest"))


def _poses(places: FloatArray, heading: FloatArray, settings: BuildingSettings) -> FloatArray:
    """Return T_world_camera (N, 4, 4), with the slight sway of what carries the camera."""
    moved = np.append(0.0, np.linalg.norm(np.diff(places, axis=0), axis=1))
    # Whole numbers of waves a lap: the last pose is the first one again.
    sway = 2 * np.pi * np.cumsum(moved) * settings.laps / max(float(moved.sum()), 1e-9)
    height = settings.camera_height_m + 0.004 * np.sin(41 * sway) + 0.003 * np.sin(67 * sway + 1)
    pitch = np.deg2rad(-1.5 + 0.4 * np.sin(37 * sway) + 0.25 * np.sin(83 * sway + 2))
    roll = np.deg2rad(0.3 * np.sin(29 * sway + 1))
    positions = places + np.column_stack([np.zeros((len(places), 2)), height])
    return camera_poses(positions, heading, pitch, roll)
