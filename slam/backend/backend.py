"""Creation of keyframes in the background, and the results of the mapper so far."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.backend.mapper import Mapper, MapUpdate
from roomgraph.slam.backend.pose_graph import Constraint
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.estimate import Estimate
from roomgraph.slam.frontend.local_map import LocalMap, covisible, local_map
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.tracking import LoopClosure

FloatArray = NDArray[np.float64]

# Maximum number of keyframes that are being made while tracking goes on.
IN_FLIGHT = 4


@dataclass(frozen=True, slots=True)
class _Pending:
    """A keyframe in progress: its content, and its estimated pose until it is done."""

    id: int
    view: View
    reference: int | None
    T_reference_keyframe: FloatArray
    update: Future[MapUpdate]

    @property
    def features(self) -> Features:
        return self.view.features

    @property
    def points(self) -> FloatArray:
        return self.view.points_camera

    @property
    def thumbnail(self) -> RangeImage:
        return self.view.thumbnail


class Backend:
    """Creates keyframes in two threads, in order, and keeps a copy of the map for tracking.

    What tracking sees changes only when it asks: with the n-th keyframe handed in, the results up
    to the (n - `IN_FLIGHT`)-th are taken in, whether or not more are there. So the outcome does
    not depend on which thread is faster.

    Attributes
    ----------
    poses : dict of int to (4, 4) float64
        T_world_keyframe as far as known now, also of keyframes that are still being made.
    keyframes : dict of int to Keyframe
        The finished ones.
    closures : tuple of LoopClosure
        The loops between these that hold.
    constraints : tuple of Constraint
        Between these.
    placed : set of int
        Keyframes of the sub-map that is the world, as far as known.
    """

    def __init__(self, mapper: Mapper) -> None:
        self.mapper = mapper
        self.poses: dict[int, FloatArray] = {}
        self.keyframes: dict[int, Keyframe] = {}
        self.closures: tuple[LoopClosure, ...] = ()
        self.constraints: tuple[Constraint, ...] = ()
        self.placed: set[int] = set()
        # One describes a keyframe while the other takes the one before into the map.
        self._describers = ThreadPoolExecutor(1, thread_name_prefix="describer")
        self._mappers = ThreadPoolExecutor(1, thread_name_prefix="mapper")
        self._pending: deque[_Pending] = deque()
        self._new_closures: list[LoopClosure] = []
        # By keyframe; made of the constraints when it is asked for.
        self._neighbours: defaultdict[int, set[int]] | None = None
        self._next = 0

    def start(self, view: View, T_world_camera: FloatArray) -> int:
        """Create the first keyframe of a map or of a new sub-map; return its id."""
        return self._submit(
            view, None, T_world_camera,
            lambda keyframe: self.mapper.start(keyframe, view, T_world_camera),
        )  # fmt: skip

    def insert(self, view: View, estimate: Estimate) -> int:
        """Create a keyframe from a view with known pose; return its id."""
        return self._submit(
            view, estimate.reference, se3.inverse(estimate.T_camera_reference),
            lambda keyframe: self.mapper.insert(keyframe, view, estimate),
        )  # fmt: skip

    def finish(self) -> None:
        """Wait for all keyframes in progress and collect their results."""
        while self._pending:
            self._take()

    def around(self, reference: int) -> LocalMap:
        """Return the points of a keyframe and of its covisible neighbours.

        Goes by what is known of the map now: nothing is waited for but features.
        """
        linked = self._linked(reference)
        chosen = covisible(reference, linked, self.poses, self.mapper.settings.neighbours)
        return local_map([(self._described(k), self.poses[k]) for k in chosen])

    def thumbnail(self, keyframe: int) -> RangeImage:
        """Return the thumbnail of a keyframe, done or in progress."""
        return self._described(keyframe).thumbnail

    def known_points(self, keyframe: int) -> FloatArray:
        """Return a keyframe's features with depth as points in its camera frame (N, 3)."""
        points = self._described(keyframe).points
        return points[np.isfinite(points[:, 2])]

    def new_closures(self) -> tuple[LoopClosure, ...]:
        """Return the loop closures found since the last call."""
        found, self._new_closures = tuple(self._new_closures), []
        return found

    def _linked(self, reference: int) -> set[int]:
        """Return the keyframes linked to one; for one in progress, those likely to be linked.

        These are the others on the way back to one that is done, what hangs on all these, and what
        that one is linked to.
        """
        making = {pending.id: pending.reference for pending in self._pending}
        way, done = {reference}, reference
        while (before := making.get(done)) is not None:
            done = before
            way.add(done)
        for keyframe, before in making.items():  # in the order in which they were handed in
            if before in way:
                way.add(keyframe)
        if self._neighbours is None:
            self._neighbours = defaultdict(set)
            for constraint in self.constraints:
                self._neighbours[constraint.first].add(constraint.second)
                self._neighbours[constraint.second].add(constraint.first)
        return (way | self._neighbours[done]) - {reference}

    def _described(self, keyframe: int) -> _Pending | Keyframe:
        """Return a keyframe, done or in progress."""
        making = next((pending for pending in self._pending if pending.id == keyframe), None)
        return making or self.keyframes[keyframe]

    def _submit(
        self,
        view: View,
        reference: int | None,
        T: FloatArray,
        take_in: Callable[[Keyframe], MapUpdate],
    ) -> int:
        keyframe, self._next = self._next, self._next + 1
        described = self._describers.submit(self.mapper.describe, keyframe, view)
        while len(self._pending) >= IN_FLIGHT:
            self._take()
        update = self._mappers.submit(lambda: take_in(described.result()))
        self._pending.append(_Pending(keyframe, view, reference, T, update))
        self._chain()
        return keyframe

    def _take(self) -> None:
        try:
            update = self._pending[0].update.result()
        except Exception:
            self._abandon()
            raise
        self._pending.popleft()
        self.poses, self.closures = dict(update.poses), update.closures
        self.constraints, self._neighbours = update.constraints, None
        self.placed = set(update.placed)
        self.keyframes[update.keyframe.id] = update.keyframe
        self._new_closures.extend(update.new_closures)
        self._chain()

    def _abandon(self) -> None:
        """Discard the keyframes in progress after one has failed."""
        for pending in self._pending:
            pending.update.cancel()
        # The map is at rest only once what runs already has come to its end.
        wait([pending.update for pending in self._pending])
        self._pending.clear()

    def _chain(self) -> None:
        """Update the estimated poses of the keyframes in progress."""
        for pending in self._pending:
            T = pending.T_reference_keyframe
            if pending.reference is not None:
                T = self.poses[pending.reference] @ T
            self.poses[pending.id] = T
            if pending.reference in self.placed or not self.keyframes:
                self.placed.add(pending.id)
