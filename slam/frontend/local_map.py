"""The points around the camera, from several keyframes at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.features.extraction import Features

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LocalMap:
    """Points of a reference keyframe and its neighbours, in the reference's camera frame.

    Attributes
    ----------
    reference : int
        Id of the reference keyframe.
    points : (N, 3) float64
        Metres.
    descriptors : (N, D)
        One a point.
    owners : (N,) int
        Ids of the keyframes that they come from.
    rows : (N,) int
        Which feature of its owner each is.
    """

    reference: int
    points: FloatArray
    descriptors: NDArray[Any]
    owners: NDArray[np.intp]
    rows: NDArray[np.intp]

    def visible(
        self, T_camera_reference: FloatArray, intrinsics: Intrinsics, margin: float
    ) -> tuple[NDArray[np.intp], FloatArray]:
        """Return which points (M,) a camera would see, and at which pixels (M, 2).

        `margin` pixels outside the image still count.
        """
        points = se3.transform(T_camera_reference, self.points)
        ahead = np.flatnonzero(points[:, 2] > 0.1)
        pixels = intrinsics.project(points[ahead])
        inside = np.all(
            (pixels > -margin) & (pixels < (intrinsics.width + margin, intrinsics.height + margin)),
            axis=1,
        )
        return ahead[inside], pixels[inside]


class Described(Protocol):
    """A keyframe in a local map: done, in progress, or of an earlier run."""

    @property
    def id(self) -> int:
        """Id of the keyframe."""

    @property
    def features(self) -> Features:
        """Its N features."""

    @property
    def points(self) -> FloatArray:
        """Points of the features in its camera frame (N, 3), metres; NaN without depth."""


def local_map(keyframes: Sequence[tuple[Described, FloatArray]]) -> LocalMap:
    """Join keyframes, given with T_world_keyframe (4, 4); the first is the reference."""
    reference, T_world_reference = keyframes[0]
    T_reference_world = se3.inverse(T_world_reference)
    points, descriptors, owners, rows = [], [], [], []
    for keyframe, T_world_keyframe in keyframes:
        known = np.flatnonzero(np.isfinite(keyframe.points[:, 2]))
        points.append(se3.transform(T_reference_world @ T_world_keyframe, keyframe.points[known]))
        descriptors.append(keyframe.features.descriptors[known])
        owners.append(np.full(len(known), keyframe.id))
        rows.append(known)
    return LocalMap(
        reference.id, np.concatenate(points), np.concatenate(descriptors),
        np.concatenate(owners), np.concatenate(rows),
    )  # fmt: skip


def covisible(
    reference: int, linked: Iterable[int], T_world: Mapping[int, FloatArray], count: int
) -> list[int]:
    """Return a keyframe and its `count` most covisible neighbours."""
    T_reference_world = se3.inverse(T_world[reference])
    ranked = []
    for other in linked:
        T = T_reference_world @ T_world[other]
        ranked.append((np.linalg.norm(T[:3, 3]) + 2 * se3.rotation_angle(T), other))
    return [reference, *(k for _, k in sorted(ranked)[:count])]
