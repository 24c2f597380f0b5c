"""Finishes that tell one kind of room from the next: panelling, mosaic, perforated sheet, cane.

All rooms of a kind have the same one, in colours of their own. No two pieces of a finish are quite
alike: a regular pattern would match itself everywhere.
"""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.patterns import (
    Colour,
    Generator,
    noise,
    pick,
    plain,
    shift,
    tint,
    wood,
)


def panelling(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw upright tongued boards, each with a grain of its own."""
    grain = np.rot90(wood(rng, width, height, colour, 1.3)).copy()
    left = 0
    while left < width:
        right = left + int(rng.integers(22, 34))
        board = grain[:, left:right]
        board[:] = np.clip(board * rng.uniform(0.85, 1.1), 0, 255)
        cv2.line(grain, (right, 0), (right, height), shift(rng, (56, 42, 30)), 2)
        cv2.line(grain, (right + 2, 0), (right + 2, height), shift(rng, colour, 30), 1)
        left = right
    return grain


def mosaic(rng: Generator, height: int, width: int, colours: tuple[Colour, ...]) -> Image:
    """Draw small square stones of several colours in pale grout."""
    side = 13
    image = plain(height, width, (206, 208, 206))
    for top in range(0, height - 4, side):
        for left in range(0, width - 4, side):
            end = left + side - 3, top + side - 3
            cv2.rectangle(image, (left, top), end, pick(rng, colours, 22), -1)
    return image


def bricks(
    rng: Generator, height: int, width: int, colours: tuple[Colour, ...], flowers: float
) -> Image:
    """Draw glazed tiles laid like bricks; a share of them carries a painted flower."""
    tall, wide = 26, 52
    image = plain(height, width, (122, 112, 100))
    for row, top in enumerate(range(0, height, tall)):
        for left in range(-(row % 2) * wide // 2, width, wide):
            face = pick(rng, colours, 8)
            end = left + wide - 3, top + tall - 3
            cv2.rectangle(image, (left, top), end, face, -1)
            cv2.line(image, (left + 2, top + 2), (end[0] - 2, top + 2), shift(rng, face, 14), 1)
            if rng.random() < flowers:
                _flower(rng, image, ((left + end[0]) // 2, (top + end[1]) // 2))
    return image


def _flower(rng: Generator, image: Image, centre: tuple[int, int]) -> None:
    petal = pick(rng, ((186, 60, 40), (40, 80, 150), (206, 140, 40)))
    start = int(rng.integers(60))
    for angle in range(start, start + 180, 60):
        cv2.ellipse(image, centre, (11, 3), angle, 0, 360, petal, -1, cv2.LINE_AA)
    cv2.circle(image, centre, 3, (240, 214, 90), -1, cv2.LINE_AA)


def perforated(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw a sheet with staggered round holes, some of them stopped."""
    image = tint(colour, 0.06 * noise(rng, height, width, (50, 50)))
    pitch = 15
    hole: Colour = (34, 36, 40)
    for row, y in enumerate(range(8, height - 4, pitch - 2)):
        for x in range(8 + row % 2 * pitch // 2, width - 4, pitch):
            if rng.random() < 0.9:
                radius = int(rng.integers(3, 5))
                cv2.circle(image, (x, y), radius, shift(rng, hole, 16), -1, cv2.LINE_AA)
    return image


def studs(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw a rubber floor with round studs, each lit from one side."""
    image = tint(colour, 0.10 * noise(rng, height, width, (30, 30)))
    pitch = 20
    for y in range(pitch // 2, height, pitch):
        for x in range(pitch // 2, width, pitch):
            raised = shift(rng, colour, 16)
            cv2.circle(image, (x + 1, y + 1), 7, (44, 48, 52), -1, cv2.LINE_AA)
            light = tuple(min(255, c + 56) for c in raised)
            cv2.circle(image, (x - 1, y - 1), 6, light, -1, cv2.LINE_AA)
    return image


def cane(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw a webbing of cane: two slanting layers and an upright one, with gaps between."""
    dark: Colour = (84, 62, 40)
    image = plain(height, width, dark)
    for x in range(-height, width, 17):
        for end in (x + height, x):
            start = x if end != x else x + height
            strand = shift(rng, colour, 18)
            cv2.line(image, (start, 0), (end, height), strand, int(rng.integers(4, 6)), cv2.LINE_AA)
    for y in range(8, height, 17):
        cv2.line(image, (0, y), (width, y), shift(rng, colour, 22), 2, cv2.LINE_AA)
    return image


def louvres(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw a metal sheet with columns of air slots, each with a lip, and rivets between."""
    image = tint(colour, 0.05 * noise(rng, height, width, (40, 40)))
    pitch = width // max(1, width // 34)
    for row, top in enumerate(range(4, height - 9, 13)):
        for left in range(0, width - pitch + 1, pitch):
            dark, light = (
                tuple(int(min(255, f * c)) for c in shift(rng, colour, 10)) for f in (0.3, 1.35)
            )
            if row % 4 == 3:
                cv2.circle(image, (left + pitch // 2, top + 4), 3, light, -1, cv2.LINE_AA)
                continue
            begin, end = left + int(rng.integers(3, 6)), left + pitch - int(rng.integers(4, 7))
            cv2.rectangle(image, (begin, top), (end, top + 3), light, -1)
            cv2.rectangle(image, (begin, top + 3), (end, top + 8), dark, -1)
    return image


def tread(rng: Generator, height: int, width: int, metal: Image) -> Image:
    """Emboss a sheet of metal with lozenges that lie this way and that."""
    image = metal.copy()
    pitch = 19
    for row, y in enumerate(range(pitch // 2, height, pitch)):
        for column, x in enumerate(range(pitch // 2, width, pitch)):
            angle = (45 if (row + column) % 2 else 135) + int(rng.integers(-8, 9))
            dark, light = shift(rng, (92, 96, 102), 14), shift(rng, (226, 230, 234), 14)
            cv2.ellipse(image, (x + 1, y + 2), (9, 3), angle, 0, 360, dark, -1, cv2.LINE_AA)
            cv2.ellipse(image, (x, y), (8, 2), angle, 0, 360, light, -1, cv2.LINE_AA)
    return image


def terrazzo(rng: Generator, height: int, width: int, colour: Colour, slab: int) -> Image:
    """Draw slabs of terrazzo: angular chips of several stones, close together, and joints."""
    image = tint(colour, 0.15 * noise(rng, height, width, (60, 60)))
    palette: tuple[Colour, ...] = ((62, 58, 58), (236, 230, 218), (150, 92, 72), (104, 112, 116))
    for _ in range(height * width // 130):
        around = rng.integers(-6, 7, (5, 2)) * float(rng.uniform(0.4, 1.2))
        chip = cv2.convexHull((around + rng.integers(0, (width, height))).astype(np.int32))
        cv2.fillConvexPoly(image, chip, pick(rng, palette, 20), cv2.LINE_AA)
    for edge in range(0, height, slab):
        cv2.line(image, (0, edge), (width, edge), (85, 82, 80), 2)
    for edge in range(0, width, slab):
        cv2.line(image, (edge, 0), (edge, height), (85, 82, 80), 2)
    return image


def dashes(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw a carpet of squares woven with broken stripes, turned from square to square."""
    image = tint(colour, 0.22 * noise(rng, height, width, (3, 3)))
    side = width // 4
    for top in range(0, height, side):
        for left in range(0, width, side):
            cell = image[top : top + side, left : left + side]
            _weave(rng, cell if rng.random() < 0.5 else cell.transpose(1, 0, 2), colour)
    return image


def _weave(rng: Generator, cell: Image, colour: Colour) -> None:
    height, width = cell.shape[:2]
    for y in range(2, height - 5, 9):
        x = int(rng.integers(0, 12))
        while x < width:
            end = x + int(rng.integers(8, 36))
            cell[y : y + 5, x:end] = np.clip(
                np.array(shift(rng, colour, 12)) * (0.5 if rng.random() < 0.5 else 1.5), 0, 255
            )
            x = end + int(rng.integers(5, 14))
