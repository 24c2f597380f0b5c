"""What walls, floors and ceilings are covered with: drawn from what such rooms may have.

Most finishes are found in several kinds of rooms; hardly any gives a kind away.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.rendering.mesh import Image, Material
from roomgraph.datasets.synthetic.rooms.site import PIXELS_PER_M, STRIP_M
from roomgraph.datasets.synthetic.textures import finishes, homes, patterns
from roomgraph.datasets.synthetic.textures.patterns import Colour

PAINTS: tuple[Colour, ...] = (
    (240, 238, 232), (236, 230, 214), (226, 230, 232), (214, 222, 210), (230, 214, 200),
    (206, 214, 226), (246, 240, 222), (196, 204, 196), (222, 206, 212), (186, 190, 196),
    (214, 178, 150), (160, 180, 190), (244, 244, 244), (232, 224, 208),
)  # fmt: skip
WOODS: tuple[Colour, ...] = (
    (176, 134, 88), (150, 104, 66), (204, 176, 134), (110, 78, 54), (190, 180, 164), (86, 66, 52),
)  # fmt: skip
GROUND: tuple[Colour, ...] = (
    (150, 140, 128), (120, 124, 126), (176, 164, 146), (96, 104, 116), (140, 112, 96),
    (196, 190, 180), (110, 120, 104),
)  # fmt: skip
CARPETS: tuple[Colour, ...] = (
    (110, 112, 116), (90, 104, 130), (150, 140, 124), (120, 70, 66), (86, 100, 86), (176, 166, 150),
)  # fmt: skip
GLAZES: tuple[Colour, ...] = (
    (236, 238, 236), (206, 222, 226), (240, 232, 212), (186, 206, 196), (150, 170, 186),
    (224, 210, 206),
)  # fmt: skip
GROUPS = {
    "bathroom": "wet", "kitchen": "kitchen", "office": "work", "meeting_room": "work",
    "printer_area": "work", "laboratory": "plain", "store_room": "plain", "corridor": "way",
    "hall": "way", "stairwell": "way", "elevator_area": "way", "elevator": "way",
}  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class Finish:
    """What a room is covered with; `wall` is a strip from ceiling to floor, `STRIP_M` wide."""

    wall: Image
    floor: Material
    ceiling: Material


def draw_finish(label: str, ceiling_m: float, is_home: bool, rng: np.random.Generator) -> Finish:
    """Draw what a room of a kind is covered with."""
    group = GROUPS.get(label, "home")
    if is_home and group in ("work", "way", "plain"):
        group = "home" if rng.random() < 0.8 else group
    wall = _wall(group, ceiling_m, is_home, rng)
    return Finish(wall, _floor(group, rng), _ceiling(is_home, rng))


def _choose(rng: np.random.Generator, odds: dict[str, float]) -> str:
    share = np.array(list(odds.values()))
    return list(odds)[int(rng.choice(len(odds), p=share / share.sum()))]


FLOORS: dict[str, dict[str, float]] = {
    "wet": {"tiles": 0.6, "mosaic": 0.15, "linoleum": 0.15, "stone": 0.1},
    "kitchen": {"tiles": 0.45, "planks": 0.25, "linoleum": 0.2, "terrazzo": 0.1},
    "work": {"carpet": 0.4, "squares": 0.15, "linoleum": 0.2, "planks": 0.25},
    "plain": {"linoleum": 0.5, "tiles": 0.2, "terrazzo": 0.15, "stone": 0.15},
    "way": {"stone": 0.2, "terrazzo": 0.2, "linoleum": 0.2, "carpet": 0.2, "tiles": 0.2},
    "home": {"planks": 0.4, "parquet": 0.2, "carpet": 0.25, "tiles": 0.15},
}


def _floor(group: str, rng: np.random.Generator) -> Material:
    kind, side = _choose(rng, FLOORS[group]), 440
    ground, wood = patterns.pick(rng, GROUND, 14), patterns.pick(rng, WOODS, 12)
    glaze, carpet = patterns.pick(rng, (*GROUND, *GLAZES), 10), patterns.pick(rng, CARPETS, 12)
    tile = int(rng.choice((55, 88, 110, 146)))
    draw: dict[str, Callable[[], Image]] = {
        "planks": lambda: homes.planks(rng, side, side, wood),
        "parquet": lambda: homes.herringbone(rng, side, side, wood),
        "carpet": lambda: patterns.cloth(rng, side, side, carpet),
        "squares": lambda: finishes.dashes(rng, side, side, carpet),
        "tiles": lambda: patterns.tiles(
            rng, (side, side), (tile, tile), (glaze,), (150, 146, 140), 0
        ),
        "mosaic": lambda: finishes.mosaic(rng, side, side, (glaze, ground, glaze)),
        "linoleum": lambda: patterns.linoleum(rng, side, side, ground),
        "terrazzo": lambda: finishes.terrazzo(rng, side, side, ground, 146),
        "stone": lambda: patterns.stone(rng, side, side, ground, 146),
    }
    return Material(draw[kind](), 2.0, 2.0)


def _ceiling(is_home: bool, rng: np.random.Generator) -> Material:
    if not is_home and rng.random() < 0.6:
        return Material(patterns.ceiling(rng, 120), 0.6, 0.6)
    return Material(patterns.plaster(rng, 256, 256, patterns.shift(rng, (238, 237, 233), 6)), 3, 3)


WALLS: dict[str, dict[str, float]] = {
    "wet": {"tiled": 0.75, "paint": 0.25},
    "kitchen": {"paint": 0.65, "tiled": 0.25, "paper": 0.1},
    "work": {"paint": 0.8, "two": 0.08, "bricks": 0.06, "panels": 0.06},
    "plain": {"paint": 0.65, "two": 0.2, "tiled": 0.1, "bricks": 0.05},
    "way": {"paint": 0.5, "two": 0.3, "panels": 0.12, "bricks": 0.08},
    "home": {"paint": 0.6, "paper": 0.28, "panels": 0.06, "bricks": 0.06},
}


def _wall(group: str, ceiling_m: float, is_home: bool, rng: np.random.Generator) -> Image:
    height, width = int(ceiling_m * PIXELS_PER_M), int(STRIP_M * PIXELS_PER_M)
    kind, colour = _choose(rng, WALLS[group]), patterns.pick(rng, PAINTS, 8)
    if kind == "bricks":
        return homes.bare_bricks(rng, height, width)
    if kind == "paper":
        draw = homes.striped_paper if rng.random() < 0.5 else homes.printed_paper
        image = draw(rng, height, width, colour)
    else:
        image = patterns.plaster(rng, height, width, colour)
    if kind == "tiled":
        top = float(rng.choice((1.2, 1.5, 2.1)))
        rows = min(height, int(top * PIXELS_PER_M))
        tall = int(rng.choice((26, 38, 52, 77)))
        wide = tall * int(rng.choice((1, 1, 2)))
        glaze = patterns.pick(rng, GLAZES, 8)
        share = 0.08 if rng.random() < 0.3 else 0.0
        image[-rows:] = patterns.tiles(
            rng, (rows, width), (tall, wide), (glaze,), (176, 178, 176), share
        )
        return image
    if kind in ("two", "panels"):
        rows = int(float(rng.uniform(0.9, 1.3)) * PIXELS_PER_M)
        lower = patterns.pick(rng, GROUND if kind == "two" else WOODS, 12)
        draw_lower = patterns.plaster if kind == "two" else finishes.panelling
        image[-rows:] = draw_lower(rng, rows, width, lower)
    board = int(float(rng.uniform(0.06, 0.12)) * PIXELS_PER_M)
    image[-board:] = (232, 230, 224) if is_home else [int(0.7 * c) for c in colour]
    image[-board - 1 : -board] = [int(0.5 * c) for c in colour]
    return image
