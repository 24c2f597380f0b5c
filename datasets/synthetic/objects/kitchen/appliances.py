"""Large machines: dishwashers and refrigerators."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.kitchen.shared import DARK, STEEL
from roomgraph.datasets.synthetic.objects.look import Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Generator

__all__ = ["dishwasher", "refrigerator"]


def dish_front(rng: Generator) -> Image:
    """Draw a dishwasher's front: a panel with buttons and a display, a door with a handle."""
    white = patterns.plain(220, 160, (238, 239, 239))
    image = white if rng.random() < 0.5 else patterns.steel(rng, 220, 160)
    cv2.rectangle(image, (0, 0), (159, 30), patterns.pick(rng, ((60, 62, 66), (206, 208, 210))), -1)
    cv2.rectangle(image, (60, 7), (100, 24), (14, 16, 20), -1)
    ink.write(image, "0:45", (63, 8, 97, 23), (255, 120, 80))
    for x in (14, 28, 42, 114, 128, 142):
        cv2.circle(image, (x, 15), 4, (150, 154, 158), -1, cv2.LINE_AA)
    cv2.line(image, (0, 32), (159, 32), (40, 40, 42), 2)
    cv2.rectangle(image, (1, 1), (158, 218), (110, 112, 116), 2)
    ink.write(image, ink.word(rng).upper(), (60, 40, 100, 52), (90, 92, 100))
    return image


def dishwasher(stand: Stand, look: Look) -> None:
    """Build a dishwasher that stands by itself."""
    with stand.surfaces.thing("dish_washer"):
        front = Material(dish_front(stand.rng))
        stand.box((-0.3, 0.3), (0.02, 0.56), (0.0, 0.10), DARK)
        stand.box((-0.3, 0.3), (0.02, 0.60), (0.10, 0.85), paint((236, 237, 237)), front=front)
        tube(stand, (-0.22, 0.63, 0.71), (0.22, 0.63, 0.71), 0.012, STEEL)
        for x in (-0.2, 0.2):
            tube(stand, (x, 0.6, 0.71), (x, 0.63, 0.71), 0.010, STEEL, sides=4)


def refrigerator(stand: Stand, look: Look) -> None:
    """Build a refrigerator, white, coloured or of steel, with two doors, handles and magnets."""
    rng, tall = stand.rng, float(stand.rng.uniform(1.6, 2.0))
    wide, deep = float(rng.uniform(0.29, 0.36)), float(rng.uniform(0.58, 0.68))
    split = tall * float(rng.choice([0.33, 0.40, 0.68]))
    steel = bool(rng.random() < 0.35)
    colour = patterns.pick(rng, ((238, 238, 235), (226, 222, 205), (170, 206, 200), (176, 50, 46)))
    body = Material(patterns.steel(rng, 300, 120), 0.9, 2.2) if steel else paint(colour)
    with stand.surfaces.thing("refrigerator"):
        stand.box((-wide, wide), (0.02, deep - 0.07), (0.03, tall), body)
        stand.box((-wide + 0.02, wide - 0.02), (0.05, deep - 0.1), (0.0, 0.06), DARK)
        for z in ((0.06, split - 0.006), (split + 0.006, tall)):
            stand.box((-wide, wide), (deep - 0.06, deep), z, body)
            reach = min(0.45, 0.6 * (z[1] - z[0]))
            low = z[1] - reach - 0.04 if z[0] < 0.1 else z[0] + 0.04
            x, y = -wide + 0.05, deep + 0.035
            tube(stand, (x, y, low), (x, y, low + reach), 0.012, STEEL if not steel else DARK)
            for end in (low + 0.02, low + reach - 0.02):
                tube(stand, (x, deep, end), (x, y, end), 0.010, STEEL, sides=4)
        for _ in range(int(rng.integers(0, 3)) if steel else int(rng.integers(1, 8))):
            at, up = float(rng.uniform(-0.15, wide - 0.15)), float(rng.uniform(0.9, tall - 0.2))
            if abs(up - split) > 0.1:
                note = ink.photo(rng, 48, 40) if rng.random() < 0.5 else ink.sheet(rng, 56, 40)
                cv2.circle(note, (20, 4), 4, patterns.pick(rng, ink.VIVID), -1, cv2.LINE_AA)
                note_x, note_z = (at, at + 0.12), (up - 0.08, up + 0.08)
                stand.picture(note_x, note_z, deep + 0.003, Material(note))
