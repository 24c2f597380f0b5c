"""Sinks of laboratories."""

from __future__ import annotations

from itertools import pairwise

import cv2

from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, GLASS, PALE, TOPS, UNITS
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import finishes, ink, kitchen, patterns

__all__ = ["lab_sink"]


def lab_sink(stand: Stand, look: Look) -> None:
    """Build a sink unit with a bent tap, a rack for glass and an eye wash with its sign."""
    rng, colour = stand.rng, patterns.pick(stand.rng, UNITS)
    basin = paint((206, 208, 210)) if rng.random() < 0.5 else paint((70, 74, 78))
    top = paint(patterns.pick(rng, TOPS))
    with stand.surfaces.thing("sink"):
        front = Material(kitchen.drawers(patterns.plaster(rng, 170, 120, colour), 1))
        for x in ((-0.5, 0.0), (0.0, 0.5)):
            stand.box(x, (0.02, 0.6), (0.08, 0.68), paint(colour), front=front)
        stand.box((-0.5, 0.5), (0.06, 0.56), (0, 0.08), DARK)
        for x, y in (((-0.5, -0.3), (0.0, 0.66)), ((0.2, 0.5), (0.0, 0.66)),
                     ((-0.3, 0.2), (0.0, 0.18)), ((-0.3, 0.2), (0.54, 0.66))):  # fmt: skip
            stand.box(x, y, (0.86, 0.9), top)
            inner = (max(y[0], 0.02), min(y[1], 0.6))
            stand.box(x, inner, (0.68, 0.86), basin if x[1] == 0.2 else paint(colour))
        stand.wall((-0.3, 0.2), (0.68, 0.86), 0.602, paint(colour))
        stand.sheet((-0.3, 0.2), (0.18, 0.54), 0.7, basin)
        stand.sheet((-0.07, -0.03), (0.34, 0.38), 0.703, DARK)
        chrome = paint((196, 200, 204))
        path = [(0.1, 0.9), (0.1, 1.2), (0.14, 1.28), (0.24, 1.3), (0.31, 1.26), (0.33, 1.15)]
        for (y0, z0), (y1, z1) in pairwise(path):
            tube(stand, (-0.05, y0, z0), (-0.05, y1, z1), 0.014, chrome)
        for left, tap in ((-0.13, (40, 90, 200)), (0.03, (200, 40, 40))):
            tube(stand, (-0.05, 0.1, 0.96), (left, 0.1, 0.96), 0.012, chrome)
            tube(stand, (left, 0.1, 0.94), (left, 0.1, 1.0), 0.022, paint(tap))
        _eye_wash(stand.at(0.36, 0.14, 0.9))
        peg = Material(finishes.perforated(rng, 100, 110, (232, 234, 232)))
        stand.box((-0.46, 0.1), (0.012, 0.03), (1.36, 1.86), PALE, front=peg)
        for i in range(6):
            left, z = -0.38 + 0.2 * (i % 3), 1.5 + 0.22 * (i // 3)
            tube(stand, (left, 0.03, z), (left, 0.12, z + 0.03), 0.006, PALE, sides=4)
            if rng.random() < 0.7:
                tube(stand, (left, 0.08, z - 0.11), (left, 0.1, z + 0.05), (0.045, 0.02), GLASS)


def _eye_wash(stand: Stand) -> None:
    """Build an eye wash: a yellow bowl with two nozzles, a push plate, a green sign."""
    yellow, green = paint((240, 206, 40)), (20, 130, 80)
    tube(stand, (0, 0, 0), (0, 0, 0.14), 0.02, paint((196, 200, 204)))
    lathe(stand, (0, 0), [(0.04, 0.12), (0.12, 0.2), (0.115, 0.2), (0.06, 0.15)], yellow)
    for x in (-0.045, 0.045):
        tube(stand, (x, 0, 0.15), (x, 0, 0.22), (0.012, 0.024), paint((40, 150, 80)))
    sign: Image = patterns.plain(100, 100, green)
    cv2.ellipse(sign, (50, 36), (32, 17), 0, 0, 360, (244, 246, 244), -1, cv2.LINE_AA)
    cv2.circle(sign, (50, 36), 10, green, -1, cv2.LINE_AA)
    for x in (30, 50, 70):
        cv2.line(sign, (x, 58), (x, 70), (244, 246, 244), 4)
    ink.write(sign, "EYE WASH", (6, 74, 94, 96), (244, 246, 244))
    stand.picture((-0.13, 0.13), (0.55, 0.81), -0.126, Material(sign))
