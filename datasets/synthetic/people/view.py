"""What a camera sees when, and the tracks of people before it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.people.gait import FloatArray
from roomgraph.datasets.synthetic.people.person import Doing
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.datasets.vectors import arc_lengths

IsFree = Callable[[FloatArray, float], NDArray[np.bool_]]

STEP_S = 0.1
# Half the camera's angle of view, and some more: nobody appears or vanishes where it sees.
HALF_VIEW_RAD = np.deg2rad(28.5 + 4)
FAR_M = 8.0


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Where a person is, every `STEP_S` seconds.

    `stamps_s` (K,), `xy` (K, 2), `heading` (K,) while standing, the height `floor_m` of the floor
    and what is done at each of the stamps, up to the next.
    """

    stamps_s: FloatArray
    xy: FloatArray
    heading: FloatArray
    floor_m: float
    doing: tuple[Doing, ...]

    def between(self, begin: int, end: int) -> Track:
        """Return the samples `begin` to `end`, the latter included."""
        part = slice(begin, end + 1)
        return replace(
            self, stamps_s=self.stamps_s[part], xy=self.xy[part], heading=self.heading[part],
            doing=self.doing[part],
        )  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """Where the camera is and looks, by time.

    Attributes
    ----------
    stamps_s : (N,) float64
        Seconds.
    xy : (N, 2) float64
        Above which point of the floor it is.
    heading : (N,) float64
        Where it looks, without jumps.
    floor_m : (N,) float64
        Height of the floor.
    arc_m : (N,) float64
        How far it has come.
    """

    stamps_s: FloatArray
    xy: FloatArray
    heading: FloatArray
    floor_m: FloatArray
    arc_m: FloatArray

    @classmethod
    def of(cls, camera: Trajectory, floor_m: FloatArray) -> View:
        """Return the view of a camera at the poses of a trajectory."""
        xy = camera.positions[:, :2]
        ahead = camera.T_world_camera[:, :2, 2]
        heading = np.unwrap(np.arctan2(ahead[:, 1], ahead[:, 0]))
        return cls(camera.stamps_s, xy, heading, np.asarray(floor_m), arc_lengths(xy))

    def at(self, stamps_s: FloatArray) -> FloatArray:
        """Return x, y, heading, floor, way so far (M, 5) at times."""
        columns = (*self.xy.T, self.heading, self.floor_m, self.arc_m)
        values = [np.interp(stamps_s, self.stamps_s, column) for column in columns]
        return np.stack(values, axis=-1)

    def on_way(self, arc_m: FloatArray) -> FloatArray:
        """Return points (M, 2) of the camera's own way, by its length up to them."""
        # Where the camera stood still, the way has points without length.
        keep = np.append(True, np.diff(self.arc_m) > 1e-6)
        arc, xy = self.arc_m[keep], self.xy[keep]
        return np.column_stack([np.interp(arc_m, arc, xy[:, axis]) for axis in (0, 1)])

    def distance(self, stamps_s: FloatArray, xy: FloatArray) -> FloatArray:
        """Return how far on the floor people at points (M, 2) are from the camera at times."""
        return np.asarray(np.linalg.norm(self.at(stamps_s)[:, :2] - xy, axis=1))

    def sees(self, stamps_s: FloatArray, xy: FloatArray) -> NDArray[np.bool_]:
        """Return whether points (M, 2) are in the picture at times, if no wall hides them."""
        here = self.at(stamps_s)
        way = xy - here[:, :2]
        aside = np.arctan2(way[:, 1], way[:, 0]) - here[:, 2]
        aside = np.abs((aside + np.pi) % (2 * np.pi) - np.pi)
        away = np.hypot(way[:, 0], way[:, 1])
        # Somebody half out of the picture is still in it.
        half = HALF_VIEW_RAD + np.arctan2(0.4, np.maximum(away, 0.2))
        return np.asarray((aside < half) & (away < FAR_M))


def trim(track: Track, view: View, is_free: IsFree, meeting_s: float) -> Track | None:
    """Cut a track down to the least that begins and ends out of sight, on free floor.

    None if there is no such part of it round the meeting.
    """
    stamps, middle = track.stamps_s, int(np.argmin(np.abs(track.stamps_s - meeting_s)))
    flat = np.abs(view.at(stamps)[:, 3] - track.floor_m) < 0.05
    good = is_free(track.xy, track.floor_m) & flat
    if not good[middle]:
        return None
    before, after = np.flatnonzero(~good[:middle]), np.flatnonzero(~good[middle:])
    first = int(before[-1]) + 1 if len(before) else 0
    last = middle + int(after[0]) - 1 if len(after) else len(stamps) - 1
    # Before the recording begins and after it ends nobody looks.
    seen = view.sees(stamps, track.xy)
    seen &= (stamps >= view.stamps_s[0]) & (stamps <= view.stamps_s[-1])
    hidden = np.flatnonzero(~seen[first : last + 1]) + first
    begins, finishes = hidden[hidden < middle], hidden[hidden > middle]
    if not len(begins) or not len(finishes):
        return None
    return track.between(int(begins[-1]), int(finishes[0]))
