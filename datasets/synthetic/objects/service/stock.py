"""What lies in store rooms: cartons, crates, cans, tools, and the colours there."""

from __future__ import annotations

from itertools import pairwise

import cv2

from roomgraph.datasets.synthetic.objects.look import paint
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.shapes import Point, block, lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour, pick, plain

DARK, STEEL, YELLOW = (34, 34, 38), (168, 172, 178), (244, 196, 30)
CARDBOARDS: tuple[Colour, ...] = ((184, 142, 96), (168, 126, 82), (200, 164, 118))
PLASTICS: tuple[Colour, ...] = (
    (40, 80, 160), (190, 40, 36), (60, 130, 70), (230, 180, 40), (90, 94, 100),
)  # fmt: skip
Span = tuple[float, float]


def join(stand: Stand, points: list[Point], radius: float, material: Material) -> None:
    """Join points with bars."""
    for a, b in pairwise(points):
        tube(stand, a, b, radius, material, sides=5)


def put_carton(stand: Stand, x: Span, y: Span, z: Span) -> None:
    """Put down a cardboard box: tape, a label, arrows that say which way is up."""
    rng = stand.rng
    colour = pick(rng, CARDBOARDS, 8)
    brown = Material(patterns.wood(rng, 48, 48, colour, 0.2), 2.0, 2.0)
    face = patterns.wood(rng, 96, 120, colour, 0.2)
    top = face.copy()
    cv2.rectangle(face, (54, 0), (66, 34), (214, 184, 132), -1)
    cv2.rectangle(top, (0, 42), (120, 54), (214, 184, 132), -1)
    cv2.line(top, (0, 48), (120, 48), (110, 78, 48), 1)
    if rng.random() < 0.6:
        face[52:88, 8:56] = ink.sheet(rng, 36, 48)
    if rng.random() < 0.6:
        for left in (78, 96):
            cv2.arrowedLine(face, (left, 84), (left, 56), (40, 34, 30), 3, tipLength=0.4)
    else:
        title = ink.word(rng).upper()
        ink.write(face, title, (62, 50, 116, 76), pick(rng, ink.VIVID), thickness=2)
    cv2.rectangle(face, (0, 0), (119, 95), (120, 88, 56), 1)
    with stand.surfaces.thing("cardboard_box"):
        stand.box(x, y, z, brown, front=Material(face), top=Material(top))


def put_crate(stand: Stand, x: Span, y: Span, z: Span) -> None:
    """Put down an open plastic crate with slots and grips, something in it."""
    rng = stand.rng
    colour = pick(rng, PLASTICS)
    dark: Colour = (colour[0] // 3, colour[1] // 3, colour[2] // 3)
    face = plain(80, 140, colour)
    for left in range(8, 130, 22):
        cv2.rectangle(face, (left, 34), (left + 13, 70), dark, -1)
    cv2.rectangle(face, (48, 8), (92, 22), dark, -1)
    for edge in (2, 27, 76):
        cv2.line(face, (0, edge), (140, edge), patterns.shift(rng, colour, 30), 3)
    inside = plain(80, 120, dark)
    if rng.random() < 0.5:
        for i in range(24):
            at = (10 + 20 * (i % 6), 10 + 20 * (i // 6))
            cv2.circle(inside, at, 8, (60, 90, 60), -1, cv2.LINE_AA)
            cv2.circle(inside, at, 5, (220, 190, 60), -1, cv2.LINE_AA)
    cv2.rectangle(inside, (0, 0), (119, 79), colour, 5)
    slots = Material(face, x[1] - x[0], z[1] - z[0])
    with stand.surfaces.thing("crate"):
        stand.box(x, y, z, slots, front=Material(face), top=Material(inside))


def put_can(stand: Stand, x: float, y: float, z: float) -> None:
    """Put down a can of paint: label round it, lid, drips, handle."""
    rng, label = stand.rng, plain(64, 160, pick(stand.rng, ((240, 240, 236), (70, 74, 80))))
    shade = pick(rng, ink.VIVID)
    cv2.rectangle(label, (0, 22), (160, 44), shade, -1)
    ink.write(label, "PAINT", (96, 22, 152, 44), (250, 250, 250))
    for edge in (2, 61):
        cv2.line(label, (0, edge), (160, edge), (150, 152, 156), 4)
    for drip in rng.integers(0, 160, 4):
        cv2.line(label, (int(drip), 0), (int(drip), int(rng.integers(8, 30))), shade, 4)
    with stand.surfaces.thing("paint_can"):
        lathe(stand, (x, y), [(0.085, z), (0.085, z + 0.19)], Material(label), sides=8)
        lathe(stand, (x, y), [(0.07, z + 0.19), (0.07, z + 0.2)], paint(STEEL), sides=8)


def put_toolbox(stand: Stand, x: float, y: float, z: float) -> None:
    """Put down a tool box: tapering lid, handle, clasps."""
    colour = paint(pick(stand.rng, PLASTICS))
    black, a, b, h = paint(DARK), 0.22, 0.11, z + 0.15
    with stand.surfaces.thing("toolbox"):
        stand.box((x - a, x + a), (y - b, y + b), (z, h), black)
        low = [(x - a, y + b, h), (x + a, y + b, h), (x + a, y - b, h), (x - a, y - b, h)]
        top = [(x + 0.8 * (p - x), y + 0.6 * (q - y), h + 0.07) for p, q, _ in low]
        block(stand, top, low, colour)
        for side in (-0.13, 0.13):
            stand.box((x + side - 0.02, x + side + 0.02), (y + b, y + b + 0.01), (h - 0.05, h),
                      paint(YELLOW))  # fmt: skip
        up = h + 0.12
        join(stand, [(x - 0.09, y, h + 0.06), (x - 0.09, y, up), (x + 0.09, y, up),
                      (x + 0.09, y, h + 0.06)], 0.011, black)  # fmt: skip
