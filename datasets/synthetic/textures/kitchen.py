"""Kitchen things: cupboards, hob, oven, fridge, crockery, food."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.finishes import cane
from roomgraph.datasets.synthetic.textures.ink import VIVID, lines, photo, sheet, word, write
from roomgraph.datasets.synthetic.textures.patterns import (
    Colour,
    Generator,
    noise,
    pick,
    plain,
    shift,
    steel,
    tint,
)


def cupboard(rng: Generator, face: Image, handle: int) -> Image:
    """Draw a cupboard's door: a panel of cane, its handle (0 bar, 1 knob, 2 across)."""
    image = face.copy()
    height, width = image.shape[:2]
    cv2.rectangle(image, (1, 1), (width - 2, height - 2), (70, 60, 50), 2)
    inset = max(10, width // 7)
    box = (inset, inset), (width - inset, height - inset)
    web = cane(rng, height - 2 * inset, width - 2 * inset, (206, 176, 124))
    image[inset : height - inset, inset : width - inset] = web
    cv2.rectangle(image, *box, (96, 84, 70), 3)
    cv2.rectangle(image, (inset + 3, inset + 3), box[1], (236, 230, 220), 1)
    steel_colour = (190, 192, 196)
    x, y = int(width * 0.86), height // 4
    if handle == 0:
        cv2.rectangle(image, (x + 3, y + 3), (x + 9, y + height // 3 + 3), (60, 54, 48), -1)
        cv2.rectangle(image, (x, y), (x + 5, y + height // 3), steel_colour, -1)
    elif handle == 1:
        cv2.circle(image, (x + 2, y + 3), 8, (60, 54, 48), -1, cv2.LINE_AA)
        cv2.circle(image, (x, y), 7, steel_colour, -1, cv2.LINE_AA)
        cv2.circle(image, (x - 2, y - 2), 2, (245, 245, 245), -1, cv2.LINE_AA)
    else:
        cv2.rectangle(image, (width // 4, 17), (3 * width // 4, 23), (60, 54, 48), -1)
        cv2.rectangle(image, (width // 4, 14), (3 * width // 4, 19), steel_colour, -1)
    return image


def drawers(face: Image, count: int) -> Image:
    """Draw a stack of drawers with bar handles."""
    image = face.copy()
    height, width = image.shape[:2]
    for i in range(count):
        top, bottom = i * height // count, (i + 1) * height // count - 1
        cv2.rectangle(image, (1, top + 1), (width - 2, bottom), (70, 60, 50), 2)
        y = top + (bottom - top) // 3
        cv2.rectangle(image, (width // 3, y + 3), (2 * width // 3, y + 8), (60, 54, 48), -1)
        cv2.rectangle(image, (width // 3, y), (2 * width // 3, y + 5), (195, 196, 200), -1)
    return image


def hob(rng: Generator, height: int, width: int) -> Image:
    """Draw a hob from above with four plates, and perhaps pans on it."""
    image = plain(height, width, (30, 30, 33))
    cv2.rectangle(image, (3, 3), (width - 4, height - 4), (150, 152, 156), 2)
    for x in (0.28, 0.72):
        for y in (0.30, 0.70):
            centre, radius = (
                (int(x * width), int(y * height)),
                int(rng.uniform(0.13, 0.19) * height),
            )
            for ring in range(3):
                cv2.circle(image, centre, radius - 5 * ring, (120, 60, 50), 1, cv2.LINE_AA)
            if rng.random() < 0.4:
                cv2.circle(image, centre, radius + 3, pick(rng, VIVID), -1, cv2.LINE_AA)
                cv2.circle(image, centre, radius - 3, (170, 120, 60), -1, cv2.LINE_AA)
    return image


def oven(rng: Generator, height: int, width: int) -> Image:
    """Draw an oven's front: knobs, a clock, a window with a grill."""
    image = steel(rng, height, width)
    for i in range(5):
        centre = int((0.12 + 0.19 * i) * width), int(0.10 * height)
        if i == 2:
            left, top = centre[0] - 22, centre[1] - 9
            cv2.rectangle(image, (left, top), (left + 44, top + 18), (14, 16, 14), -1)
            write(image, "12:45", (left + 3, top + 2, left + 41, top + 16), (120, 255, 120))
            continue
        cv2.circle(image, centre, 10, (40, 40, 44), -1, cv2.LINE_AA)
        cv2.line(image, centre, (centre[0], centre[1] - 9), (240, 240, 240), 2)
    cv2.rectangle(
        image, (width // 10, height // 5), (9 * width // 10, height // 4), (90, 92, 96), -1
    )
    box = (width // 10, height // 3), (9 * width // 10, 9 * height // 10)
    cv2.rectangle(image, *box, (34, 28, 26), -1)
    for y in range(height // 2, 4 * height // 5, 9):
        cv2.line(image, (width // 8, y), (7 * width // 8, y), (120, 112, 104), 1)
    return image


def fridge(rng: Generator, height: int, width: int) -> Image:
    """Draw a fridge's front with magnets, notes, photographs and a handle."""
    white = pick(rng, ((236, 236, 232), (226, 222, 205), (186, 206, 200)))
    image = tint(white, 0.05 * noise(rng, height, width, (80, 40)))
    split = int(height * rng.uniform(0.28, 0.4))
    cv2.line(image, (0, split), (width, split), (80, 80, 80), 4)
    for y in (split - height // 8, split + 12):
        cv2.rectangle(
            image, (width // 12, y), (width // 12 + 8, y + height // 10), (110, 112, 116), -1
        )
    for _ in range(int(rng.integers(9, 16))):
        tall, wide = int(rng.integers(26, 64)), int(rng.integers(24, 56))
        note = photo(rng, tall, wide) if rng.random() < 0.4 else sheet(rng, tall, wide)
        top, left = int(rng.integers(8, height - 70)), int(rng.uniform(0.2, 0.95) * (width - wide))
        image[top : top + tall, left : left + wide] = note
        magnet = left + wide // 2, top + 4
        cv2.circle(image, magnet, int(rng.integers(4, 8)), pick(rng, VIVID), -1, cv2.LINE_AA)
    return image


def crockery(rng: Generator, height: int, width: int) -> Image:
    """Draw an open shelf with cups, plates, glasses, jars and packets."""
    image = plain(height, width, pick(rng, ((206, 196, 178), (182, 168, 146))))
    x = 4
    while x < width - 44:
        kind, wide = int(rng.integers(4)), int(rng.integers(26, 44))
        base, colour = height - 4, pick(rng, (*VIVID, (240, 240, 236)))
        if kind == 0:
            top = base - int(0.4 * height)
            cv2.rectangle(image, (x, top), (x + wide - 10, base), colour, -1)
            cv2.ellipse(image, (x + wide - 9, (top + base) // 2), (7, 10), 0, 0, 360, colour, 3)
            cv2.line(image, (x, top + 8), (x + wide - 10, top + 8), shift(rng, colour, 90), 3)
        elif kind == 1:
            for i in range(int(rng.integers(5, 11))):
                y = base - i * 6
                cv2.ellipse(
                    image, (x + wide // 2, y), (wide // 2, 4), 0, 0, 360, (244, 244, 240), -1
                )
                cv2.ellipse(image, (x + wide // 2, y), (wide // 2, 4), 0, 0, 360, (96, 120, 160), 1)
        elif kind == 2:
            image[base - int(0.75 * height) : base, x : x + wide - 4] = packet(
                rng, int(0.75 * height), wide - 4
            )
        else:
            top = base - int(0.6 * height)
            cv2.rectangle(image, (x, top), (x + wide - 8, base), pick(rng, FOOD), -1)
            cv2.rectangle(image, (x - 1, top - 8), (x + wide - 7, top), (60, 60, 64), -1)
            cv2.rectangle(image, (x + 3, top + 14), (x + wide - 11, top + 30), (244, 240, 226), -1)
            lines(rng, image, (x + 5, top + 16, x + wide - 13, top + 29), 5)
        x += wide + 3
    return image


FOOD: tuple[Colour, ...] = (
    (196, 130, 50),
    (140, 40, 30),
    (230, 200, 120),
    (70, 44, 26),
    (90, 120, 50),
)


def packet(rng: Generator, height: int, width: int) -> Image:
    """Draw a packet of food: colour, name, picture."""
    image = plain(height, width, pick(rng, VIVID))
    write(image, word(rng), (2, 3, width - 2, height // 3), (250, 248, 240))
    centre = width // 2, 2 * height // 3
    cv2.circle(image, centre, width // 3, pick(rng, FOOD), -1, cv2.LINE_AA)
    cv2.circle(image, centre, width // 5, pick(rng, VIVID), -1, cv2.LINE_AA)
    return image


def sink(rng: Generator, height: int, width: int) -> Image:
    """Draw a steel sink from above, with bowl and draining board."""
    image = steel(rng, height, width)
    cv2.rectangle(
        image, (width // 14, height // 6), (width // 2, 5 * height // 6), (96, 100, 104), -1
    )
    cv2.circle(image, (2 * width // 7, height // 2), height // 14, (40, 40, 42), -1, cv2.LINE_AA)
    for x in range(4 * width // 7, 13 * width // 14, 12):
        cv2.line(image, (x, height // 5), (x, 4 * height // 5), (120, 124, 128), 3)
    return image


def tablecloth(rng: Generator, side: int) -> Image:
    """Draw a checked tablecloth laid with plates and cups."""
    colour = pick(rng, ((190, 50, 48), (50, 90, 160), (60, 130, 80), (200, 150, 50)))
    image = plain(side, side, (240, 236, 226))
    step = side // 14
    for i in range(0, side, 2 * step):
        image[i : i + step] = (image[i : i + step] * 0.5 + [c * 0.5 for c in colour]).astype(
            "uint8"
        )
        stripe = image[:, i : i + step]
        image[:, i : i + step] = (stripe * 0.5 + [c * 0.5 for c in colour]).astype("uint8")
    for x, y in ((0.3, 0.3), (0.7, 0.32), (0.5, 0.72)):
        centre = int(x * side), int(y * side)
        cv2.circle(image, centre, side // 10, (248, 248, 246), -1, cv2.LINE_AA)
        cv2.circle(image, centre, side // 10, (90, 110, 160), 2, cv2.LINE_AA)
        cv2.circle(image, centre, side // 17, pick(rng, FOOD), -1, cv2.LINE_AA)
    return image


def clock(side: int) -> Image:
    """Draw a wall clock on a square of wall."""
    image = plain(side, side, (228, 224, 214))
    middle = side // 2
    cv2.circle(image, (middle, middle), middle - 3, (250, 250, 250), -1, cv2.LINE_AA)
    cv2.circle(image, (middle, middle), middle - 3, (40, 40, 44), 4, cv2.LINE_AA)
    for hour in range(12):
        axis = cv2.ellipse2Poly((middle, middle), (middle - 11,) * 2, 0, hour * 30, hour * 30, 1)
        cv2.circle(image, tuple(int(v) for v in axis[0]), 3, (30, 30, 34), -1)
    cv2.line(image, (middle, middle), (middle, side // 5), (20, 20, 20), 3, cv2.LINE_AA)
    cv2.line(image, (middle, middle), (3 * side // 4, middle + 6), (20, 20, 20), 4, cv2.LINE_AA)
    return image
