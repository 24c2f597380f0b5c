"""The floor of a room while it is furnished: what is taken, and whether one can still walk."""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.furnishing.piece import Piece, outline, solid_outlines
from roomgraph.datasets.synthetic.plans.layout import Point, Room
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.structure.faces import Face
from roomgraph.datasets.synthetic.structure.windows import Window

Mask = NDArray[np.uint8]
CELL_M = 0.05
# A person's half width: how far the way through a room keeps from everything.
BODY_M = 0.3
# In front of a door nothing stands: this far into the room, and this much beside it.
DOOR_ZONE_M, DOOR_BESIDE_M = 0.95, 0.06
LOW_M = 0.82


@dataclass(slots=True)
class Wall:
    """A face of the room with what stands at it and hangs on it: along it, and upwards."""

    face: Face
    windows: list[Window]
    standing: list[tuple[float, float, float]] = field(default_factory=list)
    hanging: list[tuple[float, float, float, float]] = field(default_factory=list)


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A piece that was given a place.

    Attributes
    ----------
    piece : Piece
    stand : Stand
        Where it is set down.
    wall, x : int, float
        The number of the wall that it stands at or hangs on, and where along it; -1 for none.
    """

    piece: Piece
    stand: Stand
    wall: int = -1
    x: float = 0.0

    @property
    def is_hung(self) -> bool:
        """Whether it hangs on a wall above the floor's furniture."""
        return self.wall >= 0 and float(self.piece.low[2]) >= LOW_M


