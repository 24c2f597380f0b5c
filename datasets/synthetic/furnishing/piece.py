"""A piece of furniture, built once and set down anywhere."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roomgraph.datasets.synthetic.objects.catalogue import build_model
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Quad, Surfaces, Thing
from roomgraph.datasets.synthetic.rendering.stand import Stand

# How a piece is built: its stand's axes are then the world's, x mirrored.
FACING = np.pi / 2


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A piece of furniture at the origin, its front towards y.

    Attributes
    ----------
    model : str
        What it was built by.
    surfaces : Surfaces
        Its quads, things, footprints and lamps.
    low, high : (3,) float64
        Its bounds in its own frame (x to the right as seen from the front), metres.
    """

    model: str
    surfaces: Surfaces
    low: FloatArray
    high: FloatArray

    @property
    def width(self) -> float:
        """How wide it is, metres."""
        return float(self.high[0] - self.low[0])


def make_piece(model: str, rng: np.random.Generator, look: Look, **options: float | int) -> Piece:
    """Build a piece by the name of its model."""
    surfaces = Surfaces(rng)
    build_model(model, Stand(surfaces, (0.0, 0.0, 0.0), FACING), look, **options)
    points = np.concatenate([quad.corners for quad in surfaces.quads])
    own = points * (-1, 1, 1)
    return Piece(model, surfaces, own.min(axis=0), own.max(axis=0))


def outline(piece: Piece, stand: Stand, margin: float = 0.0) -> FloatArray:
    """Return the corners (4, 2) of a piece's bounds on the floor when set down at a stand."""
    (x0, y0, _), (x1, y1, _) = piece.low - margin, piece.high + margin
    return stand.world([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)])[:, :2]


def solid_outlines(piece: Piece, stand: Stand) -> list[FloatArray]:
    """Return the rectangles (4, 2) on the floor that a piece takes when set down at a stand."""
    found = []
    for x0, y0, x1, y1 in piece.surfaces.footprints:
        corners = [(-x0, y0, 0), (-x1, y0, 0), (-x1, y1, 0), (-x0, y1, 0)]
        found.append(stand.world(corners)[:, :2])
    return found


def set_down(piece: Piece, stand: Stand) -> None:
    """Add a piece's quads, things and lamps where a stand is."""
    target, source = stand.surfaces, piece.surfaces
    offset = len(target.quads)
    for quad in source.quads:
        target.quads.append(Quad(_moved(quad.corners, stand), quad.material, quad.window))
    for thing in source.things:
        quads = slice(thing.quads.start + offset, thing.quads.stop + offset)
        target.things.append(Thing(thing.name, quads, slice(0, 0)))
    for lamp in source.lamps:
        position = _moved(np.array([lamp.position]), stand)[0]
        tip = _moved(np.array([lamp.position]) + np.array([lamp.direction]), stand)[0]
        target.lamps.append(
            replace(lamp, position=_triple(position), direction=_triple(tip - position))
        )


def _moved(points: FloatArray, stand: Stand) -> FloatArray:
    return stand.world(points * (-1, 1, 1))


def _triple(point: FloatArray) -> tuple[float, float, float]:
    return float(point[0]), float(point[1]), float(point[2])
