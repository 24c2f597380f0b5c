"""Drawing a floor plan up: cells in rows, openings between neighbours, slanting walls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from roomgraph.datasets.synthetic.plans.layout import (
    WALL_M,
    Doorway,
    FloorPlan,
    Opening,
    Rectangle,
    Room,
    Shaft,
)
from roomgraph.datasets.synthetic.plans.slanting import slanted

# Ceilings of rooms, and what lies between a ceiling and the floor above, metres.
CEILINGS_M = (2.4, 3.5)
SLAB_M = 0.3
# Widths of rooms: small, medium and large ones, and how often each is drawn.
WIDTHS_M = ((2.5, 3.2), (3.2, 4.6), (4.6, 6.6))
WIDTH_ODDS = (0.35, 0.4, 0.25)
SMALLEST_M = 2.5
STAIRS_M = (2.6, 5.3)
LIFT_M = (2.0, 2.0)
LANDING_M = 1.3
# A wall's end keeps this much beside an opening.
JAMB_M = 0.22


@dataclass(frozen=True, slots=True)
class Shared:
    """The stretch of wall between two cells: its direction, where it lies, from where to where."""

    along: str
    at: float
    begin: float
    end: float


@dataclass(slots=True)
class Draft:
    """A plan being drawn.

    Attributes
    ----------
    rng : numpy.random.Generator
        Chooses all that is free.
    levels : int
        How many floors it will have.
    """

    rng: np.random.Generator
    levels: int
    rooms: list[Room] = field(default_factory=list)
    doorways: list[Doorway] = field(default_factory=list)
    stairs: Shaft | None = None
    lift: Shaft | None = None
    ceiling_m: float = 0.0
    _counts: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.ceiling_m = float(self.rng.uniform(*CEILINGS_M))

    @property
    def storey_m(self) -> float:
        """From floor to floor."""
        return self.ceiling_m + SLAB_M

    def room(self, label: str, floor: Rectangle, level: int, of: Room | None = None) -> Room:
        """Add a room of a kind, or a further part of the room `of`."""
        lowered = float(self.rng.uniform(0.05, 0.3)) if self.rng.random() < 0.25 else 0.0
        ceiling = max(CEILINGS_M[0], self.ceiling_m - lowered)
        if of is not None:
            part = sum(room.name == of.name for room in self.rooms)
            made = replace(of, floor=floor, part=part)
        else:
            self._counts[label] = self._counts.get(label, 0) + 1
            name = f"{label}{self._counts[label]}"
            made = Room(name, label, floor, level, level * self.storey_m, ceiling)
        self.rooms.append(made)
        return made

    def join(self, first: Room, second: Room, kind: Opening | None = None) -> bool:
        """Open the wall between two rooms; `kind` is drawn if it is not given.

        Return whether there is room for an opening.
        """
        wall = shared_wall(first.floor, second.floor)
        if wall is None:
            return False
        length = wall.end - wall.begin
        if kind == "open":
            ceiling = min(first.ceiling_m, second.ceiling_m)
            self._open(first, second, wall, (wall.begin + wall.end) / 2, length, ceiling)
            return True
        kind = kind or self._kind(length)
        width = {"passage": float(self.rng.uniform(1.5, 2.2))}.get(
            kind, float(self.rng.uniform(0.84, 1.02))
        )
        width = min(width, length - 2 * JAMB_M)
        if width < 0.8:
            return False
        low, high = wall.begin + JAMB_M + width / 2, wall.end - JAMB_M - width / 2
        share = float(self.rng.random())
        if self.rng.random() < 0.6:  # Doors are more often near a corner than in the middle.
            share = 0.05 + 0.2 * share if share < 0.5 else 0.95 - 0.2 * share
        lower = min(first.ceiling_m, second.ceiling_m) - 0.15
        height = min(float(self.rng.uniform(2.0, 2.15)) + (0.1 if kind == "passage" else 0), lower)
        self._open(first, second, wall, low + share * (high - low), width, height, kind)
        return True

    def _kind(self, length: float) -> Opening:
        draw = float(self.rng.random())
        if length > 2.6 and draw < 0.1:
            return "passage"
        return "jamb" if draw < 0.3 else "door"

    def _open(
        self, first: Room, second: Room, wall: Shared, middle: float, width: float, height: float,
        kind: Opening = "open",
    ) -> None:  # fmt: skip
        xy = (middle, wall.at) if wall.along == "x" else (wall.at, middle)
        near = middle < (wall.begin + wall.end) / 2
        self.doorways.append(
            Doorway(
                (first.key, second.key), xy, wall.along, width, height, kind,
                is_glass=kind == "door" and bool(self.rng.random() < 0.18),
                hinge=-1 if near else 1, level=first.level, base_m=first.base_m,
            )
        )  # fmt: skip

    def core(self, x: float, y: float, door_side: int) -> None:
        """Place a stairwell and an elevator, one behind the other along y; two levels need them.

        `x` is the wall of the cells with smaller x.
        """
        if self.levels < 2:
            return
        wide, long = STAIRS_M
        self.stairs = Shaft("stairwell1", Rectangle(x, y, x + wide, y + long), door_side)
        top = y + long + WALL_M
        left = x if door_side < 0 else x + wide - LIFT_M[0]
        floor = Rectangle(left, top, left + LIFT_M[0], top + LIFT_M[1])
        self.lift = Shaft("elevator1", floor, door_side)

    def join_core(self, level: int) -> None:
        """Add the shafts' rooms on a level and open them to their neighbours."""
        for shaft, label in ((self.stairs, "stairwell"), (self.lift, "elevator")):
            if shaft is None:
                continue
            made = Room(
                shaft.name, label, shaft.floor, level, level * self.storey_m, self.storey_m,
                part=level,
            )  # fmt: skip
            if label == "elevator":
                made = replace(made, ceiling_m=2.3)
            elif level == self.levels - 1:
                made = replace(made, ceiling_m=self.ceiling_m)
            self.rooms.append(made)
            r = shaft.floor
            x = r.x0 - WALL_M / 2 if shaft.door_side < 0 else r.x1 + WALL_M / 2
            y = r.y0 + LANDING_M / 2 if label == "stairwell" else r.centre[1]
            beside = np.array([[x + shaft.door_side * (WALL_M / 2 + 0.05), y]])
            others = [room for room in self.rooms if room.level == level and room is not made]
            neighbour = min(others, key=lambda room: float(room.floor.distance(beside)[0]))
            kind: Opening = "lift" if label == "elevator" else "jamb"
            self.doorways.append(
                Doorway(
                    (neighbour.key, made.key), (x, y), "y", 0.96, 2.05, kind,
                    level=level, base_m=made.base_m,
                )
            )  # fmt: skip

    def finish(self, kind: str) -> FloorPlan:
        """Slant some walls and return the plan."""
        if self.rng.random() < 0.45:
            self.rooms = [slanted(room, self.doorways, self.rng) for room in self.rooms]
        return FloorPlan(
            tuple(self.rooms), tuple(self.doorways), kind, self.storey_m, self.stairs, self.lift
        )


