"""Corridors: closed doors, plates, notice boards, exit signs, radiators, extinguishers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import CEILING_M, FloorPlan
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import (
    PIXELS_PER_M,
    SIGN_GLOW,
    STRIP_M,
    Site,
    Style,
    gaps,
    makes,
    material,
    paint,
)
from roomgraph.datasets.synthetic.textures import finishes, ink, laboratory, patterns, signs

TITLES = {"office": "OFFICE", "laboratory": "LABORATORY", "kitchen": "KITCHEN", "bathroom": "WC"}


def style(site: Site) -> Style:
    """Return walls in two coats of paint with a rail between, over speckled linoleum."""
    rng = site.rng
    height, width = int(CEILING_M * PIXELS_PER_M), int(STRIP_M * PIXELS_PER_M)
    wall = patterns.plaster(rng, height, width, patterns.shift(rng, (236, 232, 220), 6))
    lower = patterns.pick(rng, ((150, 176, 170), (196, 176, 130), (150, 164, 190)))
    rail = height - int(1.0 * PIXELS_PER_M)
    wall[rail:] = finishes.panelling(rng, height - rail, width, lower)
    wall[rail - 12 : rail] = patterns.wood(rng, 12, width, (150, 110, 74))
    wall[-22:] = [int(0.55 * c) for c in lower]
    colour = patterns.pick(rng, ((150, 120, 96), (110, 124, 112), (134, 128, 140)))
    floor = patterns.linoleum(rng, 440, 440, colour)
    floor[:30] = patterns.linoleum(rng, 30, 440, patterns.shift(rng, (80, 76, 74)))
    return Style(wall, material(floor, 220), material(patterns.wood(rng, 200, 480, (150, 106, 66))))


def furnish(site: Site, plan: FloorPlan) -> None:
    """Furnish the corridor's two long walls, between the doorways, and its closed end."""
    face = patterns.wood(
        site.rng, 520, 240, patterns.pick(site.rng, ((150, 104, 64), (176, 136, 92)))
    )
    deck = _deck(site.rng)
    for name in site.walls:
        wall = site.walls[name]
        side = _side(site, wall.stand)
        openings = gaps(site.room, side, wall.stand, plan)
        if wall.length < 3:
            if not openings:
                _end(site, name)
            continue
        _plates(site, wall.stand, side, plan)
        edges = [(0.0, 0.0, 0.0), *openings, (wall.length, wall.length, 0.0)]
        for before, after in pairwise(edges):
            _stretch(site, wall.stand, (before[1] + 0.42, after[0] - 0.18), face, deck)


def _side(site: Site, stand: Stand) -> str:
    r = site.room.floor
    x, y = (float(v) for v in stand.world([(0.5, 0, 0)])[0][:2])
    distances = {"south": y - r.y0, "north": r.y1 - y, "west": x - r.x0, "east": r.x1 - x}
    return min(distances, key=lambda side: abs(distances[side]))


def _plates(site: Site, stand: Stand, side: str, plan: FloorPlan) -> None:
    """Hang the rooms' name plates to the right of their doorways."""
    for begin, end, _ in gaps(site.room, side, stand, plan):
        x, y = stand.world([((begin + end) / 2, -0.5, 0)])[0][:2]
        title = TITLES.get(plan.room_at((float(x), float(y))).label, "LIFT")
        plate = Material(signs.room_plate(site.rng, 90, 90, title))
        stand.picture((end + 0.12, end + 0.36), (1.4, 1.64), 0.015, plate)


def _deck(rng: np.random.Generator) -> Iterator[int]:
    """Deal the kinds of things on the walls in turn, shuffled anew after each round."""
    while True:
        yield from (int(kind) for kind in rng.permutation(7))


