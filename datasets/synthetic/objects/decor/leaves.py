"""Leaves and pots, which plants are made of."""

from __future__ import annotations

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.decor.colours import WHITE
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad
from roomgraph.datasets.synthetic.rendering.shapes import Point, lathe
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import finishes, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain


def draw_leaf(rng: np.random.Generator, colour: Colour) -> Material:
    """Draw a leaf for a kite: its rib runs from the image's top left to its bottom right."""
    image = patterns.tint(colour, 0.35 * patterns.noise(rng, 40, 40, (9, 9)))
    light: Colour = (min(colour[0] + 70, 255), min(colour[1] + 60, 255), min(colour[2] + 50, 255))
    cv2.line(image, (0, 0), (39, 39), light, 2, cv2.LINE_AA)
    for at in range(6, 36, 8):
        for end in ((at + 12, at), (at, at + 12)):
            cv2.line(image, (at, at), end, patterns.shift(rng, light, 20), 1, cv2.LINE_AA)
    return Material(image)


def kite(stand: Stand, root: Point, tip: Point, width: float, leaf: Material) -> None:
    """Add a leaf: a kite from its root to its tip, as level across as it can be."""
    a, b = np.array(root), np.array(tip)
    aside = np.cross(b - a, (0.0, 0.0, 1.0))
    aside = aside / max(float(np.linalg.norm(aside)), 1e-6) * width / 2
    middle = a + 0.45 * (b - a)
    corners = stand.world(np.array([a, middle - aside, b, middle + aside]))
    stand.surfaces.quads.append(Quad(corners, leaf))


def put_pot(stand: Stand, look: Look, radius: float, tall: float) -> None:
    """Add a pot with earth in it: clay, glazed, painted or a basket."""
    rng, kind = stand.rng, int(stand.rng.integers(4))
    image = plain(16, 16, pick(rng, ((176, 92, 58), WHITE, look.accent, (60, 62, 66))))
    if kind == 0:
        image = finishes.cane(rng, 80, 240, (196, 160, 104))
    elif kind == 1:
        image = plain(64, 16, pick(rng, ((186, 100, 66), (170, 84, 52))))
        image[12:15] = (120, 58, 36)
    profile = [(0.78 * radius, 0.0), (radius, tall), (0.9 * radius, tall),
               (0.86 * radius, tall - 0.2 * radius)]  # fmt: skip
    lathe(stand, (0.0, 0.0), profile, Material(image), sides=10)
    earth = Material(patterns.tint((62, 46, 36), patterns.noise(rng, 32, 32, (3, 3))))
    reach = 0.62 * radius
    stand.sheet((-reach, reach), (-reach, reach), tall - 0.18 * radius, earth)


def turned(angle: float, reach: float, z: float) -> Point:
    """Return the point at a direction and a distance from the middle, at a height."""
    return reach * float(np.cos(angle)), reach * float(np.sin(angle)), z
