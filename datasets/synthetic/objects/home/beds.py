"""Beds with their bedding."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import block, cushion, tube
from roomgraph.datasets.synthetic.rendering.stand import Span, Stand
from roomgraph.datasets.synthetic.textures import patterns

__all__ = ["bed"]


def _bedding(look: Look, rng: np.random.Generator) -> Material:
    """Return a duvet's cover: striped, checked, flowered or plain, with soft creases."""
    pale = patterns.pick(rng, ((240, 238, 232), (214, 222, 230), (232, 222, 208), look.fabric2))
    ink_colour, kind = look.accent, int(rng.integers(4))
    image = patterns.plain(256, 256, pale)
    if kind < 2:
        for i in range(0, 256, 32):
            image[:, i : i + 12] = ink_colour
            if kind == 1:
                band = image[i : i + 12]
                band[:] = (0.5 * band + 0.5 * np.array(ink_colour)).astype(np.uint8)
    elif kind == 2:
        for x, y in rng.integers(0, 256, (46, 2)):
            for angle in np.arange(5) * 2 * np.pi / 5:
                at = int(x + 7 * np.cos(angle)), int(y + 7 * np.sin(angle))
                cv2.circle(image, at, 4, ink_colour, cv2.FILLED, cv2.LINE_AA)
    creases = 1 + 0.22 * patterns.noise(rng, 256, 256, (60, 24))
    return Material(np.clip(image * creases[..., None], 0, 255).astype(np.uint8), 1.1, 1.1)


def bed(stand: Stand, look: Look, width: float | None = None) -> None:
    """Build a bed, single or double: frame, headboard, mattress, duvet turned back, pillows."""
    rng, wood = stand.rng, look.wooden(stand.rng)
    wide = width or (0.95 if rng.random() < 0.4 else float(rng.uniform(1.45, 1.85)))
    half, long = wide / 2, float(rng.uniform(2.04, 2.14))
    white = Material(patterns.cloth(rng, 64, 64, (236, 234, 228)), 1.0, 1.0)
    with stand.surfaces.thing("bed"):
        _bedstead(stand, look, half, long, wood)
        cushion(stand, (0.03 - half, half - 0.03), (0.07, long - 0.04), (0.28, 0.48), white)
        cover, fold = _bedding(look, rng), float(rng.uniform(0.62, 0.82))
        spread = (-half - 0.015, half + 0.015), (fold, long - 0.02), (0.26, 0.55)
        cushion(stand, *spread, cover, bevel=0.07)
        turned = (-half - 0.02, half + 0.02), (fold - 0.05, fold + 0.22), (0.33, 0.575)
        cushion(stand, *turned, white if rng.random() < 0.6 else look.woven(rng), bevel=0.07)
        for centre in (0.0,) if wide < 1.3 else (-half / 2, half / 2):
            size = min(0.36, half - 0.09)
            with stand.surfaces.thing("pillow"):
                _pillow(stand.at(centre, 0.12), size, white)
            if wide >= 1.3 and rng.random() < 0.5:
                with stand.surfaces.thing("pillow"):
                    _pillow(stand.at(centre, 0.28), 0.7 * size, look.woven(rng, second=True))


def _pillow(stand: Stand, half: float, cloth: Material) -> None:
    """Lean a plump pillow back against what is behind it."""
    rings = []
    for up, thick, wide in (
        (0, 0.02, 0.95),
        (0.07, 0.07, 1),
        (0.25, 0.075, 0.98),
        (0.35, 0.02, 0.9),
    ):
        y, z, x = 0.19 - 0.35 * up, 0.50 + 0.85 * up, half * wide
        front, back = (y + thick, z + 0.4 * thick), (y - thick, z - 0.4 * thick)
        rings.append([(-x, *front), (x, *front), (x, *back), (-x, *back)])
    for low, high in pairwise(rings):
        block(stand, high, low, cloth)


def _bedstead(stand: Stand, look: Look, half: float, long: float, wood: Material) -> None:
    """Build a bed's frame: headboard of wood, bars or padding, rails, legs, perhaps a footboard."""
    rng, kind, top = stand.rng, int(stand.rng.integers(3)), float(stand.rng.uniform(0.9, 1.15))
    frame = look.metallic() if kind == 1 else wood
    for y in (0.035, long - 0.01):
        for x in (-half, half):
            high = top if y < 1 and kind < 2 else 0.36
            stand.box((x - 0.03, x + 0.03), (y - 0.025, y + 0.025), (0.0, high), frame)
    for x in (-half - 0.01, half - 0.02):
        stand.box((x, x + 0.03), (0.03, long), (0.16, 0.31), frame)
    stand.box((-half, half), (long - 0.03, long), (0.16, 0.33), frame)
    if kind == 0:
        for low, high in ((0.45, top - 0.10), (top - 0.09, top - 0.01)):
            stand.box((-half, half), (0.02, 0.05), (low, high), wood)
    elif kind == 1:
        for share in np.linspace(-0.8, 0.8, 7):
            x = float(share) * half
            tube(stand, (x, 0.035, 0.4), (x, 0.035, top - 0.04), 0.01, frame, sides=5)
        tube(stand, (-half, 0.035, top - 0.04), (half, 0.035, top - 0.04), 0.018, frame)
    else:
        fabric, parts = look.woven(rng), max(2, round(half / 0.2))
        for i in range(parts):
            left, right = ((half + 0.03) * (2 * k / parts - 1) for k in (i, i + 1))
            for low in (0.30, (0.30 + top) / 2):
                high = low + (top - 0.3) / 2
                _padding(stand, (left, right), (low, high), fabric)
    if kind == 0 and rng.random() < 0.6:
        stand.box((-half - 0.03, half + 0.03), (long, long + 0.035), (0.10, 0.44), wood)


def _padding(stand: Stand, x: Span, z: Span, fabric: Material) -> None:
    """Build a padded square of a headboard: it bulges towards the viewer."""
    stand.box(x, (0.012, 0.05), z, fabric)
    inner_x, inner_z = (x[0] + 0.03, x[1] - 0.03), (z[0] + 0.03, z[1] - 0.03)
    corners = [(0, 1), (1, 1), (1, 0), (0, 0)]
    outer = np.array([(x[i], 0.051, z[k]) for i, k in corners])
    inner = np.array([(inner_x[i], 0.085, inner_z[k]) for i, k in corners])
    for i in range(4):
        j = (i + 1) % 4
        side = np.array([outer[i], outer[j], inner[j], inner[i]])
        stand.surfaces.cover(stand.world(side), fabric)
    stand.surfaces.cover(stand.world(inner), fabric)
