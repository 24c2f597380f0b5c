"""Parts of a building that move: what the renderer asks of them, and stiff ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from roomgraph.datasets.se3 import pose, transform
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Quad


class Body(Protocol):
    """Something that moves: a door, an elevator's cabin, a person."""

    @property
    def quads(self) -> Sequence[Quad]:
        """Its surfaces at rest: light is computed for them there."""

    @property
    def radius_m(self) -> float:
        """How far its points are from its centre at most."""

    def is_there(self, stamp_s: float) -> bool:
        """Whether it is in the building at a time."""

    def centre(self, stamp_s: float) -> FloatArray:
        """Its middle (3,) at a time."""

    def corners(self, stamp_s: float) -> FloatArray:
        """Its quads' corners (N, 4, 3) at a time."""


@dataclass(frozen=True, slots=True, eq=False)
class Stiff:
    """A body that keeps its form.

    Attributes
    ----------
    quads : sequence of Quad
        Its surfaces at rest, in the world.
    motion : callable
        Returns the motion (4, 4) from rest to where it is at a time, seconds.
    radius_m : float
        How far its points are from its centre at most.
    """

    quads: Sequence[Quad]
    motion: Callable[[float], FloatArray]
    radius_m: float = field(init=False)
    _points: FloatArray = field(init=False)
    _middle: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        points = np.concatenate([quad.corners for quad in self.quads])
        middle = points.mean(axis=0)
        radius_m = float(np.linalg.norm(points - middle, axis=1).max())
        for name, value in (("_points", points), ("_middle", middle), ("radius_m", radius_m)):
            object.__setattr__(self, name, value)

    def is_there(self, stamp_s: float) -> bool:
        """Whether it is in the building at a time: always."""
        return True

    def centre(self, stamp_s: float) -> FloatArray:
        """Its middle (3,) at a time."""
        return np.asarray(transform(self.motion(stamp_s), self._middle[None])[0])

    def corners(self, stamp_s: float) -> FloatArray:
        """Its quads' corners (N, 4, 3) at a time."""
        return transform(self.motion(stamp_s), self._points).reshape(-1, 4, 3)


def shifted(offset: FloatArray) -> FloatArray:
    """Return the motion (4, 4) by an offset (3,)."""
    return pose(t=offset)


def turned(about: tuple[float, float], angle: float) -> FloatArray:
    """Return the turn (4, 4) about an upright axis through a point, counter-clockwise, radians."""
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([(c, -s, 0), (s, c, 0), (0, 0, 1.0)])
    axis = np.array([*about, 0.0])
    return pose(R, axis - R @ axis)


def smooth(stamp_s: float, begin_s: float, end_s: float) -> float:
    """Rise smoothly from 0 at `begin_s` to 1 at `end_s`."""
    share = float(np.clip((stamp_s - begin_s) / max(end_s - begin_s, 1e-9), 0, 1))
    return share * share * (3 - 2 * share)
