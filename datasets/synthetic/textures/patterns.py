"""Images of materials: wood, carpet, tiles, plaster, stone, steel, cloth."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.rendering.mesh import Image

Colour = tuple[int, int, int]
Plane = NDArray[np.float32]
Generator = np.random.Generator


def plain(height: int, width: int, colour: Colour) -> Image:
    """Return an image of one colour."""
    return np.full((height, width, 3), colour, dtype=np.uint8)


def noise(rng: Generator, height: int, width: int, cell: tuple[float, float]) -> Plane:
    """Return smooth noise (height, width) in about -0.5 to 0.5 with cells of a size in pixels."""
    rows, columns = (max(2, int(n / c) + 2) for n, c in zip((height, width), cell, strict=True))
    coarse = rng.random((rows, columns), dtype=np.float32) - 0.5
    fine = cv2.resize(coarse, (width, height), interpolation=cv2.INTER_LINEAR)
    return np.asarray(fine, dtype=np.float32)


def grain(rng: Generator, height: int, width: int) -> Plane:
    """Return white noise (height, width) in -0.5 to 0.5."""
    return rng.random((height, width), dtype=np.float32) - np.float32(0.5)


def tint(colour: Colour, value: Plane) -> Image:
    """Return `colour` made lighter or darker by the relative `value` (H, W)."""
    image = cv2.merge([value * np.float32(c) + np.float32(c) for c in colour])
    return np.asarray(cv2.convertScaleAbs(cv2.max(image, 0.0)), dtype=np.uint8)


def shift(rng: Generator, colour: Colour, amount: int = 12) -> Colour:
    """Return a colour near another."""
    r, g, b = np.clip(np.array(colour) + rng.integers(-amount, amount + 1, 3), 0, 255)
    return int(r), int(g), int(b)


def pick(rng: Generator, colours: tuple[Colour, ...], amount: int = 10) -> Colour:
    """Return one of several colours, a little changed."""
    return shift(rng, colours[int(rng.integers(len(colours)))], amount)


def plaster(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Painted plaster: almost nothing to see."""
    value = 0.012 * grain(rng, height, width) + 0.035 * noise(rng, height, width, (70, 70))
    return tint(colour, value)


def wood(rng: Generator, height: int, width: int, colour: Colour, contrast: float = 1.0) -> Image:
    """Wood with the grain along the width."""
    warp = noise(rng, height, width, (height / 4, width / 3)) * 5
    rows = np.linspace(0, height / 22, height, dtype=np.float32)[:, None]
    rings = np.sin((rows + warp) * 6.28)
    value = 0.05 * rings + 0.22 * noise(rng, height, width, (2.5, 60))
    value += 0.12 * noise(rng, height, width, (9, 140)) + 0.03 * grain(rng, height, width)
    for _ in range(int(height * width / 60000)):
        centre = int(rng.integers(width)), int(rng.integers(height))
        knot = np.zeros((height, width), dtype=np.float32)
        cv2.ellipse(knot, centre, (9, 5), 0, 0, 360, 1.0, -1)
        value -= 0.35 * cv2.GaussianBlur(knot, (9, 9), 2)
    return tint(colour, contrast * value)


def tiles(
    rng: Generator,
    shape: tuple[int, int],
    side: tuple[int, int],
    colours: tuple[Colour, ...],
    grout: Colour,
    pattern: float = 0.0,
) -> Image:
    """Tiles of `side` (height, width) pixels; a share `pattern` of them carries an ornament."""
    height, width = shape
    image = plain(height, width, grout)
    kind, light = int(rng.integers(0, 3)), pick(rng, colours, 60)
    dark = pick(rng, ((60, 90, 140), (150, 80, 50)))
    for top in range(0, height, side[0]):
        for left in range(0, width, side[1]):
            bottom, right = min(top + side[0], height) - 1, min(left + side[1], width) - 1
            if min(bottom - top, right - left) < 2:
                continue
            colour = pick(rng, colours, 4)
            face = tint(colour, 0.08 * noise(rng, bottom - top, right - left, (12, 12)))
            image[top + 1 : bottom + 1, left + 1 : right + 1] = face
            if rng.random() < pattern:
                _ornament(image, (left, top, right, bottom), kind, light, dark)
    return image


