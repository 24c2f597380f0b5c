"""Towels on rails, and mats."""

from __future__ import annotations

import cv2

from roomgraph.datasets.synthetic.objects.bathroom.shared import CHROME, TOWELS, WHITE
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns

__all__ = ["bath_mat", "towel_rail"]


def _towel(stand: Stand, x: tuple[float, float], z: tuple[float, float], y: float) -> None:
    rng = stand.rng
    image = patterns.cloth(rng, 120, 90, patterns.pick(rng, TOWELS, 20))
    for top in (8, 96, 104):
        image[top : top + 4] = patterns.pick(rng, TOWELS)
    with stand.surfaces.thing("towel"):
        stand.box(x, (y - 0.03, y + 0.03), z, Material(image[30:60]), front=Material(image))


def towel_rail(stand: Stand, look: Look) -> None:
    """Build a rail or a heated ladder with towels over it."""
    rng, metal = stand.rng, WHITE if stand.rng.random() < 0.5 else CHROME
    with stand.surfaces.thing("towel_rail"):
        if rng.random() < 0.5:
            for x in (-0.24, 0.24):
                tube(stand, (x, 0.06, 0.55), (x, 0.06, 1.65), 0.018, metal)
                tube(stand, (x, 0.012, 1.5), (x, 0.06, 1.5), 0.012, metal, sides=4)
            for k in range(13):
                z = 0.6 + 0.075 * k + 0.06 * (k // 5)
                tube(stand, (-0.24, 0.06, z), (0.24, 0.06, z), 0.011, metal, sides=4)
            _towel(stand, (-0.2, float(rng.uniform(0.0, 0.2))), (0.85, 1.37), 0.065)
        else:
            tube(stand, (-0.4, 0.08, 1.25), (0.4, 0.08, 1.25), 0.012, metal)
            for x in (-0.38, 0.38):
                tube(stand, (x, 0.012, 1.25), (x, 0.08, 1.25), (0.025, 0.012), metal)
            for x in (-0.33, 0.03):
                wide = float(rng.uniform(0.24, 0.3))
                _towel(stand, (x, x + wide), (float(rng.uniform(0.65, 0.9)), 1.268), 0.08)


def bath_mat(stand: Stand, look: Look) -> None:
    """Lay a tufted mat on the floor."""
    rng, colour = stand.rng, patterns.pick(stand.rng, TOWELS, 20)
    image = patterns.tint(colour, 0.5 * patterns.noise(rng, 110, 170, (4, 4)))
    for inset in (9, 14):
        edge = patterns.shift(rng, colour, 60)
        cv2.rectangle(image, (inset, inset), (169 - inset, 109 - inset), edge, 3)
    with stand.surfaces.thing("bath_mat"):
        stand.sheet((-0.4, 0.4), (-0.26, 0.26), 0.004, Material(image))
