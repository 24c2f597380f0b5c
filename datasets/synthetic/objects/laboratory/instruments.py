"""Instruments that stand on benches."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, GLASS, PALE, STEEL
from roomgraph.datasets.synthetic.objects.look import SCREEN_GLOW, Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, instruments, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID

__all__ = ["centrifuge", "microscope", "oscilloscope"]


def microscope(stand: Stand, look: Look) -> None:
    """Build a microscope: base, arm, stage, revolver of lenses, head with two eyepieces."""
    rng = stand.rng
    body = PALE if rng.random() < 0.7 else paint((70, 74, 80))
    with stand.surfaces.thing("microscope"):
        cushion(stand, (-0.09, 0.09), (-0.13, 0.12), (0, 0.05), body, bevel=0.02)
        stand.box((-0.04, 0.04), (-0.13, -0.07), (0.05, 0.3), body)
        lathe(stand, (0, 0.04), [(0.035, 0.05), (0.025, 0.075)], DARK, sides=8)
        stand.box((-0.08, 0.08), (-0.06, 0.1), (0.135, 0.15), DARK)
        stand.box((-0.035, 0.035), (0.02, 0.045), (0.15, 0.154), GLASS)
        ring = [(-0.045, 0.08), (0.045, 0.08), (0.045, -0.13), (-0.045, -0.13)]
        block(stand, [(x, y, 0.335) for x, y in ring], [(x, y, 0.27) for x, y in ring], body)
        lathe(stand, (0, 0.035), [(0.03, 0.225), (0.045, 0.27)], DARK, sides=8)
        for x, y, low in ((0, 0.035, 0.165), (-0.03, 0.02, 0.19), (0.03, 0.02, 0.19)):
            tube(stand, (0.6 * x, y, 0.235), (x, y, low), (0.014, 0.009), STEEL)
        tube(stand, (0, 0.02, 0.33), (0, 0.06, 0.37), (0.05, 0.04), body, sides=8)
        for x in (-0.032, 0.032):
            tube(stand, (x, 0.05, 0.35), (x, 0.13, 0.41), 0.018, body)
            tube(stand, (x, 0.12, 0.402), (x, 0.165, 0.436), 0.021, DARK)
        for x in (-1, 1):
            tube(stand, (0.04 * x, -0.1, 0.1), (0.085 * x, -0.1, 0.1), 0.028, DARK, sides=8)


def centrifuge(stand: Stand, look: Look) -> None:
    """Build a bench centrifuge: slanting panel in front, round lid on top."""
    rng, half = stand.rng, float(stand.rng.uniform(0.15, 0.18))
    body = PALE if rng.random() < 0.7 else paint((120, 140, 156))
    panel = patterns.plain(60, 150, (70, 76, 84))
    panel[10:36, 12:66] = (30, 60, 50)
    ink.write(panel, str(int(rng.integers(1000, 9999))), (14, 12, 64, 34), (120, 255, 150))
    for i in range(3):
        cv2.rectangle(panel, (78 + 22 * i, 14), (94 + 22 * i, 28), VIVID[i], -1)
    cv2.circle(panel, (100, 45), 9, (220, 222, 222), -1, cv2.LINE_AA)
    with stand.surfaces.thing("centrifuge"):
        ring = ((-half, 0.19), (half, 0.19), (half, -0.2), (-half, -0.2))
        top = [(a, b - (0.07 if b > 0 else 0), 0.23) for a, b in ring]
        block(stand, top, [(a, b, 0.09) for a, b in ring], body)
        stand.box((-half, half), (-0.2, 0.19), (0.01, 0.09), body)
        face = [(a, b, z + 0.002) for a, b, z in (
            (-half + 0.02, 0.128, 0.22), (half - 0.02, 0.128, 0.22),
            (half - 0.02, 0.188, 0.1), (-half + 0.02, 0.188, 0.1))]  # fmt: skip
        stand.surfaces.picture(stand.world(face), Material(panel, glow=(0.8, 0.6, 0.9, 0.9)))
        levels = [(0.9 * half, 0.23), (0.9 * half, 0.255), (0.6 * half, 0.285), (0.2 * half, 0.295)]
        lathe(stand, (0, -0.04), levels, paint((150, 156, 162)))
        stand.box((-0.04, 0.04), (0.1, 0.125), (0.23, 0.25), DARK)


def oscilloscope(stand: Stand, look: Look) -> None:
    """Build an oscilloscope: lit screen with curves, knobs, sockets, a handle."""
    rng, half, tall = stand.rng, 0.17, float(stand.rng.uniform(0.16, 0.2))
    case, view = (
        paint(patterns.pick(rng, instruments.CASES)),
        patterns.plain(100, 140, (14, 30, 30)),
    )
    view[10:100:16], view[:, 8:140:16] = (44, 84, 76), (44, 84, 76)
    x = np.linspace(2, 138, 70)
    for colour in ((250, 226, 70), (90, 240, 255)):
        turns, size, level = rng.uniform(6, 30), rng.uniform(12, 28), rng.uniform(35, 65)
        curve = np.column_stack([x, level + size * np.sin(x * turns / 138)]).astype(np.int32)
        cv2.polylines(view, [curve], False, colour, 2, cv2.LINE_AA)
    with stand.surfaces.thing("oscilloscope"):
        stand.box((-half, half), (-0.1, 0.1), (0.015, tall), case)
        stand.picture(
            (-half + 0.01, half - 0.01), (0.022, tall - 0.006), 0.102, paint((58, 62, 68))
        )
        screen = Material(view, glow=SCREEN_GLOW)
        stand.picture((-half + 0.02, 0.03), (0.05, tall - 0.015), 0.105, screen)
        for i in range(6):
            a, b = 0.065 + 0.038 * (i % 3), tall - 0.035 - 0.045 * (i // 3)
            knob = PALE if i < 3 else paint(((250, 226, 70), (90, 200, 230), (230, 90, 150))[i - 3])
            tube(stand, (a, 0.1, b), (a, 0.125, b), 0.013, knob)
        for i in range(4):
            a = -0.12 + 0.07 * i
            tube(stand, (a, 0.1, 0.035), (a, 0.12, 0.035), 0.01, STEEL)
        for a in (-0.1, 0.1):
            tube(stand, (a, 0.03, tall), (a, 0.03, tall + 0.035), 0.008, DARK, sides=4)
        tube(stand, (-0.1, 0.03, tall + 0.035), (0.1, 0.03, tall + 0.035), 0.01, DARK)
        for a in (-0.13, 0.13):
            stand.box((a - 0.015, a + 0.015), (-0.08, 0.08), (0, 0.015), DARK)
