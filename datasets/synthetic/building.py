"""The building as a whole: its floor plan and every surface in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.furnishing.furnish import (
    Circumstances,
    Furnished,
    circumstances,
    furnish_room,
)
from roomgraph.datasets.synthetic.plans.corridor import plan_floor
from roomgraph.datasets.synthetic.plans.layout import (
    DoorState,
    Doorway,
    FloorPlan,
    Room,
)
from roomgraph.datasets.synthetic.plans.registry import PLANS
from roomgraph.datasets.synthetic.rendering.mesh import Image, Lamp, Material, Quad, Surfaces, Thing
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.rooms import (
    bathroom,
    corridor,
    elevator,
    kitchen,
    laboratory,
    office,
)
from roomgraph.datasets.synthetic.rooms.site import Site, Style, make_site
from roomgraph.datasets.synthetic.structure import doors, shell, stairs
from roomgraph.datasets.synthetic.structure.elevator import surround
from roomgraph.datasets.synthetic.textures import patterns

FloatArray = NDArray[np.float64]
KINDS: dict[str, tuple[Callable[[Site], None], Callable[[Site], Style]]] = {
    "kitchen": (kitchen.furnish, kitchen.style),
    "bathroom": (bathroom.furnish, bathroom.style),
    "laboratory": (laboratory.furnish, laboratory.style),
    "elevator_area": (elevator.furnish, elevator.style),
}
STATES: dict[DoorState, float] = {"open": 0.45, "half": 0.2, "closed": 0.35}


@dataclass(frozen=True, slots=True, eq=False)
class Leaf:
    """A door's leaf: how it turns, how far it is or will be open, and its material."""

    swing: doors.Swing
    angle: float
    face: Image


@dataclass(frozen=True, slots=True, eq=False)
class Building:
    """A building with everything in it.

    Attributes
    ----------
    seed : int
        What it was made from.
    plan : FloorPlan
        Rooms and doorways.
    quads : sequence of Quad
        Every surface that does not move.
    footprints : (N, 4) float64
        Rectangles on the floor that furniture and door frames take: x0, y0, x1, y1. The corridor
        plan's only.
    lamps : sequence of Lamp
        Ceiling lamps, table lamps and windows.
    things : sequence of Thing
        The objects that a person would name.
    obstacles : sequence of (int, (4, 2) float64)
        The level and the corners of what takes floor. All plans' but the corridor's.
    leaves : mapping of int to Leaf
        The leaf of each doorway that has one, by the doorway's number.
    seats : sequence of Stand
        Where one can sit.
    missing : sequence of str
        What rooms must have, but had no room for.
    sun : (3,) float64 or None
        The direction that sunlight comes from.
    tint : (3, 4) float64 or None
        How much stronger red, green and blue are in each channel of light. See `lighting`.
    """

    seed: int
    plan: FloorPlan
    quads: Sequence[Quad] = field(repr=False)
    footprints: FloatArray = field(repr=False)
    lamps: Sequence[Lamp] = field(repr=False)
    things: Sequence[Thing] = field(default=(), repr=False)
    obstacles: Sequence[tuple[int, FloatArray]] = field(default=(), repr=False)
    leaves: dict[int, Leaf] = field(default_factory=dict, repr=False)
    seats: Sequence[Stand] = field(default=(), repr=False)
    missing: Sequence[str] = ()
    sun: FloatArray | None = None
    tint: FloatArray | None = None

    @property
    def rooms(self) -> tuple[Room, ...]:
        """The rooms in the order of the walk, the corridor first."""
        return self.plan.rooms

    @property
    def doorways(self) -> tuple[Doorway, ...]:
        """The openings between the rooms."""
        return self.plan.doorways

    def room_at(self, xy: tuple[float, float] | FloatArray, level: int = 0) -> Room:
        """Return the room at a point; inside walls and doorways, the nearest one."""
        return self.plan.room_at(xy, level)


def build(seed: int, plan: str = "corridor", floors: int = 1, visit: int = 0) -> Building:
    """Build what belongs to a seed: a family of plans, its floors, and the state at a visit."""
    if plan == "corridor":
        return _build_corridor(seed)
    drawn = PLANS[plan](np.random.default_rng((seed, 0)), floors)
    drawn = _with_states(drawn, np.random.default_rng((seed, 6, visit)))
    return _build(drawn, circumstances(seed, visit, drawn))


def _with_states(plan: FloorPlan, rng: np.random.Generator) -> FloorPlan:
    """Draw how the doors stand."""
    states, odds = list(STATES), list(STATES.values())
    doorways = tuple(
        replace(door, state=states[int(rng.choice(3, p=odds))]) if door.kind == "door" else door
        for door in plan.doorways
    )
    return replace(plan, doorways=doorways)


