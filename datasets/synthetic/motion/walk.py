"""The walk: a closed, smooth way through every room, with the camera looking where it goes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline
from scipy.ndimage import gaussian_filter1d, minimum_filter1d
from scipy.spatial.transform import Rotation

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.plans.layout import Rectangle, Room
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.datasets.vectors import arc_lengths

FloatArray = NDArray[np.float64]
Point = tuple[float, float]

# Kept from furniture by the corners of the way; the spline that rounds them stays inside.
MARGIN_M = 0.52
# Largest round through a room, across and into it.
ROUND_M = (1.2, 1.4)
SPACING_M = 0.5
SAMPLE_M = 0.01
HEADING_SMOOTHING_M = 0.85
# The camera turns this much later than the way does: it looks at a room until it has left it.
HEADING_LAG_M = 0.5
SPEED_SMOOTHING_M = 0.12


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """One lap, sampled every `SAMPLE_M` or so; the last sample is where the first is.

    Attributes
    ----------
    xy : (N, 2) float64
        Points on the floor, metres.
    heading : (N,) float64
        Where the camera looks, radians, without jumps.
    arc_m : (N,) float64
        Length of the way so far.
    """

    xy: FloatArray
    heading: FloatArray
    arc_m: FloatArray


def walk(building: Building, settings: BuildingSettings) -> Trajectory:
    """Walk through every room and back to the start, `settings.laps` times.

    The last pose is the first one again. A frame moves the camera by at most `step_m`, and turns
    it by at most about `turn_deg`. With `settings.frames` only the walk's beginning is returned.
    """
    way = find_way(building)
    arc = pace(way, settings)
    lap = way.arc_m[-1]
    frames = len(arc) - 1
    index = np.arange(frames * settings.laps + 1)[: settings.frames]
    along = arc[index % frames]
    x, y = (np.interp(along, way.arc_m, way.xy[:, axis]) for axis in (0, 1))
    heading = np.interp(along, way.arc_m, way.heading)
    sway = 2 * np.pi * along / lap
    height = settings.camera_height_m + 0.004 * np.sin(41 * sway) + 0.003 * np.sin(67 * sway + 1)
    pitch = np.deg2rad(-1.5 + 0.4 * np.sin(37 * sway) + 0.25 * np.sin(83 * sway + 2))
    roll = np.deg2rad(0.3 * np.sin(29 * sway + 1))
    T = camera_poses(np.column_stack([x, y, height]), heading, pitch, roll)
    return Trajectory(index / settings.rate_hz, T)


def camera_poses(
    positions: FloatArray, heading: FloatArray, pitch: FloatArray, roll: FloatArray
) -> FloatArray:
    """Return T_world_camera (N, 4, 4) of cameras that look along `heading`, `pitch` upwards."""
    c, s = np.cos(heading), np.sin(heading)
    zero = np.zeros_like(c)
    level = np.empty((len(c), 3, 3))
    level[:, :, 0] = np.column_stack([s, -c, zero])
    level[:, :, 1] = np.column_stack([zero, zero, zero - 1])
    level[:, :, 2] = np.column_stack([c, s, zero])
    tilt = Rotation.from_euler("xz", np.column_stack([pitch, roll])).as_matrix()
    T = np.tile(np.eye(4), (len(c), 1, 1))
    T[:, :3, :3] = level @ tilt
    T[:, :3, 3] = positions
    return T


def find_way(building: Building) -> Way:
    """Find one lap through the building."""
    corners = np.array(_corners(building))
    controls = _densify(np.concatenate([corners, corners[:1]]))
    count = len(controls)
    knots = np.arange(-3, count + 4, dtype=np.float64)
    spline = BSpline(knots, np.concatenate([controls, controls[:3]]), 3, extrapolate=False)
    fine = spline(np.linspace(0, count, count * 80, endpoint=True) * (1 - 1e-12))
    arc = arc_lengths(fine)
    samples = np.linspace(0, arc[-1], int(arc[-1] / SAMPLE_M))
    xy = np.column_stack([np.interp(samples, arc, fine[:, axis]) for axis in (0, 1)])
    xy[-1] = xy[0]
    return Way(xy, _heading(xy), samples)


def _densify(corners: FloatArray) -> FloatArray:
    """Return points about `SPACING_M` apart along a closed polygon, every corner among them."""
    points = []
    for a, b in pairwise(corners):
        count = max(1, round(float(np.linalg.norm(b - a)) / SPACING_M))
        points.append(a + np.arange(count)[:, None] / count * (b - a))
    return np.concatenate(points)


def _heading(xy: FloatArray) -> FloatArray:
    """Return the smoothed direction of a closed way (N, 2), unwrapped."""
    steps = np.diff(xy, axis=0)
    tangent = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    turns = 2 * np.pi * np.round((tangent[-1] - tangent[0]) / (2 * np.pi))
    trend = np.linspace(0, turns, len(tangent), endpoint=False)
    level = gaussian_filter1d(tangent - trend, HEADING_SMOOTHING_M / SAMPLE_M, mode="wrap")
    level += np.deg2rad(5) * np.sin(np.arange(len(level)) / len(level) * 2 * np.pi * 23)
    lag = round(HEADING_LAG_M / SAMPLE_M)
    heading = np.roll(level, lag) + trend - turns * lag / len(level)
    return np.append(heading, heading[0] + turns)


def pace(way: Way, settings: BuildingSettings, *, is_closed: bool = True) -> FloatArray:
    """Return the arc length at each frame of a way, both ends included.

    No frame moves or turns the camera by more than the settings allow. Speeds change smoothly, on
    a closed way across its ends, too.
    """
    turn = np.abs(np.gradient(way.heading, way.arc_m))
    # A little less than the limit: pitch and roll turn the camera too.
    limit = np.deg2rad(settings.turn_deg) * 0.96
    speed = np.minimum(settings.step_m, limit / np.maximum(turn, 1e-9))
    width = SPEED_SMOOTHING_M / SAMPLE_M
    mode: Literal["wrap", "nearest"] = "wrap" if is_closed else "nearest"
    slow = minimum_filter1d(speed, 2 * int(3 * width) + 1, mode=mode)
    speed = gaussian_filter1d(slow, width, mode=mode, truncate=3.0)
    slowness = (1 / speed[:-1] + 1 / speed[1:]) / 2
    time = np.append(0, np.cumsum(np.diff(way.arc_m) * slowness))
    frames = int(np.ceil(time[-1]))
    return np.asarray(np.interp(np.linspace(0, time[-1], frames + 1), time, way.arc_m))


def _corners(building: Building) -> list[Point]:
    """Return the corners of the way: out of the elevator area, through each room, and back."""
    corridor, lobby, *rooms = building.rooms
    middle = corridor.floor.centre[1]
    outwards = np.sign(corridor.floor.centre[0] - lobby.floor.centre[0])
    opening = building.plan.doorway(lobby.name)
    entry = (opening.xy[0] - 0.3 * float(outwards), middle)
    loop = _loop(building, lobby, entry)
    corners = [loop[-1], entry, (opening.xy[0] + 0.8 * float(outwards), middle)]
    for room in rooms:
        door = building.plan.doorway(room.name)
        side = float(np.sign(door.xy[1] - middle))
        before, inside = (door.xy[0], middle), (door.xy[0], door.xy[1] + side * 0.7)
        corners += [before, inside, *_loop(building, room, inside), inside, before]
    return [*corners, (opening.xy[0] + 0.8 * float(outwards), middle), entry, *loop[:-1]]


def _loop(building: Building, room: Room, entry: Point) -> list[Point]:
    """Return four corners of a round through a room, from and back to near its door."""
    door = building.plan.doorway(room.name)
    size = ROUND_M if door.along == "x" else ROUND_M[::-1]
    free = _shrink(free_floor(building, room), *size)
    if door.along == "x":
        near, far = sorted((free.y0, free.y1), key=lambda y: abs(y - entry[1]))
        near = (near + far) / 2 if abs(near - entry[1]) < 0.5 else near
        corners = [(free.x0, near), (free.x0, far), (free.x1, far), (free.x1, near)]
    else:
        near, far = sorted((free.x0, free.x1), key=lambda x: abs(x - entry[0]))
        near = (near + far) / 2 if abs(near - entry[0]) < 0.5 else near
        corners = [(near, free.y0), (far, free.y0), (far, free.y1), (near, free.y1)]
    rng = np.random.default_rng((building.seed, 3, building.rooms.index(room)))
    return corners[::-1] if rng.random() < 0.5 else corners


def _shrink(r: Rectangle, width: float, depth: float) -> Rectangle:
    """Return the middle of a rectangle, of at most this size."""
    (x, y), a, b = r.centre, min(width, r.x1 - r.x0) / 2, min(depth, r.y1 - r.y0) / 2
    return Rectangle(x - a, y - b, x + a, y + b)


def free_floor(building: Building, room: Room) -> Rectangle:
    """Return a large rectangle of a room's floor that is `MARGIN_M` from everything in it."""
    r = room.floor
    free = (r.x0 + MARGIN_M, r.y0 + MARGIN_M, r.x1 - MARGIN_M, r.y1 - MARGIN_M)
    for x0, y0, x1, y1 in building.footprints:
        a0, b0, a1, b1 = x0 - MARGIN_M, y0 - MARGIN_M, x1 + MARGIN_M, y1 + MARGIN_M
        if a1 <= free[0] or a0 >= free[2] or b1 <= free[1] or b0 >= free[3]:
            continue
        cuts = [
            (a1, *free[1:]), (free[0], b1, *free[2:]), (*free[:2], a0, free[3]), (*free[:3], b0),
        ]  # fmt: skip
        free = max(cuts, key=lambda f: max(f[2] - f[0], 0.0) * max(f[3] - f[1], 0.0))
    return Rectangle(*(float(value) for value in free))
