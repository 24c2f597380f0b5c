"""Racks of instruments and of servers."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, STEEL
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import finishes, instruments, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID

__all__ = ["instrument_rack", "server_rack"]


def instrument_rack(stand: Stand, look: Look) -> None:
    """Build an open rack full of modules, with cables between them, on castors."""
    rng, tall = stand.rng, float(stand.rng.uniform(1.3, 1.85))
    side = Material(
        finishes.louvres(rng, 180, 120, patterns.pick(rng, instruments.CASES)), 0.7, 1.2
    )
    with stand.surfaces.thing("instrument_rack"):
        front = Material(instruments.rack(rng, int(250 * tall), 150))
        stand.box((-0.29, 0.29), (0.02, 0.54), (0.09, tall), side, front=front)
        for x in (-0.31, 0.27):
            stand.box((x, x + 0.04), (0.5, 0.58), (0.06, tall + 0.02), STEEL)
        for z in (0.06, tall - 0.01):
            stand.box((-0.31, 0.31), (0.01, 0.58), (z, z + 0.03), STEEL)
        for i in range(3):
            z = 0.35 + i * (tall - 0.5) / 3
            high = float(rng.uniform(0.13, 0.19))
            face = Material(instruments.instrument(rng, int(400 * high), 200))
            case = paint(patterns.pick(rng, instruments.CASES))
            stand.box((-0.265, 0.265), (0.5, 0.6), (z, z + high), case, front=face)
            for x in (-0.245, 0.245):
                tube(stand, (x, 0.62, z + 0.03), (x, 0.62, z + high - 0.03), 0.008, STEEL)
        for x in (-0.25, 0.25):
            for y in (0.08, 0.5):
                tube(stand, (x - 0.012, y, 0.03), (x + 0.012, y, 0.03), 0.03, DARK, sides=8)


def server_rack(stand: Stand, look: Look) -> None:
    """Build a black cabinet of servers with lamps and patch cables, its door taken off."""
    rng, tall = stand.rng, float(stand.rng.uniform(1.6, 2.05))
    side = Material(finishes.louvres(rng, 200, 140, (62, 64, 70)), 0.9, 1.4)
    with stand.surfaces.thing("server_rack"):
        front = Material(_servers(rng, int(260 * tall), 150))
        stand.box((-0.3, 0.3), (0.02, 0.78), (0.05, tall), side, front=front)
        for x in (-0.31, 0.27):
            stand.box((x, x + 0.04), (0.74, 0.84), (0.04, tall + 0.01), DARK)
        for z in (0.04, tall - 0.03):
            stand.box((-0.31, 0.31), (0.02, 0.84), (z, z + 0.05), DARK)
        for z in np.arange(0.2, tall - 0.2, 0.27):
            if rng.random() < 0.45:
                face = Material(_servers(rng, 36, 150))
                stand.box((-0.26, 0.26), (0.78, 0.81), (z, z + 0.13), STEEL, front=face)
        for x in (-0.26, 0.26):
            for y in (0.1, 0.74):
                tube(stand, (x, y, 0.05), (x, y, 0), 0.025, STEEL)


def _servers(rng: np.random.Generator, height: int, width: int) -> Image:
    """Draw servers and switches above each other: vents, discs, lamps, sockets with cables."""
    image, y = patterns.plain(height, width, (18, 18, 20)), 3
    while y < height - 10:
        tall = min(int(rng.choice((11, 24, 24, 36))), height - y - 3)
        grey = patterns.pick(rng, ((46, 48, 52), (34, 36, 40), (120, 124, 128), (60, 66, 78)))
        cv2.rectangle(image, (8, y), (width - 9, y + tall - 2), grey, -1)
        if tall < 14:
            for x in range(16, width - 20, 7):
                cv2.rectangle(image, (x, y + 3), (x + 4, y + 7), (10, 10, 12), -1)
                if rng.random() < 0.4:
                    end = (x + int(rng.integers(-9, 10)), y + int(rng.integers(14, 40)))
                    cv2.line(image, (x + 2, y + 5), end, patterns.pick(rng, VIVID), 2, cv2.LINE_AA)
        else:
            for x in range(14, width - 34, 15):
                cv2.rectangle(image, (x, y + 3), (x + 12, y + tall - 6), (22, 23, 26), -1)
                cv2.line(image, (x + 2, y + tall // 2), (x + 10, y + tall // 2), (90, 92, 98), 2)
        for x in (width - 26, width - 19):
            lamp = patterns.pick(rng, ((80, 250, 100), (80, 170, 250), (250, 180, 50)))
            cv2.circle(image, (x, y + tall // 2), 2, lamp, -1)
        y += tall
    return image
