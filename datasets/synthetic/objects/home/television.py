"""Televisions on their stands."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.home.bookcases import book_row, slanting_legs
from roomgraph.datasets.synthetic.objects.home.laid import put_vase
from roomgraph.datasets.synthetic.objects.look import SCREEN_GLOW, Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns

__all__ = ["tv_stand"]

BLACK = (26, 26, 29)


def _television(stand: Stand, half: float, hung: bool) -> None:
    """Build a flat television above z = 0: on, or off with a pale reflection in it."""
    rng, tall, black = stand.rng, 1.125 * half, paint(BLACK)
    if rng.random() < 0.45:
        screen = Material(ink.photo(rng, 160, 284), glow=SCREEN_GLOW)
    else:
        sheen = np.linspace(0.9, -0.3, 284, dtype=np.float32)[None].repeat(160, axis=0)
        image = patterns.tint((34, 36, 42), sheen)
        cv2.fillPoly(image, [np.array([(20, 0), (90, 0), (20, 160), (0, 160)])], (58, 62, 70))
        screen = Material(image, shiny=True)
    low, y = (0.0, 0.03) if hung else (0.07, 0.12)
    with stand.surfaces.thing("tv"):
        stand.box((-half, half), (y, y + 0.035), (low, low + tall), black)
        inner = (0.012 - half, half - 0.012), (low + 0.018, low + tall - 0.012)
        stand.picture(*inner, y + 0.038, screen)
        stand.box((-0.02, 0.02), (y + 0.03, y + 0.04), (low + 0.004, low + 0.01), paint((150,) * 3))
        for x in () if hung else (-0.6 * half, 0.6 * half):
            stand.box((x - 0.02, x + 0.02), (0.05, 0.24), (0.0, 0.014), black)
            stand.box((x - 0.015, x + 0.015), (0.12, 0.15), (0.01, 0.08), black)


def tv_stand(stand: Stand, look: Look) -> None:
    """Build a low board with doors and open bays, and a big television on it or hung above."""
    rng, wood, half = stand.rng, look.wooden(stand.rng), float(stand.rng.uniform(0.7, 0.95))
    deep, low, high = 0.40, float(rng.uniform(0.10, 0.16)), float(rng.uniform(0.42, 0.54))
    face = paint(look.front) if rng.random() < 0.4 else wood
    kinds = [[1, 0, 1], [0, 1, 0], [1, 0, 0]][int(rng.integers(3))]
    with stand.surfaces.thing("tv_stand"):
        slanting_legs(stand, half, deep, low, wood)
        stand.box((-half, half), (0.012, 0.03), (low, high), wood)
        for up in (low, high - 0.025):
            stand.box((-half, half), (0.012, deep), (up, up + 0.025), wood)
        for share in (-1, -0.36, 0.33, 0.97):
            side = share * half
            stand.box((side, side + 0.022), (0.02, deep - 0.005), (low, high), wood)
        for i, kind in enumerate(kinds):
            x = (-0.97 + 0.66 * i) * half + 0.01, (-0.97 + 0.66 * (i + 1)) * half - 0.005
            if kind:
                wide, tall = (x[0] - 0.01, x[1] + 0.01), (low + 0.02, high - 0.02)
                stand.box(wide, (deep - 0.02, deep + 0.002), tall, face)
                grip = (x[0] + x[1]) / 2
                bar = (grip - 0.07, grip + 0.07), (deep, deep + 0.02), (high - 0.08, high - 0.065)
                stand.box(*bar, look.metallic())
                continue
            shelf = (low + high) / 2
            stand.box(x, (0.03, deep - 0.03), (shelf, shelf + 0.016), wood)
            box = (x[0] + 0.03, x[1] - 0.05), (0.1, deep - 0.07), (shelf + 0.016, shelf + 0.075)
            stand.box(*box, paint(BLACK))
            stand.box((x[0] + 0.05, x[0] + 0.07), (0.3, 0.335), (shelf + 0.03, shelf + 0.05), face)
            book_row(stand, (x[0] + 0.02, x[1] - 0.02), (low + 0.025, shelf), deep - 0.08)
        if rng.random() < 0.5:
            put_vase(stand.at(half - 0.09, 0.2, high))
    hung = bool(rng.random() < 0.4)
    _television(stand.at(0, 0, high + (0.25 if hung else 0)), float(rng.uniform(0.5, 0.68)), hung)
