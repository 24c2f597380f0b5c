"""What the units of one kitchen are made of, and their fronts."""

from __future__ import annotations

from dataclasses import dataclass

import cv2

from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.textures import finishes, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, Generator

TOPS: tuple[Colour, ...] = ((120, 112, 106), (60, 60, 64), (214, 208, 200), (166, 150, 130))
TILES: tuple[Colour, ...] = ((240, 238, 228), (206, 222, 226), (244, 226, 190), (150, 176, 160))


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """What one kitchen's units are made of; `panelled` doors are framed, `handle` is its kind."""

    body: Material
    face: Image
    panelled: bool
    handle: int
    top: Material
    splash: Material


def draw_fit(rng: Generator, look: Look) -> Fit:
    """Draw what the units of a kitchen are made of."""
    if rng.random() < 0.35:
        face = patterns.wood(rng, 220, 220, look.wood, 0.8)
    else:
        face = patterns.plaster(rng, 220, 220, look.front)
    if rng.random() < 0.4:
        top = Material(patterns.wood(rng, 190, 420, (176, 124, 74), 0.9), 2.5, 1.1)
    else:
        top = Material(patterns.stone(rng, 190, 420, patterns.pick(rng, TOPS), 1000), 2.5, 1.1)
    glaze = patterns.pick(rng, TILES)
    kinds = (
        finishes.bricks(rng, 120, 440, (glaze,), float(rng.choice([0.0, 0.3]))),
        patterns.tiles(rng, (120, 440), (30, 30), (glaze,), (190, 188, 182), 0.15),
        finishes.mosaic(rng, 120, 440, (glaze, patterns.shift(rng, glaze, 60))),
    )
    splash = Material(kinds[int(rng.integers(3))], 2.2, 0.6)
    body = Material(face, 1.0, 1.0)
    return Fit(body, face, bool(rng.random() < 0.5), int(rng.integers(4)), top, splash)


def unit_front(rng: Generator, fit: Fit, rows: int, *, hung: bool = False) -> Material:
    """Draw the front of a unit: a door (one row) or drawers, with handles."""
    image = fit.face[:200, :150].copy()
    left = bool(rng.random() < 0.5)
    for i in range(rows):
        top, low = i * 200 // rows, (i + 1) * 200 // rows - 1
        cv2.rectangle(image, (0, top), (149, low), (52, 46, 42), 2)
        if fit.panelled:
            cv2.rectangle(image, (20, top + 16), (130, low - 16), (84, 78, 70), 2)
            cv2.rectangle(image, (23, top + 19), (132, low - 14), (236, 234, 228), 1)
        x, y = (12 if left else 136), (low - 40 if hung else top + 40)
        if rows > 1 or fit.handle == 2:
            x, y = 75, (low - 10 if hung else top + 12)
            ends = (45, y), (105, y)
        else:
            ends = (x, y - 26), (x, y + 26)
        if fit.handle == 3:
            edge = low - 4 if hung else top + 4
            cv2.rectangle(image, (2, edge - 3), (147, edge + 3), (36, 34, 34), -1)
        elif fit.handle == 1:
            cv2.circle(image, (x + 1, y + 3), 6, (60, 54, 48), -1, cv2.LINE_AA)
            cv2.circle(image, (x, y), 5, (206, 206, 204), -1, cv2.LINE_AA)
        else:
            (x0, y0), (x1, y1) = ends
            cv2.line(image, (x0 + 2, y0 + 3), (x1 + 2, y1 + 3), (66, 60, 54), 4)
            cv2.line(image, (x0, y0), (x1, y1), (206, 208, 210), 4)
    return Material(image)
