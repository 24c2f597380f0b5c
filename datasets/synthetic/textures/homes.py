"""What homes are papered, floored and closed with: wallpapers, planks, parquet, panelled doors."""

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
    plaster,
    shift,
    tint,
    wood,
)


def _lit(rng: Generator, colour: Colour, amount: float) -> Colour:
    """Return a colour a little lighter or darker, its hue kept."""
    factor = 1 + float(rng.uniform(-amount, amount))
    red, green, blue = (int(min(255, factor * c)) for c in colour)
    return red, green, blue


def striped_paper(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw wallpaper with upright stripes of two or three widths."""
    image = plaster(rng, height, width, colour)
    other, line = shift(rng, colour, 26), shift(rng, colour, 60)
    period = int(rng.integers(24, 70))
    for x in range(0, width, period):
        image[:, x : x + period // 2] = plaster(rng, height, min(period // 2, width - x), other)
        image[:, x : x + 2] = line
    return image


def printed_paper(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw wallpaper with a printed motif: leaves, rings or lozenges in staggered rows."""
    image = plaster(rng, height, width, colour)
    ink, second = shift(rng, colour, 55), shift(rng, colour, 55)
    pitch, kind = int(rng.integers(34, 64)), int(rng.integers(3))
    for row, y in enumerate(range(0, height + pitch, pitch)):
        for x in range(row % 2 * pitch // 2, width + pitch, pitch):
            _motif(image, (x, y), pitch // 3, kind, (ink, second))
    return image


def _motif(
    image: Image, at: tuple[int, int], size: int, kind: int, inks: tuple[Colour, Colour]
) -> None:
    if kind == 0:
        for angle in (30, 90, 150):
            cv2.ellipse(image, at, (size, size // 4), angle, 0, 360, inks[0], -1, cv2.LINE_AA)
        cv2.circle(image, at, size // 4, inks[1], -1, cv2.LINE_AA)
    elif kind == 1:
        cv2.circle(image, at, size, inks[0], 2, cv2.LINE_AA)
        cv2.circle(image, at, size // 2, inks[1], -1, cv2.LINE_AA)
    else:
        corners = np.array([(0, -size), (size // 2, 0), (0, size), (-size // 2, 0)]) + at
        cv2.fillPoly(image, [corners.astype(np.int32)], inks[0], cv2.LINE_AA)


def planks(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw floor boards of uneven length, side by side."""
    image = plain(height, width, colour)
    board = int(rng.integers(22, 40))
    for top in range(0, height, board):
        left = -int(rng.integers(0, 200))
        while left < width:
            right = left + int(rng.integers(180, 420))
            a, b = max(0, left), min(width, right)
            rows = min(board, height - top)
            if b > a:
                tone = _lit(rng, colour, 0.13)
                image[top : top + rows, a:b] = wood(rng, rows, b - a, tone, 0.6)
                image[top : top + rows, b - 1 : b] = [int(0.55 * c) for c in colour]
            left = right
        image[top : top + 1] = [int(0.55 * c) for c in colour]
    return image


def herringbone(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw parquet laid in a herringbone."""
    image = plain(height, width, colour)
    across, long = 16, 64
    step = across * 2
    for row in range(-2, height // across + 3):
        for column in range(-2, width // step + 3):
            x, y = column * step, row * across
            shade = _lit(rng, colour, 0.16)
            lean = 1 if column % 2 else -1
            corners = np.array(
                [(0, 0), (step, lean * step), (step, lean * step + across), (0, across)]
            )
            place = np.add(corners, (x, y)).astype(np.int32)
            cv2.fillPoly(image, [place], shade, cv2.LINE_AA)
            cv2.polylines(image, [place], True, tuple(int(0.6 * c) for c in shade), 1, cv2.LINE_AA)
    value = 0.10 * noise(rng, height, width, (3, long))
    return np.asarray(np.clip(image * (1 + value[..., None]), 0, 255), dtype=np.uint8)


def bare_bricks(rng: Generator, height: int, width: int) -> Image:
    """Draw a wall of bare or whitewashed bricks."""
    colour = pick(rng, ((160, 86, 66), (196, 190, 182), (140, 110, 90)))
    image = tint((190, 184, 176), 0.1 * noise(rng, height, width, (6, 6)))
    tall, wide = 20, 58
    for row, top in enumerate(range(0, height, tall)):
        for left in range(-(row % 2) * wide // 2, width, wide):
            face = _lit(rng, colour, 0.15)
            cv2.rectangle(image, (left + 2, top + 2), (left + wide - 3, top + tall - 3), face, -1)
    value = 0.12 * noise(rng, height, width, (4, 5))
    return np.asarray(np.clip(image * (1 + value[..., None]), 0, 255), dtype=np.uint8)


def panelled_door(rng: Generator, face: Image) -> Image:
    """Draw a leaf with two to six sunk panels and a plate for the handle."""
    image = face.copy()
    height, width = image.shape[:2]
    rows, columns = int(rng.integers(1, 4)), int(rng.integers(1, 3))
    edge = width // 8
    for row in range(rows):
        for column in range(columns):
            left = edge + column * (width - edge) // columns
            right = (column + 1) * (width - edge) // columns
            top = edge + row * (height - edge) // rows
            bottom = (row + 1) * (height - edge) // rows
            inner = image[top:bottom, left:right]
            inner[:] = np.clip(inner * 0.93, 0, 255)
            dark = tuple(int(v) for v in 0.7 * inner.mean(axis=(0, 1)))
            cv2.rectangle(image, (left, top), (right, bottom), dark, 3)
    at = int(0.9 * width), int(0.5 * height)
    cv2.rectangle(image, (at[0] - 5, at[1] - 20), (at[0] + 5, at[1] + 24), (180, 176, 160), -1)
    return image
