"""The up direction, the ceiling to hide, and the viewpoint of the scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from roomgraph.datasets.vectors import unit

FloatArray = NDArray[np.float64]

# Of the eye above the horizon: rooms are seen from above, walls still stand.
_ELEVATION = np.radians(58.0)
# Half the width and height that the scene may take, as tangents of the angle. The viewer opens 55
# degrees from top to bottom (tangent 0.52); the views are about as wide as high.
_HALF_VIEW = np.array([0.50, 0.43])
_MIN_DISTANCE_M = 1.5
# Kept in sight on all sides of the path: the camera, or where no map is known yet, the rooms.
_CAMERA_M, _ROOM_M = 0.4, 2.0
# Points in one such square of the floor plan go by the same part of the path.
_CELL_M = 0.2


@dataclass(frozen=True, slots=True)
class Axes:
    """Directions in the world, unit vectors (3,).

    Attributes
    ----------
    right, forward : (3,) float64
        Horizontal; as the first camera saw them, or as they are on the floor plan.
    up : (3,) float64
        Against gravity, as far as the camera's motion or the floor plan tells.
    """

    right: FloatArray
    forward: FloatArray
    up: FloatArray

    @classmethod
    def of_map(cls, T_map_world: FloatArray) -> Axes:
        """Return the axes of the map frame, in which the floor plan is drawn."""
        return cls(*T_map_world[:3, :3])

    def on_floor(self, points_world: FloatArray) -> FloatArray:
        """Return points (N, 3) as seen on a floor plan (N, 2): right and forward, metres."""
        return np.asarray(points_world @ np.column_stack([self.right, self.forward]))


@dataclass(frozen=True, slots=True)
class Framing:
    """The viewpoint: positions (3,) in the world, metres, and the up direction."""

    eye: FloatArray
    target: FloatArray
    up: FloatArray


def level_axes(T_world_camera: FloatArray) -> Axes:
    """Estimate the horizontal axes from camera poses (N, 4, 4), N > 0.

    Nobody holds a camera askew for long: its x axis stays level whatever its pitch. Up is
    therefore at right angles to all x axes; where these are too much alike to tell, the mean
    upright axis of the images decides.
    """
    x, y = T_world_camera[:, :3, 0], T_world_camera[:, :3, 1].mean(axis=0)
    y = unit(y)
    spread = x.T @ x / len(x) + 0.01 * (np.eye(3) - np.outer(y, y))
    up = np.linalg.eigh(spread)[1][:, 0]
    up = up if up @ y < 0 else -up
    right = unit(x[0] - (x[0] @ up) * up)
    return Axes(right, np.cross(up, right), up)


def below_ceiling(
    points_world: FloatArray, path: FloatArray, up: FloatArray, headroom_m: float
) -> NDArray[np.bool_]:
    """Tell which points (N, 3) are at most `headroom_m` above the nearest part of the path (F, 3).

    The nearest part on the floor plan, to within a few decimetres: a path may lead up the stairs.
    """
    if not len(points_world) or not len(path):
        return np.ones(len(points_world), dtype=bool)
    across = np.linalg.svd(up[None])[2][1:].T
    cells = np.floor(points_world @ across / _CELL_M).astype(np.int64)
    columns = int(cells[:, 1].max() - cells[:, 1].min()) + 1
    numbers = cells[:, 0] * columns + cells[:, 1]
    _, first, cell = np.unique(numbers, return_index=True, return_inverse=True)
    nearest = np.asarray(KDTree(path @ across).query((cells[first] + 0.5) * _CELL_M)[1])
    return np.asarray(points_world @ up <= (path @ up)[nearest[cell]] + headroom_m)


def frame_scene(points_world: FloatArray, path: FloatArray, axes: Axes) -> Framing:
    """Return the nearest eye that sees a path (F, 3) and, but for stray ones, points (N, 3).

    One of both may be empty; around a path without points, room is left for the rooms. The eye
    looks down and forward. From an eye at c, a point p is in sight if
    ``|p_x - c_x| <= t_x (p_z - c_z)``, and the same for y: the farthest right and the farthest left
    point give c_x and a bound of c_z.
    """
    reach = _CAMERA_M if len(points_world) else _ROOM_M
    sides = reach * np.array([axes.right, -axes.right, axes.forward, -axes.forward])
    low, high = _spread(points_world)
    body = points_world[((points_world >= low) & (points_world <= high)).all(axis=1)]
    inside = np.concatenate([body, (path[:, None] + sides).reshape(-1, 3)])
    ahead = np.cos(_ELEVATION) * axes.forward - np.sin(_ELEVATION) * axes.up
    view = np.column_stack([axes.right, np.cross(ahead, axes.right), ahead])
    seen = inside @ view
    rising = (seen[:, :2] - _HALF_VIEW * seen[:, 2:]).max(axis=0)
    falling = (-seen[:, :2] - _HALF_VIEW * seen[:, 2:]).max(axis=0)
    middle = float(np.median(seen[:, 2]))
    back = min(float((-(rising + falling) / (2 * _HALF_VIEW)).min()), middle - _MIN_DISTANCE_M)
    across = (rising - falling) / 2
    return Framing(view @ [*across, back], view @ [*across, middle], axes.up)


def _spread(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return minimum and maximum of points (N, 3) without outliers."""
    if not len(points):
        return np.zeros(3), np.zeros(3)
    low, high = np.percentile(points, [1, 99], axis=0)
    return low, high
