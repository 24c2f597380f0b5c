"""Where one can walk on a level, and the most comfortable way from one place to another."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components, dijkstra

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.plans.layout import WALL_M, Room
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray

CELL_M = 0.1
# Obstacles are drawn this many times finer than cells.
FINE = 4
# Nearer than this to anything, nobody walks; beyond the second, nobody minds.
CLOSEST_M, EASY_M = 0.2, 0.55
# What a metre past an obstacle costs more than one in the open.
SQUEEZE = 4.0


@dataclass(frozen=True, slots=True, eq=False)
class FreeSpace:
    """The floor of one level.

    Attributes
    ----------
    origin : (2,) float64
        The corner of the grid, metres.
    clearance : (rows, columns) float64
        Distance of each cell's middle to the nearest wall or thing, metres; 0 where there is one,
        and where nobody can get to.
    graph : (cells, cells) sparse matrix
        What it costs to walk from a cell to its neighbours.
    """

    origin: FloatArray
    clearance: FloatArray
    graph: csr_matrix

    def cell(self, xy: FloatArray) -> int:
        """Return the number of the walkable cell nearest to a point (2,)."""
        rows, columns = np.nonzero(self.clearance > CLOSEST_M)
        middles = self.origin + (np.column_stack([columns, rows]) + 0.5) * CELL_M
        best = int(np.argmin(np.sum((middles - xy) ** 2, axis=1)))
        return int(rows[best] * self.clearance.shape[1] + columns[best])

    def middles(self, cells: NDArray[np.integer]) -> FloatArray:
        """Return the middles (N, 2) of cells."""
        row, column = np.divmod(cells, self.clearance.shape[1])
        return self.origin + (np.column_stack([column, row]) + 0.5) * CELL_M

    def is_free(self, xy: FloatArray, margin_m: float = CLOSEST_M) -> NDArray[np.bool_]:
        """Whether points (N, 2) are on free floor with a margin around them."""
        column, row = ((np.atleast_2d(xy) - self.origin) / CELL_M).astype(int).T
        rows, columns = self.clearance.shape
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        row, column = np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)
        return np.asarray(inside & (self.clearance[row, column] > margin_m))

    def way(self, begin: FloatArray, end: FloatArray) -> FloatArray:
        """Return the middles (N, 2) of the cells of the best way between two points."""
        start, goal = self.cell(begin), self.cell(end)
        _, before = dijkstra(self.graph, True, np.array([start]), True)
        cells = [goal]
        while cells[-1] != start:
            cells.append(int(before[0, cells[-1]]))
        return self.middles(np.array(cells[::-1]))


def free_space(building: Building, level: int) -> FreeSpace:
    """Draw the floor of a level: rooms and openings, less everything that stands there.

    The cells of stairs and elevators are not part of it.
    """
    plan = building.plan
    rooms = [room for room in plan.rooms if room.level == level and not is_shaft(room)]
    corners = np.concatenate([room.floor.polygon for room in rooms])
    origin = corners.min(axis=0) - 0.6
    columns, rows = (np.ceil((corners.max(axis=0) + 0.6 - origin) / CELL_M)).astype(int)
    fine = np.zeros((int(rows) * FINE, int(columns) * FINE), np.uint8)

    def fill(points: FloatArray, value: int) -> None:
        pixels = (points - origin) / CELL_M * FINE - 0.5
        cv2.fillConvexPoly(fine, np.rint(pixels * 16).astype(np.int32), value, cv2.LINE_8, 4)

    for room in rooms:
        fill(room.polygon, 1)
    for door in plan.doorways:
        if door.level != level:
            continue
        half, deep = door.width_m / 2, WALL_M / 2 + (0.3 if door.kind == "open" else 0.1)
        size = np.array([(half, deep) if door.along == "x" else (deep, half)])
        signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        fill(np.array(door.xy) + signs * size, 1)
    if level == 0:
        for x0, y0, x1, y1 in building.footprints:
            fill(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), 0)
    for where, outline in building.obstacles:
        if where == level:
            fill(outline, 0)
    distance = cv2.distanceTransform(fine, cv2.DIST_L2, 5).astype(np.float64) * CELL_M / FINE
    clearance = _without_pockets(distance[FINE // 2 :: FINE, FINE // 2 :: FINE])
    return FreeSpace(origin, clearance, _graph(clearance))


def _without_pockets(clearance: FloatArray) -> FloatArray:
    """Return the clearances with 0 where one cannot get to from the largest part of the floor."""
    walkable = clearance > CLOSEST_M
    _, parts = connected_components(_graph(clearance), directed=False)
    part = np.reshape(parts, clearance.shape)
    main = int(np.bincount(part[walkable]).argmax()) if walkable.any() else -1
    return np.where(part == main, clearance, 0.0)


def is_shaft(room: Room) -> bool:
    """Whether a room is a stairwell or an elevator."""
    return room.label in ("stairwell", "elevator")


def _graph(clearance: FloatArray) -> csr_matrix:
    """Return the costs of steps between neighbouring walkable cells."""
    rows, columns = clearance.shape
    number = np.arange(rows * columns).reshape(rows, columns)
    narrow = np.clip((EASY_M - clearance) / (EASY_M - CLOSEST_M), 0, 1)
    price = 1 + SQUEEZE * narrow**2
    walkable = clearance > CLOSEST_M
    begin, end, cost = [], [], []
    for dr, dc in ((0, 1), (1, 0), (1, 1), (1, -1)):
        a = np.s_[0 : rows - dr, max(0, -dc) : columns - max(0, dc)]
        b = np.s_[dr:rows, max(0, dc) : columns + min(0, dc)]
        both = walkable[a] & walkable[b]
        begin.append(number[a][both])
        end.append(number[b][both])
        cost.append(np.hypot(dr, dc) * CELL_M * (price[a] + price[b])[both] / 2)
    first, second, weight = (np.concatenate(part) for part in (begin, end, cost))
    return csr_matrix(
        (np.tile(weight, 2), (np.append(first, second), np.append(second, first))),
        shape=(number.size, number.size),
    )
