"""The pose graph over keyframes, in one part or several that no link joins yet."""

from __future__ import annotations

from bisect import bisect_left
from pathlib import Path

import gtsam
import numpy as np
from numpy.typing import NDArray

from datasets import poses
from datasets.files import replacing
from slam.errors import SlamError
from slam.solver import Link, PoseGraphSettings, Solver, factor_of

__all__ = ["Link", "PoseGraph", "PoseGraphSettings"]

FloatArray = NDArray[np.float64]


class PoseGraph:
    """Keyframe poses that agree best with all links between them.

    Keyframe ids count up, and serve as keys. The graph may consist of several components
    (sub-maps): the first keyframe of each is held at the pose it is added with. The first link
    between two components joins them: the younger moves as a whole, and hangs on its links alone
    from then on. So the world's frame stays that of the oldest keyframe.
    """

    def __init__(self, settings: PoseGraphSettings) -> None:
        self.settings = settings
        self.links: list[Link] = []
        self._ids: list[int] = []
        self._T: FloatArray = np.empty((0, 4, 4))
        self._way: list[float] = []
        # The keyframe that began the sub-map: as tracked, and as joined by links.
        self._tracked: list[int] = []
        self._component: dict[int, int] = {}
        self._members: dict[int, list[int]] = {}
        self._held: set[int] = set()
        self._loose: set[int] = set()
        self._numbers: list[int] = []
        self._solver = Solver(settings)
        self._is_stale = self._has_loop = False

    def __len__(self) -> int:
        return len(self._ids)

    def __contains__(self, keyframe: int) -> bool:
        return keyframe in self._component

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
        """How many sub-maps there are that no link joins."""
        return len(self._held)

    def component_of(self, keyframe: int) -> int:
        """Return the id of the oldest keyframe of the sub-map that a keyframe belongs to."""
        self._row(keyframe)
        return self._component[keyframe]

    def way_between(self, first: int, second: int) -> float:
        """Return the length of the way from one keyframe to the other, as tracked, metres.

        Infinite if tracking was lost in between.
        """
        i, j = self._row(first), self._row(second)
        if self._tracked[i] != self._tracked[j]:
            return float("inf")
        return abs(self._way[j] - self._way[i])

    def add_keyframe(
        self, keyframe: int, T_world_keyframe: FloatArray, starts_component: bool = False
    ) -> None:
        """Add a keyframe where it is believed to be.

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
        step = 0.0 if starts else np.linalg.norm(T_world_keyframe[:3, 3] - self._T[-1, :3, 3])
        self._way.append(float(step) + (self._way[-1] if self._way else 0.0))
        self._tracked.append(keyframe if starts else self._tracked[-1])
        self._ids.append(keyframe)
        self._T = np.concatenate([self._T, T_world_keyframe[None]])
        self._component[keyframe] = keyframe
        self._members[keyframe] = [keyframe]
        self._solver.add_pose(keyframe, T_world_keyframe)
        if starts:
            self._held.add(keyframe)
            self._solver.add_prior(keyframe, T_world_keyframe)
        else:
            self._loose.add(keyframe)

    def add_link(self, link: Link) -> None:
        """Add a measurement between two keyframes; between two sub-maps it joins them.

        Raises
        ------
        SlamError
            One of the keyframes is not in the graph.
        """
        first, second = self.component_of(link.first), self.component_of(link.second)
        if first != second:
            self._join(link, first, second)
        self.links.append(link)
        self._numbers.append(self._solver.add_link(link))
        self._has_loop |= link.is_loop

    def optimise(self) -> None:
        """Take the new keyframes and links in and update all poses.

        Raises
        ------
        SlamError
            A keyframe hangs on no link, so its pose is undetermined.
        """
        if self._loose:
            raise SlamError(
                "pose graph cannot be solved", where=f"keyframe {min(self._loose)}",
                expected="a link to every keyframe",
            )  # fmt: skip
        if self._is_stale:
            self._rebuild()
        self._T = self._solver.update(thoroughly=self._is_stale or self._has_loop)
        self._is_stale = self._has_loop = False

    def write_g2o(self, path: Path) -> None:
        """Write poses and links, without kernels, for other tools (``VERTEX_SE3:QUAT``)."""
        factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        for key, T in zip(self._ids, self._T, strict=True):
            values.insert(key, gtsam.Pose3(T))
        for link in self.links:
            factors.add(factor_of(link, self.settings, robust=False))
        with replacing(path) as temporary:
            gtsam.writeG2o(factors, values, str(temporary))

    def _row(self, keyframe: int) -> int:
        if keyframe not in self._component:
            raise SlamError("no such keyframe in the pose graph", where=f"keyframe {keyframe}")
        return bisect_left(self._ids, keyframe)

    def _join(self, link: Link, first: int, second: int) -> None:
        """Make two components one; of two that are held, the younger moves to where it fits."""
        kept, other = sorted((first, second), key=lambda c: (c not in self._held, c))
        members = self._members.pop(other)
        if other in self._held:
            T_first_second = link.T_first_second
            if second == other:
                moved = self[link.first] @ T_first_second @ poses.inverse(self[link.second])
            else:
                moved = self[link.second] @ poses.inverse(self[link.first] @ T_first_second)
            rows = [self._row(keyframe) for keyframe in members]
            self._T[rows] = moved @ self._T[rows]
            self._held.remove(other)
            self._is_stale = True
        self._component.update(dict.fromkeys(members, kept))
        self._members[kept].extend(members)
        if kept in self._held:
            self._loose.difference_update(members)

    def _rebuild(self) -> None:
        """Begin a new solver at the present poses: iSAM2 cannot move its own as a whole."""
        self._solver = Solver(self.settings)
        for keyframe, T in zip(self._ids, self._T, strict=True):
            self._solver.add_pose(keyframe, T)
            if keyframe in self._held:
                self._solver.add_prior(keyframe, T)
        self._numbers = [self._solver.add_link(link) for link in self.links]
