"""The corridor plan: a corridor with rooms on both sides and the elevators at one end."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import WALL_M, Doorway, FloorPlan, Rectangle, Room

# Width of a room along the corridor, and its depth away from it: smallest and largest, metres.
SIZES = {
    "office": ((3.5, 4.0), (3.6, 4.2)),
    "laboratory": ((3.8, 4.3), (3.7, 4.3)),
    "kitchen": ((3.4, 3.8), (3.5, 4.0)),
    "bathroom": ((3.1, 3.5), (3.3, 3.6)),
    "elevator_area": ((3.2, 3.6), (3.5, 4.0)),
}
DOOR_TO_CORNER_M = 1.3
# Between the two offices: the topological map tells places of a kind apart by their distance.
OFFICES_APART_M = (4.7, 5.1)


def plan_floor(rng: np.random.Generator) -> FloorPlan:
    """Draw up a floor: three rooms on one side of the corridor, two on the other.

    The offices are the first and the last room of the walk, a room and its stores apart.
    """
    order = ["office", *(str(label) for label in rng.permutation(_OTHERS)), "office"]
    # Walked in this order: rooms 0, 2, 4 are on one side of the corridor, 1 and 3 on the other.
    width = float(rng.uniform(1.9, 2.1))
    near, length = _spread(rng, order[0::2])
    gap = float(rng.uniform(0.3, 0.7)) * (length - _row_length(order[1::2]))
    far, far_length = _row(rng, order[1::2], max(0.0, gap))
    length = max(length, far_length)
    spans = [span for pair in zip(near, [*far, None], strict=True) for span in pair if span]
    sides = [1, -1, 1, -1, 1]
    mirrored = (rng.random() < 0.5, rng.random() < 0.5)
    return _assemble(rng, order, spans, sides, (length, width), mirrored)


_OTHERS = ("laboratory", "kitchen", "bathroom")


def _row_length(labels: list[str]) -> float:
    return sum(SIZES[label][0][1] + WALL_M for label in labels)


def _row(
    rng: np.random.Generator, labels: list[str], start: float
) -> tuple[list[tuple[float, float]], float]:
    """Return where each room of a row begins and ends along the corridor, and the row's end."""
    spans = []
    for label in labels:
        end = start + float(rng.uniform(*SIZES[label][0]))
        spans.append((start, end))
        start = end + WALL_M
    return spans, start - WALL_M


def _spread(rng: np.random.Generator, labels: list[str]) -> tuple[list[tuple[float, float]], float]:
    """Return a row of three rooms, as `_row` does, with `OFFICES_APART_M` between the outer two."""
    first, middle, last = (float(rng.uniform(*SIZES[label][0])) for label in labels)
    apart = float(rng.uniform(*OFFICES_APART_M))
    start = first + WALL_M + float(rng.random()) * (apart - middle - 2 * WALL_M)
    length = first + apart + last
    return [(0.0, first), (start, start + middle), (first + apart, length)], length


def _assemble(
    rng: np.random.Generator,
    labels: list[str],
    spans: list[tuple[float, float]],
    sides: list[int],
    corridor: tuple[float, float],
    mirrored: tuple[bool, bool],
) -> FloorPlan:
    length, width = corridor
    lobby_width, lobby_depth = (float(rng.uniform(*size)) for size in SIZES["elevator_area"])
    shift, half = float(rng.uniform(-0.3, 0.3)), lobby_depth / 2
    rooms = [
        Room("corridor1", "corridor", Rectangle(0, -width / 2, length, width / 2)),
        Room(
            "elevator_area1", "elevator_area",
            Rectangle(-WALL_M - lobby_width, shift - half, -WALL_M, shift + half),
        ),
    ]  # fmt: skip
    opening = (-WALL_M / 2, 0.0), "y", width - 0.3, 2.3
    doorways = [Doorway(("corridor1", "elevator_area1"), *opening)]
    counts: dict[str, int] = {}
    for label, (start, end), side in zip(labels, spans, sides, strict=True):
        counts[label] = counts.get(label, 0) + 1
        name = f"{label}{counts[label]}"
        inner = width / 2 + WALL_M
        outer = inner + float(rng.uniform(*SIZES[label][1]))
        floor = Rectangle(
            start, min(side * inner, side * outer), end, max(side * inner, side * outer)
        )
        door_x = float(rng.uniform(start + DOOR_TO_CORNER_M, end - DOOR_TO_CORNER_M))
        rooms.append(Room(name, label, floor))
        doorways.append(
            Doorway(
                ("corridor1", name), (door_x, side * (width + WALL_M) / 2), "x",
                float(rng.uniform(0.98, 1.04)), float(rng.uniform(2.0, 2.1)),
            )
        )  # fmt: skip
    plan = FloorPlan(tuple(rooms), tuple(doorways))
    return _mirror(plan, *mirrored)


def _mirror(plan: FloorPlan, in_x: bool, in_y: bool) -> FloorPlan:
    """Turn the plan round, so that floors differ in more than their sizes."""
    sx, sy = (-1 if in_x else 1), (-1 if in_y else 1)

    def rectangle(r: Rectangle) -> Rectangle:
        (xa, xb), (ya, yb) = sorted((sx * r.x0, sx * r.x1)), sorted((sy * r.y0, sy * r.y1))
        return Rectangle(xa, ya, xb, yb)

    rooms = tuple(Room(r.name, r.label, rectangle(r.floor)) for r in plan.rooms)
    doorways = tuple(
        Doorway(d.rooms, (sx * d.xy[0], sy * d.xy[1]), d.along, d.width_m, d.height_m)
        for d in plan.doorways
    )
    return FloorPlan(rooms, doorways)
