"""What is true of a recorded world: rooms, transitions, objects, and boxes around them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import find_objects

from roomgraph.datasets.places import PlaceTruth
from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.imu import GRAVITY
from roomgraph.datasets.synthetic.plans.layout import Room
from roomgraph.datasets.synthetic.renderer import Sight
from roomgraph.datasets.synthetic.settings import ADDED, BuildingSettings
from roomgraph.datasets.synthetic.structure.moving import Body
from roomgraph.datasets.synthetic.world import World

FloatArray = NDArray[np.float64]
# One is in a doorway when this near to it, before and behind.
DOORWAY_M = 0.5
# A box of fewer pixels says nothing.
LEAST_PIXELS = 40
# Rooms by the ratio of their sides, and by their longer side, metres (as the COLD annotation:
# a rectangle fitted to the room).
ELONGATED, SQUARE = 2.0, 1.25
SMALL_M, LARGE_M = 3.6, 5.2


def place_truth(world: World) -> PlaceTruth:
    """Return room, floor and transition of each frame; of the first walk, the rooms only."""
    positions = world.trajectory.positions
    levels = [world.level_of(index) for index in range(len(positions))]
    rooms = [
        world.building.room_at(xy, level)
        for xy, level in zip(positions[:, :2], levels, strict=True)
    ]
    labels, names = tuple(room.label for room in rooms), tuple(room.name for room in rooms)
    stamps = world.trajectory.stamps_s
    if world.settings.is_plain:
        return PlaceTruth(stamps, labels, names)
    transitions = tuple(
        transition(world.building, xy, level, room)
        for xy, level, room in zip(positions[:, :2], levels, rooms, strict=True)
    )
    return PlaceTruth(stamps, labels, names, tuple(levels), transitions)


def transition(building: Building, xy: FloatArray, level: int, room: Room) -> str:
    """Return "stairs", "elevator", "door" or "jamb" if a place is one, else an empty string."""
    if room.label == "stairwell":
        return "stairs"
    if room.label == "elevator":
        return "elevator"
    for door in building.doorways:
        if door.level != level or door.kind in ("open", "lift"):
            continue
        along, across = np.abs(xy - door.xy) if door.along == "x" else np.abs(xy - door.xy)[::-1]
        if across < DOORWAY_M and along < door.width_m / 2:
            return "door" if door.kind == "door" else "jamb"
    return ""


@dataclass(frozen=True, slots=True)
class ObjectTruth:
    """An object: its name, class, bounds (metres) and where it is.

    `first`, `last` are the numbers of its first triangle, and of the one after its last.
    """

    name: str
    kind: str
    centre: tuple[float, float, float]
    size: tuple[float, float, float]
    room: str
    floor: int
    first: int
    last: int


def object_truth(world: World) -> list[ObjectTruth]:
    """Return all objects: what stands there, doors that move, people where they appear."""
    building, found = world.building, []
    counts: dict[str, int] = {}

    def add(kind: str, points: FloatArray, first: int, last: int) -> None:
        counts[kind] = counts.get(kind, 0) + 1
        low, high = points.min(axis=0), points.max(axis=0)
        middle = (low + high) / 2
        level = building.plan.level_at(float(low[2]) + 0.05)
        found.append(
            ObjectTruth(
                f"{kind}{counts[kind]}", kind, _triple(middle), _triple(high - low),
                building.room_at(middle[:2], level).name, level, first, last,
            )
        )  # fmt: skip

    for thing in building.things:
        quads = building.quads[thing.quads]
        points = np.concatenate([quad.corners for quad in quads])
        add(thing.name, points, 2 * thing.quads.start, 2 * thing.quads.stop)
    start = 2 * len(building.quads)
    moving, stamps = world.animation, world.trajectory.stamps_s
    kinds = [*moving.names, *["person"] * len(moving.people)]
    bodies: list[Body] = [*moving.bodies, *moving.people]
    for kind, body in zip(kinds, bodies, strict=True):
        # Somebody who comes later is told of where they appear; who never does, not at all.
        there = next((float(stamp) for stamp in stamps if body.is_there(float(stamp))), None)
        if there is not None:
            corners = body.corners(there).reshape(-1, 3)
            add(kind, corners, start, start + 2 * len(body.quads))
        start += 2 * len(body.quads)
    return found


def _triple(values: FloatArray) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])


@dataclass(frozen=True, slots=True)
class Box:
    """An object in an image: left, top, right, bottom in pixels, ends excluded; pixels seen."""

    number: int
    left: int
    top: int
    right: int
    bottom: int
    pixels: int


class BoxFinder:
    """Finds the boxes around what is seen of each object, parts of it included.

    Parameters
    ----------
    objects : iterable of ObjectTruth
        An object's parts come before it.
    """

    def __init__(self, objects: Iterable[ObjectTruth]) -> None:
        self.objects = list(objects)
        last = max((item.last for item in self.objects), default=0)
        # The smallest object that a triangle belongs to; 0 for none, also for a miss (-1).
        owner = np.zeros(last + 1, dtype=np.int32)
        sizes = [item.last - item.first for item in self.objects]
        order = np.argsort(sizes, kind="stable")[::-1]
        parents = np.zeros(len(self.objects) + 1, dtype=np.int32)
        for number in order:
            item = self.objects[int(number)]
            parents[number + 1] = owner[item.first]
            owner[item.first : item.last] = number + 1
        self._owner, self._parents = owner, parents
        self._from_small = [int(number) + 1 for number in order[::-1]]

    def boxes(self, sight: Sight) -> list[Box]:
        """Return the boxes in an image."""
        triangle = sight.hits.triangle
        known = (triangle >= 0) & (triangle < len(self._owner) - 1)
        labels = np.where(known, self._owner[np.where(known, triangle, 0)], 0)
        counts = np.bincount(labels.ravel(), minlength=len(self._parents))
        slices = find_objects(labels, max_label=len(self._parents) - 1)
        bounds: dict[int, tuple[int, int, int, int]] = {
            number + 1: (area[1].start, area[0].start, area[1].stop, area[0].stop)
            for number, area in enumerate(slices)
            if area is not None
        }
        for number in self._from_small:
            parent = int(self._parents[number])
            if number in bounds and parent:
                counts[parent] += counts[number]
                bounds[parent] = _union(bounds[number], bounds.get(parent, bounds[number]))
        return [
            Box(number - 1, *bounds[number], int(counts[number]))
            for number in sorted(bounds)
            if counts[number] >= LEAST_PIXELS
        ]


def _union(a: tuple[int, int, int, int], b: tuple[int, int, int, int]) -> tuple[int, int, int, int]:
    return min(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3])


def room_shape(room: Room) -> str:
    """Return "elongated", "rectangular" or "square", after the sides of the room's cell."""
    sides = sorted((room.floor.x1 - room.floor.x0, room.floor.y1 - room.floor.y0))
    ratio = sides[1] / sides[0]
    return "elongated" if ratio >= ELONGATED else "square" if ratio < SQUARE else "rectangular"


