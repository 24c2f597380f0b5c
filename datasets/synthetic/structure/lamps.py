"""Ceiling lamps: lit panels in a grid, or a pendant in the middle."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import Room
from roomgraph.datasets.synthetic.rendering.lighting import EVENING, LAMP
from roomgraph.datasets.synthetic.rendering.mesh import Glow, Lamp, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.shapes import lathe, tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns

# Rooms without daylight: their lamps are as bright by day as windows are elsewhere.
INNER, INNER_POWER = ("corridor", "stairwell", "store_room"), 2.4


def hang_lamps(surfaces: Surfaces, room: Room, is_home: bool, is_on: bool) -> None:
    """Hang a room's ceiling lamps; if they are off, only the evening's burn, and weakly."""
    rng, r = surfaces.rng, room.floor
    if is_home and r.area < 30:
        _pendant(surfaces, room, is_on)
        return
    columns, rows = max(1, round((r.x1 - r.x0) / 2.4)), max(1, round((r.y1 - r.y0) / 2.4))
    first = int(rng.integers(2))
    long = bool(rng.random() < 0.5)
    for i in range(columns):
        for j in range(rows):
            x = r.x0 + (i + 0.5) * (r.x1 - r.x0) / columns
            y = r.y0 + (j + 0.5) * (r.y1 - r.y0) / rows
            evening = (i + j) % 2 == first or columns * rows == 1
            _panel(surfaces, (x, y), room, evening, is_on, long)


def _glow(evening: bool, is_on: bool) -> Glow:
    return (0.0, 3.0 if is_on else 0.3, 1.7 if evening and is_on else 0.1, 0.15)


def _by_day(room: Room) -> float:
    return INNER_POWER if room.label in INNER else 1.0


def _burn(
    surfaces: Surfaces, at: tuple[float, float, float], power: float, evening: bool, is_on: bool,
    by_day: float,
) -> None:  # fmt: skip
    """Add a lamp's light; one that is off gives none."""
    if not is_on:
        return
    surfaces.lamps.append(Lamp(at, (0, 0, -1), by_day * power, LAMP))
    if evening:
        surfaces.lamps.append(Lamp(at, (0, 0, -1), 1.5 * power, EVENING))


def _panel(
    surfaces: Surfaces, xy: tuple[float, float], room: Room, evening: bool, is_on: bool, long: bool
) -> None:
    picture = patterns.plain(64, 64, (250, 250, 244))
    picture[::8] = (214, 214, 210)
    z = room.base_m + room.ceiling_m
    a, b = (0.6, 0.12) if long else (0.3, 0.3)
    (x, y) = xy
    corners = np.array([(x + a, y + b, z), (x - a, y + b, z), (x - a, y - b, z), (x + a, y - b, z)])
    corners[:, 2] -= 0.012
    with surfaces.thing("lamp"):
        surfaces.picture(corners, Material(picture, glow=_glow(evening, is_on)))
    power = 2.5 + 0.4 * (room.ceiling_m - 2.4)
    _burn(surfaces, (x, y, z - 0.03), power, evening, is_on, _by_day(room))


def _pendant(surfaces: Surfaces, room: Room, is_on: bool) -> None:
    """Hang a shade on a cord."""
    rng, (x, y) = surfaces.rng, room.floor.centre
    top = room.base_m + room.ceiling_m
    drop = float(np.clip(rng.uniform(0.25, 0.7), 0.2, room.ceiling_m - 1.95))
    stand = Stand(surfaces, (x, y, top), 0.0)
    colour = patterns.pick(rng, ((244, 240, 228), (226, 190, 130), (60, 62, 66), (180, 90, 70)))
    shade = Material(patterns.plain(8, 8, colour), glow=_glow(True, is_on))
    cord = Material(patterns.plain(8, 8, (60, 60, 62)))
    wide = float(rng.uniform(0.12, 0.26))
    foot = 0.5 * wide if rng.random() < 0.5 else wide
    with surfaces.thing("lamp"):
        tube(stand, (0, 0, 0), (0, 0, -drop), 0.012, cord, sides=4)
        profile = [(foot, -drop - 0.18), (wide, -drop - 0.1), (0.05, -drop)]
        lathe(stand, (0, 0), profile, shade, sides=10)
    power = 2.6 + 0.22 * room.floor.area
    _burn(surfaces, (x, y, top - drop - 0.2), power, True, is_on, _by_day(room))
    if is_on:  # The shade lets light out to the ceiling, too.
        surfaces.lamps.append(Lamp((x, y, top - drop), (0, 0, 1), 0.35 * power, EVENING))
        surfaces.lamps.append(Lamp((x, y, top - drop), (0, 0, 1), 0.3 * power, LAMP))
