"""Surfaces: textured quadrilaterals, the things they make up, and lamps."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Image = NDArray[np.uint8]
# How strongly a surface shines by itself: as if lit by windows, by lamps, by evening lamps, by
# the sky's ambient light. See `lighting`.
Glow = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Material:
    """An image with the size, in metres, that it covers when it is laid out.

    `shiny` surfaces (steel, mirrors, glass) give a depth camera no reading.
    """

    image: Image
    width_m: float = 1.0
    height_m: float = 1.0
    shiny: bool = False
    glow: Glow | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Quad:
    """A four-sided surface that shows a part of a material's image.

    Attributes
    ----------
    corners : (4, 3) float64
        Clockwise from the top left as seen from outside, metres.
    material : Material
        What it is made of.
    window : (float, float, float, float)
        The part of the image to be seen: left, top, right, bottom, each 0 to 1.
    """

    corners: FloatArray
    material: Material
    window: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Thing:
    """An object that a person would name: its class, and which quads and footprints are its own.

    Things may lie in each other: a keyboard belongs to its desk, too.
    """

    name: str
    quads: slice
    footprints: slice


@dataclass(frozen=True, slots=True)
class Lamp:
    """A source of light at `position`, shining towards `direction`, in one channel.

    See `lighting` for the channels.
    """

    position: tuple[float, float, float]
    direction: tuple[float, float, float]
    power: float
    channel: int


@dataclass(slots=True)
class Surfaces:
    """A growing list of quads, with the things they make up, their footprints and their lamps."""

    rng: np.random.Generator
    quads: list[Quad] = field(default_factory=list, repr=False)
    footprints: list[FloatArray] = field(default_factory=list, repr=False)
    things: list[Thing] = field(default_factory=list, repr=False)
    lamps: list[Lamp] = field(default_factory=list, repr=False)

    @contextmanager
    def thing(self, name: str) -> Iterator[None]:
        """Make one thing of a class out of all that is added inside the block."""
        quads, footprints = len(self.quads), len(self.footprints)
        yield
        made = slice(quads, len(self.quads)), slice(footprints, len(self.footprints))
        self.things.append(Thing(name, *made))

    def picture(self, corners: FloatArray, material: Material) -> None:
        """Add a quad that shows the material's whole image."""
        self.quads.append(Quad(corners, material))

    def cover(self, corners: FloatArray, material: Material) -> None:
        """Lay a parallelogram out with a material of fixed size, in as many pieces as needed."""
        right, down = corners[1] - corners[0], corners[3] - corners[0]
        columns = _pieces(float(np.linalg.norm(right)), material.width_m)
        rows = _pieces(float(np.linalg.norm(down)), material.height_m)
        for x0, x1, left, share_x in self._windows(columns):
            for y0, y1, top, share_y in self._windows(rows):
                at = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
                piece = np.array([corners[0] + x * right + y * down for x, y in at])
                window = (left, top, left + share_x, top + share_y)
                self.quads.append(Quad(piece, material, window))

    def _windows(
        self, pieces: list[tuple[float, float, float]]
    ) -> list[tuple[float, float, float, float]]:
        """Start at a random place of the image when a single piece leaves room for it."""
        if len(pieces) > 1:
            return [(a, b, 0.0, share) for a, b, share in pieces]
        a, b, share = pieces[0]
        return [(a, b, float(self.rng.uniform(0, 1 - share)), share)]


def _pieces(length: float, size: float) -> list[tuple[float, float, float]]:
    """Cut a length into pieces of at most `size`: begin, end (0 to 1), share of the image."""
    count = max(1, int(np.ceil(length / size - 1e-6)))
    edges = np.minimum(np.arange(count + 1) * size / max(length, 1e-9), 1.0)
    return [
        (float(a), float(b), min(1.0, float((b - a) * length / size))) for a, b in pairwise(edges)
    ]
