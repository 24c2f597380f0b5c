"""Laboratories: benches with instruments, glassware, racks, warning signs."""

from __future__ import annotations

from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import (
    PIXELS_PER_M,
    SCREEN_GLOW,
    Site,
    Style,
    makes,
    material,
    paint,
    strip,
)
from roomgraph.datasets.synthetic.textures import (
    finishes,
    ink,
    instruments,
    kitchen,
    laboratory,
    office,
    patterns,
)
from roomgraph.datasets.synthetic.textures.patterns import Colour

BENCHES: tuple[Colour, ...] = ((196, 204, 206), (150, 166, 180), (206, 200, 180))
PEGS: tuple[Colour, ...] = ((206, 196, 170), (176, 186, 192))


def style(site: Site) -> Style:
    """Return pale painted walls over linoleum."""
    rng = site.rng
    colour = patterns.pick(rng, ((120, 146, 150), (140, 150, 130), (126, 132, 150)))
    floor = material(finishes.studs(rng, 440, 440, colour), 220)
    wall = strip(site, patterns.pick(rng, ((228, 234, 234), (226, 230, 222)), 5))
    # Perforated sheet from the benches to the height of a hand.
    low, high = (len(wall) - int(z * PIXELS_PER_M) for z in (0.35, 1.35))
    wall[high:low] = finishes.perforated(rng, low - high, wall.shape[1], patterns.pick(rng, PEGS))
    return Style(wall, floor, paint((160, 170, 176)))


def furnish(site: Site) -> None:
    """Furnish a laboratory: benches along three walls, shelves and racks above and between."""
    rng, walls = site.rng, site.walls
    colour = patterns.pick(rng, BENCHES)
    far = walls["far"]
    _bench(site, far.stand.at(0.05), far.length - 0.1, colour, shelf=False)
    site.window("far", far.length / 2, 1.6)
    first, second = ("left", "right") if rng.random() < 0.5 else ("right", "left")
    start = 0.3 if first == "left" else 0.75
    _bench(site, walls[first].stand.at(start), walls[first].length - 1.05, colour, shelf=True)
    start = 0.3 if second == "left" else 0.75
    _rack_side(site, walls[second].stand.at(start), walls[second].length - 1.05)
    _beside_door(site)


@makes("lab_bench")
def _bench(site: Site, stand: Stand, length: float, colour: Colour, *, shelf: bool) -> None:
    rng = site.rng
    body, top = paint(colour), paint((64, 68, 72))
    count = max(2, round(length / 0.62))
    for i in range(count):
        x = (i * length / count, (i + 1) * length / count)
        front = laboratory.bench_unit(rng, 200, 160, colour)
        stand.box(x, (0, 0.60), (0.08, 0.82), body, front=Material(front))
    stand.box((0, length), (0, 0.66), (0.82, 0.86), top)
    at = 0.08
    while at < length - 0.3:
        wide = float(rng.uniform(0.32, 0.5))
        at += _on_bench(site, stand.at(at), min(wide, length - at - 0.05)) + float(
            rng.uniform(0.05, 0.2)
        )
    if shelf:
        for z in (1.42, 1.80):
            stand.box((0, length), (0, 0.26), (z - 0.02, z), paint((216, 220, 222)))
            at = 0.0
            while at < length - 0.3:
                wide = min(1.1, length - at)
                row = Material(laboratory.glassware(rng, 90, int(250 * wide)))
                stand.picture((at, at + wide), (z, z + 0.34), 0.15, row)
                at += wide


def _on_bench(site: Site, stand: Stand, wide: float) -> float:
    """Put an instrument, a screen or flasks on the bench; return how much of it that takes."""
    rng, kind = site.rng, float(site.rng.random())
    if kind < 0.62:
        tall = float(rng.uniform(0.16, 0.26))
        case = paint(patterns.pick(rng, instruments.CASES))
        for level in range(1 if rng.random() < 0.5 else 2):
            front = Material(instruments.instrument(rng, int(380 * tall), int(380 * wide)))
            z = 0.86 + level * (tall + 0.01)
            stand.box((0, wide), (0.15, 0.48), (z, z + tall), case, front=front)
        return wide
    if kind < 0.74:
        picture = Material(office.screen(rng, 150, 210), glow=SCREEN_GLOW)
        stand.box((0, 0.46), (0.2, 0.25), (0.94, 1.28), paint((50, 52, 56)), front=picture)
        stand.box((0.15, 0.31), (0.15, 0.32), (0.86, 0.94), paint((50, 52, 56)))
        return 0.5
    for i in range(3):
        liquid = paint(
            patterns.pick(rng, ((70, 150, 200), (206, 160, 60), (180, 80, 70), (110, 170, 100)))
        )
        place = (0.06 + 0.13 * i, float(rng.uniform(0.25, 0.45)))
        stand.prism(place, (0.86, 0.98), (0.06, 0.04), liquid)
        stand.prism(place, (0.98, 1.08), (0.03, 0.02), paint((214, 226, 230)))
    return 0.42


@makes("instrument_rack")
def _rack_side(site: Site, stand: Stand, length: float) -> None:
    """Stand racks of modules, gas cylinders and a cabinet along a wall, posters above."""
    rng, x = site.rng, 0.05
    dark = paint((40, 42, 46))
    for _ in range(2):
        front = Material(instruments.rack(rng, 400, 150))
        stand.box((x, x + 0.62), (0, 0.55), (0, 1.75), dark, front=front)
        x += 0.66
    for _ in range(2):
        colour = patterns.pick(rng, ((40, 90, 60), (60, 70, 110), (130, 40, 40), (90, 94, 98)))
        stand.prism((x + 0.16, 0.18), (0, 1.25), 0.12, paint(colour))
        stand.prism((x + 0.16, 0.18), (1.25, 1.45), (0.10, 0.03), paint((210, 212, 206)))
        x += 0.3
    board = min(1.2, length - x - 0.05)
    if board > 0.4:
        picture = Material(laboratory.pegboard(rng, 200, int(260 * board)))
        stand.picture((x + 0.05, x + 0.05 + board), (1.0, 1.78), 0.015, picture)
        cabinet = Material(
            kitchen.cupboard(rng, patterns.plaster(rng, 180, 160, (196, 180, 60)), 0)
        )
        stand.box(
            (x + 0.1, x + min(0.7, board)),
            (0, 0.42),
            (0, 0.75),
            paint((200, 180, 60)),
            front=cabinet,
        )


def _beside_door(site: Site) -> None:
    """Hang the periodic table and warning signs beside the door."""
    rng, wall = site.rng, site.walls["door"]
    (a, b), (c, d) = wall.beside_gap(0.12)
    width = min(1.3, b - a)
    table = Material(laboratory.periodic_table(rng, 240, int(300 * width)))
    wall.stand.picture((a, a + width), (1.0, 1.82), 0.012, table)
    for z in (1.5, 1.12):
        wall.stand.picture(
            (c + 0.05, c + 0.37), (z, z + 0.32), 0.012, Material(laboratory.warning(rng, 110))
        )
    if d - c > 0.8:
        wall.stand.picture(
            (c + 0.42, c + 0.8), (1.15, 1.75), 0.012, Material(ink.sheet(rng, 200, 130))
        )
