"""Bottles and glasses."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import lathe, loft, ring
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

__all__ = ["bottle", "wine_glass"]

DRINKS: tuple[tuple[Colour, Colour], ...] = (
    ((30, 60, 34), (238, 230, 208)), ((70, 30, 26), (226, 196, 120)),
    ((176, 206, 222), ink.VIVID[1]),
    ((206, 170, 60), (60, 90, 44)), ((232, 232, 228), ink.VIVID[0]), ((110, 60, 24), ink.VIVID[7]),
)  # fmt: skip


def flask(
    stand: Stand, tall: float, wide: float, colours: tuple[Colour, Colour], cap: Colour
) -> None:
    """Build a bottle of shampoo, soap or oil: body with a label, shoulder, cap."""
    image = patterns.plain(64, 96, colours[0])
    cv2.rectangle(image, (0, 16), (95, 50), colours[1], -1)
    dark = (40, 40, 46) if sum(colours[1]) > 380 else (244, 242, 236)
    for x in (0, 48):
        ink.write(image, ink.word(stand.rng), (x + 3, 18, x + 45, 34), dark)
        ink.lines(stand.rng, image, (x + 6, 38, x + 42, 48), 4, dark)
    body = [ring((0, 0, z), (wide, 0.7 * wide), sides=8, corner=0.7) for z in (0.0, 0.78 * tall)]
    shoulder = ring((0, 0, 0.85 * tall), (0.5 * wide, 0.45 * wide), sides=8)
    loft(stand, body, Material(image), closed=False)
    loft(stand, [body[1], shoulder], paint(colours[0]))
    lathe(stand, (0, 0), [(0.55 * wide, 0.84 * tall), (0.5 * wide, tall)], paint(cap), sides=6)


def bottle(stand: Stand, look: Look) -> None:
    """Build a bottle of wine, water or oil, with its label and cap."""
    rng = stand.rng
    glass, label = DRINKS[int(rng.integers(len(DRINKS)))]
    image = patterns.plain(96, 128, patterns.shift(rng, glass, 8))
    image[:, 24:36] = [(c + 220) // 2 for c in glass]
    for x in (0, 64):
        cv2.rectangle(image, (x + 4, 22), (x + 58, 82), label, -1)
        dark = (36, 32, 36) if sum(label) > 380 else (246, 244, 236)
        ink.write(image, ink.word(rng), (x + 8, 28, x + 54, 48), dark)
        ink.lines(rng, image, (x + 10, 54, x + 52, 78), 6, dark)
    tall, wide = float(rng.uniform(0.27, 0.33)), float(rng.uniform(0.034, 0.042))
    plain = paint(glass)
    with stand.surfaces.thing("bottle"):
        lathe(stand, (0, 0), [(wide, 0), (wide, 0.58 * tall)], Material(image), sides=16)
        neck = [(wide, 0.58 * tall), (0.42 * wide, 0.74 * tall), (0.36 * wide, 0.92 * tall)]
        lathe(stand, (0, 0), neck, plain, sides=16)
        top = [(0.42 * wide, 0.89 * tall), (0.42 * wide, tall)]
        lathe(stand, (0, 0), top, paint(patterns.pick(rng, ink.VIVID)), sides=6)


def wine_glass(stand: Stand, look: Look) -> None:
    """Build a wine glass, empty or half full."""
    rng = stand.rng
    clear = Material(patterns.plain(16, 16, (206, 220, 226)), 8.0, 8.0, shiny=True)
    wine = patterns.pick(rng, ((110, 20, 36), (226, 206, 120), (198, 212, 218)))
    with stand.surfaces.thing("wine_glass"):
        foot = [(0.034, 0.0), (0.03, 0.004), (0.004, 0.012), (0.004, 0.085)]
        lathe(stand, (0, 0), foot, clear, sides=8)
        full = [(0.004, 0.085), (0.030, 0.105), (0.040, 0.14)]
        lathe(stand, (0, 0), full, paint(wine), sides=8)
        lathe(
            stand,
            (0, 0),
            [(0.040, 0.14), (0.033, 0.20), (0.030, 0.20), (0.037, 0.142)],
            clear,
            sides=8,
        )
