"""What a person may do where a camera comes by: single scenes, each a short track."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.people.gait import FloatArray
from roomgraph.datasets.synthetic.people.person import Doing
from roomgraph.datasets.synthetic.people.view import STEP_S, IsFree, Track, View, trim
from roomgraph.datasets.vectors import arc_lengths

# The longest that a scene goes on before or after the meeting.
REACH_S = 14.0
# Metres a second.
SLOWEST, FASTEST = 0.7, 1.35

Scene = Callable[[np.random.Generator, View, IsFree, float], Track | None]


@dataclass(frozen=True, slots=True, eq=False)
class DoorSpot:
    """A doorway: its middle, the floor's height, and the direction through it, radians."""

    xy: FloatArray
    floor_m: float
    across: float


def _straight(
    stamps: FloatArray, xy: FloatArray, heading: FloatArray, floor: float, walks: bool = True
) -> Track:
    doing: Doing = "walk" if walks else "stand"
    return Track(stamps, xy, heading, floor, (doing,) * len(stamps))


def _stamps(meeting_s: float, before: float = REACH_S, after: float = REACH_S) -> FloatArray:
    count = int(before / STEP_S), int(after / STEP_S)
    return np.asarray(meeting_s + STEP_S * np.arange(-count[0], count[1] + 1))


def _open_between(is_free: IsFree, a: FloatArray, b: FloatArray, floor: float) -> bool:
    """Return whether the straight line between two points is free floor."""
    share = np.linspace(0, 1, max(2, int(np.linalg.norm(b - a) / 0.1)))[:, None]
    return bool(is_free(a + share * (b - a), floor).all())


def _ahead(
    rng: np.random.Generator, view: View, is_free: IsFree, meeting_s: float, aside: float
) -> tuple[FloatArray, float, float] | None:
    """Return a free point that the camera looks at, its heading and the floor's height."""
    x, y, heading, floor, _ = view.at(np.array([meeting_s]))[0]
    angle = heading + rng.uniform(-aside, aside)
    here, far = np.array([x, y]), rng.uniform(1.5, 3.5)
    point = here + far * np.array([np.cos(angle), np.sin(angle)])
    if not _open_between(is_free, here, point, floor):
        return None
    return point, float(heading), float(floor)


def crossing(
    rng: np.random.Generator, view: View, is_free: IsFree, meeting_s: float
) -> Track | None:
    """Walk from one side of the picture to the other, 1.5 to 3.5 m ahead of the camera."""
    found = _ahead(rng, view, is_free, meeting_s, 0.1)
    if found is None:
        return None
    point, heading, floor = found
    angle = heading + rng.choice([-1, 1]) * np.pi / 2 + rng.uniform(-0.45, 0.45)
    speed, stamps = rng.uniform(SLOWEST, FASTEST), _stamps(meeting_s)
    way = np.array([np.cos(angle), np.sin(angle)])
    xy = point + (speed * (stamps - meeting_s))[:, None] * way
    return trim(_straight(stamps, xy, np.full(len(stamps), angle), floor), view, is_free, meeting_s)


def standing_turning(
    rng: np.random.Generator, view: View, is_free: IsFree, meeting_s: float
) -> Track | None:
    """Stand near the camera's way and turn this way and that."""
    found = _ahead(rng, view, is_free, meeting_s, 0.4)
    if found is None:
        return None
    point, heading, floor = found
    stamps = _stamps(meeting_s)
    knots = np.arange(stamps[0], stamps[-1] + 8.0, 4.0) + rng.uniform(-1, 1)
    turns = heading + rng.uniform(0, 2 * np.pi) + np.cumsum(rng.uniform(-1.1, 1.1, len(knots)))
    # Stays turned for most of the time between two knots.
    place = np.interp(stamps, knots, np.arange(len(knots)))
    eased = np.floor(place) + np.clip((place % 1 - 0.4) / 0.3, 0, 1)
    facing = np.interp(eased, np.arange(len(knots)), turns)
    xy = np.tile(point, (len(stamps), 1))
    return trim(_straight(stamps, xy, facing, floor, False), view, is_free, meeting_s)


