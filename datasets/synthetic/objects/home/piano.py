"""Pianos."""

from __future__ import annotations

from roomgraph.datasets.synthetic.objects.home.laid import put_fruit_bowl, put_vase
from roomgraph.datasets.synthetic.objects.home.television import BLACK
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import cushion, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns

__all__ = ["piano"]


def _keys(stand: Stand) -> Material:
    """Return a piano's keys from above, four octaves of them."""
    image = patterns.plain(44, 448, (240, 238, 230))
    for i in range(28):
        image[:, 16 * i] = (90, 88, 84)
        if i % 7 not in (2, 6):
            image[:27, 16 * i + 11 : 16 * i + 21] = (18, 18, 20)
    return Material(image)


def piano(stand: Stand, look: Look) -> None:
    """Build an upright piano with its keys, music, pedals, and mostly a bench before it."""
    rng, high, half = stand.rng, float(stand.rng.uniform(1.12, 1.26)), 0.74
    colour = patterns.pick(rng, ((28, 27, 28), (28, 27, 28), (90, 48, 30), (132, 84, 50)), 6)
    sheen = Material(patterns.wood(rng, 120, 240, colour, 0.5), 1.5, 0.8)
    brass, y = paint((196, 160, 80)), 0.36
    with stand.surfaces.thing("piano"):
        stand.box((-half, half), (0.012, y), (0.0, high), sheen)
        stand.box((-half - 0.02, half + 0.02), (0.012, y + 0.03), (high, high + 0.03), sheen)
        stand.box((-half, half), (y, 0.62), (0.60, 0.66), sheen)
        for x in (-half, half - 0.07):
            cushion(stand, (x, x + 0.07), (y, 0.63), (0.66, 0.80), sheen, bevel=0.03)
            stand.box((x, x + 0.07), (0.53, 0.60), (0.0, 0.60), sheen)
            stand.box((x, x + 0.07), (y, 0.64), (0.0, 0.06), sheen)
        stand.box((0.07 - half, half - 0.07), (y, 0.42), (0.66, 0.78), sheen)
        board = (0.07 - half, half - 0.07), (0.43, 0.595), (0.66, 0.70)
        stand.box(*board, paint((232, 230, 222)), top=_keys(stand))
        stand.box(board[0], (0.42, 0.432), (0.66, 0.708), paint((140, 30, 36)))
        for x in (-0.55, 0.05) if rng.random() < 0.5 else ():
            stand.box((x, x + 0.5), (y, y + 0.012), (0.86, high - 0.06), sheen)
        stand.box((-0.35, 0.35), (y, y + 0.05), (0.82, 0.84), sheen)
        for x in (-0.2, 0.01):
            sheet = Material(ink.sheet(rng, 110, 76))
            stand.box(
                (x, x + 0.2), (y + 0.012, y + 0.016), (0.84, 1.1), paint((236,) * 3), front=sheet
            )
        for x in (-0.09, 0.0, 0.09):
            stand.box((x - 0.016, x + 0.016), (y, y + 0.11), (0.04, 0.055), brass)
        (put_vase if rng.random() < 0.4 else put_fruit_bowl)(stand.at(0.5, 0.18, high + 0.03))
    if rng.random() < 0.7:
        with stand.surfaces.thing("stool"):
            pad = paint(BLACK) if rng.random() < 0.5 else look.woven(rng)
            cushion(stand, (-0.3, 0.3), (0.74, 1.06), (0.42, 0.50), pad)
            stand.box((-0.29, 0.29), (0.75, 1.05), (0.36, 0.42), sheen)
            for x in (-0.26, 0.26):
                for z in (0.78, 1.02):
                    tube(stand, (x, z, 0.37), (x, z, 0.0), (0.026, 0.016), sheen)
