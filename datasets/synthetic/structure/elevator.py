"""Elevators: a cabin, its doors and the doors on every level, and when they move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import Doorway, FloorPlan, Shaft
from roomgraph.datasets.synthetic.rendering.lighting import EVENING, LAMP
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Lamp, Material, Quad, Surfaces
from roomgraph.datasets.synthetic.rendering.shapes import tube
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.structure.moving import Stiff, shifted, smooth
from roomgraph.datasets.synthetic.textures import patterns, signs

CABIN_HEIGHT_M = 2.25
# Between the cabin's walls and its shaft, and from the doors' plane to the shaft's wall.
SHAFT_GAP_M = 0.14
DOORS_S, SPEED_M_S = 1.8, 1.6


@dataclass(frozen=True, slots=True)
class Ride:
    """One ride of the camera in the elevator, times in seconds.

    The doors of the level `start` open at `called_s`, close from `closing_s` on, and those of
    the level `end` open at `arrived_s`; they close again from `left_s` on.
    """

    start: int
    end: int
    called_s: float
    closing_s: float
    arrived_s: float
    left_s: float

    def height(self, stamp_s: float, storey_m: float) -> float:
        """Return how high the cabin's floor is at a time."""
        begin = self.closing_s + DOORS_S
        share = smooth(stamp_s, begin, self.arrived_s)
        return storey_m * (self.start + (self.end - self.start) * share)

    def opened(self, stamp_s: float, level: int | None = None) -> float:
        """Return how far the doors on a level are open, 0 to 1; without a level, the cabin's."""
        first = smooth(stamp_s, self.called_s, self.called_s + DOORS_S)
        first -= smooth(stamp_s, self.closing_s, self.closing_s + DOORS_S)
        last = smooth(stamp_s, self.arrived_s, self.arrived_s + DOORS_S)
        last -= smooth(stamp_s, self.left_s, self.left_s + DOORS_S)
        if level is None:
            return max(first, last)
        return first if level == self.start else last if level == self.end else 0.0


Rides = tuple[Ride, ...]


def _current(rides: Rides, stamp_s: float) -> Ride:
    """Return the ride that a time belongs to: the last one called, or the first of all."""
    begun = [ride for ride in rides if ride.called_s <= stamp_s]
    return begun[-1] if begun else rides[0]


def cabin_height(rides: Rides, stamp_s: float, storey_m: float) -> float:
    """Return how high the cabin's floor is at a time."""
    return _current(rides, stamp_s).height(stamp_s, storey_m) if rides else 0.0


def doors_opened(rides: Rides, stamp_s: float, level: int | None = None) -> float:
    """Return how far the doors on a level are open, 0 to 1; without a level, the cabin's."""
    return _current(rides, stamp_s).opened(stamp_s, level) if rides else 0.0


def ride_seconds(levels: int, storey_m: float) -> float:
    """Return how long a ride over some levels takes from door to door."""
    return 1.5 * levels * storey_m / SPEED_M_S


def _door_stand(surfaces: Surfaces, shaft: Shaft, base_m: float) -> Stand:
    """Return a stand in the middle of the shaft's door wall, looking out of the shaft."""
    r = shaft.floor
    x, facing = (r.x0, np.pi) if shaft.door_side < 0 else (r.x1, 0.0)
    return Stand(surfaces, (x, r.centre[1], base_m), facing)


def build_elevator(
    surfaces: Surfaces, plan: FloorPlan, rides: Rides, rng: np.random.Generator
) -> list[Stiff]:
    """Return the cabin with its doors, and the doors on every level.

    `surfaces` gets the cabin's lamp; the quads of what moves are taken out again.
    """
    shaft = plan.lift
    assert shaft is not None
    doors = [door for door in plan.doorways if door.kind == "lift"]
    bodies = [_cabin(surfaces, plan, shaft, rides, rng)]
    leaf = Material(signs.elevator_door(rng, 480, 230), shiny=True)
    for side in (-1, 1):
        quads = _panel(_door_stand(surfaces, shaft, 0.0), doors[0], side, -0.10, leaf)

        def with_cabin(stamp_s: float, side: int = side) -> FloatArray:
            aside = _aside(shaft, side) * doors_opened(rides, stamp_s) * doors[0].width_m / 2
            return shifted(aside + np.array([0, 0, cabin_height(rides, stamp_s, plan.storey_m)]))

        bodies.append(Stiff(quads, with_cabin))
    for door in doors:
        bodies += _landing_doors(surfaces, shaft, door, leaf, rides)
    return bodies


def _landing_doors(
    surfaces: Surfaces, shaft: Shaft, door: Doorway, leaf: Material, rides: Rides
) -> list[Stiff]:
    bodies = []
    for side in (-1, 1):
        quads = _panel(_door_stand(surfaces, shaft, door.base_m), door, side, -0.04, leaf)

        def motion(stamp_s: float, side: int = side) -> FloatArray:
            opened = doors_opened(rides, stamp_s, door.level)
            return shifted(_aside(shaft, side) * opened * door.width_m / 2)

        bodies.append(Stiff(quads, motion))
    return bodies


def _aside(shaft: Shaft, side: int) -> FloatArray:
    """Return the direction (3,) in which the panel on a side of the door slides open."""
    facing = np.pi if shaft.door_side < 0 else 0.0
    return side * np.array([-np.sin(facing), np.cos(facing), 0.0])


