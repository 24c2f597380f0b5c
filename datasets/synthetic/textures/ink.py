"""Writing, drawings and pictures to be put on paper, screens, doors and walls."""

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
    shift,
    tint,
)

WORDS = (
    "room", "plan", "meeting", "report", "notes", "data", "survey", "draft", "paper", "review",
    "project", "design", "safety", "order", "invoice", "minutes", "agenda", "archive", "index",
    "budget", "staff", "public", "open", "close", "map", "study", "method", "result", "figure",
    "table", "volume", "letter", "office", "service", "contract", "model", "summary",
)  # fmt: skip
VIVID: tuple[Colour, ...] = (
    (196, 48, 42), (32, 84, 160), (44, 130, 72), (226, 168, 36), (120, 58, 132), (24, 140, 150),
    (214, 106, 34), (52, 52, 60), (150, 40, 70), (92, 116, 40), (230, 222, 206), (70, 110, 180),
)  # fmt: skip


def word(rng: Generator) -> str:
    """Return a word."""
    return str(WORDS[int(rng.integers(len(WORDS)))])


def write(
    image: Image,
    text: str,
    box: tuple[int, int, int, int],
    colour: Colour,
    font: int = cv2.FONT_HERSHEY_DUPLEX,
    thickness: int = 1,
) -> None:
    """Write a line as large as fits into a box: left, top, right, bottom."""
    left, top, right, bottom = box
    (width, height), base = cv2.getTextSize(text, font, 1.0, thickness)
    scale = min((right - left) / max(width, 1), (bottom - top) / max(height + base, 1))
    x = left + (right - left - scale * width) / 2
    y = top + (bottom - top + scale * (height - base)) / 2 + scale * base / 2
    cv2.putText(image, text, (int(x), int(y)), font, scale, colour, thickness, cv2.LINE_AA)


def lines(
    rng: Generator,
    image: Image,
    box: tuple[int, int, int, int],
    pitch: int,
    colour: Colour = (60, 60, 66),
) -> None:
    """Fill a box with ragged lines of strokes that look like print at a distance."""
    left, top, right, bottom = box
    for y in range(top, bottom - pitch // 2, pitch):
        x, end = left, right - int(rng.integers(0, max(1, (right - left) // 3)))
        if rng.random() < 0.12:
            continue
        while x < end:
            length = int(rng.integers(pitch // 2 + 1, pitch * 3))
            ink = shift(rng, colour, 25)
            cv2.rectangle(image, (x, y), (min(x + length, end), y + max(1, pitch // 2)), ink, -1)
            x += length + max(2, pitch // 3)


def chart(rng: Generator, image: Image, box: tuple[int, int, int, int]) -> None:
    """Draw a bar chart, a curve or a pie into a box."""
    left, top, right, bottom = box
    kind = int(rng.integers(3))
    cv2.rectangle(image, (left, top), (right, bottom), (120, 120, 126), 1)
    if kind == 0:
        count = int(rng.integers(4, 9))
        step = max(2, (right - left) // count)
        for i in range(count):
            height = int(rng.uniform(0.15, 0.95) * (bottom - top))
            bar = left + i * step + 1
            end = bar + step - 3, bottom
            cv2.rectangle(image, (bar, bottom - height), end, pick(rng, VIVID), -1)
    elif kind == 1:
        for _ in range(3):
            steps = np.cumsum(rng.standard_normal(24))
            steps = (steps - steps.min()) / max(float(np.ptp(steps)), 1e-6)
            x = np.linspace(left + 2, right - 2, 24)
            y = bottom - 3 - steps * (bottom - top - 6)
            curve = np.column_stack([x, y]).astype(np.int32)
            cv2.polylines(image, [curve], False, pick(rng, VIVID), 2, cv2.LINE_AA)
    else:
        centre = (left + right) // 2, (top + bottom) // 2
        radius = max(2, min(right - left, bottom - top) // 2 - 2)
        edges = np.sort(rng.integers(0, 360, 4))
        for a, b in zip(edges, np.roll(edges, -1), strict=True):
            last = int(b) + (360 if b <= a else 0)
            cv2.ellipse(image, centre, (radius, radius), 0, int(a), last, pick(rng, VIVID), -1)


def photo(rng: Generator, height: int, width: int) -> Image:
    """Return something like a photograph or painting: clouds of colour, hills, shapes."""
    image = tint(pick(rng, VIVID, 40), 1.2 * noise(rng, height, width, (height / 5, width / 5)))
    for _ in range(int(rng.integers(2, 5))):
        level = rng.uniform(0.3, 0.9) * height
        ridge = level + 0.35 * height * noise(rng, 1, width, (1, width / 7))[0]
        below = np.arange(height)[:, None] > ridge[None, :]
        image[below] = tint(pick(rng, VIVID, 30), 0.5 * noise(rng, height, width, (5, 9)))[below]
    for _ in range(int(rng.integers(3, 12))):
        centre = int(rng.integers(width)), int(rng.integers(height))
        radius = int(rng.uniform(0.02, 0.10) * width) + 2
        cv2.circle(image, centre, radius, pick(rng, VIVID), -1, cv2.LINE_AA)
    return image


def poster(rng: Generator, height: int, width: int) -> Image:
    """Return a poster: title, columns of text, charts or a photograph, on a paper of its own."""
    paper = (245, 243, 236) if rng.random() < 0.6 else pick(rng, VIVID, 20)
    dark = sum(paper) < 380
    ink: Colour = (240, 240, 236) if dark else (40, 40, 48)
    image = plain(height, width, paper)
    margin, head = width // 16 + 2, height // 7
    cv2.rectangle(image, (0, 0), (width, head), pick(rng, VIVID), -1)
    title = f"{word(rng)} {word(rng)}".upper()
    write(image, title, (margin, 2, width - margin, head), (250, 250, 246), thickness=2)
    top = head + margin
    columns = int(rng.integers(1, 4))
    step = (width - margin) // columns
    for column in range(columns):
        y = top
        while y < height - margin * 2:
            bottom = min(height - margin, y + int(rng.uniform(0.15, 0.4) * height))
            box = margin + column * step, y, (column + 1) * step, bottom
            if rng.random() < 0.5:
                lines(rng, image, box, max(5, height // 46), ink)
            elif rng.random() < 0.6:
                chart(rng, image, box)
            elif box[3] - box[1] > 8 and box[2] - box[0] > 8:
                image[box[1] : box[3], box[0] : box[2]] = photo(
                    rng, box[3] - box[1], box[2] - box[0]
                )
            y = bottom + margin // 2
    return image


def sheet(rng: Generator, height: int, width: int) -> Image:
    """Return a sheet of paper: print, perhaps with a chart."""
    image = plain(height, width, shift(rng, (242, 241, 234), 6))
    margin = max(3, width // 9)
    split = int(rng.uniform(0.35, 0.9) * height)
    lines(rng, image, (margin, margin, width - margin, split), max(4, height // 18))
    if split < 0.7 * height:
        chart(rng, image, (margin, split + 3, width - margin, height - margin))
    cv2.rectangle(image, (0, 0), (width - 1, height - 1), (186, 184, 178), 1)
    return image


def framed(picture: Image, colour: Colour, rim: int) -> Image:
    """Return a picture with a frame around it."""
    edge = cv2.copyMakeBorder(picture, *[rim] * 4, cv2.BORDER_CONSTANT, value=colour)
    cv2.rectangle(
        edge, (rim - 1, rim - 1), (edge.shape[1] - rim, edge.shape[0] - rim), (30, 28, 26), 1
    )
    return np.asarray(edge, dtype=np.uint8)
