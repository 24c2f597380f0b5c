"""Office things: books, screens, keyboards, papers, boards."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.textures.ink import VIVID, chart, lines, sheet, word, write
from roomgraph.datasets.synthetic.textures.patterns import (
    Colour,
    Generator,
    pick,
    plain,
    shift,
    tint,
)


def books(rng: Generator, height: int, width: int, taste: tuple[Colour, ...]) -> Image:
    """Draw a shelf's load of book spines and file binders."""
    image = plain(height, width, (34, 28, 24))
    x = int(rng.integers(0, 12))
    while x < width - 8:
        thick = int(rng.integers(7, 22))
        if rng.random() < 0.25:
            x = _binders(rng, image, x, height)
            continue
        if rng.random() < 0.06:
            x += int(rng.integers(15, 45))
            continue
        tall = int(rng.uniform(0.62, 0.95) * height)
        spine = _spine(rng, tall, thick, pick(rng, taste, 22))
        shown = spine[:, : min(thick, width - x)]
        image[height - tall :, x : x + shown.shape[1]] = shown
        x += thick + 1
    return image


def _spine(rng: Generator, height: int, width: int, colour: Colour) -> Image:
    across = 0.35 * (np.sin(np.linspace(0.25, 2.9, width)) - 0.9)
    spine = tint(colour, np.repeat(across[None].astype(np.float32), height, axis=0))
    ink: Colour = (244, 232, 196) if sum(colour) < 400 else (30, 30, 40)
    for y in rng.integers(4, max(6, height // 5), 2):
        cv2.line(spine, (0, int(y)), (width, int(y)), ink, 1)
        cv2.line(spine, (0, height - int(y)), (width, height - int(y)), ink, 1)
    title = np.zeros((width, int(height * 0.6), 3), dtype=np.uint8)
    write(title, f"{word(rng)} {word(rng)}", (2, 1, title.shape[1] - 2, width - 1), (255, 255, 255))
    mask = np.rot90(title, 3)[:, :, 0] > 90
    top = height // 5
    spine[top : top + mask.shape[0]][mask] = ink
    return spine


def _binders(rng: Generator, image: Image, x: int, height: int) -> int:
    """Add two to four file binders of a kind, with labels and finger holes."""
    colour = pick(rng, ((40, 40, 46), (36, 70, 140), (150, 36, 40), (60, 110, 70)))
    for _ in range(int(rng.integers(2, 5))):
        right, top = x + 20, int(0.14 * height)
        if right >= image.shape[1]:
            break
        cv2.rectangle(image, (x, top), (right, height), shift(rng, colour, 8), -1)
        cv2.rectangle(image, (x + 3, top + 8), (right - 3, top + height // 2), (238, 236, 226), -1)
        lines(rng, image, (x + 5, top + 12, right - 4, top + height // 2 - 4), 6)
        cv2.circle(image, (x + 10, height - 14), 5, (150, 150, 155), 1, cv2.LINE_AA)
        x = right + 1
    return x + 1


def screen(rng: Generator, height: int, width: int) -> Image:
    """Draw a monitor: dark rim, desktop, windows with text and charts."""
    image = plain(height, width, (26, 27, 30))
    inner = image[5 : height - 9, 5 : width - 5]
    inner[:] = pick(rng, ((40, 80, 130), (30, 110, 110), (70, 60, 110)))
    for _ in range(int(rng.integers(2, 4))):
        left, top = int(rng.uniform(0, 0.4) * width), int(rng.uniform(0, 0.35) * height)
        right = min(left + int(rng.uniform(0.45, 0.8) * width), inner.shape[1] - 2)
        bottom = min(top + int(rng.uniform(0.45, 0.75) * height), inner.shape[0] - 8)
        dark = rng.random() < 0.4
        paper: Colour = (36, 38, 44) if dark else (240, 241, 244)
        cv2.rectangle(inner, (left, top), (right, bottom), paper, -1)
        cv2.rectangle(inner, (left, top), (right, top + 7), pick(rng, VIVID), -1)
        box = left + 5, top + 12, right - 5, bottom - 5
        if rng.random() < 0.3:
            chart(rng, inner, box)
        else:
            lines(rng, inner, box, 7, pick(rng, VIVID) if dark else (50, 52, 60))
    cv2.rectangle(inner, (0, inner.shape[0] - 7), (width, inner.shape[0]), (28, 32, 44), -1)
    return image


def keyboard(rng: Generator, height: int, width: int) -> Image:
    """Draw a keyboard from above."""
    dark = rng.random() < 0.7
    image = plain(height, width, (28, 28, 30) if dark else (200, 200, 196))
    key: Colour = (64, 64, 68) if dark else (236, 236, 230)
    rows, columns = 5, 16
    for row in range(rows):
        for column in range(columns):
            left, top = 4 + column * (width - 8) // columns, 4 + row * (height - 8) // rows
            right, bottom = left + (width - 8) // columns - 2, top + (height - 8) // rows - 2
            cv2.rectangle(image, (left, top), (right, bottom), shift(rng, key, 6), -1)
            cv2.line(image, (left + 2, top + 2), (left + 4, top + 4), (180, 180, 180), 1)
    return image


def desk_top(rng: Generator, wood: Image) -> Image:
    """Draw a desk from above: papers, keyboard, mouse, mug, notes."""
    image = wood.copy()
    height, width = image.shape[:2]
    for _ in range(int(rng.integers(4, 8))):
        paper = sheet(rng, int(height * 0.42), int(height * 0.3))
        _lay(rng, image, paper, float(rng.uniform(-35, 35)))
    board = keyboard(rng, int(height * 0.2), int(height * 0.62))
    top, left = int(height * 0.66), int(rng.uniform(0.25, 0.5) * width)
    space = image[top : top + board.shape[0], left : left + board.shape[1]]
    space[:] = board[: space.shape[0], : space.shape[1]]
    mug = int(rng.uniform(0.1, 0.9) * width), int(rng.uniform(0.2, 0.5) * height)
    cv2.circle(image, mug, height // 18, pick(rng, VIVID), -1, cv2.LINE_AA)
    cv2.circle(image, mug, height // 26, (44, 30, 22), -1, cv2.LINE_AA)
    return image


def _lay(rng: Generator, image: Image, paper: Image, degrees: float) -> None:
    """Lay a paper down somewhere, turned."""
    height, width = image.shape[:2]
    centre = paper.shape[1] / 2, paper.shape[0] / 2
    turn = cv2.getRotationMatrix2D(centre, degrees, 1.0)
    turn[:, 2] += rng.uniform((0.08 * width, 0.0), (0.75 * width, 0.5 * height))
    mask = cv2.warpAffine(np.full(paper.shape[:2], 255, np.uint8), turn, (width, height))
    laid = cv2.warpAffine(paper, turn, (width, height), flags=cv2.INTER_LINEAR)
    image[mask > 200] = laid[mask > 200]


def whiteboard(rng: Generator, height: int, width: int) -> Image:
    """Draw a whiteboard with sketches, writing and magnets."""
    image = plain(height, width, (240, 242, 242))
    pens: tuple[Colour, ...] = ((30, 50, 150), (170, 30, 40), (20, 110, 60), (30, 30, 30))
    for _ in range(int(rng.integers(4, 8))):
        x, y = int(rng.uniform(0.03, 0.6) * width), int(rng.uniform(0.05, 0.75) * height)
        pen = pick(rng, pens)
        text = f"{word(rng)} {word(rng)}"
        write(
            image, text, (x, y, x + width // 3, y + height // 8), pen, cv2.FONT_HERSHEY_SIMPLEX, 2
        )
        if rng.random() < 0.6:
            a, b = rng.integers((0, 0), (width, height), (2, 2))
            cv2.arrowedLine(image, a.tolist(), b.tolist(), pen, 2, cv2.LINE_AA)
    for _ in range(3):
        left, top = int(rng.uniform(0.05, 0.8) * width), int(rng.uniform(0.1, 0.7) * height)
        box = left, top, left + width // 7, top + height // 6
        cv2.rectangle(image, box[:2], box[2:], pick(rng, pens), 2)
    cv2.rectangle(image, (0, 0), (width - 1, height - 1), (150, 152, 156), 6)
    return image


def pinboard(rng: Generator, height: int, width: int) -> Image:
    """Draw a cork board with notes, photographs and leaflets."""
    image = tint((176, 132, 84), 0.5 * (rng.random((height, width), dtype=np.float32) - 0.5))
    for _ in range(int(rng.integers(9, 15))):
        note = sheet(rng, int(rng.uniform(0.2, 0.4) * height), int(rng.uniform(0.1, 0.2) * width))
        if rng.random() < 0.3:
            note[:] = pick(rng, ((250, 226, 90), (250, 160, 180), (150, 220, 240)))
            lines(rng, note, (3, 3, note.shape[1] - 3, note.shape[0] - 3), 7)
        top = int(rng.integers(4, height - note.shape[0] - 4))
        left = int(rng.integers(4, width - note.shape[1] - 4))
        image[top : top + note.shape[0], left : left + note.shape[1]] = note
        cv2.circle(
            image, (left + note.shape[1] // 2, top + 4), 3, pick(rng, VIVID), -1, cv2.LINE_AA
        )
    cv2.rectangle(image, (0, 0), (width - 1, height - 1), (110, 78, 46), 7)
    return image
