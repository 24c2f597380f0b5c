"""Routes between places, over the topological graph."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse

from roomgraph.datasets import se3
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.graph import Doorway, SemanticGraph
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OccupancyGrid

FloatArray = NDArray[np.float64]

# Without a known vertical: the first camera's axes, turned so that its up is up.
_T_LEVEL_WORLD = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
# Half the width of who walks across a room.
_CLEARANCE_M = 0.2
# Coordinates further than this outside of all places and nodes are a mistake.
_OUTSIDE_M = 2.0
# A change of direction below this is straight on.
_STRAIGHT_DEG = 30.0
_COORDINATES = re.compile(
    r"\s*,\s*".join([r"-?\d+(?:\.\d*)?"] * 2) + r"(?:\s*,\s*-?\d+(?:\.\d*)?)?"
)


@dataclass(frozen=True, slots=True)
class Leg:
    """The part of a route inside one place.

    Attributes
    ----------
    place, label : str
        Where it lies.
    length_m : float
        From the border (or the start) to the next border (or the goal).
    door : Doorway or None
        What it ends at; None at the goal, and where no doorway is known.
    turn_deg : float or None
        Change of direction into the next leg, left positive; None at the goal.
    """

    place: str
    label: str
    length_m: float
    door: Doorway | None
    turn_deg: float | None


@dataclass(frozen=True, slots=True)
class Route:
    """A route from node to node of the graph, place by place."""

    nodes: tuple[int, ...]
    length_m: float
    legs: tuple[Leg, ...]


def nodes_of(graph: SemanticGraph, name: str) -> tuple[int, ...]:
    """Return the nodes that a name may refer to, one for each place.

    Parameters
    ----------
    graph : SemanticGraph
        Where to look.
    name : str
        A place (``office2``, ``Office 2``): its middle. A label (``office``): the middle of each
        place of that kind. Coordinates: ``x,y`` on the floor of the map frame or ``x,y,z`` in the
        world, metres: the node nearest to there.

    Raises
    ------
    SemanticsError
        Nothing is called so, or the coordinates lie outside of all that was mapped.
    """
    if not graph.nodes:
        raise SemanticsError(
            "the graph has no nodes", expected="the graph of a run with tracked frames"
        )
    if _COORDINATES.fullmatch(name.strip()):
        return (_nearest(graph, [float(value) for value in name.split(",")], name),)
    wanted = plain(name)
    places = [place for place in graph.places if plain(place) == wanted]
    if not places:
        kinds = {node.place: node.label for node in graph.nodes}
        places = [place for place in graph.places if plain(kinds[place]) == wanted]
    if not places:
        known = dict.fromkeys([*graph.places, *(node.label for node in graph.nodes)])
        known.pop(UNKNOWN, None)
        raise SemanticsError(
            "no such place", where=name, expected=", ".join(known),
            hint="or give coordinates: x,y in the map frame or x,y,z in the world frame",
        )  # fmt: skip
    return tuple(_middle(graph, place) for place in places)


def find_route(
    graph: SemanticGraph, start: str, goal: str, grid: OccupancyGrid | None = None
) -> Route:
    """Return the shortest route from `start` to `goal`.

    It leads along the way walked, and across rooms over their free floor.

    Parameters
    ----------
    graph : SemanticGraph
        Of a run.
    start, goal : str
        See `nodes_of`.
    grid : OccupancyGrid, optional
        The run's free floor; without it only ways that were walked are known.

    Raises
    ------
    SemanticsError
        Start or goal is not known, or no way leads from one to the other.
    """
    import networkx

    ways = networkx.Graph()
    ways.add_nodes_from(node.id for node in graph.nodes)
    for edge in graph.edges:
        ways.add_edge(edge.source, edge.target, length=edge.length_m)
    for a, b, length in () if grid is None else _across(graph, grid):
        if not ways.has_edge(a, b) or length < ways.edges[a, b]["length"]:
            ways.add_edge(a, b, length=length)
    starts, goals = nodes_of(graph, start), nodes_of(graph, goal)
    lengths, paths = networkx.multi_source_dijkstra(ways, set(starts), weight="length")
    reached = [node for node in goals if node in lengths]
    if not reached:
        raise SemanticsError(
            "no known route", where=f"from {start} to {goal}",
            expected="places connected in the graph", got="parts of the map that are not connected",
        )  # fmt: skip
    nearest = min(reached, key=lambda node: (lengths[node], node))
    path = tuple(int(node) for node in paths[nearest])
    steps = [float(ways.edges[pair]["length"]) for pair in pairwise(path)]
    return Route(path, float(lengths[nearest]), _legs(graph, path, steps))


def _across(graph: SemanticGraph, grid: OccupancyGrid) -> Iterator[tuple[int, int, float]]:
    """Yield nodes of a place connected by free floor, with the distance over the floor."""
    free = ndimage.distance_transform_edt(grid.cells == FREE) * grid.cell_m > _CLEARANCE_M
    xy = se3.transform(grid.T_map_world, graph.positions)[:, :2]
    cells = np.floor((xy - grid.origin_xy) / grid.cell_m).astype(np.intp)[:, ::-1]
    for room in graph.rooms:
        corners = (room.polygon_map - grid.origin_xy) / grid.cell_m - 0.5
        inside: NDArray[np.uint8] = np.zeros(free.shape, dtype=np.uint8)
        cv2.fillPoly(inside, [np.rint(corners).astype(np.int32)], 1)
        floor = free & (inside > 0)
        ids = np.array([n.id for n in graph.nodes if n.place == room.name], dtype=np.intp)
        if not floor.any() or len(ids) < 2:
            continue
        away, at = ndimage.distance_transform_edt(~floor, return_indices=True)
        row, column = np.clip(cells[ids], 0, np.array(free.shape) - 1).T
        near = away[row, column] * grid.cell_m < 2 * _CLEARANCE_M
        ids, row, column = ids[near], row[near], column[near]
        lengths = _lengths(floor, at[0][row, column], at[1][row, column]) * grid.cell_m
        for i, j in np.argwhere(np.triu(np.isfinite(lengths), 1)):
            a, b = int(ids[i]), int(ids[j])
            yield a, b, max(float(lengths[i, j]), float(np.linalg.norm(xy[a] - xy[b])))


def _lengths(
    floor: NDArray[np.bool_], rows: NDArray[np.intp], columns: NDArray[np.intp]
) -> FloatArray:
    """Return the distances (N, N) between cells over the floor, in cells; inf if unconnected."""
    number = np.cumsum(floor).reshape(floor.shape) - 1
    starts, ends, lengths = [], [], []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        here = (slice(0, -down or None), slice(max(0, -right), -right if right > 0 else None))
        there = (slice(down, None), slice(max(0, right), right if right < 0 else None))
        both = floor[here] & floor[there]
        starts.append(number[here][both])
        ends.append(number[there][both])
        lengths.append(np.full(len(starts[-1]), np.hypot(down, right)))
    joined = sparse.coo_matrix(
        (np.concatenate(lengths), (np.concatenate(starts), np.concatenate(ends))),
        shape=(int(floor.sum()),) * 2,
    ).tocsr()
    nodes = number[rows, columns]
    found = sparse.csgraph.dijkstra(joined, directed=False, indices=nodes)
    return np.asarray(found[:, nodes], dtype=np.float64)


def plain(name: str) -> str:
    """Return a name normalised for comparison: without case, blanks and underscores."""
    return re.sub(r"[\s_-]+", "", name).lower()


def upright(graph: SemanticGraph) -> FloatArray:
    """Return the positions (N, 3) of the nodes in the map frame, z up."""
    return _upright(graph, graph.positions)


def _upright(graph: SemanticGraph, points_world: FloatArray) -> FloatArray:
    T = _T_LEVEL_WORLD if graph.T_map_world is None else graph.T_map_world
    return se3.transform(T, points_world)


def _nearest(graph: SemanticGraph, values: list[float], name: str) -> int:
    nodes = upright(graph)
    point = np.array(values)
    if len(values) == 3:
        gaps = np.linalg.norm(graph.positions - point, axis=1)
        point = _upright(graph, point[None])[0]
    else:
        gaps = np.linalg.norm(nodes[:, :2] - point, axis=1)
    outlines = [room.polygon_map for room in graph.rooms]
    known = np.concatenate([nodes[:, :2], *outlines])
    low, high = known.min(axis=0) - _OUTSIDE_M, known.max(axis=0) + _OUTSIDE_M
    if (point[:2] < low).any() or (point[:2] > high).any():
        raise SemanticsError(
            "not on the map", where=name,
            expected=f"x from {low[0]:.1f} to {high[0]:.1f} m, y from {low[1]:.1f} to "
            f"{high[1]:.1f} m in the map frame",
            got=f"x {point[0]:.1f} m, y {point[1]:.1f} m",
        )  # fmt: skip
    return int(gaps.argmin())


def _middle(graph: SemanticGraph, place: str) -> int:
    """Return the node nearest to a place's centre; without one, to all its nodes (the medoid)."""
    ids = np.array([node.id for node in graph.nodes if node.place == place])
    for room in graph.rooms:
        if room.name == place:
            gaps = upright(graph)[ids, :2] - room.centre_map
            return int(ids[np.linalg.norm(gaps, axis=1).argmin()])
    positions = graph.positions[ids]
    distances = np.linalg.norm(positions[:, None] - positions[None], axis=2)
    return int(ids[distances.sum(axis=1).argmin()])


