"""Kitchens: cupboards, worktop, hob, oven, fridge, table."""

from __future__ import annotations

from dataclasses import dataclass

import cv2

from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import (
    PIXELS_PER_M,
    Site,
    Style,
    makes,
    material,
    paint,
    strip,
)
from roomgraph.datasets.synthetic.textures import finishes, ink, kitchen, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

FACES: tuple[Colour, ...] = ((222, 214, 196), (182, 132, 84), (150, 176, 160), (206, 196, 190))
FLOORS: tuple[Colour, ...] = ((196, 120, 84), (214, 186, 146), (150, 110, 86))
GLAZES: tuple[Colour, ...] = ((240, 238, 228), (206, 222, 226), (244, 226, 190))


@dataclass(frozen=True, slots=True, eq=False)
class Front:
    """What the cupboards of a kitchen look like."""

    face: Image
    handle: int


def style(site: Site) -> Style:
    """Return painted walls, and a floor of large terracotta tiles in two colours."""
    rng = site.rng
    colour = patterns.pick(rng, FLOORS)
    second = patterns.shift(rng, (232, 220, 196), 8)
    floor = patterns.tiles(
        rng, (440, 440), (55, 55), (colour, colour, second), (120, 106, 92), 0.25
    )
    wall = strip(site, patterns.pick(rng, ((246, 232, 190), (236, 222, 200), (226, 232, 208)), 6))
    tiled = int(1.35 * PIXELS_PER_M)
    wall[-tiled:] = finishes.bricks(rng, tiled, wall.shape[1], (patterns.pick(rng, GLAZES),), 0.2)
    return Style(wall, material(floor, 220), paint((236, 232, 222)))


def furnish(site: Site) -> None:
    """Furnish a kitchen: a kitchenette along two walls, a fridge, a table at the third."""
    rng, walls = site.rng, site.walls
    colour = patterns.pick(rng, FACES)
    face = (
        patterns.wood(rng, 256, 256, colour, 0.8)
        if rng.random() < 0.5
        else patterns.plaster(rng, 256, 256, colour)
    )
    front = Front(face, int(rng.integers(3)))
    splash = _splash(site)
    main, other = ("left", "right") if rng.random() < 0.5 else ("right", "left")
    start = 0.3 if main == "left" else 0.72
    length = walls[main].length - 1.02
    _cooking_side(site, walls[main].stand.at(start), length, front, splash)
    far = walls["far"]
    _washing_side(site, far.stand.at(0.05), far.length - 0.1, front, splash)
    site.window("far", far.length / 2, 1.3)
    _fridge(site, walls[other].stand.at(0.68 if other == "right" else walls[other].length - 1.42))
    start = 1.6 if other == "right" else 0.3
    _table(site, walls[other].stand.at(start), splash)
    _beside_door(site)


def _splash(site: Site) -> Material:
    """Return the tiles behind the worktop, many of them with flowers."""
    rng = site.rng
    colours: tuple[Colour, ...] = (patterns.pick(rng, GLAZES),)
    return material(finishes.bricks(rng, 140, 420, colours, 0.4))


@makes("kitchen_counter")
def _cooking_side(site: Site, stand: Stand, length: float, front: Front, splash: Material) -> None:
    """Build base and wall units, with an oven under a hob and a hood above them."""
    rng = site.rng
    steel = patterns.steel(rng, 220, 160)
    oven = Material(kitchen.oven(rng, 200, 150), shiny=True)
    count = max(3, round(length / 0.6))
    unit, special = length / count, int(rng.integers(1, count - 1))
    place = (special * unit, (special + 1) * unit)
    _base_units(site, stand, length, count, front, {special: oven})
    for i in range(count):
        if i != special:
            leaf = Material(kitchen.cupboard(rng, front.face[:180, :150], front.handle))
            span = (i * unit, (i + 1) * unit)
            stand.box(span, (0, 0.34), (1.42, 2.10), material(front.face), front=leaf)
    stand.wall((0, length), (0.90, 1.42), 0.006, splash)
    stand.sheet(place, (0.06, 0.56), 0.903, Material(kitchen.hob(rng, 130, 150)))
    stand.box(place, (0, 0.42), (1.55, 1.72), material(steel, shiny=True))
    stand.wall(place, (1.72, 2.55), 0.01, material(steel))
    _things(site, stand, length, place)


@makes("kitchen_counter")
def _washing_side(site: Site, stand: Stand, length: float, front: Front, splash: Material) -> None:
    """Build base units with a sink in the middle of the worktop."""
    middle, steel = length / 2, paint((190, 194, 198))
    _base_units(site, stand, length, max(3, round(length / 0.6)), front, {})
    stand.wall((0, length), (0.90, 1.42), 0.006, splash)
    basin = Material(kitchen.sink(site.rng, 120, 230), shiny=True)
    stand.sheet((middle - 0.45, middle + 0.45), (0.06, 0.54), 0.903, basin)
    stand.prism((middle - 0.2, 0.1), (0.9, 1.15), 0.02, steel)
    stand.box((middle - 0.22, middle - 0.18), (0.1, 0.3), (1.13, 1.16), steel)
    _things(site, stand, length, (middle - 0.5, middle + 0.5))


