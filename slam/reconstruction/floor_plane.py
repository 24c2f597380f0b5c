"""The up direction, the floor height, and the direction of the walls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.datasets.vectors import unit
from roomgraph.slam.keyframe import Keyframe

FloatArray = NDArray[np.float64]

_REFINEMENTS = 5
# Planes whose corners are looked at: some hundred pairs.
_LARGEST = 20
# Walls fill heights evenly; a floor stands out from the layer above it by this factor.
_PROMINENCE = 3.0


class FloorPlaneSettings(Settings):
    """How the vertical and the floor are found."""

    max_tilt_deg: float = Field(
        default=50.0,
        gt=0,
        le=90,
        description="maximum tilt of the camera from upright, averaged over the run, degrees",
    )
    tolerance_deg: float = Field(
        default=5.0,
        gt=0,
        le=20,
        description="maximum tilt of a plane that counts as horizontal or vertical, degrees",
    )
    min_drop_m: float = Field(
        default=0.3,
        ge=0,
        description="minimum distance of the floor below the camera's usual height, metres",
    )
    layer_m: float = Field(
        default=0.1,
        gt=0,
        le=0.5,
        description="horizontal planes within this height form one surface, metres",
    )
    max_below: float = Field(
        default=0.03,
        ge=0,
        le=0.5,
        description="maximum share of the observed points below the floor",
    )


@dataclass(frozen=True, slots=True)
class FloorPlane:
    """The map frame: z up, the floor at 0, x along the walls; its origin below the first camera.

    Attributes
    ----------
    T_map_world : (4, 4) float64
        Maps world points, which lie as the first camera does, to the map frame.
    has_level : bool
        Whether up comes from planes; else from how the camera was held.
    has_floor : bool
        Whether a floor was seen; else the lowest of what was seen stands for it.
    has_walls : bool
        Whether x follows walls; else the camera's first heading.
    """

    T_map_world: FloatArray
    has_level: bool
    has_floor: bool
    has_walls: bool

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings about assumptions that replace missing observations."""
        found = []
        if not self.has_level:
            found.append(
                "no horizontal surface or wall was observed: the up direction is the mean of the "
                "camera's"
            )
        if not self.has_floor:
            found.append("no floor was observed: heights are measured from the lowest surface")
        return tuple(found)


@dataclass(frozen=True, slots=True)
class _Surfaces:
    """All planes in the world: normals (N, 3), a point on each (N, 3), weights (N,)."""

    normals: FloatArray
    points: FloatArray
    weights: FloatArray


def find_floor_plane(
    keyframes: Iterable[Keyframe],
    T_world_keyframe: Mapping[int, FloatArray],
    settings: FloorPlaneSettings | None = None,
) -> FloorPlane:
    """Find up, the floor and the walls' direction from the keyframes' planes.

    Up is the direction, within a camera's usual tilt, that level planes are normal to and walls
    are parallel to (a Manhattan vertical; Coughlan & Yuille, 1999, take edges for it). The floor is
    the lowest surface facing up, well below the camera, with next to nothing seen underneath.

    Parameters
    ----------
    keyframes : iterable of Keyframe
        With their planes and clouds.
    T_world_keyframe : mapping of int to (4, 4) float64
        Their poses.
    settings : FloorPlaneSettings, optional
        Tolerances.
    """
    settings = settings or FloorPlaneSettings()
    kept = [k for k in keyframes if k.id in T_world_keyframe]
    if not kept:
        return FloorPlane(se3.pose(R=[[0, 0, 1], [-1, 0, 0], [0, -1, 0]]), False, False, False)
    T = np.array([T_world_keyframe[k.id] for k in kept])
    held = unit(-T[:, :3, 1].mean(axis=0))
    surfaces = _surfaces(kept, T_world_keyframe)
    level = _vertical(surfaces, held, settings)
    up = held if level is None else level
    seen = _heights(kept, T_world_keyframe, up)
    floor = _floor(surfaces, T[:, :3, 3], seen, up, settings)
    height = floor if floor is not None else _lowest(seen)
    walls = _wall_direction(surfaces, up, settings)
    along = _unit_across(T[0, :3, 2], up) if walls is None else walls
    along = _longest(along, up, T[:, :3, 3])
    R = np.array([along, np.cross(up, along), up])
    t = np.array([0.0, 0.0, -height])
    return FloorPlane(se3.pose(R, t), level is not None, floor is not None, walls is not None)


def _surfaces(keyframes: list[Keyframe], T_world_keyframe: Mapping[int, FloatArray]) -> _Surfaces:
    """Move planes to the world, each weighed by the points seen on it."""
    normals, points, weights = [], [], []
    for keyframe in keyframes:
        T = T_world_keyframe[keyframe.id]
        for plane in keyframe.planes:
            normals.append(T[:3, :3] @ plane.normal)
            points.append(T[:3, :3] @ plane.points.mean(axis=0) + T[:3, 3])
            weights.append(float(len(plane.points)))
    return _Surfaces(
        np.array(normals).reshape(-1, 3), np.array(points).reshape(-1, 3), np.array(weights)
    )


