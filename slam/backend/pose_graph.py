"""The pose graph of keyframes, with one or several unconnected components."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Container, Mapping
from dataclasses import replace
from pathlib import Path

import gtsam
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.files import replacing
from roomgraph.slam.backend.connectivity import Connections
from roomgraph.slam.backend.solver import (
    Constraint,
    PoseGraphSettings,
    Solver,
    deviations,
    factor_of,
)
from roomgraph.slam.errors import SlamError

__all__ = ["Constraint", "PoseGraph", "PoseGraphSettings"]

FloatArray = NDArray[np.float64]

# Between, only poses near new constraints are read back: others move less than iSAM2's threshold.
REFRESH_EVERY = 16


class PoseGraph:
    """The optimal keyframe poses under all constraints between them.

    Keyframe ids count up, and serve as keys. The graph may consist of several components
    (sub-maps): the first keyframe of each is held at the pose it is added with. The first
    constraint between two components joins them: the younger moves as a whole, and hangs on its
    constraints alone from then on. So the world's frame stays that of the oldest keyframe.

    Attributes
    ----------
    constraints : list of Constraint
        All constraints that hold.
    rejected : list of Constraint
        Loops that were taken out again because the others contradicted them.
    """

    def __init__(self, settings: PoseGraphSettings) -> None:
        self.settings = settings
        self.constraints: list[Constraint] = []
        self.rejected: list[Constraint] = []
        self._ids: list[int] = []
        self._T: FloatArray = np.empty((0, 4, 4))
        self._connections = Connections()
        self._solver = Solver(settings)
        self._numbers: list[int] = []
        self._touched: set[int] = set()
        self._is_stale = self._is_bent = False
        self._updates = 0

    def __len__(self) -> int:
        return len(self._ids)

    def __contains__(self, keyframe: int) -> bool:
        return keyframe in self._connections

    def __getitem__(self, keyframe: int) -> FloatArray:
        """Return T_world_keyframe (4, 4)."""
        return np.array(self._T[self._row(keyframe)])

    @property
    def poses(self) -> dict[int, FloatArray]:
        """All T_world_keyframe (4, 4) by keyframe id."""
        return dict(zip(self._ids, self._T.copy(), strict=True))

    def stacked(self) -> tuple[NDArray[np.intp], FloatArray]:
        """Return all ids (N,), in order, and T_world_keyframe (N, 4, 4)."""
        return np.array(self._ids, dtype=np.intp), self._T.copy()

    @property
    def components(self) -> int:
        """Number of sub-maps not connected by constraints."""
        return len(self._connections.roots)

    def component_of(self, keyframe: int) -> int:
        """Return the id of the oldest keyframe of the sub-map that a keyframe belongs to."""
        self._row(keyframe)
        return self._connections.component_of(keyframe)

    @property
    def world(self) -> int:
        """The oldest keyframe of the sub-map whose frame is the world's.

        It is the oldest sub-map with at least half as many keyframes as the largest: a beginning
        that was soon lost gives way, and the world does not change hands between equals.
        """
        size = {root: len(self.members_of(root)) for root in self._connections.roots}
        enough = max(size.values()) / 2
        return min(root for root in size if size[root] >= enough)

    def members_of(self, component: int) -> list[int]:
        """Return the keyframes of the sub-map with this oldest keyframe."""
        return self._connections.members_of(component)

    def path_length(self, first: int, second: int, limit: float) -> float:
        """Return the shortest path along constraints, metres; infinite beyond `limit` metres."""
        return self._connections.ways_from(first, limit, second).get(second, float("inf"))

    def around(self, keyframe: int, metres: float) -> set[int]:
        """Return the keyframes within a distance in metres along constraints."""
        return set(self._connections.ways_from(keyframe, metres))

    def add_keyframe(
        self, keyframe: int, T_world_keyframe: FloatArray, starts_component: bool = False
    ) -> None:
        """Add a keyframe at its estimated pose.

        Parameters
        ----------
        keyframe : int
            Its id, larger than all before.
        starts_component : bool
            Whether it begins a sub-map, and is held where it is; the very first always does.

        Raises
        ------
        SlamError
            The keyframe is there already, or its id is not the largest.
        """
        if self._ids and keyframe <= self._ids[-1]:
            what = "is in the graph already" if keyframe in self else "has too small an id"
            raise SlamError(f"keyframe {what}", where=f"keyframe {keyframe}")
        starts = starts_component or not self._ids
        self._ids.append(keyframe)
        self._T = np.concatenate([self._T, T_world_keyframe[None]])
        self._connections.add(keyframe, is_root=starts)
        self._touched.add(keyframe)
        self._solver.add_pose(keyframe, T_world_keyframe)
        if starts:
            self._solver.add_prior(keyframe, T_world_keyframe)

    def add_constraint(self, constraint: Constraint) -> None:
        """Add a measurement between two keyframes; between two sub-maps it joins them.

        Raises
        ------
        SlamError
            One of the keyframes is not in the graph.
        """
        rows = [self._row(keyframe) for keyframe in (constraint.first, constraint.second)]
        moving = self._connections.connect(constraint.first, constraint.second, _length(constraint))
        if moving:
            self._move(moving, constraint)
        elif constraint.is_loop:
            first, second = self._T[rows][:, None]
            far = deviations([constraint], first, second, self.settings)[0]
            self._is_bent |= bool(far > self.settings.kernel_width)
        self.constraints.append(constraint)
        self._numbers.append(self._solver.add_constraint(constraint))
        for keyframe in (constraint.first, constraint.second):
            self._touched.update((keyframe, *self._connections.connected(keyframe)))

    def measure_again(self, T_world: Mapping[int, FloatArray], since: int) -> None:
        """Update constraints between keyframes from jointly adjusted poses.

        Only constraints by features that close no loop are changed.

        Parameters
        ----------
        T_world : mapping of int to (4, 4) float64
            The poses.
        since : int
            No keyframe before it was moved.
        """
        for place in reversed(range(len(self.constraints))):
            constraint = self.constraints[place]
            if constraint.is_loop or constraint.by != "features":
                continue
            if constraint.second < since:
                break
            if constraint.first in T_world and constraint.second in T_world:
                T = se3.inverse(T_world[constraint.first]) @ T_world[constraint.second]
                self.constraints[place] = replace(constraint, T_first_second=T)
                self._solver.remove(self._numbers[place])
                self._numbers[place] = self._solver.add_constraint(self.constraints[place])

    def optimise(self) -> list[Constraint]:
        """Add new keyframes and constraints to the solver and update all poses.

        Returns
        -------
        list of Constraint
            Loops taken out because the others contradict them.

        Raises
        ------
        SlamError
            A keyframe hangs on no constraint, so its pose is undetermined.
        """
        if self._connections.loose:
            raise SlamError(
                "pose graph cannot be solved", where=f"keyframe {min(self._connections.loose)}",
                expected="a constraint to every keyframe",
            )  # fmt: skip
        if not (self._is_stale or self._is_bent):
            self._update()
            return []
        self._settle()
        rejected: list[Constraint] = []
        while worst := self._contradicted():
            rejected += worst
            self._take_out(worst)
            self._settle()
        self.rejected += rejected
        return rejected

    def write_g2o(self, path: Path, keyframes: Container[int] | None = None) -> None:
        """Write poses and constraints, without kernels, for other tools (``VERTEX_SE3:QUAT``).

        Of all keyframes, or of those given.
        """
        factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        for key, T in zip(self._ids, self._T, strict=True):
            if keyframes is None or key in keyframes:
                values.insert(key, gtsam.Pose3(T))
        for constraint in self.constraints:
            if keyframes is None or (
                constraint.first in keyframes and constraint.second in keyframes
            ):
                factors.add(factor_of(constraint, self.settings, robust=False))
        with replacing(path) as temporary:
            gtsam.writeG2o(factors, values, str(temporary))

    def _row(self, keyframe: int) -> int:
        if keyframe not in self:
            raise SlamError("no such keyframe in the pose graph", where=f"keyframe {keyframe}")
        return bisect_left(self._ids, keyframe)

    def _move(self, moving: list[int], constraint: Constraint) -> None:
        """Move keyframes rigidly to satisfy a constraint to another sub-map."""
        T_world_second = self[constraint.first] @ constraint.T_first_second
        moved = T_world_second @ se3.inverse(self[constraint.second])
        moved = se3.inverse(moved) if constraint.first in moving else moved
        rows = [self._row(keyframe) for keyframe in moving]
        self._T[rows] = moved @ self._T[rows]
        self._is_stale = True

    def _update(self) -> None:
        """Update the solver with small changes."""
        self._solver.update(thoroughly=False)
        self._updates += 1
        if self._updates % REFRESH_EVERY == 0:
            self._T = self._solver.poses()
        else:
            for keyframe in self._touched:
                self._T[self._row(keyframe)] = self._solver.pose(keyframe)
        self._touched.clear()

    def _settle(self) -> None:
        """Update the solver with large changes; rebuild it if parts move rigidly."""
        if self._is_stale:
            self._solver = Solver(self.settings)
            for keyframe, T in zip(self._ids, self._T, strict=True):
                self._solver.add_pose(keyframe, T)
                if keyframe in self._connections.roots:
                    self._solver.add_prior(keyframe, T)
            self._numbers = [
                self._solver.add_constraint(constraint) for constraint in self.constraints
            ]
        self._solver.update(thoroughly=True)
        self._T = self._solver.poses()
        self._is_stale = self._is_bent = False
        self._touched.clear()

    def _contradicted(self) -> list[Constraint]:
        """Return the loops with large residuals; only the worst, which distort the others."""
        loops = [constraint for constraint in self.constraints if constraint.is_loop]
        if not loops:
            return []
        first, second = (
            self._T[[self._row(end) for end in ends]]
            for ends in zip(
                *((constraint.first, constraint.second) for constraint in loops), strict=True
            )
        )
        far = deviations(loops, first, second, self.settings)
        limit = max(self.settings.reject_width, far.max() / 2)
        return [loops[i] for i in np.flatnonzero(far > limit)]

    def _take_out(self, constraints: list[Constraint]) -> None:
        gone = {id(constraint) for constraint in constraints}
        places = [i for i, constraint in enumerate(self.constraints) if id(constraint) in gone]
        for i in reversed(places):
            constraint = self.constraints.pop(i)
            self._solver.remove(self._numbers.pop(i))
            self._is_stale |= self._connections.disconnect(
                constraint.first, constraint.second, _length(constraint)
            )


def _length(constraint: Constraint) -> float:
    return float(np.linalg.norm(constraint.T_first_second[:3, 3]))
