"""How far the walk keeps from walls and furniture, measured apart from how it is planned."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.plans.layout import Doorway, Rectangle, Room

FloatArray = NDArray[np.float64]


def clearance(building: Building, xy: FloatArray) -> FloatArray:
    """Return the distance (N,) of points (N, 2) to the nearest wall or furniture."""
    obstacles = [Rectangle(*(float(v) for v in f)) for f in building.footprints]
    distance = np.min([box.distance(xy) for box in obstacles], axis=0)
    for room in building.rooms:
        for wall in _wall_pieces(building, room):
            distance = np.minimum(distance, wall.distance(xy))
    return np.asarray(distance)


def _wall_pieces(building: Building, room: Room) -> list[Rectangle]:
    """Return a room's walls as degenerate rectangles, with the doorways left open."""
    r, pieces = room.floor, []
    doors = [door for door in building.doorways if room.name in door.rooms]
    for axis, level in ((1, r.y0), (1, r.y1), (0, r.x0), (0, r.x1)):
        low, high = (r.x0, r.x1) if axis == 1 else (r.y0, r.y1)
        start = low
        for begin, end in [*sorted(_openings(doors, axis, level)), (high, high)]:
            ends = (start, level, begin, level) if axis == 1 else (level, start, level, begin)
            pieces.append(Rectangle(*ends))
            start = end
    return pieces


def _openings(doors: list[Doorway], axis: int, level: float) -> list[tuple[float, float]]:
    along = "x" if axis == 1 else "y"
    return [
        (door.xy[1 - axis] - door.width_m / 2, door.xy[1 - axis] + door.width_m / 2)
        for door in doors
        if door.along == along and abs(door.xy[axis] - level) < 0.2
    ]
