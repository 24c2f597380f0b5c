"""Lockers and letter boxes."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.objects.service.panels import DARK, WHITE
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

__all__ = ["letter_boxes", "locker_row"]


def locker_row(stand: Stand, look: Look, *, count: int = 4) -> None:
    """Build a row of steel lockers with vents, locks and numbers."""
    rng, wide = stand.rng, float(stand.rng.uniform(0.3, 0.4))
    tiers, half = int(rng.integers(1, 3)), count * wide / 2
    colour = pick(rng, ((150, 160, 168), (60, 96, 140), (206, 204, 196), (160, 60, 50), look.front))
    body = paint(pick(rng, ((140, 144, 148), (92, 96, 100))))
    with stand.surfaces.thing("locker"):
        stand.box((-half, half), (0.0, 0.5), (0.1, 1.82), body)
        stand.box((-half + 0.02, half - 0.02), (0.03, 0.46), (0.0, 0.1), paint(DARK))
        tall = 1.72 / tiers
        for i in range(count * tiers):
            x, z = -half + (i % count) * wide, 0.1 + (i // count) * tall
            face = _locker_door(int(260 * tall), int(260 * wide), colour, str(i + 1))
            stand.box((x + 0.006, x + wide - 0.006), (0.5, 0.515), (z + 0.008, z + tall - 0.008),
                      body, front=Material(face))  # fmt: skip


def _locker_door(height: int, width: int, colour: Colour, number: str) -> Image:
    """Draw a locker's door: slots for air, number, lock."""
    image = plain(height, width, colour)
    dark: Colour = (colour[0] // 3, colour[1] // 3, colour[2] // 3)
    for y in (*range(24, 60, 7), *range(height - 60, height - 24, 7)):
        cv2.line(image, (width // 4, y), (3 * width // 4, y), dark, 2)
    cv2.rectangle(image, (width // 3, 72), (2 * width // 3, 94), (244, 244, 240), -1)
    ink.write(image, number, (width // 3, 74, 2 * width // 3, 92), (20, 20, 24))
    x, y = int(0.82 * width), height // 2
    cv2.rectangle(image, (x - 6, y - 16), (x + 6, y + 16), (60, 62, 66), -1)
    cv2.circle(image, (x, y - 6), 4, (210, 212, 216), -1, cv2.LINE_AA)
    cv2.rectangle(image, (1, 1), (width - 2, height - 2), dark, 1)
    return image


def letter_boxes(stand: Stand, look: Look) -> None:
    """Hang a block of letter boxes with slots, names and locks."""
    rng, columns, rows = stand.rng, int(stand.rng.integers(3, 6)), int(stand.rng.integers(2, 5))
    colour = pick(rng, ((176, 178, 182), (70, 90, 80), (120, 84, 60), (58, 60, 66), (60, 90, 140)))
    with stand.surfaces.thing("mailbox"):
        half, z = 0.16 * columns, 1.5 - 0.15 * rows
        stand.box((-half - 0.02, half + 0.02), (0.0, 0.2), (z - 0.02, z + 0.3 * rows + 0.02),
                  paint((60, 60, 64)))  # fmt: skip
        for i in range(columns * rows):
            face = plain(90, 100, patterns.shift(rng, colour, 4))
            cv2.rectangle(face, (8, 10), (92, 28), (206, 206, 204), -1)
            cv2.rectangle(face, (14, 16), (86, 23), (16, 16, 18), -1)
            cv2.rectangle(face, (10, 44), (60, 60), (250, 248, 240), -1)
            ink.write(face, ink.word(rng), (12, 45, 58, 59), (30, 30, 40))
            cv2.circle(face, (80, 52), 6, (214, 200, 140), -1, cv2.LINE_AA)
            x, y = -half + 0.32 * (i % columns), z + 0.3 * (i // columns)
            stand.box((x + 0.005, x + 0.315), (0.2, 0.21), (y + 0.005, y + 0.295),
                      paint(colour), front=Material(face))  # fmt: skip
            if rng.random() < 0.25:
                stand.box((x + 0.08, x + 0.24), (0.2, 0.24), (y + 0.2, y + 0.21), paint(WHITE))
