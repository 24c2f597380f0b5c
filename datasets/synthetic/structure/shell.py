"""The building's shell: walls with doorways, floors, ceilings, door frames, ceiling lamps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import CEILING_M, WALL_M, Doorway, FloorPlan
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms.site import STRIP_M, Site, Style, gaps
from roomgraph.datasets.synthetic.textures import patterns


def raise_room(site: Site, style: Style, plan: FloorPlan, ceiling: Material) -> None:
    """Build a room's floor, ceiling and walls, and hang its ceiling lamps."""
    r = site.room.floor
    low = np.array([(r.x0, r.y1), (r.x1, r.y1), (r.x1, r.y0), (r.x0, r.y0)])
    site.surfaces.cover(np.column_stack([low, np.zeros(4)]), style.floor)
    high = low[[1, 0, 3, 2]]
    site.surfaces.cover(np.column_stack([high, np.full(4, CEILING_M)]), ceiling)
    strip = Material(style.wall)
    sides = {(np.pi / 2): "south", 0.0: "west", -np.pi / 2: "north", np.pi: "east"}
    for wall in site.walls.values():
        openings = gaps(site.room, sides[wall.stand.facing], wall.stand, plan)
        raise_wall(wall.stand, wall.length, openings, strip)
    _hang_lamps(site)


def raise_wall(
    stand: Stand,
    length: float,
    openings: Sequence[tuple[float, float, float]],
    strip: Material,
    ceiling_m: float = CEILING_M,
) -> None:
    """Cover a wall with strips from floor to ceiling, and with lintels over the openings.

    An opening is where it begins and ends along the wall, and how high it is, metres.
    """
    start = 0.0
    for begin, end, height in [*openings, (length, length, ceiling_m)]:
        _strips(stand, (start, begin), 0.0, strip, ceiling_m)
        if end > begin and height < ceiling_m - 1e-6:
            _strips(stand, (begin, end), height, strip, ceiling_m)
        start = end


def _strips(
    stand: Stand, span: tuple[float, float], foot: float, strip: Material, ceiling_m: float
) -> None:
    """Cover a stretch of wall from `foot` upwards with the upper part of the strip."""
    count = max(1, int(np.ceil((span[1] - span[0]) / STRIP_M - 1e-9)))
    edges = np.minimum(span[0] + np.arange(count + 1) * STRIP_M, span[1])
    for a, b in pairwise(edges):
        if b - a < 1e-6:
            continue
        corners = stand.world([(a, 0, ceiling_m), (b, 0, ceiling_m), (b, 0, foot), (a, 0, foot)])
        window = (0.0, 0.0, float((b - a) / STRIP_M), (ceiling_m - foot) / ceiling_m)
        stand.surfaces.quads.append(Quad(corners, strip, window))


def _hang_lamps(site: Site) -> None:
    """Hang ceiling lamps in a grid; every second one burns in the evening."""
    r = site.room.floor
    columns = max(2, round((r.x1 - r.x0) / 2.0))
    rows = max(1, round((r.y1 - r.y0) / 2.0))
    first = int(site.rng.integers(2))
    for i in range(columns):
        for j in range(rows):
            x = r.x0 + (i + 0.5) * (r.x1 - r.x0) / columns
            y = r.y0 + (j + 0.5) * (r.y1 - r.y0) / rows
            site.lamp(x, y, evening=(i + j) % 2 == first, power=2.2 if rows > 1 else 2.8)


def frame_doorway(surfaces: Surfaces, door: Doorway, frame: Material, floor: Material) -> None:
    """Build a doorway's frame, the underside of its lintel and its threshold."""
    facing = np.pi / 2 if door.along == "x" else 0.0
    stand = Stand(surfaces, (*door.xy, door.base_m), facing)
    half, deep, height = door.width_m / 2, WALL_M / 2 + 0.015, door.height_m
    for x in (-half - 0.07, half):
        stand.box((x, x + 0.07), (-deep, deep), (0, height + 0.07), frame)
    stand.box((-half, half), (-deep, deep), (height, height + 0.07), frame)
    sheet = [
        (-half, -WALL_M / 2, 0),
        (half, -WALL_M / 2, 0),
        (half, WALL_M / 2, 0),
        (-half, WALL_M / 2, 0),
    ]
    surfaces.cover(stand.world([(x, y, 0.001) for x, y, _ in sheet]), floor)


def ceiling_material(rng: np.random.Generator) -> Material:
    """Return a suspended ceiling of square panels."""
    return Material(patterns.ceiling(rng, 120), 0.6, 0.6)
