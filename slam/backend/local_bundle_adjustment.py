"""The landmarks that keyframes share, and their adjustment over the latest keyframes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.backend.bundle_adjustment import Observations, adjust
from roomgraph.slam.features.matching import Matches
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.keyframe import Keyframe

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
Poses = Mapping[int, FloatArray]


class LocalBundleAdjustmentSettings(Settings):
    """How many keyframes are adjusted together."""

    enabled: bool = Field(
        default=True,
        description="adjust keyframes and landmarks together (local bundle adjustment)",
    )
    size: int = Field(
        default=8, ge=2, le=50, description="maximum number of latest keyframes that are adjusted"
    )
    held: int = Field(
        default=6,
        ge=1,
        le=50,
        description="maximum number of covisible older keyframes, held fixed",
    )
    landmarks: int = Field(
        default=800,
        ge=50,
        description="approximate number of landmarks adjusted; those seen by most keyframes are "
        "chosen",
    )
    min_shared: int = Field(
        default=15,
        ge=6,
        description="minimum number of landmarks that a keyframe shares with the others",
    )


class LocalBundleAdjustment:
    """Keeps tracks of features over keyframes, and adjusts the latest keyframes on them.

    A landmark lies in the camera frame of the keyframe that first saw it, so it moves along when
    loops move that one.
    """

    def __init__(self, settings: LocalBundleAdjustmentSettings, noise: SensorNoise) -> None:
        self.settings, self.noise = settings, noise
        # Of each keyframe: which landmark each of its features is, -1 for none.
        self._landmark: dict[int, IntArray] = {}
        self._owner: IntArray = np.empty(0, dtype=np.intp)
        self._position: FloatArray = np.empty((0, 3))
        self._count = 0

    def add(self, keyframe: Keyframe) -> None:
        """Add a keyframe without matches."""
        self._landmark[keyframe.id] = np.full(len(keyframe.features), -1, dtype=np.intp)

    def match(self, keyframe: Keyframe, other: Keyframe, rows: Matches) -> None:
        """Note that features of `other` and of `keyframe` (N, 2) are the same points."""
        theirs, ours = self._landmark[other.id], self._landmark[keyframe.id]
        fresh = rows[(theirs[rows[:, 0]] < 0) & (ours[rows[:, 1]] < 0)]
        if len(fresh):
            ids = self._make(other.id, other.points[fresh[:, 0]])
            theirs[fresh[:, 0]] = ids
        unknown = ours[rows[:, 1]] < 0
        ids = theirs[rows[unknown, 0]]
        # A keyframe sees a landmark once.
        _, first = np.unique(ids, return_index=True)
        first = first[~np.isin(ids[first], ours)]
        ours[rows[unknown, 1][first]] = ids[first]

    def adjust(
        self, newest: int, around: set[int], keyframes: Mapping[int, Keyframe], T_world: Poses
    ) -> dict[int, FloatArray]:
        """Return T_world_keyframe (4, 4) of the adjusted and of the fixed keyframes.

        Parameters
        ----------
        newest : int
            The keyframe that has just come in.
        around : set of int
            Keyframes linked to the latest ones.
        """
        free = self._connected([k for k in sorted(around | {newest})[-self.settings.size :]])
        if newest not in free:
            return {}
        shared = self._seen_by(free)
        counts = [
            (int(np.isin(self._landmark[k], shared).sum()), k)
            for k in around - set(free)
            if k in self._landmark
        ]
        counts = sorted(c for c in counts if c[0] >= self.settings.min_shared)
        held = [k for _, k in counts[-self.settings.held :]]
        if not held:
            held, free = free[:1], free[1:]
        if not free:
            return {}
        return self._solve(free, held, keyframes, T_world)

    def _solve(
        self, free: list[int], held: list[int], keyframes: Mapping[int, Keyframe], T_world: Poses
    ) -> dict[int, FloatArray]:
        chosen = [*free, *held]
        cameras, rows, ids = self._observations(chosen)
        used, landmarks = np.unique(ids, return_inverse=True)
        seen = Observations(
            cameras, landmarks,
            np.concatenate([
                keyframes[k].features.pixels[rows[cameras == i]] for i, k in enumerate(chosen)
            ]),
            np.concatenate([
                keyframes[k].points[rows[cameras == i], 2] for i, k in enumerate(chosen)
            ]),
        )  # fmt: skip
        T_owner = self._of_owners(used, T_world)
        points = (T_owner[:, :3, :3] @ self._position[used][..., None])[..., 0] + T_owner[:, :3, 3]
        T = np.array([se3.inverse(T_world[k]) for k in chosen])
        is_free = np.arange(len(chosen)) < len(free)
        done = adjust(T, is_free, points, seen, keyframes[free[0]].intrinsics, self.noise)
        adjusted = {k: se3.inverse(T) for k, T in zip(chosen, done.T_camera_world, strict=True)}
        self._settle(used, done.landmarks, {**T_world, **adjusted})
        for i, k in enumerate(chosen):
            wrong = rows[(cameras == i) & ~done.inliers]
            self._landmark[k][wrong] = -1
        return adjusted

    def _settle(self, used: IntArray, points: FloatArray, T_world: Poses) -> None:
        """Store landmarks (L, 3), given in the world, in their owners' frames."""
        T = np.linalg.inv(self._of_owners(used, T_world))
        self._position[used] = (T[:, :3, :3] @ points[..., None])[..., 0] + T[:, :3, 3]

    def _of_owners(self, used: IntArray, T_world: Poses) -> FloatArray:
        """Return the poses (L, 4, 4) of the keyframes that own landmarks."""
        owners, which = np.unique(self._owner[used], return_inverse=True)
        return np.array([T_world[k] for k in owners.tolist()])[which]

    def _observations(self, chosen: list[int]) -> tuple[IntArray, IntArray, IntArray]:
        """Return camera (index into chosen), feature and landmark of those seen at least twice."""
        cameras, rows, ids = [], [], []
        for i, k in enumerate(chosen):
            known = np.flatnonzero(self._landmark[k] >= 0)
            cameras.append(np.full(len(known), i, dtype=np.intp))
            rows.append(known)
            ids.append(self._landmark[k][known])
        camera, row, landmark = (np.concatenate(c) for c in (cameras, rows, ids))
        _, which, views = np.unique(landmark, return_inverse=True, return_counts=True)
        often = views[which] >= _fewest(views, self.settings.landmarks)
        return camera[often], row[often], landmark[often]

    def _connected(self, candidates: list[int]) -> list[int]:
        """Leave out keyframes that share too few landmarks with the others."""
        candidates = [k for k in candidates if k in self._landmark]
        while len(candidates) > 1:
            camera, _, _ = self._observations(candidates)
            count = np.bincount(camera, minlength=len(candidates))
            if count.min() >= self.settings.min_shared:
                break
            candidates.pop(int(count.argmin()))
        return candidates

    def _seen_by(self, chosen: list[int]) -> IntArray:
        """Return the landmarks that any of these keyframes sees."""
        ids = np.unique(np.concatenate([self._landmark[k] for k in chosen]))
        return ids[ids >= 0]

    def _make(self, owner: int, positions: FloatArray) -> IntArray:
        """Create landmarks from points (N, 3) in a keyframe's camera frame; return their ids."""
        first, self._count = self._count, self._count + len(positions)
        if self._count > len(self._owner):
            room = max(1024, self._count)
            self._owner = np.concatenate([self._owner, np.empty(room, dtype=np.intp)])
            self._position = np.concatenate([self._position, np.empty((room, 3))])
        self._owner[first : self._count] = owner
        self._position[first : self._count] = positions
        return np.arange(first, self._count)


def _fewest(views: IntArray, landmarks: int) -> int:
    """Return the minimum number of views per landmark that gives about the wanted number."""
    with_views = np.cumsum(np.bincount(views)[::-1])[::-1]
    too_many = np.flatnonzero(with_views[2:] > 2 * landmarks)
    return 2 if not len(too_many) else int(too_many[-1]) + 3
