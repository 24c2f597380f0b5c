"""Boards and screens to write on, pin to and show pictures on."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import SCREEN_GLOW, Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import DARK
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, office, patterns
from roomgraph.datasets.synthetic.textures.ink import VIVID

__all__ = ["flip_chart", "pinboard", "projector_screen", "whiteboard"]


def whiteboard(stand: Stand, look: Look, width: float = 1.5) -> None:
    """Hang a whiteboard with a tray of pens."""
    rng, half, tall = stand.rng, width / 2, float(stand.rng.uniform(0.85, 1.1))
    with stand.surfaces.thing("whiteboard"):
        face = Material(office.whiteboard(rng, int(230 * tall), int(230 * width)))
        frame = paint((186, 188, 192))
        stand.box((-half, half), (0.012, 0.035), (0.92, 0.92 + tall), frame, front=face)
        stand.box((-0.3, 0.3), (0.035, 0.1), (0.92, 0.935), frame)
        for i in range(3):
            x, pen = -0.24 + 0.15 * i, paint(VIVID[i])
            tube(stand, (x, 0.07, 0.945), (x + 0.12, 0.07, 0.945), 0.009, pen)
        stand.box((0.16, 0.28), (0.045, 0.09), (0.935, 0.97), paint((40, 70, 130)))


def pinboard(stand: Stand, look: Look, width: float = 1.1) -> None:
    """Hang a cork board with notes and photographs."""
    tall = float(stand.rng.uniform(0.7, 0.95))
    low, face = 1.0, office.pinboard(stand.rng, int(260 * tall), int(260 * width))
    with stand.surfaces.thing("pinboard"):
        z = (low, low + tall)
        stand.box((-width / 2, width / 2), (0.012, 0.035), z, look.metallic(), front=Material(face))


def flip_chart(stand: Stand, look: Look) -> None:
    """Build a flip chart: a tripod that carries a leaning pad of written paper."""
    rng, metal = stand.rng, paint((176, 178, 182) if stand.rng.random() < 0.6 else (60, 62, 66))
    low, high = float(rng.uniform(0.78, 0.9)), float(rng.uniform(1.8, 1.92))

    def lean(z: float) -> float:
        return 0.14 - 0.17 * (z - low)

    with stand.surfaces.thing("flip_chart"):
        for x in (-1.0, 1.0):
            tube(stand, (0.33 * x, 0.3, 0), (0.26 * x, lean(high) - 0.05, high), 0.014, metal)
        tube(stand, (0, -0.45, 0), (0, lean(high) - 0.06, high - 0.05), 0.014, metal)
        stand.footprint((-0.35, 0.35), (-0.45, 0.32))
        rings = [
            [(-0.35, lean(z), z), (0.35, lean(z), z), (0.35, lean(z) - 0.025, z),
             (-0.35, lean(z) - 0.025, z)] for z in (high, low)
        ]  # fmt: skip
        block(stand, rings[0], rings[1], paint((228, 230, 230)))
        top, foot = high - 0.03, low + 0.08
        page = np.array([(-0.32, lean(top) + 0.012, top), (0.32, lean(top) + 0.012, top),
                         (0.32, lean(foot) + 0.02, foot),
                         (-0.32, lean(foot) + 0.02, foot)])  # fmt: skip
        written = office.whiteboard(rng, 330, 240)[10:-10, 10:-10].copy()
        stand.surfaces.picture(stand.world(page), Material(written))
        y = lean(high)
        stand.box((-0.34, 0.34), (y - 0.03, y + 0.03), (high - 0.05, high + 0.01), metal)
        stand.box((-0.35, 0.35), (0.13, 0.21), (low - 0.01, low + 0.01), metal)
        for i in range(3):
            x = -0.2 + 0.14 * i
            tube(stand, (x, 0.18, low + 0.02), (x + 0.11, 0.18, low + 0.02), 0.01, paint(VIVID[i]))


def projector_screen(stand: Stand, look: Look) -> None:
    """Hang a pulled-down screen; sometimes a picture is thrown on it."""
    rng, low = stand.rng, float(stand.rng.uniform(0.85, 1.05))
    shown = patterns.plain(240, 340, (240, 240, 238))
    lit = bool(rng.random() < 0.4)
    if lit:
        slide = ink.poster(rng, 206, 300)
        shown[20:226, 20:320] = slide
    with stand.surfaces.thing("projector_screen"):
        face = Material(ink.framed(shown, (24, 24, 26), 9), glow=SCREEN_GLOW if lit else None)
        stand.box((-0.9, 0.9), (0.06, 0.07), (low, 2.18), DARK, front=face)
        stand.box((-0.98, 0.98), (0.014, 0.13), (2.16, 2.27), paint((232, 232, 230)))
        tube(stand, (-0.9, 0.065, low), (0.9, 0.065, low), 0.016, DARK)
        tube(stand, (0, 0.07, low), (0, 0.07, low - 0.12), 0.005, DARK)
        for x in (-0.99, 0.98):
            stand.box((x, x + 0.012), (0.012, 0.14), (2.15, 2.28), DARK)