@dataclass(slots=True)
class Plot:
    """A room's floor as a grid of cells, and its walls.

    Attributes
    ----------
    room : Room
    walls : list of Wall
    placed : list of Placed
        What was set down, in order.
    """

    room: Room
    walls: list[Wall]
    placed: list[Placed] = field(default_factory=list)
    _origin: FloatArray = field(init=False)
    _inside: Mask = field(init=False)
    _taken: Mask = field(init=False)
    _kept: Mask = field(init=False)
    _entries: list[tuple[int, int]] = field(init=False)

    def __post_init__(self) -> None:
        r = self.room.floor
        self._origin = np.array([r.x0, r.y0]) - 0.2
        size = int((r.y1 - r.y0 + 0.4) / CELL_M), int((r.x1 - r.x0 + 0.4) / CELL_M)
        self._inside, self._taken, self._kept = (np.zeros(size, np.uint8) for _ in range(3))
        self._fill(self._inside, self.room.polygon)
        self._entries = []
        for wall in self.walls:
            for gap in wall.face.gaps:
                self._keep_door(wall.face, gap.begin, gap.end, gap.doorway.kind == "open")

    def _keep_door(self, face: Face, begin: float, end: float, is_open: bool) -> None:
        """Keep the floor before an opening free; a way through it goes by its middle."""
        deep = 0.5 if is_open else max(DOOR_ZONE_M, end - begin if end - begin < 1.2 else 0)
        beside = 0.0 if is_open else DOOR_BESIDE_M
        x0, x1 = begin - beside, end + beside
        zone = face.stand.world([(x0, 0, 0), (x1, 0, 0), (x1, deep, 0), (x0, deep, 0)])[:, :2]
        self._fill(self._kept, zone)
        middle = face.stand.world([((begin + end) / 2, 0.42, 0)])[0, :2]
        column, row = ((middle - self._origin) / CELL_M).astype(int)
        self._entries.append((int(row), int(column)))

    def _fill(self, mask: Mask, corners: FloatArray) -> None:
        # cv2 fills what its 16 fractional units call inside, borders included.
        pixels = (corners - self._origin) / CELL_M - 0.5
        cv2.fillConvexPoly(mask, np.rint(pixels * 16).astype(np.int32), 1, cv2.LINE_8, 4)

    def _drawn(self, corners: FloatArray) -> NDArray[np.bool_]:
        mask = np.zeros_like(self._inside)
        self._fill(mask, corners)
        return np.asarray(mask > 0)

    def fits(self, piece: Piece, stand: Stand, margin: float = 0.0) -> bool:
        """Whether a piece may be set down at a stand: on free floor, leaving a way round it."""
        shrunk = self._drawn(outline(piece, stand, -0.02))
        # An outline that is far outside the room marks no cell at all.
        if not shrunk.any() or not (self._inside[shrunk] > 0).all():
            return False
        solids = solid_outlines(piece, stand)
        if not solids:  # It lies flat: one walks over it.
            return True
        wide = self._drawn(outline(piece, stand, margin)) if margin else shrunk
        if (self._taken[wide] > 0).any() or (self._kept[shrunk] > 0).any():
            return False
        before = self._taken.copy()
        for solid in solids:
            self._fill(self._taken, solid)
        walkable = self._is_walkable()
        self._taken = before
        return walkable

    def fits_at_wall(self, piece: Piece, number: int, x: float) -> bool:
        """Whether a piece may stand with its back to a wall, or hang on it, its middle at x."""
        wall = self.walls[number]
        low, high = x + float(piece.low[0]), x + float(piece.high[0])
        foot, head = float(piece.low[2]), float(piece.high[2])
        if low < 0.02 or high > wall.face.length - 0.02 or head > self.room.ceiling_m - 0.02:
            return False
        taken = [(w.begin - 0.04, w.end + 0.04, w.sill, w.head) for w in wall.windows]
        taken += [
            (g.begin - 0.09, g.end + 0.09, 0, g.doorway.height_m + 0.09) for g in wall.face.gaps
        ]
        taken += [(a, b, 0.0, top) for a, b, top in wall.standing] + wall.hanging
        if any(low < b and a < high and foot < d and c < head for a, b, c, d in taken):
            return False
        return foot >= LOW_M or self.fits(piece, self.wall_stand(number, x))

    def hides_window(self, piece: Piece, number: int, x: float) -> bool:
        """Whether a piece before a wall, its middle at x along it, would stand before a window."""
        low, high = x + float(piece.low[0]), x + float(piece.high[0])
        return any(
            low < window.end and window.begin < high and float(piece.high[2]) > window.sill
            for window in self.walls[number].windows
        )

    def wall_stand(self, number: int, x: float) -> Stand:
        """Return where a piece stands with its back to a wall."""
        return self.walls[number].face.stand.at(x, 0.012)

    def put(self, placed: Placed) -> None:
        """Give a piece its place, whether it fits or not."""
        self.placed.append(placed)
        piece, x = placed.piece, placed.x
        if placed.wall >= 0:
            wall = self.walls[placed.wall]
            low, high = x + float(piece.low[0]), x + float(piece.high[0])
            foot, head = float(piece.low[2]), float(piece.high[2])
            if foot < 0.3:
                wall.standing.append((low, high, head))
            else:
                wall.hanging.append((low - 0.03, high + 0.03, foot - 0.03, head + 0.03))
        if not placed.is_hung and placed.stand.origin[2] < self.room.base_m + 0.3:
            for solid in solid_outlines(piece, placed.stand):
                self._fill(self._taken, solid)

    def _is_walkable(self) -> bool:
        """Whether all doors are joined by free floor, and the room has some to walk on."""
        free = (self._inside > 0) & (self._taken == 0)
        wide = cv2.distanceTransform(free.astype(np.uint8), cv2.DIST_L2, 3) * CELL_M > BODY_M
        if wide.sum() * CELL_M**2 < 0.5:
            return False
        _, parts = cv2.connectedComponents(wide.astype(np.uint8))
        found = {int(_nearest(parts, entry)) for entry in self._entries}
        return len(found) == 1 and 0 not in found

    def free_middle(self, rng: np.random.Generator) -> Point:
        """Return a point of the room at random, away from walls where it can."""
        free = (self._inside > 0) & (self._taken == 0) & (self._kept == 0)
        distance = cv2.distanceTransform(free.astype(np.uint8), cv2.DIST_L2, 3).astype(np.float64)
        weight = distance.ravel() ** 2
        total = weight.sum()
        if total == 0:
            return self.room.floor.centre
        row, column = np.unravel_index(int(rng.choice(len(weight), p=weight / total)), free.shape)
        x, y = self._origin + (np.array([column, row]) + 0.5) * CELL_M
        return float(x), float(y)

    @property
    def free_share(self) -> float:
        """The share of the floor that nothing stands on."""
        inside = self._inside > 0
        return float((self._taken[inside] == 0).mean())


def _nearest(parts: NDArray[np.int32], entry: tuple[int, int]) -> int:
    """Return the part at a cell, or the nearest one within a few cells; 0 if there is none."""
    row, column = entry
    r0, c0 = max(0, row - 3), max(0, column - 3)
    near = parts[r0 : row + 4, c0 : column + 4]
    rows, columns = np.nonzero(near)
    if not len(rows):
        return 0
    best = int(np.argmin((rows + r0 - row) ** 2 + (columns + c0 - column) ** 2))
    return int(near[rows[best], columns[best]])


def free_spans(wall: Wall, margin: float = 0.06) -> list[tuple[float, float]]:
    """Return the stretches of a wall without opening or furniture, the longest first."""
    taken = [(g.begin - DOOR_BESIDE_M, g.end + DOOR_BESIDE_M) for g in wall.face.gaps]
    taken += [(a, b) for a, b, _ in wall.standing]
    spans, start = [], margin
    for a, b in [*sorted(taken), (wall.face.length - margin, wall.face.length)]:
        if a > start:
            spans.append((start, a))
        start = max(start, b)
    return sorted(spans, key=lambda s: s[0] - s[1])