def _build(plan: FloorPlan, now: Circumstances) -> Building:
    surfaces = Surfaces(np.random.default_rng((now.seed, 1)))
    furnished = {room.key: furnish_room(room, plan, surfaces, now) for room in plan.rooms}
    surfaces.rng = np.random.default_rng((now.seed, 7))
    obstacles = [
        (room.level, corners) for room in plan.rooms for corners in furnished[room.key].obstacles
    ]
    if plan.stairs is not None:
        tread = Material(patterns.stone(surfaces.rng, 220, 220, (168, 162, 154), 1000), 1.2, 1.2)
        rail = Material(patterns.plain(16, 16, (70, 74, 80)), 8.0, 8.0)
        stairs.build_stairs(surfaces, plan, tread, rail)
    leaves = _hang_doors(plan, surfaces, furnished)
    for number, leaf in leaves.items():
        door = plan.doorways[number]
        if door.state != "closed":
            doors.build_leaf(surfaces, door, leaf.swing, leaf.angle, leaf.face)
        obstacles.append((door.level, doors.leaf_outline(door, leaf.swing, leaf.angle)))
    seats = [seat for made in furnished.values() for seat in made.seats]
    missing = [f"{key}: {model}" for key, made in furnished.items() for model in made.missing]
    return Building(
        now.seed, plan, surfaces.quads, np.zeros((0, 4)), surfaces.lamps, surfaces.things,
        obstacles, leaves, seats, missing, *_daylight(now),
    )  # fmt: skip


def _daylight(now: Circumstances) -> tuple[FloatArray, FloatArray]:
    """Draw where the sun stands at a visit, and the colours of daylight and lamps."""
    rng = np.random.default_rng((now.seed, 9, now.visit))
    around, up = float(rng.uniform(0, 2 * np.pi)), float(np.deg2rad(rng.uniform(15, 50)))
    sun = np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])
    warm = float(rng.normal(0, 0.06))
    daylight = np.array([1 + warm, 1, 1 - warm])
    lamps = np.array([1.0, float(rng.uniform(0.9, 1.0)), float(rng.uniform(0.68, 1.02))])
    if now.visit and rng.random() < 0.2:  # Somebody has put coloured lamps in.
        lamps = rng.uniform(0.55, 1.1, 3)
    return sun, np.column_stack([daylight, lamps, lamps, np.ones(3)])


def _hang_doors(
    plan: FloorPlan, surfaces: Surfaces, furnished: dict[str, Furnished]
) -> dict[int, Leaf]:
    """Frame the doorways, and return the leaves."""
    rng = surfaces.rng
    face = doors.leaf_face(rng)
    wooden = Material(patterns.plaster(rng, 64, 64, patterns.pick(rng, doors.FACES)), 1.0, 1.0)
    steel = Material(patterns.plain(16, 16, (140, 144, 150)), 8.0, 8.0)
    leaves = {}
    for number, door in enumerate(plan.doorways):
        if door.kind == "open":
            continue
        finish = furnished[door.rooms[0]].finish
        frame = {"lift": steel, "passage": Material(finish.wall[:64, :64], 1.0, 1.0)}.get(
            door.kind, wooden
        )
        shell.frame_doorway(surfaces, door, frame, finish.floor)
        if door.kind == "lift":
            assert plan.lift is not None
            surround(surfaces, door, plan.lift, rng)
        elif door.kind == "door":
            turn = doors.swing(door, plan)
            leaves[number] = Leaf(turn, doors.open_angle(door, rng), face)
    return leaves


def _build_corridor(seed: int) -> Building:
    plan = plan_floor(np.random.default_rng((seed, 0)))
    surfaces = Surfaces(np.random.default_rng((seed, 1)))
    ceiling = shell.ceiling_material(surfaces.rng)
    lamps: list[Lamp] = []
    styles: dict[str, Style] = {}
    for index, room in enumerate(plan.rooms):
        # A generator of its own for each room: a change to one leaves the others as they are.
        surfaces.rng = np.random.default_rng((seed, 2, index))
        site = make_site(room, plan, surfaces)
        styles[room.name] = _furnish(site, plan, seed)
        shell.raise_room(site, styles[room.name], plan, ceiling)
        lamps.extend(site.lamps)
    for door in plan.doorways:
        style = styles[door.rooms[1]]
        shell.frame_doorway(surfaces, door, style.frame, styles[door.rooms[0]].floor)
    footprints = np.array(surfaces.footprints)
    return Building(seed, plan, surfaces.quads, footprints, lamps, surfaces.things)


def _furnish(site: Site, plan: FloorPlan, seed: int) -> Style:
    """Furnish a room after its kind and return its style."""
    label = site.room.label
    if label == "office":
        look = office.theme(site, seed)
        office.furnish(site, look)
        return office.style(site, look)
    if label == "corridor":
        corridor.furnish(site, plan)
        return corridor.style(site)
    furnish, style = KINDS[label]
    furnish(site)
    return style(site)
