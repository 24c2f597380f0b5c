"""Static light: how much each surface receives from windows, lamps and the sky."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.rendering.atlas import pack
from roomgraph.datasets.synthetic.rendering.mesh import Lamp, Quad
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from roomgraph.datasets.synthetic.settings import Light
from roomgraph.datasets.vectors import unit

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

SPACING_M = 0.16
LARGEST = 24
MAP_WIDTH = 512
REACH_M = 6.0
OCCLUSION_M = 1.0
OCCLUSION_RAYS = 20
SUN_POWER = 0.8

# A light map has four channels: light through windows, from ceiling lamps, from the lamps that
# burn in the evening, and ambient. A preset says how red, green and blue follow from them.
WINDOW, LAMP, EVENING, AMBIENT = range(4)
PRESETS: dict[Light, FloatArray] = {
    "day": np.array([(0.96, 0.34, 0.02, 0.60), (1.00, 0.33, 0.02, 0.63), (1.05, 0.30, 0.01, 0.67)]),
    "dusk": np.array(
        [(0.42, 0.42, 0.22, 0.40), (0.33, 0.39, 0.19, 0.37), (0.29, 0.33, 0.14, 0.37)]
    ),
    "night": np.array(
        [(0.02, 0.06, 0.62, 0.30), (0.02, 0.06, 0.55, 0.265), (0.04, 0.05, 0.41, 0.22)]
    ),
}


@dataclass(frozen=True, slots=True, eq=False)
class LightMap:
    """Received light (H, W, 4) float32 and where each quad's patch is.

    `places` (N, 2) are the patches' top left corners, x, y, and `sizes` (N, 2) their numbers of
    samples, x, y; the outer samples lie on the edges of the quad.
    """

    image: Float32Array
    places: NDArray[np.int64]
    sizes: NDArray[np.int64]


def bake(
    quads: Sequence[Quad],
    lamps: Sequence[Lamp],
    scene: Scene,
    seed: int,
    still: int | None = None,
    sun: FloatArray | None = None,
    *,
    smooth: bool = False,
) -> LightMap:
    """Compute the light that arrives at every surface, with shadows.

    Parameters
    ----------
    quads : sequence of Quad
        The surfaces.
    lamps : sequence of Lamp
        The sources of light.
    scene : Scene
        What casts shadows.
    seed : int
        Chooses the rays that sample the ambient light.
    still : int, optional
        Only the first so many quads stay where they are; the others get the mean light.
    sun : (3,) float64, optional
        The direction that sunlight comes from; it falls in where `scene` has windows.
    smooth : bool
        Whether the light of neighbouring points of a surface is averaged, against the grain that
        few rays leave.
    """
    sizes = np.array([_samples(quad.corners) for quad in quads])
    places, height = pack([(int(h), int(w)) for w, h in sizes], MAP_WIDTH, 0)
    points, normals, owner, pixels = _sample_points(quads, sizes, places)
    light = np.zeros((len(points), 4))
    light[:, AMBIENT] = _openness(points, normals, scene, seed)
    for lamp in lamps:
        _add_lamp(light, lamp, points, normals, scene)
    if sun is not None:
        _add_sun(light, sun, points, normals, (quads, scene))
    if still is not None and still < len(quads):
        moving = owner >= still
        up = 0.75 + 0.25 * normals[moving, 2:]
        light[moving] = up * light[~moving].mean(axis=0)
    for index, quad in enumerate(quads):
        if quad.material.glow is not None:
            light[owner == index] = quad.material.glow
    image = np.zeros((height, MAP_WIDTH, 4), dtype=np.float32)
    image[pixels[:, 1], pixels[:, 0]] = light
    if smooth:
        _smooth(image, places, sizes)
    return LightMap(image, places, sizes)


def _smooth(image: Float32Array, places: NDArray[np.int64], sizes: NDArray[np.int64]) -> None:
    """Average each surface's patch with itself over three samples each way, in place."""
    for (x, y), (columns, rows) in zip(places, sizes, strict=True):
        if min(columns, rows) >= 3:
            patch = image[y : y + rows, x : x + columns]
            patch[:] = cv2.blur(patch, (3, 3), borderType=cv2.BORDER_REPLICATE)


def _samples(corners: FloatArray) -> tuple[int, int]:
    across = float(np.linalg.norm(corners[1] - corners[0]))
    down = float(np.linalg.norm(corners[3] - corners[0]))
    x, y = (int(np.clip(np.ceil(length / SPACING_M) + 1, 2, LARGEST)) for length in (across, down))
    return x, y


