"""People whom a camera meets on its way: who they are, and where they are when."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.people.figure import draw_figure
from roomgraph.datasets.synthetic.people.gait import FloatArray
from roomgraph.datasets.synthetic.people.person import Doing, Person, Schedule
from roomgraph.datasets.synthetic.people.scenes import (
    DoorSpot,
    Scene,
    crossing,
    going_ahead,
    in_doorway,
    oncoming,
    standing_turning,
)  # fmt: skip
from roomgraph.datasets.synthetic.people.view import STEP_S, IsFree, Track, View
from roomgraph.datasets.trajectory import Trajectory

# Kept from the camera, and from each other; a little more than promised, for what lies between
# two samples.
CLEARANCE_M = 0.56
APART_M = 0.7
# How fast a person may be on the outer side of a bend.
SPEED_LIMIT = 1.9
# Where a seat is worth sitting on: this near the camera's way.
SEAT_REACH_M = 5.0
DOOR_REACH_M = 4.5
SITTING_SHARE = 0.35
TRIES = 30
PAUSE_S = (3.0, 14.0)
# Hips lie this far behind the middle of a seat; feet and knees reach so far in front of it.
HIPS_BACK_M = 0.05
KNEES_M = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Seat:
    """A place to sit: its middle, the floor, the seat's height above that, where one faces."""

    xy: FloatArray
    floor_m: float
    seat_height_m: float
    facing: float


def crowd(
    rng: np.random.Generator,
    count: int,
    camera: Trajectory,
    is_free: IsFree,
    seats: Sequence[Seat],
    doors: Sequence[DoorSpot],
    floor_m: FloatArray,
) -> list[Person]:
    """Plan people so that a camera meets them, now and then, wherever it goes.

    Parameters
    ----------
    count : int
        How many people; fewer are returned if there is no room for as many.
    camera : Trajectory
        Where the camera is and looks (x right, y down, z forward; the world's z is up).
    is_free : callable
        Tells for points (N, 2) at a floor's height whether somebody may stand there.
    seats, doors : sequence of Seat, of DoorSpot
        Where to sit, and in which doorways to stand.
    floor_m : (N,) float64
        Height of the floor below the camera, for each of its poses.
    """
    view, taken = View.of(camera, floor_m), list[Track]()
    people: list[Person] = []
    places = _seats_near(rng, view, seats)
    sitting = min(len(places), int(rng.binomial(count, SITTING_SHARE)))
    for seat in places[:sitting]:
        person = _sitter(rng, seat, view)
        people.append(person)
        taken.append(_still(person.schedule))
    for _ in range(count - sitting):
        tracks = _plan(rng, view, is_free, doors, taken)
        if tracks:
            taken += tracks
            speed = float(rng.uniform(0.9, 1.25))
            people.append(Person(draw_figure(rng), _schedule(tracks), speed))
    return people


def _seats_near(rng: np.random.Generator, view: View, seats: Sequence[Seat]) -> list[Seat]:
    """Return the seats, in random order, that the camera comes near to, but not too near."""
    near = []
    for seat in seats:
        level = np.abs(view.floor_m - seat.floor_m) < 1.0
        if not level.any():
            continue
        ahead = np.array([np.cos(seat.facing), np.sin(seat.facing)])
        body = seat.xy + np.linspace(-HIPS_BACK_M, KNEES_M, 6)[:, None] * ahead
        gaps = np.linalg.norm(view.xy[level][:, None] - body, axis=2).min(axis=1)
        seen = view.sees(view.stamps_s[level], np.tile(seat.xy, (int(level.sum()), 1)))
        if gaps.min() >= CLEARANCE_M and (gaps[seen] < SEAT_REACH_M).any():
            near.append(seat)
    return [near[i] for i in rng.permutation(len(near))]


def _still(schedule: Schedule) -> Track:
    """Return the track of somebody who stays in one place."""
    s = schedule
    return Track(s.stamps_s, s.xy, s.heading, float(s.floor_m[0]), ("sit", "sit"))


