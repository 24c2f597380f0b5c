"""Instruments: scopes, meters, knobs, racks of modules with cables."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.ink import VIVID, word, write
from roomgraph.datasets.synthetic.textures.patterns import Colour, Generator, pick, plain, shift

CASES: tuple[Colour, ...] = ((196, 200, 196), (214, 206, 184), (70, 84, 96), (150, 170, 176))


def instrument(rng: Generator, height: int, width: int) -> Image:
    """Draw an instrument's front: a scope screen or a meter, knobs, sockets, lamps, lettering."""
    case = pick(rng, CASES)
    ink: Colour = (240, 240, 240) if sum(case) < 380 else (40, 40, 44)
    image = plain(height, width, case)
    cv2.rectangle(image, (2, 2), (width - 3, height - 3), shift(rng, (110, 112, 114)), 2)
    split = int(rng.uniform(0.4, 0.55) * width)
    box = 9, 9, split, int(0.72 * height)
    (_scope if rng.random() < 0.6 else _meter)(rng, image, box)
    write(
        image,
        f"{word(rng)} {int(rng.integers(10, 99))}".upper(),
        (9, box[3] + 4, split, height - 5),
        ink,
    )
    step = max(16, height // 4)
    for y in range(step // 2 + 4, height - step // 3, step):
        for x in range(split + step // 2 + 3, width - step // 3, step):
            _control(rng, image, (x, y), step // 3, ink)
    return image


def _scope(rng: Generator, image: Image, box: tuple[int, int, int, int]) -> None:
    left, top, right, bottom = box
    cv2.rectangle(image, (left, top), (right, bottom), (16, 40, 34), -1)
    for x in np.linspace(left, right, 9).astype(int):
        cv2.line(image, (int(x), top), (int(x), bottom), (50, 92, 80), 1)
    for y in np.linspace(top, bottom, 7).astype(int):
        cv2.line(image, (left, int(y)), (right, int(y)), (50, 92, 80), 1)
    x = np.linspace(left + 1, right - 1, 60)
    for colour in ((120, 255, 140), (255, 230, 90)):
        wave = np.sin(np.linspace(0, rng.uniform(8, 30), 60) + rng.uniform(0, 6))
        y = (top + bottom) / 2 + wave * (bottom - top) * rng.uniform(0.12, 0.4)
        curve = np.column_stack([x, y]).astype(np.int32)
        cv2.polylines(image, [curve], False, colour, 1, cv2.LINE_AA)


def _meter(rng: Generator, image: Image, box: tuple[int, int, int, int]) -> None:
    left, top, right, bottom = box
    cv2.rectangle(image, (left, top), (right, bottom), (246, 244, 232), -1)
    cv2.rectangle(image, (left, top), (right, bottom), (30, 30, 32), 2)
    pivot, reach = (
        ((left + right) // 2, bottom - 4),
        int(0.8 * min(bottom - top, (right - left) / 1.6)),
    )
    for angle in range(200, 345, 12):
        a = np.deg2rad(angle)
        inner = (pivot[0] + 0.85 * reach * np.cos(a), pivot[1] + 0.85 * reach * np.sin(a))
        outer = (pivot[0] + reach * np.cos(a), pivot[1] + reach * np.sin(a))
        cv2.line(
            image, (int(inner[0]), int(inner[1])), (int(outer[0]), int(outer[1])), (20, 20, 20), 2
        )
    a = np.deg2rad(rng.uniform(205, 335))
    tip = int(pivot[0] + reach * np.cos(a)), int(pivot[1] + reach * np.sin(a))
    cv2.line(image, pivot, tip, (200, 30, 30), 2, cv2.LINE_AA)


def _control(rng: Generator, image: Image, at: tuple[int, int], size: int, ink: Colour) -> None:
    kind = int(rng.integers(4))
    if kind == 0:
        cv2.circle(image, at, size, (34, 34, 38), -1, cv2.LINE_AA)
        a = rng.uniform(0, 6.28)
        tip = int(at[0] + size * np.cos(a)), int(at[1] + size * np.sin(a))
        cv2.line(image, at, tip, (244, 244, 244), 2, cv2.LINE_AA)
    elif kind == 1:
        cv2.circle(image, at, size - 1, (180, 180, 184), -1, cv2.LINE_AA)
        cv2.circle(image, at, size // 2, (20, 20, 22), -1, cv2.LINE_AA)
    elif kind == 2:
        cv2.rectangle(
            image,
            (at[0] - size, at[1] - size // 2),
            (at[0] + size, at[1] + size // 2),
            pick(rng, VIVID),
            -1,
        )
    else:
        lamp = pick(rng, ((240, 60, 50), (70, 230, 90), (250, 200, 60)))
        cv2.circle(image, at, max(3, size // 2), lamp, -1, cv2.LINE_AA)
        cv2.circle(image, at, max(3, size // 2), ink, 1, cv2.LINE_AA)


def rack(rng: Generator, height: int, width: int) -> Image:
    """Draw a rack of modules: rails, screws, slots, lamps and cables."""
    image = plain(height, width, (38, 40, 44))
    y = 6
    while y < height - 20:
        tall = min(int(rng.integers(24, 62)), height - y - 4)
        face = pick(rng, ((60, 64, 70), (170, 174, 178), (30, 44, 70), (196, 190, 170)))
        cv2.rectangle(image, (14, y), (width - 15, y + tall), face, -1)
        if rng.random() < 0.5:
            panel = instrument(rng, max(tall - 4, 24), width - 34)[: tall - 3]
            image[y + 2 : y + 2 + panel.shape[0], 17 : 17 + panel.shape[1]] = panel
        else:
            for x in range(24, width - 26, 13):
                cv2.rectangle(image, (x, y + 7), (x + 8, y + tall - 7), (20, 20, 22), -1)
                cv2.circle(image, (x + 4, y + 4), 2, pick(rng, ((80, 250, 90), (250, 180, 40))), -1)
        for x in (7, width - 8):
            cv2.circle(image, (x, y + tall // 2), 4, (170, 172, 176), -1, cv2.LINE_AA)
        y += tall + 4
    for _ in range(7):
        a, b = rng.integers((20, 10), (width - 20, height - 10), (2, 2))
        middle = (a + b) / 2 + (0, rng.uniform(30, 80))
        t = np.linspace(0, 1, 20)[:, None]
        cable = (1 - t) ** 2 * a + 2 * t * (1 - t) * middle + t**2 * b
        cv2.polylines(image, [cable.astype(np.int32)], False, pick(rng, VIVID), 3, cv2.LINE_AA)
    return image
