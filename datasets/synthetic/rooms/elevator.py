"""Elevator areas: steel doors, call buttons, floor number, plants, directories, stone."""

from __future__ import annotations

from roomgraph.datasets.synthetic.plans.layout import CEILING_M
from roomgraph.datasets.synthetic.rendering.mesh import Material
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import (
    PIXELS_PER_M,
    SIGN_GLOW,
    STRIP_M,
    Site,
    Style,
    makes,
    material,
    paint,
)
from roomgraph.datasets.synthetic.textures import finishes, ink, patterns, signs
from roomgraph.datasets.synthetic.textures.patterns import Colour

STONES: tuple[Colour, ...] = ((170, 160, 150), (150, 150, 154), (186, 170, 150))


def style(site: Site) -> Style:
    """Return walls panelled with stone to the height of a rail, over a floor of stone slabs."""
    rng = site.rng
    height, width = int(CEILING_M * PIXELS_PER_M), int(STRIP_M * PIXELS_PER_M)
    wall = patterns.plaster(rng, height, width, patterns.shift(rng, (226, 222, 214), 6))
    rail = height - int(1.3 * PIXELS_PER_M)
    colour = patterns.pick(rng, STONES)
    wall[rail:] = finishes.terrazzo(rng, height - rail, width, colour, width // 4)
    wall[rail - 8 : rail] = (120, 116, 110)
    floor = material(finishes.terrazzo(rng, 528, 528, patterns.pick(rng, STONES), 132), 220)
    return Style(wall, floor, material(patterns.stone(rng, 200, 480, colour, 1000)))


def furnish(site: Site) -> None:
    """Furnish the area: elevators on one side, floor plan, directory, plants and a bench."""
    rng, walls = site.rng, site.walls
    lifts, other = ("left", "right") if rng.random() < 0.5 else ("right", "left")
    floor = int(rng.integers(1, 9))
    _lifts(site, walls[lifts].stand, walls[lifts].length, floor)
    far = walls["far"]
    number = Material(signs.floor_number(rng, 260, 200, floor))
    far.stand.picture((0.45, 1.15), (1.0, 1.9), 0.015, number)
    plan = Material(ink.framed(signs.evacuation_plan(rng, 260, 330), (150, 154, 160), 6))
    far.stand.picture((1.4, 2.6), (1.0, 1.92), 0.015, plan)
    _plant(site, far.stand.at(far.length - 0.35, 0.33))
    _plant(site, far.stand.at(0.33, 0.33))
    _seating(site, walls[other].stand, walls[other].length)
    site.window(other, walls[other].length / 2, 1.5)


@makes("elevator_doors")
def _lifts(site: Site, stand: Stand, length: float, floor: int) -> None:
    rng = site.rng
    frame = material(patterns.steel(rng, 200, 200, (130, 134, 140)), shiny=True)
    middles = (length * 0.27, length * 0.73)
    for x in middles:
        leaf = Material(signs.elevator_door(rng, 480, 230), shiny=True)
        stand.picture((x - 0.5, x + 0.5), (0, 2.1), 0.01, leaf)
        for side in (x - 0.6, x + 0.5):
            stand.box((side, side + 0.1), (0, 0.06), (0, 2.2), frame)
        stand.box((x - 0.6, x + 0.6), (0, 0.06), (2.1, 2.2), frame)
        display = patterns.plain(50, 120, (20, 18, 18))
        ink.write(display, f"{floor} ^", (30, 6, 90, 44), (255, 110, 50), thickness=2)
        stand.picture((x - 0.2, x + 0.2), (2.25, 2.42), 0.03, Material(display, glow=SIGN_GLOW))
    middle = length / 2
    buttons = Material(signs.call_buttons(rng, 170, 80))
    stand.picture((middle - 0.1, middle + 0.1), (0.92, 1.35), 0.02, buttons)
    rules = Material(ink.sheet(rng, 150, 110))
    stand.picture((middle - 0.14, middle + 0.14), (1.45, 1.83), 0.015, rules)


@makes("plant")
def _plant(site: Site, stand: Stand) -> None:
    rng = site.rng
    pot = material(patterns.stone(rng, 160, 320, (150, 96, 70), 1000))
    leaf = Material(signs.leaves(rng, 200, 400))
    stand.prism((0, 0), (0, 0.40), (0.17, 0.22), pot, cap=paint((60, 44, 34)))
    stand.prism((0, 0), (0.42, 0.95), (0.08, 0.28), leaf)
    stand.prism((0, 0), (0.95, 1.45), (0.28, 0.05), leaf)


@makes("bench")
def _seating(site: Site, stand: Stand, length: float) -> None:
    """Place a bench under the window, a directory of firms and an ashtray beside it."""
    rng, middle = site.rng, length / 2
    seat = material(patterns.wood(rng, 160, 400, (130, 84, 50)))
    stand.box((middle - 0.7, middle + 0.7), (0.04, 0.44), (0.40, 0.46), seat)
    for x in (middle - 0.6, middle + 0.52):
        stand.box((x, x + 0.08), (0.1, 0.38), (0, 0.40), paint((70, 72, 76)))
    stand.prism((middle + 0.95, 0.2), (0, 0.62), 0.12, material(patterns.steel(rng, 170, 200)))
    board = patterns.plain(240, 170, (30, 34, 40))
    for y in range(12, 220, 26):
        ink.write(board, str(int(rng.integers(1, 9))), (10, y, 28, y + 18), (250, 200, 80))
        ink.write(board, f"{ink.word(rng)} {ink.word(rng)}", (38, y, 160, y + 18), (240, 240, 236))
    stand.picture((middle - 1.5, middle - 0.9), (1.0, 1.85), 0.015, Material(board))
    sign = Material(signs.exit_sign(70, 150, True), glow=SIGN_GLOW)
    stand.picture((middle + 0.85, middle + 1.3), (1.9, 2.1), 0.015, sign)