def room_size(room: Room) -> str:
    """Return "small", "medium" or "large", after the longer side of the room's cell."""
    longer = max(room.floor.x1 - room.floor.x0, room.floor.y1 - room.floor.y0)
    return "small" if longer < SMALL_M else "large" if longer >= LARGE_M else "medium"


def describe(world: World, settings: BuildingSettings) -> dict[str, object]:
    """Return the layout of a building and the settings as plain values, in metres."""
    building = world.building
    is_plain = settings.is_plain
    told: dict[str, object] = {
        "settings": settings.model_dump(exclude=set(ADDED) if is_plain else set()),
        "rooms": [_room(room, is_plain) for room in building.rooms],
        "doorways": [
            {
                "rooms": list(door.rooms), "xy": [round(value, 4) for value in door.xy],
                "width": round(door.width_m, 3), "height": round(door.height_m, 3),
            }
            | ({} if is_plain else {
                "kind": door.kind, "state": door.state, "glass": door.is_glass,
                "along": door.along, "floor": door.level,
            })
            for door in building.doorways
        ],
    }  # fmt: skip
    if not is_plain:
        told["floors"] = {"count": building.plan.levels, "storey": round(building.plan.storey_m, 4)}
        told["gravity"] = GRAVITY.tolist()
        told["stretches"] = [
            {"kind": s.kind, "begin": round(s.begin_s, 3), "end": round(s.end_s, 3)}
            for s in world.stretches
        ]
        told["people"] = len(world.animation.people)
        told["missing"] = list(building.missing)
    return told


def _room(room: Room, is_plain: bool) -> dict[str, object]:
    told: dict[str, object] = {
        "name": room.name, "label": room.label,
        "polygon": np.round(room.polygon, 4).tolist(), "area": round(room.floor.area, 3),
    }  # fmt: skip
    if not is_plain:
        told |= {
            "part": room.part, "floor": room.level, "base": round(room.base_m, 4),
            "ceiling": round(room.ceiling_m, 3), "shape": room_shape(room), "size": room_size(room),
        }  # fmt: skip
    return told
