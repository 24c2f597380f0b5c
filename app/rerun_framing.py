"""Which way is up, what hides the rooms, and where to look at them from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

FloatArray = NDArray[np.float64]

# Of the eye above the horizon: rooms are seen from above, walls still stand.
_ELEVATION = np.radians(58.0)
# Half the angle that the scene may take; the viewer opens 55 degrees from top to bottom.
_HALF_ANGLE = np.radians(24.0)
_MIN_EXTENT_M = 1.5


@dataclass(frozen=True, slots=True)
class Axes:
    """Directions in the world, unit vectors (3,).

    Attributes
    ----------
    right, forward : (3,) float64
        Horizontal; as the first camera saw them.
    up : (3,) float64
        Against gravity, as far as the camera's motion tells.
    """

    right: FloatArray
    forward: FloatArray
    up: FloatArray

    def on_floor(self, points_world: FloatArray) -> FloatArray:
        """Return points (N, 3) as seen on a floor plan (N, 2): right and forward, metres."""
        return np.asarray(points_world @ np.column_stack([self.right, self.forward]))


@dataclass(frozen=True, slots=True)
class Framing:
    """Where to look from: positions (3,) in the world, metres, and the way up."""

    eye: FloatArray
    target: FloatArray
    up: FloatArray


def level_axes(T_world_camera: FloatArray) -> Axes:
    """Find the level from the cameras' poses (N, 4, 4), N > 0.

    Nobody holds a camera askew for long: its x axis stays level whatever its pitch. Up is
    therefore at right angles to all x axes; where these are too much alike to tell, the mean
    upright axis of the images decides.
    """
    x, y = T_world_camera[:, :3, 0], T_world_camera[:, :3, 1].mean(axis=0)
    y = y / max(float(np.linalg.norm(y)), 1e-9)
    spread = x.T @ x / len(x) + 0.05 * (np.eye(3) - np.outer(y, y))
    up = np.linalg.eigh(spread)[1][:, 0]
    up = up if up @ y < 0 else -up
    first = x[0] - (x[0] @ up) * up
    right = first / np.linalg.norm(first)
    return Axes(right, np.cross(up, right), up)


def below_ceiling(
    points_world: FloatArray, path: FloatArray, up: FloatArray, headroom_m: float
) -> NDArray[np.bool_]:
    """Tell which points (N, 3) are at most `headroom_m` above the nearest part of the path (F, 3).

    The nearest part on the floor plan: a path may lead up the stairs.
    """
    if not len(points_world) or not len(path):
        return np.ones(len(points_world), dtype=bool)
    across = np.linalg.svd(up[None])[2][1:].T
    _, nearest = KDTree(path @ across).query(points_world @ across)
    return np.asarray(points_world @ up <= (path @ up)[nearest] + headroom_m)


def frame_scene(points_world: FloatArray, axes: Axes) -> Framing:
    """Return an eye that has all but a few stray points (N, 3), N > 0, in sight, seen from above.

    It stands behind the first camera and looks the same way.
    """
    low, high = np.percentile(points_world, [1, 99], axis=0)
    inside = points_world[((points_world >= low) & (points_world <= high)).all(axis=1)]
    inside = inside if len(inside) else points_world
    ahead = np.cos(_ELEVATION) * axes.forward - np.sin(_ELEVATION) * axes.up
    frame = np.column_stack([axes.right, np.cross(axes.right, ahead), ahead])
    seen = inside @ frame
    # A box around what is seen, then as far back as its widest point asks for.
    centre = (seen.min(axis=0) + seen.max(axis=0)) / 2
    sides = np.abs(seen[:, :2] - centre[:2]) / np.tan(_HALF_ANGLE)
    back = float((sides.max(axis=1) - (seen[:, 2] - centre[2])).max())
    target = frame @ centre
    return Framing(target - max(back, _MIN_EXTENT_M) * ahead, target, axes.up)
