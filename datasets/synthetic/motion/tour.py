"""The tour: a way through every room of a building, up its stairs and down in its elevator."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.free_space import FreeSpace, free_space, is_shaft
from roomgraph.datasets.synthetic.plans.layout import FloorPlan, Room, Shaft
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray
from roomgraph.datasets.synthetic.structure.stairs import way_up

# How many places of a room are visited: one, and one more for each so many square metres.
AREA_PER_VIEW_M2, MOST_VIEWS = 7.0, 4
BEFORE_DOOR_M = 1.1
# In the cabin, one stops this far behind its middle.
BEHIND_M = 0.12


@dataclass(frozen=True, slots=True, eq=False)
class Tour:
    """The corners of a way, without regard to how fast it is walked.

    Attributes
    ----------
    legs : tuple of (N, 3) float64
        Points on the floor, metres. Between two legs the camera rides in the elevator.
    """

    legs: tuple[FloatArray, ...]


def plan_tour(building: Building) -> Tour:
    """Plan a way through every room that comes back to where it began.

    The rooms of a level are visited by going deeper first; then the stairs lead to the next one.
    From the highest level the elevator goes down to the lowest.
    """
    plan = building.plan
    spaces = [free_space(building, level) for level in range(plan.levels)]
    start = _start(building.rooms[0], spaces[0])
    here, points = start, [np.array([[*start, 0.0]])]
    for level, space in enumerate(spaces):
        base = level * plan.storey_m
        for target in _targets(building, space, level, here):
            way = space.way(here, target)
            points.append(np.column_stack([way, np.full(len(way), base)]))
            here = target
        if level + 1 < plan.levels:
            climb = _climb(plan, space, here, level)
            points.append(climb)
            here = climb[-1, :2]
    if plan.levels == 1:
        back = spaces[0].way(here, start)
        return Tour((np.concatenate([*points, _flat(back, 0.0)]),))
    top = (plan.levels - 1) * plan.storey_m
    assert plan.lift is not None
    inside, before = _lift_points(plan.lift)
    into = spaces[-1].way(here, before)
    points += [_flat(into, top), np.array([[*before, top], [*inside, top]])]
    out = [np.array([[*inside, 0.0], [*before, 0.0]]), _flat(spaces[0].way(before, start), 0.0)]
    return Tour((np.concatenate(points), np.concatenate(out)))


def _flat(way: FloatArray, height: float) -> FloatArray:
    return np.column_stack([way, np.full(len(way), height)])


def _start(room: Room, space: FreeSpace) -> FloatArray:
    """Return the place that one can stand on nearest to a room's middle."""
    middle = space.cell(np.array(room.floor.centre))
    return np.asarray(space.middles(np.array([middle]))[0])


def _targets(
    building: Building, space: FreeSpace, level: int, here: FloatArray
) -> list[FloatArray]:
    """Return the places to visit on a level, in order: rooms behind rooms first."""
    plan = building.plan
    rng = np.random.default_rng((building.seed, 8, level))
    rooms = {room.key: room for room in plan.rooms if room.level == level and not is_shaft(room)}
    beside: dict[str, list[str]] = {key: [] for key in rooms}
    for door in plan.doorways:
        a, b = door.rooms
        if a in rooms and b in rooms:
            beside[a].append(b)
            beside[b].append(a)
    first = min(rooms.values(), key=lambda room: float(room.floor.distance(here[None])[0])).key
    order, seen, stack = [], {first}, [first]
    while stack:
        key = stack.pop()
        order.append(key)
        near = [other for other in beside[key] if other not in seen]
        seen.update(near)
        stack += [near[int(i)] for i in rng.permutation(len(near))]
    targets, last = [], here
    for key in order:
        for place in _views(rooms[key], space, last):
            targets.append(place)
            last = place
    return targets


def _views(room: Room, space: FreeSpace, last: FloatArray) -> list[FloatArray]:
    """Return the places of a room to look from: far from where one comes, and from each other."""
    cells = np.flatnonzero(space.clearance.ravel() > 0.3)
    middles = space.middles(cells)
    inside = room.floor.distance(middles) == 0
    if not inside.any():
        return [_start(room, space)]
    middles = middles[inside]
    count = min(MOST_VIEWS, 1 + int(room.floor.area / AREA_PER_VIEW_M2))
    distance = np.linalg.norm(middles - last, axis=1)
    chosen: list[FloatArray] = []
    for _ in range(count):
        best = middles[int(np.argmax(distance))]
        if chosen and float(distance.max()) < 1.0:
            break
        chosen.append(best)
        distance = np.minimum(distance, np.linalg.norm(middles - best, axis=1))
    return _round(chosen, last)


def _round(places: list[FloatArray], last: FloatArray) -> list[FloatArray]:
    """Put places in the order in which they lie round their middle: a loop, not a zigzag."""
    middle = np.mean(places, axis=0)
    angles = np.array([np.arctan2(*(place - middle)[::-1]) for place in places])
    ordered = [places[int(i)] for i in np.argsort(angles)]
    nearest = int(np.argmin([np.linalg.norm(place - last) for place in ordered]))
    return ordered[nearest:] + ordered[:nearest]


def _climb(plan: FloorPlan, space: FreeSpace, here: FloatArray, level: int) -> FloatArray:
    """Return the way from a place to the stairs, up, and out on the next level."""
    assert plan.stairs is not None
    door = next(
        d for d in plan.doorways if d.level == level and d.rooms[1].startswith(plan.stairs.name)
    )
    out = plan.stairs.door_side * np.array([BEFORE_DOOR_M * 0.7, 0.0])
    before = np.array(door.xy) + out
    base = level * plan.storey_m
    up = way_up(plan.stairs.floor, plan.storey_m, level)
    leave = np.array([[*door.xy, base + plan.storey_m], [*before, base + plan.storey_m]])
    enter = np.array([[*before, base], [*door.xy, base]])
    return np.concatenate([_flat(space.way(here, before), base), enter, up, leave])


def _lift_points(lift: Shaft) -> tuple[FloatArray, FloatArray]:
    """Return where one stands in the cabin, and before its doors."""
    r, side = lift.floor, lift.door_side
    x = r.x0 if side < 0 else r.x1
    inside = np.array([r.centre[0] - side * BEHIND_M, r.centre[1]])
    return inside, np.array([x + side * BEFORE_DOOR_M, r.centre[1]])
