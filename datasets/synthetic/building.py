"""The building as a whole: its floor plan and every surface in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic import shell
from roomgraph.datasets.synthetic.layout import Doorway, FloorPlan, Room, plan_floor
from roomgraph.datasets.synthetic.lighting import Lamp
from roomgraph.datasets.synthetic.mesh import Quad, Surfaces
from roomgraph.datasets.synthetic.rooms import (
    bathroom,
    corridor,
    elevator,
    kitchen,
    laboratory,
    office,
)
from roomgraph.datasets.synthetic.rooms.site import Site, Style, make_site

FloatArray = NDArray[np.float64]
KINDS: dict[str, tuple[Callable[[Site], None], Callable[[Site], Style]]] = {
    "kitchen": (kitchen.furnish, kitchen.style),
    "bathroom": (bathroom.furnish, bathroom.style),
    "laboratory": (laboratory.furnish, laboratory.style),
    "elevator_area": (elevator.furnish, elevator.style),
}


@dataclass(frozen=True, slots=True, eq=False)
class Building:
    """An office floor with everything in it.

    Attributes
    ----------
    seed : int
        What it was made from.
    plan : FloorPlan
        Rooms and doorways.
    quads : sequence of Quad
        Every surface.
    footprints : (N, 4) float64
        Rectangles on the floor that furniture and door frames take: x0, y0, x1, y1.
    lamps : sequence of Lamp
        Ceiling lamps, table lamps and windows.
    """

    seed: int
    plan: FloorPlan
    quads: Sequence[Quad]
    footprints: FloatArray
    lamps: Sequence[Lamp]

    @property
    def rooms(self) -> tuple[Room, ...]:
        """The rooms in the order of the walk, the corridor first."""
        return self.plan.rooms

    @property
    def doorways(self) -> tuple[Doorway, ...]:
        """The openings between the rooms."""
        return self.plan.doorways

    def room_at(self, xy: tuple[float, float] | FloatArray) -> Room:
        """Return the room at a point; inside walls and doorways, the nearest one."""
        return self.plan.room_at(xy)


def build(seed: int) -> Building:
    """Build the floor that belongs to a seed."""
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
    return Building(seed, plan, surfaces.quads, np.array(surfaces.footprints), lamps)


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
