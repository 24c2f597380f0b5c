"""Coats, shoes and umbrellas with what holds them."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import FABRICS, Look, paint
from roomgraph.datasets.synthetic.objects.service.panels import DARK, LEATHERS, WHITE
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick

__all__ = ["coat_rack", "shoe_rack", "umbrella_stand"]


def _coat(stand: Stand, x: float, top: float, colour: Colour) -> None:
    """Hang a coat with sleeves, zip and pockets from a hook."""
    rng, length = stand.rng, float(stand.rng.uniform(0.72, 1.05))
    image = patterns.cloth(rng, 128, 256, colour)
    dark: Colour = (colour[0] // 2, colour[1] // 2, colour[2] // 2)
    # The front is where the second of eight sides begins to face the viewer: 13/16 of the way.
    cv2.line(image, (208, 0), (208, 128), dark, 2)
    for button in range(30, 120, 22):
        cv2.circle(image, (214, button), 2, (206, 200, 186), -1)
    for pocket in (188, 228):
        cv2.line(image, (pocket - 5, 84), (pocket + 5, 80), dark, 2)
    cloth = Material(image)
    with stand.surfaces.thing("coat"):
        profile = [(0.20, top - length), (0.17, top - 0.5), (0.20, top - 0.14), (0.07, top - 0.02)]
        lathe(stand, (x, 0.14), profile, cloth, sides=8, stretch=0.5)
        lathe(stand, (x, 0.14), [(0.08, top - 0.05), (0.06, top + 0.03)], cloth, sides=8)
        for side in (-1, 1):
            shoulder, cuff = (
                (x + 0.18 * side, 0.15, top - 0.11),
                (x + 0.23 * side, 0.19, top - 0.66),
            )
            tube(stand, shoulder, cuff, (0.075, 0.05), cloth, sides=5)


def _bag(stand: Stand, x: float, top: float) -> None:
    """Hang a shoulder bag from a hook."""
    leather = paint(pick(stand.rng, LEATHERS))
    with stand.surfaces.thing("bag"):
        low = top - float(stand.rng.uniform(0.5, 0.75))
        cushion(stand, (x - 0.16, x + 0.16), (0.05, 0.17), (low, low + 0.26), leather)
        stand.box((x - 0.15, x + 0.15), (0.165, 0.18), (low + 0.12, low + 0.25), leather)
        stand.box(
            (x - 0.02, x + 0.02), (0.17, 0.19), (low + 0.10, low + 0.14), paint((200, 170, 90))
        )
        for side in (-1, 1):
            tube(stand, (x + 0.13 * side, 0.1, low + 0.24), (x, 0.09, top), 0.01, leather, sides=4)


def coat_rack(stand: Stand, look: Look) -> None:
    """Hang a board with hooks, and coats, a bag and a hat on them."""
    rng, top, hooks = stand.rng, 1.68, int(stand.rng.integers(4, 6))
    half, metal, wood = hooks * 0.17, look.metallic(), look.wooden(stand.rng)
    places = [(i + 0.5) * 0.34 - half for i in range(hooks)]
    coats = int(rng.integers(2, hooks))
    order = rng.permutation(hooks)
    with stand.surfaces.thing("coat_rack"):
        stand.box((-half, half), (0.0, 0.025), (top - 0.05, top + 0.09), wood)
        stand.box((-half, half), (0.0, 0.26), (top + 0.2, top + 0.225), wood)
        for x in (-half + 0.03, half - 0.05):
            stand.box((x, x + 0.02), (0.0, 0.22), (top + 0.09, top + 0.2), wood)
        for x in places:
            tube(stand, (x, 0.02, top), (x, 0.09, top + 0.03), 0.01, metal, sides=4)
        for i in order[:coats]:
            _coat(stand, places[int(i)], top, pick(rng, (*FABRICS, *ink.VIVID)))
        _bag(stand, places[int(order[coats])], top)
        with stand.surfaces.thing("hat"):
            felt, x, z = paint(pick(rng, FABRICS, 30)), float(rng.uniform(-0.4, 0.4)), top + 0.225
            lathe(stand, (x, 0.14), [(0.15, z), (0.15, z + 0.012)], felt, sides=10)
            lathe(stand, (x, 0.14), [(0.1, z + 0.012), (0.09, z + 0.1), (0.05, z + 0.12)], felt,
                  sides=10)  # fmt: skip


def _shoe(stand: Stand, x: float, y: float, z: float, leather: Material) -> None:
    """Put a shoe down, its toe towards the viewer: sole, heel part, vamp."""
    x0, x1, back, mid, toe = x - 0.045, x + 0.045, y - 0.13, y - 0.02, y + 0.14
    stand.box((x0, x1), (back, toe), (z, z + 0.02), paint(WHITE if z > 0.2 else DARK))
    high, low = z + 0.1, z + 0.045
    ring = [(x0, toe, z + 0.02), (x1, toe, z + 0.02), (x1, mid, z + 0.02), (x0, mid, z + 0.02)]
    top = [(x0 + 0.015, toe, low), (x1 - 0.015, toe, low), (x1, mid, high), (x0, mid, high)]
    block(stand, top, ring, leather)
    stand.box((x0, x1), (back, mid), (z + 0.02, high), leather, top=paint((24, 22, 22)))


def shoe_rack(stand: Stand, look: Look) -> None:
    """Build a low rack of slats with pairs of shoes."""
    rng, tiers, half = stand.rng, int(stand.rng.integers(2, 4)), float(stand.rng.uniform(0.32, 0.5))
    wood, metal = look.wooden(rng), look.metallic()
    with stand.surfaces.thing("shoe_rack"):
        for x in (-half, half - 0.02):
            stand.box((x, x + 0.02), (0.0, 0.32), (0.0, 0.24 * tiers + 0.02), wood)
        for tier in range(tiers):
            z = 0.24 * tier + 0.1
            for y in (0.04, 0.16, 0.28):
                tube(
                    stand,
                    (0.01 - half, y, z - 0.01),
                    (half - 0.01, y, z - 0.01),
                    0.01,
                    metal,
                    sides=4,
                )
            for x in np.arange(-half + 0.09, half - 0.15, 0.24):
                if rng.random() < 0.75:
                    with stand.surfaces.thing("shoe"):
                        leather = paint(pick(rng, (*LEATHERS, *ink.VIVID)))
                        _shoe(stand, float(x), 0.16, z, leather)
                        _shoe(stand, float(x) + 0.1, 0.17, z, leather)


def umbrella_stand(stand: Stand, look: Look) -> None:
    """Build an open pot with closed umbrellas."""
    rng, radius, tall = stand.rng, float(stand.rng.uniform(0.1, 0.13)), 0.5
    pot = paint(pick(rng, (look.metal, look.accent, WHITE, DARK)))
    with stand.surfaces.thing("umbrella_stand"):
        profile = [(radius, 0.0), (0.9 * radius, 0.25), (1.1 * radius, tall), (radius, tall),
                   (0.8 * radius, 0.3)]  # fmt: skip
        lathe(stand, (0.0, 0.0), profile, pot)
        for i in range(int(rng.integers(2, 5))):
            angle = 2.1 * i + float(rng.uniform(0, 1))
            c, s = 0.09 * float(np.cos(angle)), 0.09 * float(np.sin(angle))
            with stand.surfaces.thing("umbrella"):
                cloth, stick = paint(pick(rng, ink.VIVID)), paint((90, 56, 34))
                tube(stand, (0.2 * c, 0.2 * s, 0.1), (c, s, 0.72), (0.012, 0.04), cloth)
                hook = [(c, s, 0.72), (1.15 * c, 1.15 * s, 0.86), (1.5 * c, 1.5 * s, 0.91),
                        (1.9 * c, 1.9 * s, 0.88), (1.9 * c, 1.9 * s, 0.83)]  # fmt: skip
                for a, b in pairwise(hook):
                    tube(stand, a, b, 0.011, stick, sides=4)
