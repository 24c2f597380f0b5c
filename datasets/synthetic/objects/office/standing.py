"""What stands about in offices: bins, coat stands, partitions."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.look import FABRICS, Look, paint
from roomgraph.datasets.synthetic.objects.office.shared import astray
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns

__all__ = ["coat_stand", "partition_screen", "waste_bin"]


def waste_bin(stand: Stand, look: Look) -> None:
    """Build an open waste bin with crumpled paper in it."""
    rng, tall = stand.rng, float(stand.rng.uniform(0.28, 0.36))
    outside = patterns.plain(
        60, 240, patterns.pick(rng, ((40, 42, 46), (120, 124, 128), look.accent))
    )
    if rng.random() < 0.5:
        # A bin of wire mesh.
        outside[::4], outside[:, ::4] = (18, 18, 20), (18, 18, 20)
    wide = float(rng.uniform(0.13, 0.16))
    with stand.surfaces.thing("waste_bin"):
        rim = [(0.78 * wide, 0), (wide, tall - 0.015), (wide + 0.008, tall), (wide - 0.012, tall)]
        lathe(stand, (0, 0), [*rim, (0.85 * wide, 0.62 * tall)], Material(outside))
        for _ in range(int(rng.integers(3, 7))):
            x, y, r = (
                astray(rng, 0.5 * wide),
                astray(rng, 0.5 * wide),
                float(rng.uniform(0.03, 0.05)),
            )
            z, paper = 0.68 * tall + astray(rng, 0.03), patterns.shift(rng, (232, 230, 222), 16)
            ball = [(0.6 * r, z), (r, z + 0.7 * r), (0.9 * r, z + 1.3 * r), (0.4 * r, z + 1.8 * r)]
            lathe(stand, (x, y), ball, paint(paper), sides=6)


def coat_stand(stand: Stand, look: Look) -> None:
    """Build a coat stand with a few coats on it."""
    rng, tall = stand.rng, float(stand.rng.uniform(1.68, 1.85))
    pole = look.wooden(rng) if rng.random() < 0.5 else look.metallic()
    with stand.surfaces.thing("coat_stand"):
        tube(stand, (0, 0, 0.02), (0, 0, tall), 0.02, pole, sides=8)
        stand.footprint((-0.28, 0.28), (-0.28, 0.28))
        lathe(stand, (0, 0), [(0.03, tall), (0.04, tall + 0.03), (0, tall + 0.07)], pole, sides=8)
        for angle in np.arange(4) * np.pi / 2 + 0.4:
            c, s = float(np.cos(angle)), float(np.sin(angle))
            tube(stand, (0, 0, 0.2), (0.27 * c, 0.27 * s, 0.015), 0.016, pole)
            tube(stand, (0, 0, tall - 0.1), (0.14 * c, 0.14 * s, tall - 0.06), 0.011, pole, sides=4)
            tube(stand, (0.14 * c, 0.14 * s, tall - 0.06), (0.15 * c, 0.15 * s, tall), 0.011, pole,
                 sides=4)  # fmt: skip
        first = float(rng.uniform(-0.6, 0.6))
        for i in range(int(rng.integers(2, 4))):
            _coat(stand.at(0, 0, tall - 0.08, first + i * 2 * np.pi / 3), look)


def _coat(stand: Stand, look: Look) -> None:
    """Hang a coat up in front of the pole: body in folds, collar, sleeves."""
    rng, colour = stand.rng, patterns.pick(stand.rng, (*FABRICS, look.accent), 24)
    cloth = patterns.cloth(rng, 120, 240, colour)
    # Folds run down the cloth; the open front is a dark line.
    cloth[:] = np.clip(cloth * (1 + 0.16 * np.sin(np.arange(240) * 0.42))[None, :, None], 0, 255)
    cloth[25:, 58:61] = 20
    long = float(rng.uniform(0.75, 1.15))
    body = Material(cloth)
    levels = [(0.2, -long), (0.19, -0.6), (0.2, -0.22), (0.16, -0.1), (0.08, -0.04), (0.06, 0.0)]
    with stand.surfaces.thing("coat"):
        lathe(stand, (0, 0.15), levels, body, sides=10, stretch=0.5)
        for side in (-1, 1):
            elbow = (0.23 * side, 0.15, -0.45)
            tube(stand, (0.16 * side, 0.15, -0.14), elbow, 0.058, body)
            tube(stand, elbow, (0.22 * side, 0.18, -0.7), (0.055, 0.05), body)


def partition_screen(stand: Stand, look: Look, width: float = 1.6) -> None:
    """Build an office divider: cloth panels in a metal frame on feet."""
    rng, half, metal = stand.rng, width / 2, look.metallic()
    count, cloth = max(1, round(width / 0.8)), look.woven(rng)
    with stand.surfaces.thing("partition_screen"):
        for i in range(count):
            left, right = (-half + (i + k) * width / count for k in (0, 1))
            stand.box((left + 0.02, right - 0.02), (-0.025, 0.025), (0.12, 1.37), cloth)
        for i in range(count + 1):
            x = -half + i * width / count
            stand.box((x - 0.02, x + 0.02), (-0.032, 0.032), (0.0, 1.4), metal)
            stand.box((x - 0.03, x + 0.03), (-0.22, 0.22), (0, 0.025), metal)
        for z in (0.09, 1.37):
            stand.box((-half, half), (-0.032, 0.032), (z, z + 0.03), metal)
        for turn in (0.0, np.pi):
            for _ in range(int(rng.integers(1, 4))):
                x, z = astray(rng, half - 0.25), float(rng.uniform(0.8, 1.0))
                note = Material(ink.sheet(rng, 150, 106))
                stand.at(0, 0, 0, turn).picture((x, x + 0.21), (z, z + 0.297), 0.034, note)