def _along(
    view: View, is_free: IsFree, meeting_s: float, stamps: FloatArray, arc: FloatArray, aside: float
) -> Track | None:
    """Walk along the camera's own way, `aside` to its left, at given lengths of it by time."""
    inside = (arc > view.arc_m[0] + 0.3) & (arc < view.arc_m[-1] - 0.3)
    inside &= np.abs(np.interp(arc, view.arc_m, view.floor_m) - view.at(stamps)[:, 3]) < 0.05
    if not inside[int(np.argmin(np.abs(stamps - meeting_s)))]:
        return None
    stamps, arc = stamps[inside], arc[inside]
    if len(stamps) < 3:
        return None
    # A little smoothed: nobody follows each wiggle of the camera.
    spots = [view.on_way(arc + shift) for shift in (-0.3, 0.0, 0.3)]
    way = spots[2] - spots[0]
    normal = np.column_stack([-way[:, 1], way[:, 0]])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-6)
    xy = np.mean(spots, axis=0) + aside * normal
    forward = np.sign(arc[-1] - arc[0]) * way
    heading = np.unwrap(np.arctan2(forward[:, 1], forward[:, 0]))
    floor = float(view.at(np.array([meeting_s]))[0, 3])
    return trim(_straight(stamps, xy, heading, floor), view, is_free, meeting_s)


def oncoming(
    rng: np.random.Generator, view: View, is_free: IsFree, meeting_s: float
) -> Track | None:
    """Come towards the camera on its own way and pass it by, to its left or right."""
    stamps, speed = _stamps(meeting_s, REACH_S, 7.0), rng.uniform(SLOWEST, FASTEST)
    arc = (
        view.at(np.array([meeting_s]))[0, 4] + rng.uniform(1.5, 2.5) - speed * (stamps - meeting_s)
    )
    aside = rng.choice([-1, 1]) * rng.uniform(0.6, 0.95)
    return _along(view, is_free, meeting_s, stamps, arc, float(aside))


def going_ahead(
    rng: np.random.Generator, view: View, is_free: IsFree, meeting_s: float
) -> Track | None:
    """Walk ahead of the camera in the same direction, faster than it; maybe overtake it first."""
    stamps = _stamps(meeting_s)
    here = np.interp(meeting_s, view.stamps_s, view.arc_m)
    pace = (view.arc_m[-1] - view.arc_m[0]) / max(float(np.ptp(view.stamps_s)), 1e-6)
    speed = float(np.clip(pace + rng.uniform(0.1, 0.5), SLOWEST, FASTEST))
    arc = here + rng.uniform(1.5, 3.0) + speed * (stamps - meeting_s)
    aside = rng.choice([-1, 1]) * rng.uniform(0.1, 0.9)
    return _along(view, is_free, meeting_s, stamps, np.asarray(arc), float(aside))


def in_doorway(door: DoorSpot) -> Scene:
    """Return the scene of standing in a doorway and stepping aside before the camera comes."""

    def scene(
        rng: np.random.Generator, view: View, is_free: IsFree, meeting_s: float
    ) -> Track | None:
        stamps, leaves = _stamps(meeting_s, 18.0, REACH_S), meeting_s + rng.uniform(0.5, 2.0)
        through = door.across + rng.choice([0.0, np.pi])
        ahead = np.array([np.cos(through), np.sin(through)])
        left = np.array([-ahead[1], ahead[0]]) * rng.choice([-1, 1])
        out = door.xy + rng.uniform(0.6, 1.0) * ahead
        corners = np.array([door.xy, out, out + 0.25 * ahead + rng.uniform(0.8, 1.5) * left])
        arc = arc_lengths(corners)
        walked = np.clip((stamps - leaves) * rng.uniform(SLOWEST, 1.1), 0, arc[-1])
        xy = np.column_stack([np.interp(walked, arc, corners[:, axis]) for axis in (0, 1)])
        moves = np.append(np.diff(walked) > 0, False)
        camera = view.at(stamps)[:, :2] - xy
        facing = np.unwrap(np.arctan2(camera[:, 1], camera[:, 0]))
        # Looks where the camera comes from, but does not follow it like a sunflower.
        facing = facing[0] + 0.6 * (facing - facing[0])
        doing: tuple[Doing, ...] = tuple("walk" if move else "stand" for move in moves)
        track = Track(stamps, xy, facing, door.floor_m, doing)
        return trim(track, view, is_free, meeting_s)

    return scene
