"""Lookup of rooms by position in a finished graph."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.datasets import se3
from roomgraph.semantics.graph.graph import SemanticGraph

# Finer than walls are thick, so that the two sides of one stay apart.
_CELL_M = 0.05
_MARGIN_CELLS = 8


def places_at(
    graph: SemanticGraph, points_world: NDArray[np.floating], reach_m: float = 0.3
) -> NDArray[np.int32]:
    """Return which of the graph's rooms (N,) points (N, 3) lie over; -1 for none.

    Points just outside of all, as on the surface of a wall, go with the nearest.

    Parameters
    ----------
    graph : SemanticGraph
        With rooms.
    points_world : (N, 3) float
        Metres.
    reach_m : float
        Distance from an outline at most.
    """
    if not graph.rooms or graph.T_map_world is None:
        return np.full(len(points_world), -1, dtype=np.int32)
    outlines = [room.polygon_map for room in graph.rooms]
    corners = np.concatenate(outlines)
    low = corners.min(axis=0) - _MARGIN_CELLS * _CELL_M
    columns, rows = ((corners.max(axis=0) - low) / _CELL_M).astype(int) + _MARGIN_CELLS
    image = np.full((rows, columns), -1, dtype=np.int32)
    for i, outline in enumerate(outlines):
        pixels = np.floor((outline - low) / _CELL_M).astype(np.int32)
        cv2.fillPoly(image, [pixels], i)
    distance, nearest = ndimage.distance_transform_edt(image < 0, return_indices=True)
    image = np.where(distance * _CELL_M <= reach_m, image[tuple(nearest)], -1)
    xy = se3.transform(graph.T_map_world, points_world)[:, :2]
    column, row = np.floor((xy - low) / _CELL_M).astype(np.intp).T
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    found = np.full(len(points_world), -1, dtype=np.int32)
    found[inside] = image[row[inside], column[inside]]
    return found
