"""Doorways: where one can pass from one place to the next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.semantics.graph.graph import Doorway, GraphNode
from roomgraph.semantics.rooms.watershed import RegionImage, borders
from roomgraph.slam.reconstruction.floor_analysis import FloorAnalysis
from roomgraph.slam.reconstruction.occupancy_grid import FREE

FloatArray = NDArray[np.float64]


def find_doorways(
    labelled: RegionImage,
    names: Mapping[int, str],
    nodes: Sequence[GraphNode],
    nodes_map: FloatArray,
    floor: FloorAnalysis,
    min_width_m: float,
) -> tuple[Doorway, ...]:
    """Return the passages between places that touch, in the order of the places.

    A passage is a stretch of free cells on the border of two places. Where the camera went from
    one place to another without such a border in view, a doorway of unknown width stands halfway
    between the two nodes.

    Parameters
    ----------
    labelled : (R, C) int32
        The place of each cell, as far as it was seen; 0 is none.
    names : mapping of int to str
        Name of each place, in the order of first passing.
    nodes, nodes_map : sequence of GraphNode, (N, 3) float64
        The nodes with their places, and where they lie in the map frame, metres.
    floor : FloorAnalysis
        Which cells are free.
    min_width_m : float
        Narrower gaps are no doorways.
    """
    order = {name: i for i, name in enumerate(names.values())}
    found = []
    for pair, cells in borders(labelled).items():
        first, second = sorted((names[pair[0]], names[pair[1]]), key=lambda name: order[name])
        for position, width in _passages(cells, floor, min_width_m):
            found.append(Doorway((first, second), position, width))
    joined = {frozenset(door.places) for door in found}
    for (a, before), (b, after) in pairwise(zip(nodes, nodes_map, strict=True)):
        if a.place != b.place and frozenset((a.place, b.place)) not in joined:
            joined.add(frozenset((a.place, b.place)))
            first, second = sorted((a.place, b.place), key=lambda name: order.get(name, 0))
            found.append(Doorway((first, second), (before + after)[:2] / 2, None))
    return tuple(sorted(found, key=lambda door: tuple(order.get(p, 0) for p in door.places)))


def _passages(
    cells: NDArray[np.intp], floor: FloorAnalysis, min_width_m: float
) -> list[tuple[FloatArray, float]]:
    """Return middle and width of each free stretch of border cells (N, 2)."""
    volume = floor.volume
    border = np.zeros(floor.grid.cells.shape, dtype=bool)
    border[tuple(cells.T)] = True
    # A single occupied cell, a door's handle or its threshold, does not part a passage.
    joined, count = ndimage.label(ndimage.binary_dilation(border, np.ones((3, 3), dtype=bool)))
    free = border & (floor.grid.cells == FREE)
    passages = []
    for number in range(1, count + 1):
        at = np.argwhere(free & (joined == number))
        if not len(at):
            continue
        width = (float(np.ptp(at, axis=0).max()) + 1) * volume.cell_m
        if width >= min_width_m:
            middle = (at.min(axis=0) + at.max(axis=0)) / 2
            passages.append(((middle[::-1] + 0.5) * volume.cell_m + volume.origin_xy, width))
    return passages
