"""Offices: desks with screens, bookshelves, boards, posters."""

from __future__ import annotations

from dataclasses import dataclass

from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
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
from roomgraph.datasets.synthetic.textures import finishes, ink, kitchen, office, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour


@dataclass(frozen=True, slots=True)
class Theme:
    """What tells one office from the next."""

    wood: Colour
    wall: Colour
    floor: Colour
    panel: Colour
    books: tuple[Colour, ...]
    chair: Colour


WARM: tuple[Colour, ...] = (
    (150, 50, 40),
    (190, 130, 60),
    (110, 76, 44),
    (70, 40, 36),
    (206, 186, 140),
)
COOL: tuple[Colour, ...] = (
    (40, 70, 130),
    (50, 110, 120),
    (210, 214, 220),
    (90, 100, 120),
    (30, 40, 60),
)
GREEN: tuple[Colour, ...] = (
    (50, 100, 60),
    (220, 190, 60),
    (230, 226, 210),
    (120, 140, 60),
    (40, 60, 50),
)
THEMES = (
    Theme((156, 104, 60), (230, 222, 204), (158, 112, 70), (170, 150, 120), WARM, (60, 44, 40)),
    Theme((206, 178, 136), (208, 218, 226), (86, 100, 124), (130, 146, 164), COOL, (40, 56, 100)),
    Theme((98, 66, 46), (222, 226, 206), (120, 124, 100), (150, 160, 124), GREEN, (40, 80, 56)),
    Theme(
        (222, 214, 200), (234, 214, 196), (186, 150, 108), (176, 140, 120), ink.VIVID, (150, 44, 40)
    ),
)


def theme(site: Site, seed: int) -> Theme:
    """Return the theme of an office; offices of one building have different ones."""
    number = int(site.room.name.removeprefix("office"))
    return THEMES[(seed + number * (1 + 2 * (seed % 2))) % len(THEMES)]


def style(site: Site, look: Theme) -> Style:
    """Return painted walls over carpet in squares."""
    rng = site.rng
    colour = patterns.shift(rng, look.floor, 8)
    floor = material(finishes.dashes(rng, 440, 440, colour), 220)
    frame = material(patterns.wood(rng, 200, 480, look.wood))
    wall = strip(site, patterns.shift(rng, look.wall, 6))
    # Woven panels that swallow sound, under a rail.
    high, low = (len(wall) - int(z * PIXELS_PER_M) for z in (1.05, 0.1))
    wall[high:low] = finishes.dashes(rng, low - high, wall.shape[1], look.panel)
    wall[high - 8 : high] = look.wood
    return Style(wall, floor, frame)


def furnish(site: Site, look: Theme) -> None:
    """Furnish an office: desks at the window and at a side, shelves, boards and posters."""
    rng, walls = site.rng, site.walls
    image = patterns.wood(rng, 320, 440, look.wood)
    wood = material(image)
    far = walls["far"]
    site.window("far", far.length / 2, min(2.2, far.length - 1.2))
    x = float(rng.uniform(0.1, far.length - 2.6))
    _desk(site, far.stand.at(x), 1.6, image, wood, look)
    _cabinet(site, far.stand.at(x + 1.7), wood)
    first, second = ("left", "right") if rng.random() < 0.5 else ("right", "left")
    start, end = _span(site, first)
    # The chair is kept from the door: the desk stands at the far end, the shelf at the near one.
    desk, shelf = (end - 1.45, start) if first == "left" else (start + 0.05, end - 0.85)
    _desk(site, walls[first].stand.at(desk), 1.4, image, wood, look)
    _shelf(site, walls[first].stand.at(shelf), 0.8, wood, look)
    _hang(site, first, desk + 0.1, desk + 1.4)
    start, end = _span(site, second)
    for i in range(2):
        _shelf(site, walls[second].stand.at(start + 0.1 + 0.92 * i), 0.9, wood, look)
    _hang(site, second, start + 2.05, end)
    _beside_door(site)


def _span(site: Site, name: str) -> tuple[float, float]:
    """Return the stretch of a side wall that the far wall's furniture leaves free."""
    length = site.walls[name].length
    return (0.25, length - 0.95) if name == "left" else (0.95, length - 0.25)


