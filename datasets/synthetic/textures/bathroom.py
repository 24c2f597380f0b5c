"""Bathroom things: mirrors, dispensers, partitions, signs."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.finishes import louvres
from roomgraph.datasets.synthetic.textures.ink import lines, sheet, write
from roomgraph.datasets.synthetic.textures.patterns import (
    Colour,
    Generator,
    noise,
    pick,
    plain,
    steel,
    tint,
)


def mirror(rng: Generator, height: int, width: int, opposite: Image) -> Image:
    """Draw a mirror that shows the tiles of the other side, out of focus and pale."""
    picture = cv2.resize(opposite, (width, height), interpolation=cv2.INTER_AREA)
    soft = cv2.GaussianBlur(picture, (0, 0), 2.0)
    image = np.asarray(cv2.addWeighted(soft, 0.6, plain(height, width, (206, 222, 228)), 0.4, 0))
    for _ in range(2):
        x = int(rng.uniform(0.1, 0.8) * width)
        streak = np.array(
            [(x, 0), (x + width // 9, 0), (x - width // 5, height), (x - width // 3, height)]
        )
        cv2.fillConvexPoly(image, streak.astype(np.int32), (226, 236, 240), cv2.LINE_AA)
    cv2.rectangle(image, (0, 0), (width - 1, height - 1), (150, 156, 160), 5)
    return np.asarray(image, dtype=np.uint8)


def dispenser(rng: Generator, height: int, width: int) -> Image:
    """Draw a dispenser of paper towels: steel or white, keyhole, slot, a towel hanging out."""
    white = rng.random() < 0.5
    image = plain(height, width, (232, 232, 230)) if white else steel(rng, height, width)
    cv2.rectangle(image, (1, 1), (width - 2, height - 2), (90, 94, 98), 2)
    cv2.circle(image, (width // 2, height // 10), 4, (40, 40, 42), -1, cv2.LINE_AA)
    cv2.rectangle(
        image, (width // 6, height // 5), (5 * width // 6, 2 * height // 5), (70, 110, 160), -1
    )
    write(
        image, "PAPER", (width // 5, height // 5, 4 * width // 5, 2 * height // 5), (250, 250, 250)
    )
    cv2.rectangle(
        image, (width // 8, height // 2), (7 * width // 8, height // 2 + 7), (30, 30, 32), -1
    )
    towel = np.array([(width // 5, height // 2 + 5), (4 * width // 5, height // 2 + 5),
                      (3 * width // 4, height - 6), (width // 3, height - 16)])  # fmt: skip
    cv2.fillConvexPoly(image, towel.astype(np.int32), (246, 244, 238), cv2.LINE_AA)
    cv2.polylines(image, [towel.astype(np.int32)], True, (150, 148, 142), 1, cv2.LINE_AA)
    return image


def dryer(rng: Generator, height: int, width: int) -> Image:
    """Draw a hand dryer."""
    image = steel(rng, height, width)
    cv2.rectangle(image, (2, 2), (width - 3, height - 3), (80, 84, 88), 3)
    cv2.circle(image, (width // 2, height // 2), height // 5, (40, 44, 50), -1, cv2.LINE_AA)
    cv2.circle(image, (width // 2, height // 2), height // 8, (160, 200, 240), 3, cv2.LINE_AA)
    for x in range(width // 4, 3 * width // 4, 9):
        cv2.line(image, (x, 9 * height // 10), (x, height - 6), (20, 20, 22), 3)
    return image


def partition(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw the door of a stall with its lock, hinges, a pictogram and a notice."""
    value = 0.04 * noise(rng, height, width, (30, 30)) + 0.16 * noise(rng, height, width, (4, 4))
    image = tint(colour, value)
    for top, bottom in ((0.04, 0.14), (0.61, 0.95)):
        vent = louvres(rng, int((bottom - top) * height), int(0.8 * width), colour)
        at = int(top * height)
        image[at : at + vent.shape[0], width // 10 : width // 10 + vent.shape[1]] = vent
    notice = sheet(rng, int(0.2 * height), int(0.42 * width))
    top, left = int(0.40 * height), int(0.22 * width)
    image[top : top + notice.shape[0], left : left + notice.shape[1]] = notice
    cv2.rectangle(image, (2, 2), (width - 3, height - 3), (120, 126, 130), 3)
    lock = int(0.85 * width), int(0.5 * height)
    cv2.circle(image, lock, 11, (196, 198, 200), -1, cv2.LINE_AA)
    cv2.ellipse(image, lock, (6, 6), 0, 180, 360, (40, 150, 60), -1, cv2.LINE_AA)
    for y in (0.12, 0.85):
        top = int(y * height)
        cv2.rectangle(image, (3, top), (16, top + 26), (180, 182, 186), -1)
        for dy in (6, 19):
            cv2.circle(image, (9, top + dy), 2, (60, 60, 62), -1)
    person(image, (width // 2, int(0.24 * height)), int(0.09 * height), (250, 250, 250))
    return image


def person(image: Image, centre: tuple[int, int], size: int, colour: Colour) -> None:
    """Draw the pictogram of a person."""
    x, y = centre
    cv2.circle(image, (x, y - size), size // 3, colour, -1, cv2.LINE_AA)
    half, third = size // 2, size // 3
    body = [
        (x - half, y - half),
        (x + half, y - half),
        (x + third, y + half),
        (x - third, y + half),
    ]
    cv2.fillConvexPoly(image, np.array(body, dtype=np.int32), colour, cv2.LINE_AA)
    for leg in (-size // 6, size // 6):
        cv2.line(
            image,
            (x + leg, y + size // 2),
            (x + leg, y + size + size // 3),
            colour,
            max(2, size // 5),
        )


def wash_sign(rng: Generator, height: int, width: int) -> Image:
    """Draw a sign that asks to wash one's hands, in steps."""
    image = plain(height, width, (244, 248, 250))
    blue = pick(rng, ((30, 100, 170), (20, 140, 150)))
    cv2.rectangle(image, (0, 0), (width, height // 5), blue, -1)
    write(image, "WASH YOUR HANDS", (4, 3, width - 4, height // 5 - 3), (255, 255, 255))
    for i in range(6):
        x, y = int((0.2 + 0.3 * (i % 3)) * width), int((0.40 + 0.36 * (i // 3)) * height)
        size = width // 10
        cv2.circle(image, (x, y), size, blue, 2, cv2.LINE_AA)
        cv2.ellipse(
            image,
            (x, y),
            (size // 2, size // 4),
            i * 30.0,
            0,
            360,
            (214, 160, 130),
            -1,
            cv2.LINE_AA,
        )
        cv2.circle(image, (x + size // 3, y - size // 2), 3, (80, 160, 220), -1, cv2.LINE_AA)
        lines(rng, image, (x - size, y + size + 3, x + size, y + size + 12), 5)
    return image


def basin(height: int, width: int) -> Image:
    """Draw a washbasin from above: bowl, drain, tap."""
    image = plain(height, width, (240, 242, 242))
    centre = width // 2, int(0.55 * height)
    cv2.ellipse(
        image,
        centre,
        (int(0.40 * width), int(0.34 * height)),
        0,
        0,
        360,
        (206, 212, 216),
        -1,
        cv2.LINE_AA,
    )
    cv2.ellipse(
        image,
        centre,
        (int(0.40 * width), int(0.34 * height)),
        0,
        0,
        360,
        (150, 158, 162),
        2,
        cv2.LINE_AA,
    )
    cv2.circle(image, centre, max(3, width // 22), (60, 62, 64), -1, cv2.LINE_AA)
    cv2.line(
        image, (width // 2, 4), (width // 2, height // 3), (120, 126, 132), max(4, width // 16)
    )
    return image


def shower_curtain(rng: Generator, height: int, width: int) -> Image:
    """Draw a curtain in folds with a pattern of dots, drops or stripes."""
    folds = 0.16 * np.sin(np.arange(width, dtype=np.float32) / 9)
    colour = pick(rng, ((200, 224, 232), (226, 232, 214), (220, 214, 232)))
    image = tint(colour, np.repeat(folds[None], height, axis=0))
    inks = [pick(rng, ((40, 110, 170), (30, 140, 130), (200, 90, 110))) for _ in range(3)]
    for y in range(14, height, 34):
        for x in range(10 + 17 * (y // 34 % 2), width, 34):
            # No two alike: a regular pattern would match itself everywhere.
            at = x + int(rng.integers(-6, 7)), y + int(rng.integers(-6, 7))
            axes = int(rng.integers(4, 13)), int(rng.integers(3, 8))
            ink, angle = inks[int(rng.integers(3))], float(rng.uniform(0, 180))
            cv2.ellipse(image, at, axes, angle, 0, 360, ink, -1, cv2.LINE_AA)
            cv2.circle(image, (at[0] - 2, at[1] - 2), 2, (250, 250, 250), -1, cv2.LINE_AA)
    return image
