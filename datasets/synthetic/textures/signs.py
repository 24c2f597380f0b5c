"""Things of corridors and lobbies: doors, plates, exit signs, radiators, elevators, plants."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.bathroom import person
from roomgraph.datasets.synthetic.textures.finishes import tread
from roomgraph.datasets.synthetic.textures.ink import VIVID, lines, word, write
from roomgraph.datasets.synthetic.textures.patterns import (
    Colour,
    Generator,
    noise,
    pick,
    plain,
    steel,
    tint,
)

SIGN_GREEN: Colour = (20, 130, 80)


def door(rng: Generator, face: Image, number: int) -> Image:
    """Draw a closed door: leaf in a frame, handle, plate with a number, keyhole, kick plate."""
    image = face.copy()
    height, width = image.shape[:2]
    cv2.rectangle(image, (2, 2), (width - 3, height), (70, 62, 54), 4)
    lever = int(0.86 * width), int(0.52 * height)
    cv2.rectangle(
        image, (lever[0] - 6, lever[1] - 12), (lever[0] + 6, lever[1] + 34), (180, 182, 186), -1
    )
    cv2.line(image, lever, (lever[0] - 34, lever[1]), (214, 216, 220), 7, cv2.LINE_AA)
    cv2.circle(image, (lever[0], lever[1] + 22), 3, (20, 20, 20), -1)
    plate = width // 4, int(0.22 * height), 3 * width // 4, int(0.30 * height)
    cv2.rectangle(image, plate[:2], plate[2:], (240, 240, 236), -1)
    cv2.rectangle(image, plate[:2], plate[2:], (60, 60, 64), 2)
    write(
        image,
        f"{number}",
        (plate[0] + 4, plate[1] + 3, (plate[0] + plate[2]) // 2, plate[3] - 3),
        (30, 40, 90),
    )
    lines(rng, image, ((plate[0] + plate[2]) // 2 + 4, plate[1] + 8, plate[2] - 4, plate[3] - 6), 9)
    image[int(0.92 * height) : height - 4, 8 : width - 8] = steel(
        rng, height - 4 - int(0.92 * height), width - 16
    )
    return image


def exit_sign(height: int, width: int, to_left: bool) -> Image:
    """Draw the green sign of an emergency exit."""
    image = plain(height, width, SIGN_GREEN)
    person(image, (width // 4, height // 2), height // 4, (250, 250, 250))
    tail, tip = (width // 2, height // 2), (int(0.92 * width), height // 2)
    cv2.arrowedLine(
        image, tail, tip, (250, 250, 250), max(3, height // 10), cv2.LINE_AA, tipLength=0.4
    )
    return image[:, ::-1].copy() if to_left else image


def room_plate(rng: Generator, height: int, width: int, title: str) -> Image:
    """Draw the plate beside a room's door: number, name, lines."""
    image = plain(height, width, (236, 238, 240))
    cv2.rectangle(
        image,
        (0, 0),
        (width, height // 3),
        pick(rng, ((40, 70, 120), (90, 30, 40), (60, 64, 70))),
        -1,
    )
    write(
        image, str(int(rng.integers(101, 199))), (6, 3, width - 6, height // 3 - 3), (250, 250, 250)
    )
    write(image, title, (6, height // 3 + 4, width - 6, 2 * height // 3), (40, 40, 44))
    lines(rng, image, (8, 2 * height // 3 + 4, width - 8, height - 4), 8)
    cv2.rectangle(image, (0, 0), (width - 1, height - 1), (90, 92, 96), 2)
    return image


def radiator(height: int, width: int) -> Image:
    """Draw a radiator's front: upright ribs between two rails."""
    ribs = 0.22 * np.sin(np.arange(width, dtype=np.float32) * (6.28 / 13))
    image = tint((216, 214, 206), np.repeat(ribs[None], height, axis=0))
    for y in (0, height - 12):
        cv2.rectangle(image, (0, y), (width, y + 12), (196, 194, 186), -1)
        cv2.line(image, (0, y + 12), (width, y + 12), (120, 118, 112), 2)
    return image


def evacuation_plan(rng: Generator, height: int, width: int) -> Image:
    """Draw a floor plan with walls, a route in green, symbols and a legend."""
    image = plain(height, width, (248, 248, 244))
    cv2.rectangle(
        image,
        (0, 0),
        (width, height // 8),
        pick(rng, (SIGN_GREEN, (40, 80, 150), (170, 40, 40))),
        -1,
    )
    write(image, str(rng.choice(["FLOOR PLAN", "EVACUATION PLAN", "YOU ARE HERE"])),
          (width // 12, 2, 11 * width // 12, height // 8 - 2), (255, 255, 255))  # fmt: skip
    left, right, top, bottom = width // 14, 13 * width // 14, height // 6, int(0.72 * height)
    middle = (top + bottom) // 2
    for y in (top, middle - height // 22, middle + height // 22, bottom):
        cv2.line(image, (left, y), (right, y), (30, 30, 36), 3)
    for ends in ((top, middle - height // 22), (middle + height // 22, bottom)):
        for x in np.linspace(left, right, int(rng.integers(5, 8))).astype(int):
            cv2.line(image, (int(x), ends[0]), (int(x), ends[1]), (30, 30, 36), 3)
            label = (int(x) + 6, ends[0] + 8, int(x) + width // 12, ends[0] + 8 + height // 18)
            write(image, str(int(rng.integers(100, 199))), label, (60, 60, 120))
    cv2.arrowedLine(image, (left + 8, middle), (right - 8, middle), SIGN_GREEN, 5, tipLength=0.05)
    for _ in range(6):
        at = int(rng.integers(left, right)), int(rng.integers(top, bottom))
        cv2.circle(image, at, width // 60 + 2, pick(rng, VIVID), -1, cv2.LINE_AA)
    lines(rng, image, (left, int(0.77 * height), right, height - 6), max(5, height // 32))
    return image


def elevator_door(rng: Generator, height: int, width: int) -> Image:
    """Two leaves of brushed steel with a seam, notices and a sill."""
    image = tread(rng, height, width, steel(rng, height, width, (168, 172, 178)))
    cv2.line(image, (width // 2, 0), (width // 2, height), (30, 32, 34), 5)
    for x in (width // 4, 3 * width // 4):
        cv2.line(image, (x, 0), (x, height), (130, 134, 140), 2)
    side, top = width // 8, int(0.38 * height)
    for x in (width // 2 - 2 * side, width // 2 + side):
        cv2.circle(image, (x + side // 2, top), side // 2, (210, 40, 40), 4, cv2.LINE_AA)
        person(image, (x + side // 2, top), side // 5, (40, 40, 44))
        lines(rng, image, (x, top + side // 2 + 8, x + side, top + side + 10), 7)
    return image


def call_buttons(rng: Generator, height: int, width: int) -> Image:
    """Draw the elevators' call buttons with arrows, keyhole and a small display."""
    image = steel(rng, height, width, (150, 154, 160))
    cv2.rectangle(image, (1, 1), (width - 2, height - 2), (60, 62, 66), 3)
    cv2.rectangle(
        image, (width // 6, height // 14), (5 * width // 6, height // 4), (16, 14, 14), -1
    )
    write(
        image,
        str(int(rng.integers(1, 9))),
        (width // 5, height // 14, 4 * width // 5, height // 4),
        (255, 90, 50),
    )
    for y, up in ((0.42, -1), (0.66, 1)):
        centre = width // 2, int(y * height)
        cv2.circle(image, centre, width // 4, (240, 240, 240), -1, cv2.LINE_AA)
        cv2.circle(image, centre, width // 4, (250, 150, 40), 3, cv2.LINE_AA)
        size = width // 9
        arrow = np.array([(0, up * size), (size, -up * size), (-size, -up * size)]) + centre
        cv2.fillPoly(image, [arrow.astype(np.int32)], (30, 30, 34), cv2.LINE_AA)
    cv2.circle(image, (width // 2, int(0.87 * height)), 4, (20, 20, 22), -1)
    return image


def floor_number(rng: Generator, height: int, width: int, floor: int) -> Image:
    """Draw a large number of the floor with the firms on it."""
    colour = pick(rng, ((30, 60, 110), (120, 40, 40), (40, 90, 70), (60, 60, 66)))
    image = plain(height, width, colour)
    write(
        image,
        str(floor),
        (width // 8, height // 16, 7 * width // 8, int(0.68 * height)),
        (246, 244, 236),
        thickness=5,
    )
    for i in range(3):
        y = int((0.72 + 0.09 * i) * height)
        write(
            image,
            f"{word(rng)} {word(rng)}".upper(),
            (8, y, width - 8, y + height // 13),
            (230, 228, 220),
        )
    return image


def leaves(rng: Generator, height: int, width: int) -> Image:
    """Dense leaves of a house plant."""
    image = tint((34, 62, 30), 0.8 * noise(rng, height, width, (14, 14)))
    for _ in range(height * width // 320):
        centre = int(rng.integers(width)), int(rng.integers(height))
        green = pick(rng, ((60, 130, 50), (90, 160, 70), (40, 100, 44), (140, 170, 80)))
        angle = float(rng.uniform(0, 180))
        cv2.ellipse(image, centre, (17, 6), angle, 0, 360, green, -1, cv2.LINE_AA)
        rib = cv2.ellipse2Poly(centre, (16, 1), int(angle), 0, 360, 180)
        cv2.polylines(image, [rib], False, (190, 210, 130), 1, cv2.LINE_AA)
    return image


def outside(rng: Generator, height: int, width: int) -> Image:
    """Draw what is seen through a window, with the window's frame: sky, houses, trees."""
    down = np.linspace(-0.12, 0.12, height, dtype=np.float32)[:, None]
    image = tint((190, 214, 236), down + 0.10 * noise(rng, height, width, (30, 70)))
    x = 0
    while x < width:
        wide, top = int(rng.integers(40, 110)), int(rng.uniform(0.35, 0.7) * height)
        cv2.rectangle(
            image,
            (x, top),
            (x + wide, height),
            pick(rng, ((170, 150, 136), (150, 156, 164), (196, 180, 150))),
            -1,
        )
        for wy in range(top + 8, height - 8, 17):
            for wx in range(x + 6, x + wide - 8, 15):
                cv2.rectangle(image, (wx, wy), (wx + 7, wy + 9), (90, 104, 120), -1)
        x += wide + int(rng.integers(0, 24))
    for _ in range(5):
        at = int(rng.integers(width)), int(rng.uniform(0.75, 1.0) * height)
        cv2.circle(
            image,
            at,
            int(rng.integers(14, 40)),
            pick(rng, ((86, 122, 70), (110, 140, 80))),
            -1,
            cv2.LINE_AA,
        )
    for x in (0, width // 2, width - 1):
        cv2.line(image, (x, 0), (x, height), (240, 240, 238), 13)
    for y in (0, height - 1):
        cv2.line(image, (0, y), (width, y), (240, 240, 238), 15)
    cv2.rectangle(
        image,
        (width // 2 + 8, height // 2),
        (width // 2 + 13, height // 2 + 22),
        (120, 122, 126),
        -1,
    )
    return image