@makes("desk")
def _desk(site: Site, stand: Stand, width: float, top: Image, wood: Material, look: Theme) -> None:
    rng = site.rng
    dark = paint((44, 45, 50))
    surface = Material(
        office.desk_top(rng, top[: int(0.46 * width * 256 * 0.99), : int(width * 256)])
    )
    stand.box((0, width), (0, 0.72), (0.70, 0.74), wood, top=surface)
    stand.box((0.02, 0.06), (0.05, 0.68), (0, 0.70), wood)
    stand.box(
        (width - 0.42, width - 0.02), (0.05, 0.66), (0.04, 0.70), wood, front=_drawers(site, wood)
    )
    for i in range(2 if width > 1.5 else 1):
        x, turn = 0.12 + 0.62 * i, float(rng.uniform(-0.2, 0.2))
        monitor = stand.at(x + 0.28, 0.24, 0.74, turn)
        picture = Material(office.screen(rng, 150, 230), glow=SCREEN_GLOW)
        monitor.box((-0.28, 0.28), (-0.02, 0.03), (0.10, 0.46), dark, front=picture)
        monitor.box((-0.1, 0.1), (-0.08, 0.08), (0, 0.02), dark)
        monitor.box((-0.03, 0.03), (-0.04, -0.02), (0, 0.2), dark)
    if rng.random() < 0.7:
        site.table_lamp(stand, width - 0.2, 0.2, 0.74)
    _chair(site, stand.at(0.5, 0.66, 0, float(rng.uniform(-0.4, 0.4))), look)


def _drawers(site: Site, wood: Material) -> Material:
    return Material(kitchen.drawers(wood.image[:170, :102], 3))


@makes("chair")
def _chair(site: Site, stand: Stand, look: Theme) -> None:
    fabric = material(patterns.cloth(site.rng, 120, 120, look.chair))
    dark = paint((40, 40, 44))
    stand.box((-0.23, 0.23), (-0.22, 0.20), (0.43, 0.50), fabric)
    stand.box((-0.21, 0.21), (0.20, 0.26), (0.55, 0.98), fabric)
    stand.box((-0.03, 0.03), (-0.03, 0.03), (0.08, 0.43), dark)
    stand.box((-0.25, 0.25), (-0.03, 0.03), (0.03, 0.08), dark)
    stand.box((-0.03, 0.03), (-0.25, 0.25), (0.03, 0.08), dark)


@makes("book_case")
def _shelf(site: Site, stand: Stand, width: float, wood: Material, look: Theme) -> None:
    rng = site.rng
    for x in (0.0, width - 0.025):
        stand.box((x, x + 0.025), (0, 0.32), (0, 2.0), wood)
    levels = [0.06, 0.42, 0.78, 1.14, 1.50, 1.82]
    for z, above in zip(levels, [*levels[1:], 2.0], strict=True):
        stand.box((0.025, width - 0.025), (0, 0.31), (z - 0.025, z), wood)
        tall = int((above - z - 0.03) * 260)
        row = Material(office.books(rng, tall, int(width * 260), look.books))
        stand.picture(
            (0.025, width - 0.025), (z, above - 0.03), 0.25 - float(rng.uniform(0, 0.04)), row
        )
    stand.box((0, width), (0, 0.32), (1.975, 2.0), wood)


@makes("cabinet")
def _cabinet(site: Site, stand: Stand, wood: Material) -> None:
    """Place a low cabinet with a printer on it."""
    leaf = Material(kitchen.cupboard(site.rng, wood.image[:180, :200], 0))
    stand.box((0, 0.75), (0, 0.45), (0, 0.72), wood, front=leaf)
    grey = paint((206, 206, 202))
    panel = patterns.plain(70, 120, (200, 200, 196))
    ink.lines(site.rng, panel, (10, 8, 60, 30), 7)
    panel[40:48, 10:110] = (30, 30, 34)
    panel[10:26, 78:108] = (60, 120, 160)
    stand.box((0.14, 0.60), (0.04, 0.40), (0.72, 0.98), grey, front=Material(panel))


def _hang(site: Site, name: str, start: float, end: float) -> None:
    """Hang a board or posters on the wall between two places, above the furniture."""
    rng, stand = site.rng, site.walls[name].stand
    if end - start < 0.5:
        return
    width = min(1.25, end - start)
    z = (1.22, 1.98)
    if rng.random() < 0.5:
        picture = (office.whiteboard if rng.random() < 0.5 else office.pinboard)(
            rng, 200, int(260 * width)
        )
        stand.picture((start, start + width), z, 0.015, Material(picture))
        return
    x = start
    while x + 0.45 < end:
        picture = ink.framed(ink.poster(rng, 210, 150), (40, 36, 32), 4)
        stand.picture((x, x + 0.52), (1.24, 1.96), 0.015, Material(picture))
        x += 0.62


def _beside_door(site: Site) -> None:
    """Hang a poster and a pinboard on the door's wall, and stand a waste bin there."""
    rng, wall = site.rng, site.walls["door"]
    (a, b), (c, _) = wall.beside_gap(0.15)
    width = min(1.0, b - a)
    board = Material(office.pinboard(rng, 210, int(260 * width)))
    wall.stand.picture((a, a + width), (1.1, 1.9), 0.015, board)
    poster = Material(ink.poster(rng, 220, 150))
    wall.stand.picture((c, c + 0.5), (1.1, 1.84), 0.012, poster)
    corner = 0.16 if a < c else wall.length - 0.16
    wall.stand.prism((corner, 0.15), (0, 0.36), (0.09, 0.12), paint((60, 66, 74)))