def _panel(stand: Stand, door: Doorway, side: int, y: float, leaf: Material) -> list[Quad]:
    """Build half of a sliding door, closed; `y` is its depth behind the wall's face."""
    half = door.width_m / 2
    x = (-half, 0.0) if side < 0 else (0.0, half)
    first = len(stand.surfaces.quads)
    window = (0.0, 0.5) if side < 0 else (0.5, 1.0)
    image = leaf.image[
        :, int(window[0] * leaf.image.shape[1]) : int(window[1] * leaf.image.shape[1])
    ]
    picture = Material(image, shiny=True)
    stand.picture(x, (0, door.height_m), y + 0.02, picture)
    stand.at(0, y - 0.02, 0, np.pi).picture((-x[1], -x[0]), (0, door.height_m), 0.0, picture)
    quads = stand.surfaces.quads[first:]
    del stand.surfaces.quads[first:]
    return quads


def _cabin(
    surfaces: Surfaces, plan: FloorPlan, shaft: Shaft, rides: Rides, rng: np.random.Generator
) -> Stiff:
    """Build the cabin's inside on the lowest level."""
    first, prints = len(surfaces.quads), len(surfaces.footprints)
    r = shaft.floor
    wide, deep = r.y1 - r.y0 - 2 * SHAFT_GAP_M, r.x1 - r.x0 - 2 * SHAFT_GAP_M
    # Seen by one who stands in the doors and looks in: y grows towards the doors.
    back = _door_stand(surfaces, shaft, 0.0).at(0, -deep - SHAFT_GAP_M)
    steel = Material(
        patterns.steel(
            rng, 300, 300, patterns.pick(rng, ((176, 180, 184), (190, 170, 130), (120, 124, 130)))
        ),
        1.2,
        1.2,
    )
    floor = Material(patterns.linoleum(rng, 220, 220, (90, 88, 86)), 1.0, 1.0)
    half, height = wide / 2, CABIN_HEIGHT_M
    back.wall((-half, half), (0, height), 0.0, steel)
    mirror = Material(
        patterns.tint((120, 130, 138), patterns.noise(rng, 120, 160, (60, 40)) * 0.5), shiny=True
    )
    back.picture((-half + 0.15, half - 0.15), (1.0, 2.0), 0.012, mirror)
    for side in (-1, 1):
        wall = back.at(side * half, deep / 2, 0, -side * np.pi / 2)
        wall.wall((-deep / 2, deep / 2), (0, height), 0.0, steel)
        tube(wall, (-deep / 2 + 0.1, 0.06, 0.9), (deep / 2 - 0.1, 0.06, 0.9), 0.018, steel)
    _front(back, plan, wide, deep, steel, rng)
    back.sheet((-half, half), (0, deep + 0.1), 0.0, floor)
    top = [(half, 0, height), (-half, 0, height), (-half, deep, height), (half, deep, height)]
    surfaces.picture(back.world(top)[::-1], Material(patterns.plain(16, 16, (230, 230, 226))))
    lamp = Material(patterns.plain(16, 16, (250, 250, 244)), glow=(0.9, 0.9, 1.4, 0.4))
    size = [
        (0.3, 0.4, height - 0.02),
        (-0.3, 0.4, height - 0.02),
        (-0.3, deep - 0.4, height - 0.02),
        (0.3, deep - 0.4, height - 0.02),
    ]
    surfaces.picture(back.world(size)[::-1], lamp)
    place = back.world([(0, deep / 2, height - 0.05)])[0]
    for channel, power in ((LAMP, 6.0), (EVENING, 2.4)):
        position = (float(place[0]), float(place[1]), float(place[2]))
        surfaces.lamps.append(Lamp(position, (0, 0, -1), power, channel))
    quads = surfaces.quads[first:]
    del surfaces.quads[first:], surfaces.footprints[prints:]

    def motion(stamp_s: float) -> FloatArray:
        return shifted(np.array([0, 0, cabin_height(rides, stamp_s, plan.storey_m)]))

    return Stiff(quads, motion)


def _front(
    back: Stand, plan: FloorPlan, wide: float, deep: float, steel: Material,
    rng: np.random.Generator,
) -> None:  # fmt: skip
    """Close the cabin beside and above its doors; hang the buttons there."""
    door = next(door for door in plan.doorways if door.kind == "lift")
    front = back.at(0, deep, 0, np.pi)
    half, clear = wide / 2, door.width_m / 2
    front.wall((-half, -clear), (0, CABIN_HEIGHT_M), 0.0, steel)
    front.wall((clear, half), (0, CABIN_HEIGHT_M), 0.0, steel)
    front.wall((-clear, clear), (door.height_m, CABIN_HEIGHT_M), 0.0, steel)
    buttons = Material(signs.call_buttons(rng, 220, 80))
    if half - clear > 0.2:
        front.picture((clear + 0.03, half - 0.03), (0.9, 1.5), 0.012, buttons)
    number = Material(signs.floor_number(rng, 120, 160, 1), glow=(0.3, 0.2, 0.8, 0.6))
    front.picture((-0.12, 0.12), (door.height_m + 0.02, CABIN_HEIGHT_M - 0.02), 0.012, number)


def surround(surfaces: Surfaces, door: Doorway, shaft: Shaft, rng: np.random.Generator) -> None:
    """Hang the call buttons and the floor's number beside the doors on a level."""
    facing = np.pi if shaft.door_side < 0 else 0.0
    stand = Stand(surfaces, (*door.xy, door.base_m), facing).at(0, 0.07)
    half = door.width_m / 2
    buttons = Material(signs.call_buttons(rng, 170, 80))
    stand.picture((half + 0.12, half + 0.28), (0.95, 1.3), 0.02, buttons)
    number = Material(signs.floor_number(rng, 200, 200, door.level))
    stand.picture((-0.2, 0.2), (door.height_m + 0.09, door.height_m + 0.34), 0.02, number)
