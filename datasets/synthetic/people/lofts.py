"""Surfaces wrapped round the parts of a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from roomgraph.datasets.synthetic.people.gait import LEGS, PARTS, FloatArray
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad

# How much of a corner moves with which part.
Weights = tuple[tuple[int, float], ...]
# A cross-section: height, how far its middle lies forwards, its half depth (fore and aft), its
# half width; all in metres in the frame of the part it hangs on.
Section = tuple[float, float, float, float]


@dataclass(slots=True)
class Builder:
    """Collects a body's surfaces; `scale` is its size against a person of 1.75 m."""

    joints: FloatArray
    scale: float
    quads: list[Quad] = field(default_factory=list)
    weights: list[FloatArray] = field(default_factory=list)

    def add(
        self,
        corners: FloatArray,
        weights: FloatArray,
        material: Material,
        window: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0),
    ) -> None:
        """Add a quad with corners (4, 3) in the body's frame and weights (4, P)."""
        self.quads.append(Quad(corners, material, window))
        self.weights.append(weights)

    def loft(
        self,
        part: int,
        sections: Sequence[Section],
        material: Material,
        *,
        sides: int = 6,
        weights: Sequence[Weights | None] = (),
        spread: Sequence[float] = (),
        square: float = 1.0,
        arc: tuple[float, float] = (-np.pi, np.pi),
        cap: tuple[bool, bool] = (False, False),
    ) -> None:
        """Wrap the material's image round cross-sections, given from top to bottom.

        `weights` may tell for each section which parts it moves with, if not with `part` alone;
        `spread` how much of it follows the thighs, each its own side. A `square` below 1 makes
        the ovals boxy. `cap` closes the top, the bottom. `arc` is the range of directions, from
        the front to the left, that is covered.
        """
        angles = np.linspace(*arc, sides + 1)
        c, s = (np.sign(v) * np.abs(v) ** square for v in (np.cos(angles), np.sin(angles)))
        rings, masses = list[FloatArray](), list[FloatArray]()
        for k, (z, x, depth, width) in enumerate(sections):
            ring = np.column_stack([x + depth * c, width * s, np.full(sides + 1, z)])
            rings.append(ring * self.scale + self.joints[part])
            mass = mass_of((weights[k] if k < len(weights) else None) or ((part, 1.0),))
            follow = spread[k] if k < len(spread) else 0.0
            masses.append(_follow_thighs(mass, follow, s))
        across = (angles - arc[0]) / (arc[1] - arc[0])
        heights = np.array([section[0] for section in sections])
        down = (heights[0] - heights) / (heights[0] - heights[-1])
        for k in range(len(rings) - 1):
            for i in range(sides):
                corners, mass = (_facet(rows, k, i) for rows in (rings, masses))
                left, right = float(across[i]), float(across[i + 1])
                self.add(corners, mass, material, (left, float(down[k]), right, float(down[k + 1])))
        if cap[0]:
            self._cap(rings[0][::-1], masses[0][::-1], material, (0.0, 0.04))
        if cap[1]:
            self._cap(rings[-1], masses[-1], material, (0.96, 1.0))

    def _cap(
        self, ring: FloatArray, mass: FloatArray, material: Material, rows: tuple[float, float]
    ) -> None:
        """Close a ring, the last point the first, clockwise as seen from outside.

        It shows the rim, `rows`, of the image: the colour of the surface that ends here.
        """
        count = len(ring) - 1
        for i in range(1, count - 1, 2):
            pick = [0, i, i + 1, min(i + 2, count)]
            self.add(ring[pick], mass[pick], material, (0.0, rows[0], 0.2, rows[1]))


def _facet(rows: Sequence[FloatArray], k: int, i: int) -> FloatArray:
    """Return what belongs to the corners of a quad between two rings, clockwise."""
    return np.array([rows[k][i], rows[k][i + 1], rows[k + 1][i + 1], rows[k + 1][i]])


def mass_of(weights: Weights) -> FloatArray:
    """Return weights for all parts (P,)."""
    mass = np.zeros(len(PARTS))
    for part, weight in weights:
        mass[part] = weight
    return mass


def _follow_thighs(mass: FloatArray, share: float, sideways: FloatArray) -> FloatArray:
    """Return weights (N, P) of a ring: `share` of it goes with the thigh of its side."""
    result = np.tile(mass * (1 - share), (len(sideways), 1))
    left = 0.5 + 0.5 * sideways
    result[:, LEGS[0][0]] += share * left
    result[:, LEGS[1][0]] += share * (1 - left)
    return result
