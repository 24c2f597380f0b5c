"""The outline, area and middle of a place's floor."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolume

FloatArray = NDArray[np.float64]
# A spot's distance to the walls, as a share of the largest, from which it is far from them.
_INNERMOST = 0.8
# Parts that a cell is divided into to draw outlines, and tolerance of their simplification, cells.
_FINER, _SIMPLIFIED = 3, 1.5


def outline_of(mask: NDArray[np.bool_], volume: OccupancyVolume) -> FloatArray:
    """Return the polygon (N, 2) around connected cells, metres, anticlockwise."""
    image = np.kron(mask, np.ones((_FINER, _FINER))).astype(np.uint8)
    outlines, _ = cv2.findContours(image, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    longest = max(outlines, key=len)
    outline = cv2.approxPolyDP(longest, _SIMPLIFIED * _FINER, closed=True)[:, 0]
    polygon = (outline + 0.5) / _FINER * volume.cell_m + volume.origin_xy
    return np.asarray(polygon[::-1] if _turns_clockwise(polygon) else polygon)


def area_m2(mask: NDArray[np.bool_], volume: OccupancyVolume) -> float:
    """Return the area of cells, square metres."""
    return float(mask.sum() * volume.cell_m**2)


def centre_of(mask: NDArray[np.bool_], volume: OccupancyVolume) -> FloatArray:
    """Return the point (2,) near the middle that is far from all walls, metres."""
    depth = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    inner = np.argwhere(depth >= _INNERMOST * depth.max())
    middle = np.argwhere(mask).mean(axis=0)
    row, column = inner[int(np.linalg.norm(inner - middle, axis=1).argmin())]
    return np.asarray((np.array([column, row]) + 0.5) * volume.cell_m + volume.origin_xy)


def largest_piece(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the largest connected component of cells."""
    pieces, count = ndimage.label(mask)
    if count <= 1:
        return mask
    return np.asarray(pieces == np.bincount(pieces[mask]).argmax())


def _turns_clockwise(polygon: FloatArray) -> bool:
    x, y = polygon.T
    return bool(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0)
