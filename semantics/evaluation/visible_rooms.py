"""Visible rooms: the rooms that the surfaces in an image belong to."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

# Fine enough for walls, which are a hand wide.
_CELL_M = 0.05
# Beyond the outermost walls: windows' reveals, and noise of the depth.
_MARGIN_M = 1.0


class RoomIndex:
    """Tells the room of a point on the floor plan; within a wall, the nearest room.

    Parameters
    ----------
    outlines : sequence of (N, 2) float64
        Of the rooms, metres.
    """

    def __init__(self, outlines: Sequence[NDArray[np.float64]]) -> None:
        corners = np.vstack(outlines)
        self._origin = corners.min(axis=0) - _MARGIN_M
        columns, rows = np.ceil((np.ptp(corners, axis=0) + 2 * _MARGIN_M) / _CELL_M).astype(int)
        self._count = len(outlines)
        drawn = np.full((rows, columns), -1, dtype=np.int32)
        for number, outline in enumerate(outlines):
            cells = np.floor((outline - self._origin) / _CELL_M).astype(np.int32)
            cv2.fillPoly(drawn, [cells], number)
        nearest = ndimage.distance_transform_edt(
            drawn < 0, return_distances=False, return_indices=True
        )
        self._rooms = drawn[tuple(nearest)]

    def at(self, points: NDArray[np.float64]) -> NDArray[np.int32]:
        """Return the number (N,) of the room at points (N, 2), metres."""
        cells = np.floor((points - self._origin) / _CELL_M).astype(np.intp)
        column, row = np.clip(cells, 0, np.array(self._rooms.shape[::-1]) - 1).T
        return np.asarray(self._rooms[row, column])

    def shares(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the share (R,) of points (N, 2) that lie in each room; zeros without points."""
        counts = np.bincount(self.at(points), minlength=self._count)
        return np.asarray(counts / max(1, len(points)))
