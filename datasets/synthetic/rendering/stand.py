"""The stand: a place to build at, with the shapes that furniture is put together from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Material, Quad, Surfaces


@dataclass(frozen=True, slots=True)
class Stand:
    """A place to build at, seen from the front: x to the right, y towards the viewer, z up.

    Attributes
    ----------
    surfaces : Surfaces
        Where the quads go.
    origin : (float, float, float)
        The stand's origin in the world.
    facing : float
        Direction of the y axis in the world, radians from the world's x axis.
    """

    surfaces: Surfaces
    origin: tuple[float, float, float]
    facing: float

    @property
    def rng(self) -> np.random.Generator:
        """The builder's random numbers."""
        return self.surfaces.rng

    def world(self, points: Sequence[tuple[float, float, float]] | FloatArray) -> FloatArray:
        """Return points (N, 3) of the stand in the world."""
        c, s = float(np.cos(self.facing)), float(np.sin(self.facing))
        axes = np.array([(-s, c, 0.0), (c, s, 0.0), (0.0, 0.0, 1.0)])
        return np.asarray(np.asarray(points, dtype=np.float64) @ axes + self.origin)

    def at(self, x: float, y: float = 0.0, z: float = 0.0, turn: float = 0.0) -> Stand:
        """Return a stand at a point of this one, turned by `turn` radians to its left."""
        x, y, z = self.world([(x, y, z)])[0]
        return replace(self, origin=(float(x), float(y), float(z)), facing=self.facing - turn)

    def picture(
        self, x: tuple[float, float], z: tuple[float, float], y: float, material: Material
    ) -> None:
        """Hang a picture that faces the viewer, at `y`."""
        self.surfaces.picture(self.world(_front(x, y, z)), material)

    def sheet(
        self, x: tuple[float, float], y: tuple[float, float], z: float, material: Material
    ) -> None:
        """Lay a picture flat at height `z`, its lower edge towards the viewer."""
        self.surfaces.picture(self.world(_top(x, y, z)), material)

    def wall(
        self, x: tuple[float, float], z: tuple[float, float], y: float, material: Material
    ) -> None:
        """Cover an upright rectangle that faces the viewer, at `y`."""
        self.surfaces.cover(self.world(_front(x, y, z)), material)

    def box(
        self,
        x: tuple[float, float],
        y: tuple[float, float],
        z: tuple[float, float],
        material: Material,
        *,
        front: Material | None = None,
        top: Material | None = None,
    ) -> None:
        """Add a box; `front` and `top` are pictures shown whole on those sides."""
        for name, corners in _box_sides(x, y, z).items():
            if name == "bottom" and z[0] < 0.3:
                continue
            special = {"front": front, "top": top}.get(name)
            if special is not None:
                self.surfaces.picture(self.world(corners), special)
            else:
                self.surfaces.cover(self.world(corners), material)
        self.footprint(x, y, z[0])

    def prism(
        self,
        centre: tuple[float, float],
        z: tuple[float, float],
        radius: float | tuple[float, float],
        material: Material,
        *,
        cap: Material | None = None,
    ) -> None:
        """Add an upright eight-sided prism or cone; `radius` at the foot and at the top."""
        foot, head = radius if isinstance(radius, tuple) else (radius, radius)
        angles = np.arange(9) * np.pi / 4 + np.pi / 8
        ring = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(9)])
        low = ring * foot + (*centre, z[0])
        high = ring * head + (*centre, z[1])
        for i in range(8):
            side = self.world(np.array([high[i + 1], high[i], low[i], low[i + 1]]))
            share = ((7 - i) / 8, 0.0, (8 - i) / 8, 1.0)
            self.surfaces.quads.append(Quad(side, material, share))
        for a, b, c, d in ((0, 1, 2, 3), (0, 3, 4, 7), (4, 5, 6, 7)):
            self.surfaces.picture(self.world(high[[a, b, c, d]]), cap or material)
        reach = max(foot, head)
        self.footprint(
            (centre[0] - reach, centre[0] + reach), (centre[1] - reach, centre[1] + reach), z[0]
        )

    def footprint(self, x: tuple[float, float], y: tuple[float, float], z: float = 0.0) -> None:
        """Keep the walk away from a rectangle, if what is there begins below the camera."""
        if self.origin[2] + z < 1.4:
            corners = self.world([(a, b, 0.0) for a in x for b in y])[:, :2]
            self.surfaces.footprints.append(
                np.concatenate([corners.min(axis=0), corners.max(axis=0)])
            )


Span = tuple[float, float]


def _front(x: Span, y: float, z: Span) -> FloatArray:
    return np.array([(x[0], y, z[1]), (x[1], y, z[1]), (x[1], y, z[0]), (x[0], y, z[0])])


def _top(x: Span, y: Span, z: float) -> FloatArray:
    return np.array([(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)])


def _box_sides(x: Span, y: Span, z: Span) -> dict[str, FloatArray]:
    """Return the sides of a box, each clockwise from the top left as seen from outside."""
    (x0, x1), (y0, y1), (z0, z1) = x, y, z
    return {
        "front": _front(x, y1, z),
        "back": np.array([(x1, y0, z1), (x0, y0, z1), (x0, y0, z0), (x1, y0, z0)]),
        "left": np.array([(x0, y0, z1), (x0, y1, z1), (x0, y1, z0), (x0, y0, z0)]),
        "right": np.array([(x1, y1, z1), (x1, y0, z1), (x1, y0, z0), (x1, y1, z0)]),
        "top": _top(x, y, z1),
        "bottom": np.array([(x0, y1, z0), (x1, y1, z0), (x1, y0, z0), (x0, y0, z0)]),
    }
