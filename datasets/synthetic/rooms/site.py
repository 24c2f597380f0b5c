"""A room to be furnished: its walls to stand things at, its style, its lamps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import CEILING_M, FloorPlan, Room
from roomgraph.datasets.synthetic.rendering.lighting import EVENING, LAMP, WINDOW
from roomgraph.datasets.synthetic.rendering.mesh import Glow, Image, Lamp, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.textures import patterns, signs

P = ParamSpec("P")
R = TypeVar("R")
PIXELS_PER_M = 256
STRIP_M = 3.2
SCREEN_GLOW: Glow = (0.4, 0.0, 1.0, 0.9)
SIGN_GLOW: Glow = (0.4, 0.2, 1.0, 0.8)
WINDOW_GLOW: Glow = (1.25, 0.0, 0.04, 0.05)


@dataclass(frozen=True, slots=True, eq=False)
class Style:
    """What a room's walls, floor and door frame are made of.

    `wall` shows a strip of wall from the ceiling to the floor, `STRIP_M` wide.
    """

    wall: Image
    floor: Material
    frame: Material


@dataclass(frozen=True, slots=True)
class Wall:
    """A wall seen from inside: x runs to the right along `stand`, `gap` is the doorway in it."""

    stand: Stand
    length: float
    gap: tuple[float, float, float] | None = None

    def beside_gap(self, margin: float) -> list[tuple[float, float]]:
        """Return the stretches on both sides of the doorway, less margins, the longer first."""
        left, right, _ = self.gap or (0.0, 0.0, 0.0)
        stretches = [(margin, left - margin), (right + margin, self.length - margin)]
        return sorted(stretches, key=lambda s: s[0] - s[1])


@dataclass(frozen=True, slots=True)
class Site:
    """A room being built.

    Its `walls` go round from the one with the door: door, left, far, right, as one sees them on
    coming in.
    """

    room: Room
    surfaces: Surfaces
    lamps: list[Lamp] = field(default_factory=list)
    walls: dict[str, Wall] = field(default_factory=dict)

    @property
    def rng(self) -> np.random.Generator:
        """The builder's random numbers."""
        return self.surfaces.rng

    def window(self, name: str, centre: float, width: float, power: float = 3.4) -> None:
        """Put a window into a wall; the sun lights the room through it."""
        stand = self.walls[name].stand
        view = signs.outside(self.rng, 300, int(220 * width))
        x, z = (centre - width / 2, centre + width / 2), (0.95, 2.15)
        stand.picture(x, z, 0.008, Material(view, glow=WINDOW_GLOW))
        sill = Material(patterns.plain(16, 16, (226, 226, 222)), 2.0, 2.0)
        stand.box((x[0] - 0.05, x[1] + 0.05), (0.0, 0.13), (0.91, 0.95), sill)
        inwards = stand.world([(0, 1, 0)])[0] - stand.world([(0, 0, 0)])[0]
        for share in (0.25, 0.75):
            place = stand.world([(x[0] + share * width, 0.1, 1.7)])[0]
            self.lamps.append(Lamp(_triple(place), _triple(inwards), power / 2, WINDOW))

    def lamp(self, x: float, y: float, evening: bool, power: float = 3.6) -> None:
        """Put a lit panel into the ceiling at a point of the floor, metres."""
        glow = [0.0, 3.0, 0.0, 0.1]
        if evening:
            glow[EVENING] = 1.7
            self.lamps.append(Lamp((x, y, CEILING_M - 0.03), (0, 0, -1), 1.5 * power, EVENING))
        self.lamps.append(Lamp((x, y, CEILING_M - 0.03), (0, 0, -1), power, LAMP))
        panel = patterns.plain(64, 64, (250, 250, 244))
        panel[::8] = (214, 214, 210)
        material = Material(panel, glow=(glow[0], glow[1], glow[2], glow[3]))
        corners = np.array(
            [(x - 0.3, y + 0.3), (x + 0.3, y + 0.3), (x + 0.3, y - 0.3), (x - 0.3, y - 0.3)]
        )
        # Seen from below, so clockwise there is the other way round.
        ceiling = np.column_stack([corners[[1, 0, 3, 2]], np.full(4, CEILING_M - 0.01)])
        self.surfaces.picture(ceiling, material)

    def table_lamp(self, stand: Stand, x: float, y: float, z: float) -> None:
        """Put a small lamp on a table; it burns in the evening."""
        shade = Material(patterns.plain(8, 8, (250, 226, 170)), glow=(0.3, 0.1, 1.4, 0.5))
        foot = Material(patterns.plain(8, 8, (60, 60, 64)))
        stand.prism((x, y), (z, z + 0.22), 0.02, foot)
        stand.prism((x, y), (z + 0.22, z + 0.38), (0.12, 0.07), shade)
        place = stand.world([(x, y, z + 0.5)])[0]
        self.lamps.append(Lamp(_triple(place), (0, 0, 1), 1.2, EVENING))
        below = stand.world([(x, y, z + 0.2)])[0]
        self.lamps.append(Lamp(_triple(below), (0, 0, -1), 0.5, EVENING))


