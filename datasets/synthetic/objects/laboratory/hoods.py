"""Fume hoods."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.laboratory.glassware import put_flasks
from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, PALE, STEEL, TOPS, UNITS
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import laboratory as drawn
from roomgraph.datasets.synthetic.textures import patterns

__all__ = ["fume_hood"]


def fume_hood(stand: Stand, look: Look) -> None:
    """Build a fume hood: cupboard, lit working space with glass, sash, duct to the ceiling."""
    rng, half = stand.rng, float(stand.rng.uniform(0.6, 0.8))
    colour, sash = patterns.pick(rng, UNITS), float(rng.uniform(1.2, 1.45))
    body = paint(colour)
    with stand.surfaces.thing("fume_hood"):
        front = Material(drawn.bench_unit(rng, 200, 160, colour))
        for x in ((-half, 0.0), (0.0, half)):
            stand.box(x, (0.01, 0.72), (0.0, 0.82), body, front=front)
        stand.box((-half, half), (0.01, 0.82), (0.82, 0.88), paint(patterns.pick(rng, TOPS)))
        for left in (-half, half - 0.14):
            stand.box((left, left + 0.14), (0.01, 0.78), (0.88, 1.75), body)
            for i, valve in enumerate(((210, 60, 50), (60, 110, 200), (230, 190, 40))):
                at = (left + 0.07, 1.0 + 0.08 * i)
                tube(stand, (at[0], 0.78, at[1]), (at[0], 0.81, at[1]), 0.02, paint(valve))
            stand.picture((left + 0.03, left + 0.11), (1.3, 1.42), 0.783, PALE)
        slots = patterns.plain(120, 160, (206, 210, 210))
        slots[20:26, 8:152], slots[94:100, 8:152] = (60, 62, 66), (60, 62, 66)
        stand.picture((-half + 0.14, half - 0.14), (0.88, 1.75), 0.12, Material(slots))
        put_flasks(stand.at(-0.15, 0.45, 0.88))
        _clamp(stand.at(0.25, 0.4, 0.88))
        stand.box((-half, half), (0.01, 0.78), (1.75, 2.2), body)
        sign = Material(drawn.warning(rng, 110))
        stand.picture((-0.1, 0.1), (1.88, 2.08), 0.783, sign)
        _sash(stand, half - 0.14, sash)
        lathe(stand, (0, 0.36), [(0.2, 2.2), (0.15, 2.3), (0.15, 2.57)], STEEL)


def _sash(stand: Stand, half: float, low: float) -> None:
    """Let the hood's pane down to a height: its glass mirrors a little, its frame has a grip."""
    pane = patterns.plain(60, 120, (150, 172, 174))
    for x in (20, 34, 84):
        cv2.line(pane, (x, 60), (x + 26, 0), (196, 210, 212), 7, cv2.LINE_AA)
    glass = Material(pane, shiny=True)
    stand.box((-half, half), (0.7, 0.71), (low, 1.75), glass, front=glass)
    stand.box((-half, half), (0.69, 0.74), (low - 0.03, low + 0.02), STEEL)
    stand.box((-0.15, 0.15), (0.74, 0.765), (low - 0.02, low + 0.005), DARK)
    stand.box((-0.012, 0.012), (0.69, 0.725), (low, 1.75), STEEL)


def _clamp(stand: Stand) -> None:
    """Put a stand that holds a round flask over a burner."""
    stand.box((-0.08, 0.08), (-0.1, 0.1), (0, 0.015), DARK)
    tube(stand, (0, -0.08, 0), (0, -0.08, 0.55), 0.008, STEEL)
    tube(stand, (0, -0.08, 0.34), (0, 0.02, 0.34), 0.007, STEEL)
    flask = [(0.02, 0.16), (0.06, 0.2), (0.055, 0.25), (0.018, 0.29), (0.018, 0.38)]
    lathe(stand, (0, 0.03), flask, paint(patterns.pick(stand.rng, drawn.LIQUIDS)), sides=8)
    tube(stand, (0, 0.03, 0.015), (0, 0.03, 0.13), 0.014, STEEL)