def _vertical(
    surfaces: _Surfaces, held: FloatArray, settings: FloorPlaneSettings
) -> FloatArray | None:
    """Return up (3,), unit length; None if no plane is level within the camera's tilt."""
    directions = np.concatenate([surfaces.normals, _plumb_lines(surfaces)])
    directions = np.where(directions @ held < 0, -1.0, 1.0)[:, None] * directions
    candidates = directions[directions @ held > np.cos(np.radians(settings.max_tilt_deg))]
    if not len(candidates):
        return None
    near, steep = np.cos(np.radians(settings.tolerance_deg)), _sine(settings)
    cosines = np.abs(candidates @ surfaces.normals.T)
    support = (cosines > near) @ surfaces.weights + (cosines < steep) @ surfaces.weights
    # The nearer to how the camera was held, the likelier: a desk's slope is no floor.
    up = candidates[int((support * (candidates @ held)).argmax())]
    for _ in range(_REFINEMENTS):
        cosine = np.abs(surfaces.normals @ up)
        sign = np.where(cosine > near, 1.0, np.where(cosine < steep, -1.0, 0.0))
        scatter = np.einsum(
            "n,ni,nj->ij", sign * surfaces.weights, surfaces.normals, surfaces.normals
        )
        found = np.linalg.eigh(scatter)[1][:, -1]
        up = np.asarray(found if found @ up > 0 else -found)
    return np.asarray(up)


def _plumb_lines(surfaces: _Surfaces) -> FloatArray:
    """Return the directions (N, 3) in which pairs of the largest planes meet at about a corner."""
    largest = np.argsort(-surfaces.weights, kind="stable")[:_LARGEST]
    normals = surfaces.normals[largest]
    first, second = np.triu_indices(len(normals), 1)
    lines = np.cross(normals[first], normals[second])
    length = np.linalg.norm(lines, axis=1)
    return np.asarray(lines[length > 0.5] / length[length > 0.5, None])


def _floor(
    surfaces: _Surfaces,
    positions: FloatArray,
    seen: FloatArray,
    up: FloatArray,
    settings: FloorPlaneSettings,
) -> float | None:
    """Return the floor's height along `up` from heights seen (N,), metres; None without one."""
    top = float(np.median(positions @ up)) - settings.min_drop_m
    is_level = surfaces.normals @ up > np.cos(np.radians(settings.tolerance_deg))
    planes = np.sort((surfaces.points @ up)[is_level])
    for height in [*planes, *_prominent(seen, settings.layer_m / 2)]:
        if height > top:
            continue
        layer = seen[np.abs(seen - height) <= settings.layer_m / 2]
        middle = float(np.median(layer)) if len(layer) else float(height)
        below = float(np.mean(seen < middle - settings.layer_m))
        on = float(np.mean(np.abs(seen - middle) <= settings.layer_m / 2))
        # A few odd points make no floor: it has to carry more than may lie below it.
        if below <= settings.max_below < on:
            return middle
    return None


def _prominent(heights: FloatArray, layer_m: float) -> FloatArray:
    """Return the heights, from below, at which far more is seen than in the layer above.

    A floor seen only in slivers makes no plane in any view, but all of them lie at one height.
    """
    if not len(heights):
        return np.empty(0)
    count, edges = np.histogram(heights, np.arange(heights.min(), heights.max() + layer_m, layer_m))
    above = np.append(count[2:], [0, 0])[: len(count)]
    return np.asarray(edges[:-1][count > _PROMINENCE * np.maximum(above, 1)] + layer_m / 2)


def _heights(
    keyframes: list[Keyframe], T_world_keyframe: Mapping[int, FloatArray], up: FloatArray
) -> FloatArray:
    """Return the heights of a sixteenth of what is seen (N,), metres from the world's origin."""
    heights = [
        k.cloud[::16] @ (T_world_keyframe[k.id][:3, :3].T @ up) + T_world_keyframe[k.id][:3, 3] @ up
        for k in keyframes
    ]
    return np.concatenate(heights).astype(np.float64)


def _lowest(seen: FloatArray) -> float:
    """Return the height of the lowest things seen, but for stray readings."""
    return float(np.percentile(seen, 1)) if len(seen) else 0.0


def _wall_direction(
    surfaces: _Surfaces, up: FloatArray, settings: FloorPlaneSettings
) -> FloatArray | None:
    """Return the direction (3,) of most walls, taken modulo a quarter turn."""
    is_wall = np.abs(surfaces.normals @ up) < _sine(settings)
    if not is_wall.any():
        return None
    x, y = _across(up)
    normals, weights = surfaces.normals[is_wall], surfaces.weights[is_wall]
    angles = np.arctan2(normals @ y, normals @ x)
    # The mode first, then the circular mean around it: a slanting wall shall not turn the map.
    grid = np.radians(np.arange(0, 90, 1.0))
    offset = _quarter(angles[None] - grid[:, None])
    near = np.radians(settings.tolerance_deg)
    best = grid[int(((np.abs(offset) < near) @ weights).argmax())]
    offset = _quarter(angles - best)
    kept = np.abs(offset) < near
    angle = best + np.average(offset[kept], weights=weights[kept])
    return np.asarray(np.cos(angle) * x + np.sin(angle) * y)


def _longest(along: FloatArray, up: FloatArray, positions: FloatArray) -> FloatArray:
    """Turn `along` by a quarter if the path is longer that way: maps lie on their long side."""
    across = np.cross(up, along)
    return across if np.ptp(positions @ across) > np.ptp(positions @ along) else along


def _across(up: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two directions that make a right-handed frame with `up`."""
    x = _unit_across(np.eye(3)[int(np.abs(up).argmin())], up)
    return x, np.cross(up, x)


def _unit_across(direction: FloatArray, up: FloatArray) -> FloatArray:
    level = direction - (direction @ up) * up
    if np.linalg.norm(level) < 1e-6:
        return _across(up)[0]
    return unit(level)


def _quarter(angles: FloatArray) -> FloatArray:
    """Bring angles into a quarter turn around 0."""
    return np.asarray((angles + np.pi / 4) % (np.pi / 2) - np.pi / 4)


def _sine(settings: FloorPlaneSettings) -> float:
    return float(np.sin(np.radians(settings.tolerance_deg)))
