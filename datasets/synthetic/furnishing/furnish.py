"""A room made whole: walls, windows, finishes, furniture, lamps."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.furnishing.arrange import Arranger
from roomgraph.datasets.synthetic.furnishing.finishes import Finish, draw_finish
from roomgraph.datasets.synthetic.furnishing.piece import set_down, solid_outlines
from roomgraph.datasets.synthetic.furnishing.plot import Plot, Wall
from roomgraph.datasets.synthetic.furnishing.visit import change
from roomgraph.datasets.synthetic.objects.look import draw_look
from roomgraph.datasets.synthetic.plans.layout import FloorPlan, Room
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.structure.faces import room_faces
from roomgraph.datasets.synthetic.structure.lamps import hang_lamps
from roomgraph.datasets.synthetic.structure.shell import raise_wall
from roomgraph.datasets.synthetic.structure.windows import build_window, place_windows

# Kinds of which a building may have several that look the same.
TWINS = ("office", "bedroom", "meeting_room")
HOMES = {"house": 1.0, "suite": 0.6}
WITHOUT_WINDOWS = ("stairwell", "elevator", "corridor", "store_room")
OUTER_SHARE = 0.75
SEATS = ("sofa", "armchair", "bench", "visitor_chair", "dining_chair")


@dataclass(frozen=True, slots=True)
class Circumstances:
    """What holds for all rooms of a building at a visit.

    Attributes
    ----------
    seed, visit : int
        The building, and the how manieth visit it is; 0 is the first.
    is_home : bool
        Whether people live there.
    has_twins : bool
        Whether rooms of one kind look alike.
    """

    seed: int
    visit: int
    is_home: bool
    has_twins: bool

    def stream(self, room: Room, purpose: int, *, by_visit: bool = False) -> tuple[int, ...]:
        """Return the seed of a room's random numbers for a purpose.

        Rooms that look alike share theirs.
        """
        name = room.label if self.has_twins and room.label in TWINS else room.name
        visit = (self.visit,) if by_visit else ()
        return (self.seed, 20 + purpose, zlib.crc32(name.encode()), room.part, *visit)


def circumstances(seed: int, visit: int, plan: FloorPlan) -> Circumstances:
    """Draw what holds for a whole building."""
    rng = np.random.default_rng((seed, 4))
    is_home = bool(rng.random() < HOMES.get(plan.kind, 0.0))
    return Circumstances(seed, visit, is_home, bool(rng.random() < 0.5))


@dataclass(frozen=True, slots=True, eq=False)
class Furnished:
    """A room as it was made.

    Attributes
    ----------
    finish : Finish
    obstacles : list of (4, 2) float64
        Rectangles of the floor that things take.
    seats : list of Stand
        Where one can sit, at the seat's middle on the floor, looking along y.
    missing : list of str
        What such a room must have, but there was no room for.
    """

    finish: Finish
    obstacles: list[FloatArray]
    seats: list[Stand]
    missing: list[str]


def furnish_room(room: Room, plan: FloorPlan, surfaces: Surfaces, now: Circumstances) -> Furnished:
    """Build a room with all that is in it."""
    model = _finished_like(room, plan)
    surfaces.rng = np.random.default_rng(now.stream(model, 0))
    finish = draw_finish(model.label, room.ceiling_m, now.is_home, surfaces.rng)
    surfaces.rng = np.random.default_rng(now.stream(room, 6))
    walls = _walls(room, plan, surfaces)
    _raise(room, walls, finish, surfaces, room.level == plan.levels - 1)
    look = draw_look(np.random.default_rng(now.stream(room, 1)))
    arranger = Arranger(Plot(room, walls), look, now.stream(room, 2))
    missing = arranger.furnish()
    if now.visit:
        bare = [Wall(wall.face, wall.windows) for wall in walls]
        after = Arranger(Plot(room, bare), look, arranger.seed)
        change(arranger, after, np.random.default_rng(now.stream(room, 3, by_visit=True)))
        arranger = after
    arranger.scatter(np.random.default_rng(now.stream(room, 4, by_visit=True)), 0.7)
    obstacles: list[FloatArray] = []
    seats = []
    for placed in arranger.plot.placed:
        set_down(placed.piece, placed.stand)
        if placed.stand.origin[2] < room.base_m + 0.3 and not placed.is_hung:
            obstacles += solid_outlines(placed.piece, placed.stand)
        if placed.piece.model in SEATS:
            middle = (placed.piece.low + placed.piece.high) / 2
            seats.append(placed.stand.at(float(middle[0]), float(middle[1])))
    lit = np.random.default_rng((now.seed, 5, now.visit, zlib.crc32(room.name.encode())))
    is_on = now.visit == 0 or bool(lit.random() < 0.7)
    if room.label != "elevator":
        surfaces.rng = np.random.default_rng(now.stream(room, 5))
        hang_lamps(surfaces, room, now.is_home, is_on)
    return Furnished(finish, obstacles, seats, missing)


def _finished_like(room: Room, plan: FloorPlan) -> Room:
    """Return the first of the rooms that no walls part from a room: all have its finishes."""
    joined = {room.key}
    pairs = [set(door.rooms) for door in plan.doorways if door.kind == "open"]
    while grown := [pair for pair in pairs if pair & joined and not pair <= joined]:
        joined.update(*grown)
    return next(other for other in plan.rooms if other.key in joined)


def _walls(room: Room, plan: FloorPlan, surfaces: Surfaces) -> list[Wall]:
    """Return the room's walls with windows in some of the outer ones."""
    faces = room_faces(room, plan, surfaces)
    outer = [face for face in faces if face.is_outer and not face.gaps]
    rng = surfaces.rng
    if room.label in WITHOUT_WINDOWS:
        outer = []
    # One wall at least stays whole for what is higher than a window's sill.
    whole = [face for face in faces if not face.gaps and face not in outer]
    if outer and not whole:
        outer.remove(max(outer, key=lambda face: face.length))
    chosen = [face for face in outer if rng.random() < OUTER_SHARE]
    return [
        Wall(face, place_windows(face, room.ceiling_m, rng) if face in chosen else [])
        for face in faces
    ]


def _raise(room: Room, walls: list[Wall], finish: Finish, surfaces: Surfaces, is_top: bool) -> None:
    """Build floor, ceiling, walls and windows."""
    r, z = room.floor, room.base_m
    flat = np.array([(r.x0, r.y1), (r.x1, r.y1), (r.x1, r.y0), (r.x0, r.y0)])
    if room.label != "elevator" and not (room.label == "stairwell" and room.level > 0):
        surfaces.cover(np.column_stack([flat, np.full(4, z)]), finish.floor)
    if room.label != "elevator" and (room.label != "stairwell" or is_top):
        ceiling = np.column_stack([flat[[1, 0, 3, 2]], np.full(4, z + room.ceiling_m)])
        surfaces.cover(ceiling, finish.ceiling)
    strip = Material(finish.wall)
    for wall in walls:
        if room.label == "elevator":
            continue
        raise_wall(wall.face.stand, wall.face.length, wall.face.openings, strip, room.ceiling_m)
        for window in wall.windows:
            build_window(wall.face, window, surfaces.rng, power=3.2)