def _stretch(
    site: Site, stand: Stand, span: tuple[float, float], face: Image, deck: Iterator[int]
) -> None:
    """Fill a stretch of wall; some of it stays bare."""
    rng, (x, end) = site.rng, span
    while end - x > 0.35:
        kind = next(deck)
        if kind == 0 and end - x > 1.1:
            leaf = signs.door(rng, face, int(rng.integers(100, 200)))
            stand.picture((x, x + 0.95), (0.0, 2.05), 0.02, Material(leaf))
            x += 1.2
        elif kind == 1 and end - x > 1.1:
            painting = Material(ink.framed(ink.photo(rng, 220, 280), (120, 88, 44), 8))
            stand.picture((x, x + 1.05), (1.12, 1.9), 0.02, painting)
            x += 1.2
        elif kind == 2 and end - x > 1.0:
            ribs = Material(signs.radiator(150, 230))
            stand.box((x, x + 0.9), (0.02, 0.12), (0.12, 0.72), paint((206, 204, 196)), front=ribs)
            notice = Material(ink.framed(ink.poster(rng, 160, 220), (90, 94, 98), 4))
            stand.picture((x + 0.08, x + 0.82), (1.1, 1.64), 0.015, notice)
            x += 1.05
        elif kind == 3:
            _extinguisher(site, stand.at(x))
            x += 0.5
        elif kind == 4 and end - x > 0.8:
            plan = Material(ink.framed(signs.evacuation_plan(rng, 150, 200), (130, 134, 140), 4))
            stand.picture((x, x + 0.7), (1.2, 1.73), 0.015, plan)
            x += 0.9
        elif kind == 5 and end - x > 0.7:
            picture = Material(ink.framed(ink.poster(rng, 220, 160), (60, 50, 44), 5))
            stand.picture((x, x + 0.56), (1.1, 1.86), 0.015, picture)
            x += 0.75
        else:
            x += float(rng.uniform(0.2, 0.45))


@makes("fire_extinguisher")
def _extinguisher(site: Site, stand: Stand) -> None:
    rng = site.rng
    red = patterns.tint((190, 30, 28), 0 * patterns.grain(rng, 128, 160))
    red[50:90, 30:130] = (240, 236, 226)
    ink.lines(rng, red, (36, 54, 124, 86), 7)
    stand.prism((0.14, 0.10), (0.35, 0.85), 0.075, Material(red))
    stand.prism((0.14, 0.10), (0.85, 0.95), (0.04, 0.02), paint((40, 40, 42)))
    sign = patterns.plain(100, 100, (196, 30, 30))
    ink.write(sign, "FIRE", (8, 60, 92, 94), (250, 250, 250), thickness=2)
    sign[14:56, 40:56] = (250, 250, 250)
    sign[10:20, 34:70] = (250, 250, 250)
    stand.picture((0.02, 0.26), (1.35, 1.59), 0.015, Material(sign))


def _end(site: Site, name: str) -> None:
    """Close the corridor's end with a window or an emergency exit."""
    rng, wall = site.rng, site.walls[name]
    middle = wall.length / 2
    if rng.random() < 0.5:
        site.window(name, middle, 1.2, power=5.0)
        radiator = Material(signs.radiator(150, 260))
        wall.stand.box(
            (middle - 0.5, middle + 0.5),
            (0.02, 0.12),
            (0.12, 0.72),
            paint((206, 204, 196)),
            front=radiator,
        )
    else:
        leaf = signs.door(rng, patterns.plaster(rng, 520, 240, (150, 156, 160)), 0)
        wall.stand.picture((middle - 0.5, middle + 0.5), (0, 2.05), 0.02, Material(leaf))
        wall.stand.picture(
            (middle + 0.58, middle + 0.86),
            (1.3, 1.58),
            0.015,
            Material(laboratory.warning(rng, 100)),
        )
    sign = Material(signs.exit_sign(70, 150, bool(rng.random() < 0.5)), glow=SIGN_GLOW)
    wall.stand.picture((middle - 0.25, middle + 0.25), (2.2, 2.43), 0.03, sign)
