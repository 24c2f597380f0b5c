"""Benches along walls and in the middle, with what is worked with."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.objects.laboratory.glassware import (
    put_bottles,
    put_flasks,
    put_meters,
)
from roomgraph.datasets.synthetic.objects.laboratory.instruments import (
    centrifuge,
    microscope,
    oscilloscope,
)
from roomgraph.datasets.synthetic.objects.laboratory.shared import DARK, PALE, STEEL, TOPS, UNITS
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import laboratory as drawn
from roomgraph.datasets.synthetic.textures import patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["lab_bench", "lab_island"]


def lab_bench(stand: Stand, look: Look, width: float = 2.4) -> None:
    """Build a bench along a wall, with instruments and glass, and bottles on shelves above."""
    half, colour = width / 2, patterns.pick(stand.rng, UNITS)
    with stand.surfaces.thing("lab_bench"):
        _units(stand, half, colour)
        top = paint(patterns.pick(stand.rng, TOPS))
        stand.box((-half, half), (0.0, 0.72), (0.86, 0.9), top)
        stand.box((-half, half), (0.0, 0.02), (0.9, 1.0), top)
        _apparatus(stand.at(0, 0, 0.9), look, half)
        for x in (-half + 0.02, half - 0.06):
            stand.box((x, x + 0.04), (0.0, 0.05), (0.9, 1.95), STEEL)
        for z in (1.38, 1.7):
            stand.box((-half, half), (0.014, 0.27), (z - 0.02, z), PALE)
        put_bottles(stand.at(0, 0.14, 1.38), half)
        row = Material(drawn.glassware(stand.rng, 80, int(260 * width)))
        stand.picture((-half + 0.02, half - 0.02), (1.7, 2.0), 0.2, row)


def _units(stand: Stand, half: float, colour: Colour) -> None:
    """Build a row of drawer units with a gap for the knees."""
    count, body = max(2, round(half / 0.3)), paint(colour)
    gap = int(stand.rng.integers(1, count - 1)) if count > 2 else -1
    for i in range(count):
        x = (-half + 2 * half * i / count, -half + 2 * half * (i + 1) / count)
        if i == gap:
            stand.box(x, (0.02, 0.05), (0.3, 0.86), body)
            continue
        front = Material(drawn.bench_unit(stand.rng, 200, 160, colour))
        stand.box(x, (0.02, 0.66), (0.08, 0.86), body, front=front)
        stand.box(x, (0.06, 0.6), (0.0, 0.08), DARK)


def _apparatus(stand: Stand, look: Look, half: float) -> None:
    """Put instruments, a microscope and glass side by side on a bench."""
    rng, x = stand.rng, -half + 0.08
    kinds = ["microscope", *rng.permutation(["meter", "glass", "centrifuge", "scope", "meter"])]
    if half > 0.8:
        kinds.insert(int(rng.integers(1, 4)), "glass")
    kinds = list(np.roll(kinds, int(rng.integers(len(kinds)))))
    for kind in kinds:
        wide = {"meter": float(rng.uniform(0.32, 0.46)), "glass": 0.36}.get(kind, 0.38)
        if x + wide > half - 0.04:
            continue
        place = stand.at(x + wide / 2, 0.34, 0, float(rng.uniform(-0.15, 0.15)))
        if kind == "meter":
            put_meters(place, wide)
        elif kind == "glass":
            put_flasks(place)
        else:
            model = {"microscope": microscope, "scope": oscilloscope}.get(kind, centrifuge)
            model(place, look)
        x += wide + float(rng.uniform(0.03, 0.12))


def lab_island(stand: Stand, look: Look) -> None:
    """Build a double bench in the middle of a room, with a shelf along its middle."""
    rng, half = stand.rng, float(stand.rng.uniform(0.9, 1.2))
    colour, top = patterns.pick(rng, UNITS), paint(patterns.pick(rng, TOPS))
    with stand.surfaces.thing("lab_island"):
        stand.box((-half - 0.02, half + 0.02), (-0.74, 0.74), (0.86, 0.9), top)
        for turn in (0.0, np.pi):
            side = stand.at(0, 0, 0, turn)
            _units(side, half, colour)
            _apparatus(side.at(0, 0.08, 0.9), look, half)
        for x in (-half + 0.05, half - 0.09):
            stand.box((x, x + 0.04), (-0.03, 0.03), (0.9, 1.5), STEEL)
        stand.box((-half, half), (-0.04, 0.04), (0.9, 0.98), PALE)
        stand.box((-half, half), (-0.14, 0.14), (1.34, 1.36), PALE)
        put_bottles(stand.at(0, 0, 1.36), half)
