"""Windows: the view, the frame, the sill, the daylight that comes in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.rendering.lighting import WINDOW
from roomgraph.datasets.synthetic.rendering.mesh import Glow, Lamp, Material
from roomgraph.datasets.synthetic.structure.faces import Face
from roomgraph.datasets.synthetic.textures import patterns, signs

GLOW: Glow = (1.25, 0.0, 0.04, 0.05)


@dataclass(frozen=True, slots=True)
class Window:
    """Where a window is in a wall: along it and upwards, metres."""

    begin: float
    end: float
    sill: float
    head: float


def place_windows(face: Face, ceiling_m: float, rng: np.random.Generator) -> list[Window]:
    """Choose the windows of an outer wall: one or several in a row, or none."""
    if face.gaps or face.length < 1.6:
        return []
    sill = float(rng.choice((0.3, 0.85, 0.95, 1.1)))
    head = min(ceiling_m - 0.25, sill + float(rng.uniform(1.1, 1.6)))
    count = 1 if face.length < 3 else int(rng.integers(1, 1 + int(face.length / 1.5)))
    width = min(float(rng.uniform(0.9, 1.8)), 0.85 * face.length / count)
    step = face.length / count
    middles = [(i + 0.5) * step for i in range(count)]
    return [Window(m - width / 2, m + width / 2, sill, head) for m in middles]


def build_window(face: Face, window: Window, rng: np.random.Generator, power: float) -> None:
    """Build a window's view, bars and sill; daylight comes in with a power."""
    stand, width = face.stand, window.end - window.begin
    view = signs.outside(rng, 300, int(220 * width))
    x, z = (window.begin, window.end), (window.sill, window.head)
    white = Material(patterns.plain(8, 8, patterns.shift(rng, (236, 236, 232), 6)), 4.0, 4.0)
    with stand.surfaces.thing("window"):
        # No depth camera sees the pane.
        stand.picture(x, z, 0.008, Material(view, shiny=True, glow=GLOW))
        bars = int(rng.integers(1, 3)) if width > 1.1 else 1
        for share in np.linspace(0, 1, bars + 2):
            middle = x[0] + float(share) * width
            stand.box((middle - 0.03, middle + 0.03), (0.0, 0.045), z, white)
        for level in z:
            stand.box((x[0], x[1]), (0.0, 0.045), (level - 0.03, level + 0.03), white)
        stand.box((x[0] - 0.05, x[1] + 0.05), (0.0, 0.14), (z[0] - 0.07, z[0] - 0.03), white)
    inwards = stand.world([(0, 1, 0)])[0] - stand.world([(0, 0, 0)])[0]
    for share in (0.25, 0.75):
        at = stand.world([(x[0] + share * width, 0.1, (z[0] + z[1]) / 2 + 0.1)])[0]
        direction = float(inwards[0]), float(inwards[1]), float(inwards[2])
        position = float(at[0]), float(at[1]), float(at[2])
        stand.surfaces.lamps.append(Lamp(position, direction, power * width / 2, WINDOW))
