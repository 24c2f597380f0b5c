"""What a floor plan is made of: rooms, the openings between them, stairs and elevators."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Point = tuple[float, float]

WALL_M = 0.14
CEILING_M = 2.6


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle along the axes, metres."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def centre(self) -> tuple[float, float]:
        """Its middle."""
        return (self.x0 + self.x1) / 2, (self.y0 + self.y1) / 2

    @property
    def area(self) -> float:
        """Its area, square metres."""
        return (self.x1 - self.x0) * (self.y1 - self.y0)

    @property
    def polygon(self) -> FloatArray:
        """Its corners (4, 2), counter-clockwise."""
        return np.array(
            [(self.x0, self.y0), (self.x1, self.y0), (self.x1, self.y1), (self.x0, self.y1)]
        )

    def distance(self, xy: FloatArray) -> FloatArray:
        """Return the distances (N,) of points (N, 2) to it; 0 inside."""
        low, high = np.array([self.x0, self.y0]), np.array([self.x1, self.y1])
        outside = np.maximum(np.maximum(low - xy, xy - high), 0.0)
        return np.asarray(np.linalg.norm(outside, axis=-1))


@dataclass(frozen=True, slots=True)
class Room:
    """A room or a part of one.

    Attributes
    ----------
    name, label : str
        Which one it is (`office2`), and what kind of place (`office`).
    floor : Rectangle
        The cell that it lies in.
    level : int
        The floor of the building, 0 at the bottom.
    base_m : float
        Height of its floor.
    ceiling_m : float
        Height of its ceiling above its floor.
    outline : tuple of (float, float)
        Its corners inside the cell, counter-clockwise, if its walls are not all along the axes.
    part : int
        0, or the number of a further part of the same room (a corridor round a corner).
    """

    name: str
    label: str
    floor: Rectangle
    level: int = 0
    base_m: float = 0.0
    ceiling_m: float = CEILING_M
    outline: tuple[Point, ...] = ()
    part: int = 0

    @property
    def key(self) -> str:
        """What the doorways call it: its name, with the part's number if it has several."""
        return f"{self.name}.{self.part}" if self.part else self.name

    @property
    def polygon(self) -> FloatArray:
        """Its corners (N, 2), counter-clockwise."""
        return np.array(self.outline) if self.outline else self.floor.polygon


Opening = Literal["jamb", "door", "passage", "open", "lift"]
DoorState = Literal["", "open", "half", "closed"]


@dataclass(frozen=True, slots=True)
class Doorway:
    """An opening between two rooms.

    Attributes
    ----------
    rooms : (str, str)
        Keys of the rooms; the corridor comes first. A leaf opens into the second.
    xy : (float, float)
        Its middle, in the middle of the wall.
    along : {"x", "y"}
        The direction of the wall that it is in.
    width_m, height_m : float
        Its clear size.
    kind : {"jamb", "door", "passage", "open", "lift"}
        A frame without a leaf, one with a leaf, a wide opening, no wall at all, an elevator's door.
    state : {"", "open", "half", "closed"}
        How the leaf stands; a closed one is opened when the camera comes.
    is_glass : bool
        Whether the leaf is of glass.
    hinge : {-1, 1}
        At which end of the opening, along its wall, the leaf turns.
    level, base_m : int, float
        The floor of the building, and the height of its threshold.
    """

    rooms: tuple[str, str]
    xy: tuple[float, float]
    along: str
    width_m: float
    height_m: float
    kind: Opening = "jamb"
    state: DoorState = ""
    is_glass: bool = False
    hinge: int = 1
    level: int = 0
    base_m: float = 0.0


@dataclass(frozen=True, slots=True)
class Shaft:
    """A vertical way: a stairwell or an elevator, the same rectangle on every level.

    Attributes
    ----------
    name : str
        The room's name, the same on all levels.
    floor : Rectangle
        Its cell.
    door_side : {-1, 1}
        Whether its doors are in the wall of smaller or of larger x.
    """

    name: str
    floor: Rectangle
    door_side: int


@dataclass(frozen=True, slots=True)
class FloorPlan:
    """Rooms in the order in which they are walked through, the corridor first.

    Attributes
    ----------
    rooms, doorways : tuple
        Of all levels.
    kind : str
        The family of plans.
    storey_m : float
        From floor to floor.
    stairs, lift : Shaft or None
        What joins the levels.
    """

    rooms: tuple[Room, ...]
    doorways: tuple[Doorway, ...]
    kind: str = "corridor"
    storey_m: float = CEILING_M
    stairs: Shaft | None = None
    lift: Shaft | None = None
    _by_key: dict[str, Room] = field(default_factory=dict, compare=False, repr=False)

    def __post_init__(self) -> None:
        self._by_key.update({room.key: room for room in self.rooms})

    @property
    def levels(self) -> int:
        """The number of floors."""
        return 1 + max(room.level for room in self.rooms)

    def room(self, key: str) -> Room:
        """Return the room called `key`."""
        return self._by_key[key]

    def doorway(self, key: str) -> Doorway:
        """Return the first doorway that leads into the room called `key`."""
        return next(door for door in self.doorways if door.rooms[1] == key)

    def room_at(self, xy: tuple[float, float] | FloatArray, level: int = 0) -> Room:
        """Return the room at a point; inside walls and doorways, the nearest one."""
        point = np.asarray(xy, dtype=np.float64)
        there = [room for room in self.rooms if room.level == level]
        return min(there, key=lambda room: float(room.floor.distance(point)))

    def level_at(self, z_m: float) -> int:
        """Return the level whose floor is the nearest below a height, or the lowest."""
        return int(np.clip((z_m + 1e-6) // self.storey_m, 0, self.levels - 1))