def _ornament(
    image: Image, box: tuple[int, int, int, int], kind: int, light: Colour, dark: Colour
) -> None:
    left, top, right, bottom = box
    centre = (left + right + 1) // 2, (top + bottom + 1) // 2
    reach = max(3, min(right - left, bottom - top) // 2 - 3)
    if kind == 0:
        for angle in range(0, 180, 45):
            cv2.ellipse(image, centre, (reach, reach // 3), angle, 0, 360, dark, 1, cv2.LINE_AA)
        cv2.circle(image, centre, reach // 3, light, -1, cv2.LINE_AA)
    elif kind == 1:
        corners = np.array([(0, -reach), (reach, 0), (0, reach), (-reach, 0)]) + centre
        cv2.fillPoly(image, [corners.astype(np.int32)], dark, cv2.LINE_AA)
        cv2.circle(image, centre, reach // 2, light, -1, cv2.LINE_AA)
    else:
        cv2.circle(image, centre, reach, dark, 2, cv2.LINE_AA)
        for x, y in ((left, top), (right, top), (left, bottom), (right, bottom)):
            cv2.circle(image, (x, y), reach // 2, dark, -1, cv2.LINE_AA)


def linoleum(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Linoleum: flecks and clouds of nearby colours."""
    value = 0.10 * noise(rng, height, width, (40, 40)) + 0.10 * noise(rng, height, width, (4, 4))
    image = tint(colour, value)
    for _ in range(height * width // 700):
        centre = int(rng.integers(width)), int(rng.integers(height))
        axes = int(rng.integers(2, 7)), int(rng.integers(1, 3))
        fleck = shift(rng, colour, 38)
        cv2.ellipse(image, centre, axes, float(rng.uniform(0, 180)), 0, 360, fleck, -1, cv2.LINE_AA)
    return image


def stone(rng: Generator, height: int, width: int, colour: Colour, slab: int) -> Image:
    """Polished stone in slabs: chips of many sizes, veins and narrow joints."""
    value = 0.25 * noise(rng, height, width, (60, 60)) + 0.10 * grain(rng, height, width)
    image = tint(colour, value)
    palette = (shift(rng, colour, 70), shift(rng, colour, 70), (70, 66, 64), (225, 220, 210))
    for _ in range(height * width // 450):
        points = rng.integers(-7, 8, (5, 2)) * float(rng.uniform(0.3, 1.2)) + rng.integers(
            0, (width, height)
        )
        chip = cv2.convexHull(points.astype(np.int32))
        cv2.fillConvexPoly(image, chip, pick(rng, palette), cv2.LINE_AA)
    for edge in range(0, height, slab):
        cv2.line(image, (0, edge), (width, edge), (85, 82, 80), 2)
    for edge in range(0, width, slab):
        cv2.line(image, (edge, 0), (edge, height), (85, 82, 80), 2)
    return image


def steel(rng: Generator, height: int, width: int, colour: Colour = (176, 180, 184)) -> Image:
    """Brushed steel, brushed upright, with soft reflections."""
    value = 0.10 * noise(rng, height, width, (90, 1.5)) + 0.22 * noise(
        rng, height, width, (height, width / 3)
    )
    return tint(colour, value)


def cloth(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Woven cloth."""
    weave = np.zeros((height, width), dtype=np.float32)
    weave[::3] += 0.10
    weave[:, ::3] -= 0.10
    return tint(colour, weave + 0.2 * noise(rng, height, width, (3, 3)))


def ceiling(rng: Generator, side: int) -> Image:
    """One square panel of a suspended ceiling, with its pinholes and rim."""
    image = tint((232, 232, 228), 0.03 * grain(rng, side, side))
    for _ in range(side * side // 160):
        cv2.circle(
            image, (int(rng.integers(side)), int(rng.integers(side))), 1, (196, 196, 192), -1
        )
    cv2.rectangle(image, (0, 0), (side - 1, side - 1), (205, 205, 203), 2)
    return image
