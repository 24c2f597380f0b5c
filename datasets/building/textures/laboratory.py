"""Laboratory things: instruments, racks, bottles, warning signs, the periodic table."""

from __future__ import annotations

import cv2
import numpy as np

from datasets.building.mesh import Image
from datasets.building.textures.ink import VIVID, lines, word, write
from datasets.building.textures.patterns import Colour, Generator, pick, plain, shift

ELEMENTS = (
    "H", "He", "Li", "Be", "B", "C", "N", "O", "F", "Ne", "Na", "Mg", "Al", "Si", "P", "S",
    "Cl", "Ar", "K", "Ca", "Sc", "Ti", "V", "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Ga",
    "Ge", "As", "Se", "Br", "Kr", "Rb", "Sr", "Y", "Zr", "Nb", "Mo", "Tc", "Ru", "Rh", "Pd",
    "Ag", "Cd", "In", "Sn", "Sb", "Te", "I", "Xe", "Cs", "Ba", "La", "Hf", "Ta", "W", "Re",
    "Os", "Ir", "Pt", "Au", "Hg",
)  # fmt: skip
LIQUIDS: tuple[Colour, ...] = (
    (60, 150, 210), (210, 170, 50), (180, 70, 60), (90, 170, 90), (150, 100, 180),
)  # fmt: skip
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


def glassware(rng: Generator, height: int, width: int) -> Image:
    """Draw a shelf of labelled bottles and of flasks with coloured liquids."""
    image = plain(height, width, (190, 198, 200))
    x = 6
    while x < width - 40:
        wide, tall = int(rng.integers(22, 40)), int(rng.uniform(0.5, 0.9) * height)
        draw = _bottle if rng.random() < 0.5 else _flask
        draw(rng, image, (x, height - 4 - tall, x + wide, height - 4))
        x += wide + 5
    return image


def _bottle(rng: Generator, image: Image, box: tuple[int, int, int, int]) -> None:
    left, top, right, bottom = box
    shoulder, label = top + (bottom - top) // 4, (top + bottom) // 2
    third = (right - left) // 3
    body = pick(rng, ((96, 56, 24), (226, 230, 230), (40, 80, 60)))
    cv2.rectangle(image, (left, shoulder), (right, bottom), body, -1)
    cv2.rectangle(image, (left + third, top), (right - third, shoulder), (30, 30, 34), -1)
    cv2.rectangle(image, (left + 2, label), (right - 2, bottom - 6), (246, 244, 236), -1)
    cv2.rectangle(image, (left + 4, label + 3), (left + 13, label + 12), (230, 120, 30), -1)
    lines(rng, image, (left + 4, label + 15, right - 4, bottom - 7), 5)


