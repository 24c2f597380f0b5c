"""The walls of a room as seen from inside, with the openings in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import WALL_M, Doorway, FloorPlan, Room
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand

# What lies this far behind a wall tells whether it is an outer one.
BEHIND_M = 0.6


@dataclass(frozen=True, slots=True)
class Gap:
    """An opening in a wall: where it begins and ends along it, metres."""

    begin: float
    end: float
    doorway: Doorway


@dataclass(frozen=True, slots=True)
class Face:
    """A wall seen from inside.

    Attributes
    ----------
    stand : Stand
        At its left end on the floor: x runs to the right along the wall, y into the room.
    length : float
        Metres.
    gaps : tuple of Gap
        From left to right.
    is_outer : bool
        Whether nothing of the building lies behind it: it may have windows.
    """

    stand: Stand
    length: float
    gaps: tuple[Gap, ...]
    is_outer: bool

    @property
    def openings(self) -> list[tuple[float, float, float]]:
        """Begin, end and height of each opening."""
        return [(gap.begin, gap.end, gap.doorway.height_m) for gap in self.gaps]


def room_faces(room: Room, plan: FloorPlan, surfaces: Surfaces) -> list[Face]:
    """Return the walls of a room, one for each side of its polygon."""
    corners = room.polygon
    faces = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        along = (b - a) / np.linalg.norm(b - a)
        inwards = float(np.arctan2(along[0], -along[1]))
        # Seen from inside, the right-hand way along a wall is clockwise: from b to a.
        stand = Stand(surfaces, (float(b[0]), float(b[1]), room.base_m), inwards)
        length = float(np.linalg.norm(b - a))
        gaps = [
            gap
            for door in plan.doorways
            if room.key in door.rooms and (gap := _gap(door, stand, length)) is not None
        ]
        gaps.sort(key=lambda gap: gap.begin)
        away = np.array([along[1], -along[0]]) * BEHIND_M
        behind = a + np.linspace(0.0, 1.0, 2 + int(length / 0.4))[:, None] * (b - a) + away
        faces.append(Face(stand, length, tuple(gaps), _is_free(behind, room, plan)))
    return faces


def _gap(door: Doorway, stand: Stand, length: float) -> Gap | None:
    """Return where an opening is in a wall, or None if it is in another one."""
    c, s = np.cos(stand.facing), np.sin(stand.facing)
    way = np.array(door.xy) - stand.origin[:2]
    x, y = float(-s * way[0] + c * way[1]), float(c * way[0] + s * way[1])
    is_parallel = abs(s) > 0.999 if door.along == "x" else abs(c) > 0.999
    if not is_parallel or abs(y) > WALL_M / 2 + 0.03 or not 0 < x < length:
        return None
    return Gap(x - door.width_m / 2, x + door.width_m / 2, door)


def _is_free(xy: FloatArray, room: Room, plan: FloorPlan) -> bool:
    cells = [other.floor for other in plan.rooms if other.level == room.level]
    return all(float(cell.distance(xy).min()) > 0 for cell in cells)