def _sitter(rng: np.random.Generator, seat: Seat, view: View) -> Person:
    """Return a person who sits all the time."""
    figure = draw_figure(rng)
    # Skirts and coats do not fold over a seat.
    while figure.outfit.drape is not None:
        figure = draw_figure(rng)
    ahead = np.array([np.cos(seat.facing), np.sin(seat.facing)])
    xy = np.tile(seat.xy - HIPS_BACK_M * ahead, (2, 1))
    schedule = Schedule(
        stamps_s=np.array([view.stamps_s[0] - 1.0, view.stamps_s[-1] + 1.0]), xy=xy,
        heading=np.full(2, seat.facing), floor_m=np.full(2, seat.floor_m), doing=("sit",),
        seat_m=seat.seat_height_m,
    )  # fmt: skip
    return Person(figure, schedule)


def _plan(
    rng: np.random.Generator,
    view: View,
    is_free: IsFree,
    doors: Sequence[DoorSpot],
    taken: Sequence[Track],
) -> list[Track]:
    """Return one person's scenes, one after another."""
    tracks: list[Track] = []
    now = float(view.stamps_s[0] + rng.uniform(0.0, PAUSE_S[1]))
    while now < view.stamps_s[-1]:
        track = _next(rng, view, is_free, doors, [*taken, *tracks], now)
        if track is None:
            now += 2.0
            continue
        if tracks and track.stamps_s[0] <= tracks[-1].stamps_s[-1] + 1.0:
            now += 1.0
            continue
        tracks.append(track)
        now = float(track.stamps_s[-1] + rng.uniform(*PAUSE_S))
    return tracks


def _next(
    rng: np.random.Generator,
    view: View,
    is_free: IsFree,
    doors: Sequence[DoorSpot],
    taken: Sequence[Track],
    now: float,
) -> Track | None:
    """Return a scene whose meeting is soon after a time, if one can be found."""
    kinds: list[Scene] = [crossing, crossing, oncoming, oncoming, going_ahead, standing_turning]
    for _ in range(TRIES):
        meeting = now + float(rng.uniform(1.0, 5.0))
        here = view.at(np.array([meeting]))[0]
        near = [
            door for door in doors
            if abs(door.floor_m - here[3]) < 0.05
            and 1.8 < np.linalg.norm(door.xy - here[:2]) < DOOR_REACH_M
            and view.sees(np.array([meeting]), door.xy[None])[0]
        ]  # fmt: skip
        scenes = kinds + [in_doorway(door) for door in near] * 3
        track = scenes[int(rng.integers(len(scenes)))](rng, view, is_free, meeting)
        if track is not None and track.stamps_s[0] >= now - 8.0 and _allowed(track, view, taken):
            return track
    return None


def _allowed(track: Track, view: View, taken: Sequence[Track]) -> bool:
    """Return whether a track keeps clear of the camera and of others, at a human speed."""
    if len(track.stamps_s) < 10:
        return False
    speed = np.linalg.norm(np.diff(track.xy, axis=0), axis=1) / STEP_S
    if speed.max() > SPEED_LIMIT:
        return False
    fine = np.arange(track.stamps_s[0], track.stamps_s[-1], STEP_S / 4)
    xy = _where(track, fine)
    if view.distance(fine, xy).min() < CLEARANCE_M:
        return False
    for other in taken:
        both = fine[(fine >= other.stamps_s[0]) & (fine <= other.stamps_s[-1])]
        if not len(both) or abs(other.floor_m - track.floor_m) > 1.0:
            continue
        if np.linalg.norm(_where(track, both) - _where(other, both), axis=1).min() < APART_M:
            return False
    return True


def _where(track: Track, stamps_s: FloatArray) -> FloatArray:
    """Return where a track is at times (M, 2)."""
    columns = [np.interp(stamps_s, track.stamps_s, track.xy[:, axis]) for axis in (0, 1)]
    return np.column_stack(columns)


def _schedule(tracks: Sequence[Track]) -> Schedule:
    """Join scenes, with absence between them."""
    doing: list[Doing] = []
    for track in tracks:
        doing += [*track.doing[:-1], "away"]
    return Schedule(
        stamps_s=np.concatenate([track.stamps_s for track in tracks]),
        xy=np.concatenate([track.xy for track in tracks]),
        heading=np.concatenate([track.heading for track in tracks]),
        floor_m=np.concatenate([np.full(len(track.xy), track.floor_m) for track in tracks]),
        doing=tuple(doing[:-1]),
    )