def _sample_points(
    quads: Sequence[Quad], sizes: NDArray[np.int64], places: NDArray[np.int64]
) -> tuple[FloatArray, FloatArray, NDArray[np.int64], NDArray[np.int64]]:
    """Return points just off the surfaces, their normals, quads and pixels in the map."""
    points, normals, pixels = [], [], []
    for quad, (columns, rows), place in zip(quads, sizes, places, strict=True):
        c = quad.corners
        normal = unit(np.cross(c[3] - c[0], c[1] - c[0]))
        u, v = np.meshgrid(np.linspace(0.02, 0.98, columns), np.linspace(0.02, 0.98, rows))
        u, v = u.reshape(-1, 1), v.reshape(-1, 1)
        where = (1 - u) * ((1 - v) * c[0] + v * c[3]) + u * ((1 - v) * c[1] + v * c[2])
        points.append(where + 0.004 * normal)
        normals.append(np.tile(normal, (len(where), 1)))
        x, y = np.meshgrid(np.arange(columns), np.arange(rows))
        pixels.append(np.column_stack([x.ravel(), y.ravel()]) + place)
    owner = np.repeat(np.arange(len(quads)), sizes.prod(axis=1))
    return np.concatenate(points), np.concatenate(normals), owner, np.concatenate(pixels)


def _openness(points: FloatArray, normals: FloatArray, scene: Scene, seed: int) -> FloatArray:
    """Return the share of the half space above each point that is free nearby (ambient light)."""
    rng = np.random.default_rng((seed, 7))
    total = np.zeros(len(points))
    for _ in range(OCCLUSION_RAYS):
        direction = rng.standard_normal((len(points), 3))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        direction = direction + normals * 1.02
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        total += np.minimum(scene.distances(points, direction), OCCLUSION_M) / OCCLUSION_M
    return np.asarray(0.25 + 0.75 * total / OCCLUSION_RAYS)


def _add_lamp(
    light: FloatArray, lamp: Lamp, points: FloatArray, normals: FloatArray, scene: Scene
) -> None:
    """Add a lamp's light, by Lambert's law, to the points that it reaches."""
    way = np.asarray(lamp.position) - points
    distance = np.linalg.norm(way, axis=1)
    way /= np.maximum(distance, 1e-9)[:, None]
    facing = np.einsum("ij,ij->i", way, normals)
    leaving = -(way @ np.asarray(lamp.direction))
    near = np.flatnonzero((distance < REACH_M) & (facing > 0) & (leaving > 0))
    if not len(near):
        return
    free = scene.distances(points[near], way[near]) > distance[near] - 0.05
    fade = (1 - (distance[near] / REACH_M) ** 2) ** 2 / (0.6 + distance[near] ** 2)
    # Between a point source and a panel: light also leaves and arrives at grazing angles.
    received = lamp.power * fade * (0.15 + 0.85 * leaving[near]) * (0.1 + 0.9 * facing[near])
    light[near, lamp.channel] += np.where(free, received, 0.0)


def _add_sun(
    light: FloatArray,
    sun: FloatArray,
    points: FloatArray,
    normals: FloatArray,
    world: tuple[Sequence[Quad], Scene],
) -> None:
    """Add sunlight to the points that see the sun through a window."""
    quads, scene = world
    glows = [quad.material.glow for quad in quads]
    is_window = np.array([glow is not None and glow[WINDOW] > 1 for glow in glows])
    facing = normals @ sun
    lit = np.flatnonzero(facing > 0.02)
    rays = np.concatenate([points[lit], np.tile(sun, (len(lit), 1))], axis=1).astype(np.float32)
    triangle = scene.cast(rays).triangle
    through = (triangle >= 0) & is_window[np.maximum(triangle, 0) // 2]
    light[lit[through], WINDOW] += SUN_POWER * facing[lit[through]]


def shade(received: Float32Array, light: Light, tint: FloatArray | None = None) -> Float32Array:
    """Return the (H, W, 3) colour of the light in a preset, from the (H, W, 4) light received.

    `tint` (3, 4) makes red, green and blue of each channel stronger or weaker.
    """
    mix = PRESETS[light] if tint is None else PRESETS[light] * tint
    return np.asarray(cv2.transform(received, mix.astype(np.float32)), dtype=np.float32)