def _flask(rng: Generator, image: Image, box: tuple[int, int, int, int]) -> None:
    left, top, right, bottom = box
    neck, a, b = top + (bottom - top) // 3, (2 * left + right) // 3, (left + 2 * right) // 3
    corners = [(a, top), (b, top), (b, neck), (right, bottom), (left, bottom), (a, neck)]
    outline = np.array(corners, dtype=np.int32)
    level = bottom - (bottom - top) // 3
    cv2.fillPoly(image, [outline], (222, 232, 236), cv2.LINE_AA)
    cv2.rectangle(image, (left + 4, level), (right - 4, bottom - 2), pick(rng, LIQUIDS), -1)
    cv2.polylines(image, [outline], True, (90, 104, 112), 2, cv2.LINE_AA)
    middle = (left + right) // 2
    for y in range((top + bottom) // 2, bottom - 4, 7):
        cv2.line(image, (middle, y), (middle + 7, y), (50, 60, 66), 1)


def periodic_table(rng: Generator, height: int, width: int) -> Image:
    """Draw the periodic table as a poster."""
    image = plain(height, width, pick(rng, ((244, 244, 240), (30, 40, 70), (226, 234, 238))))
    title: Colour = (40, 40, 50) if image[0, 0].sum() > 380 else (244, 244, 240)
    write(
        image, "PERIODIC TABLE OF THE ELEMENTS", (width // 5, 4, 4 * width // 5, height // 8), title
    )
    hues = [pick(rng, VIVID, 30) for _ in range(18)]
    cell_w, cell_h = (width - 16) // 18, (height - height // 7 - 10) // 8
    for i in range(126):
        column, row = i % 18, i // 18
        if (row == 0 and 0 < column < 17) or (row in (1, 2) and 1 < column < 12):
            continue
        left, top = 8 + column * cell_w, height // 7 + row * cell_h
        cv2.rectangle(image, (left, top), (left + cell_w - 2, top + cell_h - 2), hues[column], -1)
        name = ELEMENTS[i % len(ELEMENTS)]
        write(
            image,
            name,
            (left + 2, top + cell_h // 4, left + cell_w - 3, top + cell_h - 3),
            (250, 250, 250),
        )
        cv2.line(image, (left + 2, top + 3), (left + cell_w // 2, top + 3), (250, 250, 250), 1)
    return image


def warning(rng: Generator, side: int) -> Image:
    """Draw a warning sign: black on a yellow triangle, with a line of text."""
    image = plain(side, side, (246, 244, 238))
    triangle = np.array([(side // 2, 5), (side - 6, int(0.78 * side)), (6, int(0.78 * side))])
    cv2.fillPoly(image, [triangle.astype(np.int32)], (248, 204, 20), cv2.LINE_AA)
    cv2.polylines(image, [triangle.astype(np.int32)], True, (20, 20, 20), 5, cv2.LINE_AA)
    centre, kind = (side // 2, int(0.52 * side)), int(rng.integers(3))
    if kind == 0:
        write(
            image,
            "!",
            (side // 3, side // 4, 2 * side // 3, int(0.75 * side)),
            (20, 20, 20),
            thickness=3,
        )
    elif kind == 1:
        bolt = np.array([(0, -28), (-16, 6), (-2, 4), (-8, 28), (16, -8), (2, -6)]) * side / 130
        cv2.fillPoly(image, [(bolt + centre).astype(np.int32)], (20, 20, 20), cv2.LINE_AA)
    else:
        for angle in (30, 150, 270):
            cv2.ellipse(image, centre, (side // 6,) * 2, 0, angle, angle + 60, (20, 20, 20), -1)
    write(image, str(rng.choice(["DANGER", "LASER", "HIGH VOLTAGE", "ACID"])),
          (6, int(0.8 * side), side - 6, side - 4), (20, 20, 20))  # fmt: skip
    return image


def pegboard(rng: Generator, height: int, width: int) -> Image:
    """Draw a perforated board with tools, clamps and coils of cable hanging on it."""
    image = plain(height, width, pick(rng, ((206, 196, 170), (150, 158, 164))))
    for y in range(6, height, 13):
        for x in range(6, width, 13):
            cv2.circle(image, (x, y), 2, (70, 66, 60), -1)
    for x in range(24, width - 24, 44):
        kind, top = int(rng.integers(3)), int(rng.uniform(0.08, 0.3) * height)
        end = top + int(rng.uniform(0.3, 0.55) * height)
        if kind == 0:
            cv2.line(image, (x, top), (x, end), (90, 92, 96), 6, cv2.LINE_AA)
            cv2.line(image, (x, (top + end) // 2), (x, end), pick(rng, VIVID), 11, cv2.LINE_AA)
        elif kind == 1:
            for radius in (16, 13, 10):
                cv2.circle(image, (x, top + 24), radius, pick(rng, VIVID), 2, cv2.LINE_AA)
        else:
            cv2.line(image, (x - 7, top), (x + 7, end), (60, 62, 66), 5, cv2.LINE_AA)
            cv2.line(image, (x + 7, top), (x - 7, end), (60, 62, 66), 5, cv2.LINE_AA)
            cv2.circle(image, (x - 7, end), 8, pick(rng, VIVID), 4, cv2.LINE_AA)
            cv2.circle(image, (x + 7, end), 8, pick(rng, VIVID), 4, cv2.LINE_AA)
    return image
