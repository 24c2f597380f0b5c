"""Flasks, bottles and small meters on benches."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.laboratory.shared import PALE
from roomgraph.datasets.synthetic.objects.look import paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, instruments, patterns
from roomgraph.datasets.synthetic.textures import laboratory as drawn
from roomgraph.datasets.synthetic.textures.ink import VIVID
from roomgraph.datasets.synthetic.textures.patterns import Colour


def put_meters(stand: Stand, wide: float) -> None:
    """Stack one or two instruments."""
    rng, z = stand.rng, 0.01
    for _ in range(int(rng.integers(1, 3))):
        tall = float(rng.uniform(0.13, 0.2))
        front = Material(instruments.instrument(rng, int(420 * tall), int(420 * wide)))
        case = paint(patterns.pick(rng, instruments.CASES))
        stand.box((-wide / 2, wide / 2), (-0.18, 0.18), (z, z + tall), case, front=front)
        z += tall + 0.008


def put_flasks(stand: Stand) -> None:
    """Put flasks with coloured liquids, and a rack of tubes."""
    rng = stand.rng
    for x in (-0.12, 0.0, 0.12):
        y, r = float(rng.uniform(-0.1, 0.02)), float(rng.uniform(0.045, 0.058))
        skin = patterns.plain(60, 64, (214, 226, 230))
        skin[int(rng.integers(36, 48)) :] = patterns.pick(rng, drawn.LIQUIDS)
        lathe(stand, (x, y), [(r, 0), (0.018, 0.13), (0.02, 0.185)], Material(skin), sides=8)
    stand.box((-0.13, 0.13), (0.13, 0.18), (0.0, 0.015), PALE)
    stand.box((-0.13, 0.13), (0.13, 0.18), (0.06, 0.07), PALE)
    for i in range(5):
        x, colour = -0.1 + 0.05 * i, patterns.pick(rng, drawn.LIQUIDS)
        tube(stand, (x, 0.155, 0.015), (x, 0.155, 0.12), 0.01, paint(colour), sides=4)


def put_bottles(stand: Stand, half: float) -> None:
    """Put a row of bottles of chemicals, with labels, on a shelf."""
    rng, x = stand.rng, -half + 0.12
    while x < half - 0.08:
        r, tall = float(rng.uniform(0.035, 0.05)), float(rng.uniform(0.14, 0.22))
        glass: tuple[Colour, ...] = ((96, 56, 24), (226, 230, 230), (40, 80, 60), (240, 240, 236))
        skin = patterns.plain(60, 96, patterns.pick(rng, glass))
        skin[18:50, 8:40] = skin[18:50, 56:88] = (246, 244, 236)
        ink.lines(rng, skin, (60, 30, 86, 48), 5)
        skin[21:29, 60:68] = patterns.pick(rng, VIVID)
        profile = [(r, 0), (r, 0.72 * tall), (0.4 * r, 0.85 * tall)]
        lathe(stand, (x, 0), profile, Material(skin), sides=8)
        cap = paint(patterns.pick(rng, VIVID))
        tube(stand, (x, 0, 0.83 * tall), (x, 0, tall), 0.5 * r, cap, sides=4)
        x += 2 * r + float(rng.uniform(0.08, 0.36))
