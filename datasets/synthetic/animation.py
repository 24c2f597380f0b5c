"""What moves while the camera walks through: doors, the elevator, people."""

from __future__ import annotations

import logging
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.free_space import free_space
from roomgraph.datasets.synthetic.motion.journey import Journey
from roomgraph.datasets.synthetic.people.crowd import Seat, crowd
from roomgraph.datasets.synthetic.people.person import Person
from roomgraph.datasets.synthetic.people.scenes import DoorSpot
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Lamp, Surfaces
from roomgraph.datasets.synthetic.structure.doors import opened_on_the_way
from roomgraph.datasets.synthetic.structure.elevator import build_elevator
from roomgraph.datasets.synthetic.structure.moving import Stiff

logger = logging.getLogger(__name__)
# A door is passed when the camera is this near to its middle.
PASSING_M = 0.45
SEAT_HEIGHT_M = 0.45
PERSON_MARGIN_M = 0.28


@dataclass(frozen=True, slots=True, eq=False)
class Animation:
    """What moves.

    Attributes
    ----------
    bodies : tuple of Stiff
        Doors and elevators.
    names : tuple of str
        What the bodies are, as objects.
    people : tuple of Person
    lamps : tuple of Lamp
        Lamps that move along: the elevator's.
    """

    bodies: tuple[Stiff, ...]
    names: tuple[str, ...]
    people: tuple[Person, ...]
    lamps: tuple[Lamp, ...]


def animate(building: Building, journey: Journey, people: int) -> Animation:
    """Let doors open when the camera comes, the elevator go, and people walk and sit."""
    bodies: list[Stiff] = []
    names: list[str] = []
    surfaces = Surfaces(np.random.default_rng((building.seed, 10)))
    for number, leaf in building.leaves.items():
        door = building.plan.doorways[number]
        if door.state != "closed":
            continue
        passes = door_passes(building, journey, number)
        bodies.append(opened_on_the_way(surfaces, door, leaf.swing, leaf.angle, leaf.face, passes))
        names.append("door")
    if building.plan.lift is not None:
        cabin = build_elevator(surfaces, building.plan, journey.rides, surfaces.rng)
        bodies += cabin
        names += ["elevator", *["door"] * (len(cabin) - 1)]
    walkers = _people(building, journey, people) if people else ()
    return Animation(tuple(bodies), tuple(names), walkers, tuple(surfaces.lamps))


def door_passes(building: Building, journey: Journey, number: int) -> FloatArray:
    """Return when the camera goes through a doorway, seconds (K,)."""
    door = building.plan.doorways[number]
    positions = journey.trajectory.positions
    near = np.linalg.norm(positions[:, :2] - door.xy, axis=1) < PASSING_M
    near &= np.abs(journey.floor_m - door.base_m) < 0.5
    begins = np.flatnonzero(np.diff(np.append(0, near.astype(int))) == 1)
    ends = np.flatnonzero(np.diff(np.append(near.astype(int), 0)) == -1)
    middle = (begins + ends) // 2
    return np.asarray(journey.trajectory.stamps_s[middle])


def _people(building: Building, journey: Journey, count: int) -> tuple[Person, ...]:
    plan = building.plan
    spaces = [free_space(building, level) for level in range(plan.levels)]

    def is_free(xy: FloatArray, floor_m: float) -> NDArray[np.bool_]:
        level = round(floor_m / plan.storey_m)
        if abs(floor_m - level * plan.storey_m) > 0.05 or not 0 <= level < plan.levels:
            return np.zeros(len(xy), dtype=np.bool_)
        return spaces[level].is_free(xy, PERSON_MARGIN_M)

    seats = [
        Seat(np.array(seat.origin[:2]), seat.origin[2], SEAT_HEIGHT_M, seat.facing)
        for seat in building.seats
    ]
    doors = [
        DoorSpot(np.array(door.xy), door.base_m, np.pi / 2 if door.along == "x" else 0.0)
        for door in plan.doorways
        if door.kind in ("door", "jamb", "passage")
    ]
    rng = np.random.default_rng((building.seed, 11))
    people = crowd(rng, count, journey.trajectory, is_free, seats, doors, journey.floor_m)
    if len(people) < count:
        logger.warning("only %d of %d people find room beside the camera", len(people), count)
    return tuple(people)