def shared_wall(a: Rectangle, b: Rectangle) -> Shared | None:
    """Return the stretch of wall between two cells, or None if they do not touch."""
    reach = WALL_M + 1e-6
    for first, second in ((a, b), (b, a)):
        if -1e-6 <= second.x0 - first.x1 <= reach:
            begin, end = max(a.y0, b.y0), min(a.y1, b.y1)
            if end > begin:
                return Shared("y", (first.x1 + second.x0) / 2, begin, end)
        if -1e-6 <= second.y0 - first.y1 <= reach:
            begin, end = max(a.x0, b.x0), min(a.x1, b.x1)
            if end > begin:
                return Shared("x", (first.y1 + second.y0) / 2, begin, end)
    return None


def row(
    rng: np.random.Generator, begin: float, end: float, least: int = 1
) -> list[tuple[float, float]]:
    """Cut a stretch into the widths of rooms with walls between them, at least so many."""
    spans: list[tuple[float, float]] = []
    start = begin
    while True:
        low, high = WIDTHS_M[int(rng.choice(3, p=WIDTH_ODDS))]
        stop = start + float(rng.uniform(low, high))
        if end - stop < SMALLEST_M + WALL_M:
            spans.append((start, end))
            break
        spans.append((start, stop))
        start = stop + WALL_M
    if len(spans) < least:  # Large rooms only: too few of them.
        step = (end - begin + WALL_M) / least
        spans = [(begin + i * step, begin + (i + 1) * step - WALL_M) for i in range(least)]
    return spans


def depth(rng: np.random.Generator, most: float = 6.0) -> float:
    """Draw how deep a room is."""
    low, high = WIDTHS_M[int(rng.choice(3, p=WIDTH_ODDS))]
    return float(np.clip(rng.uniform(low, high), SMALLEST_M, most))


def deal(
    rng: np.random.Generator, needed: Sequence[str], others: Sequence[str], count: int
) -> list[str]:
    """Return `count` kinds in any order: those needed, then others, until they are used up."""
    kinds = [str(kind) for kind in rng.permutation(list(needed))][:count]
    while len(kinds) < count:
        kinds += [str(kind) for kind in rng.permutation(list(others))][: count - len(kinds)]
    return [str(kind) for kind in rng.permutation(kinds)]


Planner = Callable[[np.random.Generator, int], FloorPlan]
