"""Positions of the images of an experiment, and the rooms that they show."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.experiments.walks import Walk
from roomgraph.datasets import se3
from roomgraph.datasets.floor_plan import FILE_NAME, FloorPlanTruth, read_floor_plan
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.datasets.vectors import arc_lengths
from roomgraph.semantics.evaluation.visible_rooms import RoomIndex
from roomgraph.semantics.recognition.examples import Example

# Number of successive images in one piece of a walk: about 2.5 m, or a third of a turn.
STRETCH = 8
# Every n-th pixel across and down says which room an image shows.
_PIXEL_STEP = 8
# The step between two images, where nobody knows where they were taken.
_UNKNOWN_STEP_M = 0.1


@dataclass(frozen=True, slots=True)
class VisibleRoom:
    """The room that an image shows.

    Attributes
    ----------
    label, room : str
        Kind and name of the room that most of it shows.
    own_share : float
        Share of its surfaces that belong to the room it was taken in.
    """

    label: str
    room: str
    own_share: float


def positions_of(examples: Sequence[Example]) -> NDArray[np.float64] | None:
    """Return where the images of one sequence were taken (N, 3), metres; None if not known."""
    root = Path(examples[0].session)
    truth = open_sequence(root).ground_truth if root.is_dir() else None
    return None if truth is None else truth.positions[_nearest(truth, examples)]


def route_positions(examples: Sequence[Example]) -> NDArray[np.float64]:
    """Return positions like `positions_of`; small steps along a line where unknown."""
    positions = positions_of(examples)
    if positions is not None:
        return positions
    return np.outer(_UNKNOWN_STEP_M * np.arange(len(examples)), [1.0, 0.0, 0.0])


def doorway_distances(walks: Sequence[Walk], examples: Sequence[Example]) -> NDArray[np.float64]:
    """Return the distance (N,) along the walk from each image to the nearest room change, metres.

    Empty where a walk has no poses.
    """
    found: dict[tuple[str, float], float] = {}
    for walk in walks:
        positions = positions_of(walk.examples)
        if positions is None:
            return np.empty(0)
        ways = _to_changes(positions, np.array([example.group for example in walk.examples]))
        found |= {_key(e): float(way) for e, way in zip(walk.examples, ways, strict=True)}
    return np.array([found[_key(example)] for example in examples])


def visible_rooms(walks: Sequence[Walk], examples: Sequence[Example]) -> list[VisibleRoom]:
    """Return the room that each image shows; empty without poses or floor plan."""
    found: dict[tuple[str, float], VisibleRoom] = {}
    wanted = {_key(example) for example in examples}
    for walk in walks:
        own = [example for example in walk.examples if _key(example) in wanted]
        if not (walk.root / FILE_NAME).is_file():
            return []
        found |= zip(map(_key, own), _visible_rooms_of_walk(walk.root, own), strict=True)
    return [found[_key(example)] for example in examples]


def stretches_along(
    walks: NDArray[np.generic], visits: NDArray[np.str_]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the number of each image along its walk (N,), and its stretch of it.

    A visit has two stretches at least.
    """
    order, stretches = np.zeros((2, len(walks)), dtype=np.intp)
    for walk in dict.fromkeys(walks.tolist()):
        members = np.flatnonzero(walks == walk)
        order[members] = np.arange(len(members))
        first = 0
        for visit in dict.fromkeys(visits[members].tolist()):
            own = members[visits[members] == visit]
            count = max(2, round(len(own) / STRETCH))
            stretches[own] = first + np.arange(len(own)) * count // len(own)
            first += count
    return order, stretches


def _visible_rooms_of_walk(root: Path, examples: Sequence[Example]) -> list[VisibleRoom]:
    sequence, plan = open_sequence(root), read_floor_plan(root / FILE_NAME)
    truth = sequence.ground_truth
    assert truth is not None  # a building on disk has its poses
    index = RoomIndex([room.outline for room in plan.rooms])
    stamps = np.asarray(sequence.stamps_s)

    def look(example: Example, pose: NDArray[np.float64]) -> VisibleRoom:
        frame = sequence[int(np.abs(stamps - example.stamp_s).argmin())]
        return _visible_room(index.shares(_floor_points(frame, pose)), plan, example.place)

    with ThreadPoolExecutor() as pool:
        return list(pool.map(look, examples, truth.T_world_camera[_nearest(truth, examples)]))


def _visible_room(shares: NDArray[np.float64], plan: FloorPlanTruth, place: str) -> VisibleRoom:
    most = plan.rooms[int(shares.argmax())]
    own = [share for share, room in zip(shares, plan.rooms, strict=True) if room.name == place]
    return VisibleRoom(most.label, most.name, float(sum(own)))


def _floor_points(frame: Frame, T_world_camera: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return positions on the floor plan (N, 2) of the surfaces in a frame."""
    depth = frame.depth[::_PIXEL_STEP, ::_PIXEL_STEP]
    row, column = np.nonzero(depth)
    pixels = _PIXEL_STEP * np.column_stack([column, row]).astype(np.float64)
    points = frame.intrinsics.backproject(pixels, depth[row, column])
    return se3.transform(T_world_camera, points)[:, :2]


def _to_changes(positions: NDArray[np.float64], groups: NDArray[np.str_]) -> NDArray[np.float64]:
    """Return the distance (N,) along a walk to the next group change; infinite without one."""
    along = arc_lengths(positions)
    changes = np.flatnonzero(groups[1:] != groups[:-1])
    borders = (along[changes] + along[changes + 1]) / 2
    return np.asarray(np.abs(along[:, None] - borders).min(axis=1, initial=np.inf))


def _nearest(truth: Trajectory, examples: Sequence[Example]) -> NDArray[np.int64]:
    return truth.nearest(np.array([example.stamp_s for example in examples]), np.inf)


def _key(example: Example) -> tuple[str, float]:
    return example.session, example.stamp_s
