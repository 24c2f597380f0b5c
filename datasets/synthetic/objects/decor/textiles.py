"""Rugs and curtains."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from roomgraph.datasets.synthetic.objects.look import FABRICS, Look, paint
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import pick, plain

__all__ = ["curtain", "rug"]


def rug(stand: Stand, look: Look, *, width: float = 2.0, depth: float = 1.4) -> None:
    """Lay a rug: with a border and medallions, stripes, diamonds, or plain and shaggy."""
    rng, kind = stand.rng, int(stand.rng.integers(4))
    height, across = int(150 * depth), int(150 * width)
    ground = pick(rng, (look.fabric2, look.accent, (130, 40, 40), (40, 54, 90), (206, 190, 160)))
    inks = [pick(rng, (*FABRICS, *ink.VIVID), 20) for _ in range(4)]
    image = plain(height, across, ground)
    if kind == 0:
        for i, inset in enumerate((0, 7, 22, 28)):
            cv2.rectangle(image, (inset, inset), (across - inset, height - inset), inks[i], -1)
        for x in range(44, across - 30, 34):
            for y in range(44, height - 30, 34):
                axes = int(rng.integers(7, 14)), int(rng.integers(4, 9))
                cv2.ellipse(
                    image, (x, y), axes, 45.0 * (x + y), 0, 360, inks[(x + y) // 34 % 3], -1
                )
        middle = across // 2, height // 2
        for i, share in enumerate((4, 6, 10)):
            cv2.ellipse(image, middle, (across // share, height // share), 0, 0, 360, inks[i], -1)
    elif kind == 1:
        x = 0
        while x < across:
            wide = int(rng.integers(8, 40))
            cv2.rectangle(image, (x, 0), (x + wide, height), inks[int(rng.integers(4))], -1)
            x += wide
    elif kind == 2:
        for x in range(0, across + 60, 60):
            for y in range(0, height + 60, 60):
                for i, r in enumerate((30, 20, 9)):
                    ends = np.array([(x, y - r), (x + r, y), (x, y + r), (x - r, y)])
                    cv2.fillPoly(image, [ends], inks[(i + y // 60) % 4], cv2.LINE_AA)
    pile = 1 + 0.22 * patterns.noise(rng, height, across, (3, 3))
    woven = np.clip(image * pile[..., None], 0, 255).astype(np.uint8)
    if kind < 3:
        woven[:, :4:2] = woven[:, -4::2] = (226, 218, 200)
    with stand.surfaces.thing("rug"):
        stand.sheet((-width / 2, width / 2), (-depth / 2, depth / 2), 0.004, Material(woven))


def curtain(stand: Stand, look: Look, *, width: float = 0.5, height: float = 2.2) -> None:
    """Hang a pleated curtain from a piece of rod, loose or gathered by a band."""
    rng = stand.rng
    cloth = patterns.cloth(rng, 160, 160, pick(rng, (look.fabric2, look.accent, (222, 212, 196))))
    if rng.random() < 0.4:
        for x in range(6, 160, 26):
            cv2.line(cloth, (x, 0), (x, 159), patterns.shift(rng, look.accent, 30), 7)
    material, count = Material(cloth, 0.6, 2.4), max(4, round(width / 0.07))
    tied, foot, top = bool(rng.random() < 0.4), 0.04, height + 0.04
    levels = [(top, 1.0), (0.45 * top, 0.5), (foot, 0.75)] if tied else [(top, 1.0), (foot, 1.0)]
    with stand.surfaces.thing("curtain"):
        for (high, w0), (low, w1) in pairwise(levels):
            for i in range(2 * count):
                a, b = i / (2 * count) - 0.5, (i + 1) / (2 * count) - 0.5
                near, far = (0.04, 0.1) if i % 2 == 0 else (0.1, 0.04)
                corners = [(a * w0 * width, near, high), (b * w0 * width, far, high),
                           (b * w1 * width, far, low), (a * w1 * width, near, low)]  # fmt: skip
                window = (0.5 + 0.9 * a, 0.0, 0.5 + 0.9 * b, 1.0)
                stand.surfaces.quads.append(Quad(stand.world(corners), material, window))
        if tied:
            z, half = 0.45 * top, 0.26 * width
            stand.box((-half, half), (0.02, 0.115), (z - 0.03, z + 0.03), paint(look.accent))
        tube(stand, (-width / 2 - 0.03, 0.07, top + 0.02), (width / 2 + 0.03, 0.07, top + 0.02),
             0.014, look.metallic())  # fmt: skip
        stand.footprint((-width / 2, width / 2), (0.0, 0.1))
