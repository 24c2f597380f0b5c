"""Bathrooms: tiles from floor to ceiling, washbasins under mirrors, stalls, dispensers."""

from __future__ import annotations

from roomgraph.datasets.synthetic.plans.layout import CEILING_M
from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import (
    PIXELS_PER_M,
    STRIP_M,
    Site,
    Style,
    makes,
    material,
    paint,
)
from roomgraph.datasets.synthetic.textures import bathroom, finishes, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

WALLS: tuple[Colour, ...] = ((224, 236, 238), (236, 236, 226), (214, 230, 220), (226, 222, 234))
BORDERS: tuple[Colour, ...] = ((40, 96, 150), (40, 130, 120), (70, 80, 100), (130, 60, 80))


def style(site: Site) -> Style:
    """Return walls of square tiles with bands of mosaic, and a floor of mosaic."""
    rng = site.rng
    colour, border = patterns.pick(rng, WALLS, 6), patterns.pick(rng, BORDERS)
    height, width = int(CEILING_M * PIXELS_PER_M), int(STRIP_M * PIXELS_PER_M)
    side = width // int(rng.integers(16, 21))
    wall = patterns.tiles(rng, (height, width), (side, side), (colour,), (150, 156, 158))
    dark = patterns.shift(rng, (60, 66, 76))
    for z in (0.32, 1.0, 1.62):
        top = height - int(z * PIXELS_PER_M)
        wall[top : top + 39] = finishes.mosaic(rng, 39, width, (border, colour, dark))
    wall[: height - int(2.1 * PIXELS_PER_M)] = patterns.plaster(
        rng, height - int(2.1 * PIXELS_PER_M), width, (240, 240, 238)
    )
    floor = finishes.mosaic(rng, 440, 440, (border, colour, colour, dark))
    return Style(wall, material(floor, 220), paint((226, 230, 232)))


def furnish(site: Site) -> None:
    """Furnish a bathroom: basins on one side, stalls at the far end, dispensers by the door."""
    rng, walls = site.rng, site.walls
    tiles = site_tiles(site)
    wet, dry = ("left", "right") if rng.random() < 0.5 else ("right", "left")
    start = 0.35 if wet == "left" else 1.1
    _basins(site, walls[wet].stand.at(start), tiles)
    far = walls["far"]
    colour = patterns.pick(rng, ((90, 130, 150), (206, 170, 110), (120, 150, 130), (170, 110, 100)))
    _stalls(site, far.stand.at(0.03), far.length - 0.06, colour)
    length = walls[dry].length
    _dryer_side(
        site, walls[dry].stand, (0.3, length - 1.05) if dry == "left" else (1.05, length - 0.3)
    )
    _beside_door(site)


def site_tiles(site: Site) -> Image:
    """Return an image of the tiles of the opposite wall, for the mirrors."""
    rng = site.rng
    return patterns.tiles(rng, (220, 300), (32, 32), ((222, 232, 234),), (150, 158, 162), 0.06)


@makes("sink")
def _basins(site: Site, stand: Stand, tiles: Image) -> None:
    rng = site.rng
    white, steel = paint((240, 242, 242)), paint((190, 194, 198))
    for i in range(2):
        basin = stand.at(0.85 * i)
        picture = Material(bathroom.basin(130, 150))
        basin.box((0.1, 0.7), (0, 0.46), (0.68, 0.84), white, top=picture)
        basin.prism((0.4, 0.16), (0, 0.68), (0.10, 0.08), white)
        basin.prism((0.4, 0.07), (0.84, 0.98), 0.018, steel)
        basin.box((0.38, 0.42), (0.07, 0.2), (0.96, 0.99), steel)
        glass = Material(bathroom.mirror(rng, 200, 160, tiles), shiny=True)
        basin.picture((0.08, 0.72), (1.08, 1.88), 0.02, glass)
        soap = Material(bathroom.dispenser(rng, 70, 45))
        basin.box((0.75, 0.86), (0, 0.09), (1.08, 1.27), paint((226, 228, 230)), front=soap)


@makes("toilet_stall")
def _stalls(site: Site, stand: Stand, length: float, colour: Colour) -> None:
    """Build a row of stalls with closed doors, one of them open with the toilet in sight."""
    rng = site.rng
    count = 3
    wide, open_one = length / count, int(rng.integers(count))
    board, white = paint(colour), paint((242, 244, 244))
    for i in range(count):
        x0, x1 = i * wide, (i + 1) * wide
        stand.box((x1 - 0.03, x1), (0, 0.80), (0.12, 2.0), board)
        stall = stand.at(x0)
        if i == open_one:
            stall.box((wide / 2 - 0.18, wide / 2 + 0.18), (0.16, 0.62), (0, 0.40), white)
            stall.prism((wide / 2, 0.42), (0.40, 0.43), 0.2, paint((228, 230, 232)))
            stall.box((wide / 2 - 0.2, wide / 2 + 0.2), (0, 0.16), (0.40, 0.80), white)
            flush = Material(bathroom.dispenser(rng, 60, 60))
            stall.picture((wide / 2 - 0.1, wide / 2 + 0.1), (1.0, 1.2), 0.01, flush)
            continue
        leaf = Material(bathroom.partition(rng, 430, 220, colour))
        stall.box((0.02, wide - 0.05), (0.76, 0.79), (0.12, 1.95), board, front=leaf)
    stand.box((0, length), (0.76, 0.82), (1.97, 2.05), paint((150, 154, 158)))


def _dryer_side(site: Site, stand: Stand, span: tuple[float, float]) -> None:
    """Hang dispensers and a hand dryer; stand a radiator, a bin or a shower there."""
    rng, (start, end) = site.rng, span
    x = start
    for index in rng.permutation(3):
        if x + 0.45 > end:
            break
        if index == 0:
            front = Material(bathroom.dryer(rng, 80, 80))
            stand.box((x, x + 0.30), (0, 0.18), (1.15, 1.45), paint((170, 174, 178)), front=front)
            x += 0.5
        elif index == 1:
            front = Material(bathroom.dispenser(rng, 110, 90))
            stand.box((x, x + 0.32), (0, 0.12), (1.15, 1.55), paint((210, 212, 212)), front=front)
            stand.prism((x + 0.16, 0.18), (0, 0.5), (0.12, 0.15), paint((70, 74, 78)))
            x += 0.5
        else:
            wide = min(0.9, end - x)
            curtain = Material(bathroom.shower_curtain(rng, 480, int(240 * wide)))
            stand.box((x, x + wide), (0, 0.06), (0.05, 2.0), paint((220, 224, 226)), front=curtain)
            x += wide + 0.15


def _beside_door(site: Site) -> None:
    rng, wall = site.rng, site.walls["door"]
    gap = wall.gap or (0.0, 0.0, 0.0)
    sign = Material(bathroom.wash_sign(rng, 170, 130))
    wall.stand.picture((gap[1] + 0.2, gap[1] + 0.62), (1.2, 1.75), 0.012, sign)
    towel = Material(bathroom.dispenser(rng, 110, 90))
    wall.stand.box(
        (gap[0] - 0.6, gap[0] - 0.3), (0, 0.12), (1.1, 1.5), paint((210, 212, 212)), front=towel
    )