def _legs(graph: SemanticGraph, path: tuple[int, ...], steps: list[float]) -> tuple[Leg, ...]:
    """Split a route where the place changes, halfway between two nodes."""
    positions = upright(graph)
    labels = {node.place: node.label for node in graph.nodes}
    legs, length = [], 0.0
    for i, ((a, b), step) in enumerate(zip(pairwise(path), steps, strict=True)):
        here, there = graph.nodes[a].place, graph.nodes[b].place
        if here == there:
            length += step
            continue
        door = _door(graph, here, there, (positions[a] + positions[b])[:2] / 2)
        turn = _turn_deg(positions[list(path), :2], i)
        legs.append(Leg(here, labels[here], length + step / 2, door, turn))
        length = step / 2
    last = graph.nodes[path[-1]].place
    return (*legs, Leg(last, labels[last], length, None, None))


def _door(graph: SemanticGraph, here: str, there: str, border: FloatArray) -> Doorway | None:
    """Return the doorway between two places that is nearest to the route."""
    doors = [door for door in graph.doorways if set(door.places) == {here, there}]
    return min(doors, key=lambda d: float(np.linalg.norm(d.position_map - border)), default=None)


def _turn_deg(positions: FloatArray, border: int) -> float:
    """Return the turn of a route (N, 2) between node `border` and the next, left positive.

    Compared are the directions over two nodes before and after; at the ends, over the border.
    """
    here, there = positions[border], positions[border + 1]
    before = here - positions[max(0, border - 2)] if border else there - here
    after = positions[min(border + 3, len(positions) - 1)] - there
    (x0, y0), (x1, y1) = before, after if after.any() else there - here
    return float(np.degrees(np.arctan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1)))


def turning(turn_deg: float) -> str:
    """Return a turn in words: ``left``, ``right`` or ``straight on``."""
    if abs(turn_deg) < _STRAIGHT_DEG:
        return "straight on"
    return "left" if turn_deg > 0 else "right"
