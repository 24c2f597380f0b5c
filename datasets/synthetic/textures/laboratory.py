"""Laboratory things: benches, bottles, warning signs, tools, the periodic table."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.finishes import perforated
from roomgraph.datasets.synthetic.textures.ink import VIVID, lines, write
from roomgraph.datasets.synthetic.textures.patterns import Colour, Generator, pick, plain, shift

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


def bench_unit(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    """Draw the front of a bench's unit: drawers with label holders and locks, a striped foot."""
    image = plain(height, width, colour)
    count = int(rng.integers(2, 5))
    foot = height - height // 12
    for i in range(count):
        top, bottom = i * foot // count, (i + 1) * foot // count - 1
        cv2.rectangle(image, (1, top + 1), (width - 2, bottom), (84, 90, 94), 2)
        label = width // 8, top + 9, width // 2, top + 27
        cv2.rectangle(image, label[:2], label[2:], (248, 248, 240), -1)
        cv2.rectangle(image, label[:2], label[2:], (110, 114, 118), 1)
        lines(rng, image, (label[0] + 3, label[1] + 3, label[2] - 3, label[3] - 2), 6)
        lock = int(0.85 * width), top + 18
        cv2.circle(image, lock, 6, (180, 184, 186), -1, cv2.LINE_AA)
        cv2.line(image, (lock[0], lock[1] - 3), (lock[0], lock[1] + 3), (30, 30, 32), 2)
    vent = perforated(rng, foot // 2 - 40, width - 24, shift(rng, colour, 14))
    image[foot - vent.shape[0] - 6 : foot - 6, 12 : width - 12] = vent
    for x in range(-height // 12, width, 18):
        corners = np.array([(x, height), (x + 9, height), (x + 22, foot + 2), (x + 13, foot + 2)])
        cv2.fillConvexPoly(image, corners.astype(np.int32), (236, 190, 30), cv2.LINE_AA)
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