def _triple(point: np.ndarray) -> tuple[float, float, float]:
    return float(point[0]), float(point[1]), float(point[2])


def make_site(room: Room, plan: FloorPlan, surfaces: Surfaces) -> Site:
    """Return the room's site with its four walls and the doorways in them."""
    site = Site(room, surfaces)
    r = room.floor
    around = [
        ("south", Stand(surfaces, (r.x1, r.y0, 0), np.pi / 2), r.x1 - r.x0),
        ("west", Stand(surfaces, (r.x0, r.y0, 0), 0.0), r.y1 - r.y0),
        ("north", Stand(surfaces, (r.x0, r.y1, 0), -np.pi / 2), r.x1 - r.x0),
        ("east", Stand(surfaces, (r.x1, r.y1, 0), np.pi), r.y1 - r.y0),
    ]
    first = 0
    if room.label != "corridor":
        door = plan.doorway(room.name)
        distances = [door.xy[1] - r.y0, door.xy[0] - r.x0, r.y1 - door.xy[1], r.x1 - door.xy[0]]
        first = int(np.argmin(np.abs(distances)))
    for name, index in zip(("door", "left", "far", "right"), range(first, first + 4), strict=True):
        side, stand, length = around[index % 4]
        site.walls[name] = Wall(stand, length, _gap(room, side, stand, plan))
    return site


def _gap(room: Room, side: str, stand: Stand, plan: FloorPlan) -> tuple[float, float, float] | None:
    """Return where the doorway begins and ends on a wall and how high it is.

    The corridor's long walls have several; `gaps` finds them all.
    """
    found = gaps(room, side, stand, plan)
    return found[0] if len(found) == 1 else None


def gaps(room: Room, side: str, stand: Stand, plan: FloorPlan) -> list[tuple[float, float, float]]:
    """Return begin, end and height of every doorway in a wall of a room, along the wall."""
    r = room.floor
    near = {"south": r.y0, "north": r.y1, "west": r.x0, "east": r.x1}[side]
    axis = 1 if side in ("south", "north") else 0
    found = []
    for door in plan.doorways:
        if room.name in door.rooms and abs(door.xy[axis] - near) < 0.2:
            way = np.array([door.xy[0] - stand.origin[0], door.xy[1] - stand.origin[1]])
            along = float(abs(way[1 - axis]))
            found.append((along - door.width_m / 2, along + door.width_m / 2, door.height_m))
    return sorted(found)


def makes(name: str) -> Callable[[Callable[Concatenate[Site, Stand, P], R]], Callable[..., R]]:
    """Say of a function that builds at a stand which thing it makes."""

    def decorate(build: Callable[Concatenate[Site, Stand, P], R]) -> Callable[..., R]:
        @wraps(build)
        def built(site: Site, stand: Stand, *args: P.args, **kwargs: P.kwargs) -> R:
            with stand.surfaces.thing(name):
                return build(site, stand, *args, **kwargs)

        return built

    return decorate


def material(image: Image, pixels_per_m: float = PIXELS_PER_M, *, shiny: bool = False) -> Material:
    """Return a material of an image drawn at so many pixels a metre."""
    height, width = image.shape[:2]
    return Material(image, width / pixels_per_m, height / pixels_per_m, shiny)


def paint(colour: patterns.Colour) -> Material:
    """Return a material of one colour."""
    return Material(patterns.plain(16, 16, colour), 8.0, 8.0)


def strip(site: Site, colour: patterns.Colour) -> Image:
    """Return a strip of painted wall with a skirting board."""
    height, width = int(CEILING_M * PIXELS_PER_M), int(STRIP_M * PIXELS_PER_M)
    image = patterns.plaster(site.rng, height, width, colour)
    image[-20:] = [int(0.72 * c) for c in colour]
    image[-21:-20] = [int(0.5 * c) for c in colour]
    return image