def _base_units(
    site: Site, stand: Stand, length: float, count: int, front: Front, special: dict[int, Material]
) -> None:
    """Build a row of base units, some with drawers, on a plinth and under a worktop."""
    rng, face, unit = site.rng, front.face[:200, :150], length / count
    for i in range(count):
        if i in special:
            picture = special[i]
        elif rng.random() < 0.35:
            picture = Material(kitchen.drawers(face, 3))
        else:
            picture = Material(kitchen.cupboard(rng, face, front.handle))
        span = (i * unit, (i + 1) * unit)
        stand.box(span, (0, 0.58), (0.10, 0.86), material(front.face), front=picture)
    stand.box((0, length), (0, 0.54), (0, 0.10), paint((50, 48, 46)))
    top = material(patterns.stone(rng, 160, 420, (120, 112, 106), 1000))
    stand.box((0, length), (0, 0.61), (0.86, 0.90), top)


def _things(site: Site, stand: Stand, length: float, keep: tuple[float, float]) -> None:
    """Put appliances and packets on the worktop, away from the hob or sink."""
    rng, x = site.rng, 0.15
    while x < length - 0.35:
        wide = float(rng.uniform(0.2, 0.42))
        if keep[0] - wide < x < keep[1]:
            x = keep[1] + 0.05
            continue
        if rng.random() < 0.35:
            front = _microwave(site)
            stand.box((x, x + 0.42), (0.1, 0.42), (0.9, 1.17), paint((206, 206, 204)), front=front)
            x += 0.5
        elif rng.random() < 0.5:
            tall = float(rng.uniform(0.18, 0.3))
            packet = Material(kitchen.packet(rng, int(tall * 400), 70))
            stand.box(
                (x, x + 0.18), (0.2, 0.28), (0.9, 0.9 + tall), paint((200, 170, 110)), front=packet
            )
            x += 0.25
        else:
            colour = patterns.pick(rng, ink.VIVID)
            stand.prism((x + 0.1, 0.28), (0.9, 1.12), (0.09, 0.06), paint(colour))
            x += 0.28


def _microwave(site: Site) -> Material:
    image = patterns.plain(90, 140, (212, 212, 208))
    cv2.rectangle(image, (8, 10), (98, 80), (34, 34, 38), -1)
    for y in range(18, 76, 6):
        cv2.line(image, (14, y), (92, y), (70, 70, 76), 1)
    for i in range(12):
        at = 108 + 10 * (i % 3), 34 + 12 * (i // 3)
        cv2.rectangle(image, at, (at[0] + 7, at[1] + 8), (90, 92, 98), -1)
    ink.write(image, f"{int(site.rng.integers(10, 24))}:30", (104, 10, 136, 26), (40, 150, 60))
    return Material(image)


@makes("refrigerator")
def _fridge(site: Site, stand: Stand) -> None:
    image = kitchen.fridge(site.rng, 480, 180)
    stand.box((0, 0.68), (0, 0.62), (0, 1.85), paint((232, 232, 228)), front=Material(image))


@makes("dining_table")
def _table(site: Site, stand: Stand, splash: Material) -> None:
    """Place a table with two stools at the wall, a shelf with crockery and a calendar above it."""
    rng = site.rng
    wood = material(patterns.wood(rng, 200, 300, (188, 140, 90)))
    cloth = Material(kitchen.tablecloth(rng, 224))
    stand.box((0.1, 1.0), (0.02, 0.62), (0.71, 0.74), wood, top=cloth)
    for x in (0.13, 0.92):
        for y in (0.05, 0.55):
            stand.box((x, x + 0.05), (y, y + 0.05), (0, 0.71), wood)
    stand.prism(
        (0.55, 0.42), (0, 0.46), 0.16, material(patterns.cloth(rng, 100, 200, (170, 60, 50)))
    )
    stand.wall((0.0, 1.1), (0.0, 1.13), 0.006, splash)
    for z in (1.15, 1.55):
        stand.box((0.05, 1.05), (0, 0.22), (z - 0.02, z), wood)
        shelf = Material(kitchen.crockery(rng, 90, 270))
        stand.picture((0.05, 1.05), (z, z + 0.34), 0.12, shelf)


def _beside_door(site: Site) -> None:
    rng, wall = site.rng, site.walls["door"]
    gap = wall.gap or (0.0, 0.0, 0.0)
    clock = kitchen.clock(100)
    wall.stand.picture((gap[0] + 0.3, gap[0] + 0.62), (2.16, 2.48), 0.012, Material(clock))
    calendar = ink.sheet(rng, 200, 140)
    calendar[:90] = cv2.resize(ink.photo(rng, 90, 140), (140, 90))
    for i in range(35):
        x, y = 8 + 18 * (i % 7), 100 + 19 * (i // 7)
        ink.write(calendar, str(i + 1), (x, y, x + 14, y + 14), (50, 50, 60))
    wall.stand.picture((gap[1] + 0.25, gap[1] + 0.7), (1.15, 1.8), 0.012, Material(calendar))
    rail = Material(kitchen.crockery(rng, 110, 200))
    wall.stand.picture((gap[0] - 0.85, gap[0] - 0.15), (1.3, 1.68), 0.05, rail)
