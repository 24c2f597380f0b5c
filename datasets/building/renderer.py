"""Pictures of a building: one cast of rays serves the colours under every light, and the depth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from threading import Lock

import cv2
import numpy as np
from numpy.typing import NDArray

from datasets.building.atlas import LEVELS, build_atlas
from datasets.building.building import Building
from datasets.building.lighting import LightMap, bake, shade
from datasets.building.mesh import Image, Quad
from datasets.building.raycast import Hits, Scene
from datasets.building.sensor import NoiseBank, develop, measure
from datasets.building.settings import LIGHTS, Light
from datasets.camera import Intrinsics

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
BLACK = 12


@dataclass(frozen=True, slots=True, eq=False)
class Rendered:
    """One view: colour (H, W, 3) uint8 for each light asked for, and depth (H, W) in metres."""

    colours: Mapping[Light, Image]
    depth: Float32Array


class Renderer:
    """A camera in a building.

    Parameters
    ----------
    building : Building
        What there is to see.
    intrinsics : Intrinsics
        The camera; without distortion.
    """

    def __init__(self, building: Building, intrinsics: Intrinsics) -> None:
        quads = building.quads
        self.intrinsics = intrinsics
        self.scene = Scene(quads)
        self._atlas, self._corners, density = _lay_out(quads)
        self._light = bake(quads, building.lamps, self.scene, building.seed)
        self._table = _triangle_table(self._corners, _light_corners(self._light))
        per_triangle = np.repeat(density, 2)
        self._log_density = np.append(np.log2(per_triangle), 0).astype(np.float32)
        self._shiny = np.append(np.repeat([q.material.shiny for q in quads], 2), True)
        self._rays = _camera_rays(intrinsics)
        self._bank = NoiseBank.draw(intrinsics.height, intrinsics.width)
        self._lock = Lock()

    def render(
        self,
        T_world_camera: FloatArray,
        lights: Sequence[Light] = ("day",),
        noise: float = 1.0,
        seed: Sequence[int] = (0,),
    ) -> Rendered:
        """Render a view.

        Parameters
        ----------
        T_world_camera : (4, 4) float64
            Where the camera is.
        lights : sequence of {"day", "dusk", "night"}
            The lights to render the view under.
        noise : float
            Scale of the noise; 0 gives exact depth and clean colours.
        seed : sequence of int
            Seeds the noise; give each frame its own.
        """
        rays = self._world_rays(T_world_camera)
        with self._lock:
            hits = self.scene.cast(rays)
        grazing = _grazing(hits, rays[..., 3:])
        place = self._places(hits)
        albedo = self._albedo(place, hits, grazing)
        received = np.asarray(
            cv2.remap(self._light.image, place[..., 2], place[..., 3], cv2.INTER_LINEAR),
            dtype=np.float32,
        )
        height, width = albedo.shape[:2]
        colours: dict[Light, Image] = {}
        for light in lights:
            rng = np.random.default_rng((*seed, LIGHTS.index(light)))
            normal = self._bank.window(rng, height, width)
            colours[light] = develop(albedo, shade(received, light), light, noise, normal)
        normal = self._bank.window(np.random.default_rng((*seed, 99)), height, width)
        blind = self._shiny[hits.triangle] | (albedo.max(axis=2) < BLACK)
        return Rendered(colours, measure(hits.t, grazing, blind, noise, normal))

    def _world_rays(self, T_world_camera: FloatArray) -> Float32Array:
        rays = np.empty((*self._rays.shape[:2], 6), dtype=np.float32)
        rays[..., :3] = T_world_camera[:3, 3]
        rays[..., 3:] = self._rays @ T_world_camera[:3, :3].T.astype(np.float32)
        return rays

    def _places(self, hits: Hits) -> Float32Array:
        """Return for each pixel where it looks in the atlas (x, y) and in the light map (x, y)."""
        table = self._table
        u, v = hits.uv[..., :1], hits.uv[..., 1:]
        place = table[0].take(hits.triangle, axis=0, mode="wrap")
        place += u * table[1].take(hits.triangle, axis=0, mode="wrap")
        place += v * table[2].take(hits.triangle, axis=0, mode="wrap")
        return place

    def _albedo(self, place: Float32Array, hits: Hits, grazing: Float32Array) -> Image:
        """Look the texture up in the level whose pixels are as large as the image's."""
        t = np.where(np.isfinite(hits.t), hits.t, 1.0)
        detail = self._log_density[hits.triangle] + np.log2(t / self.intrinsics.fx)
        detail -= 0.6 * np.log2(np.maximum(grazing, 0.05))
        level = np.clip(np.rint(detail), 0, LEVELS - 1).astype(np.int64)
        scale = np.exp2(-np.arange(LEVELS)).astype(np.float32)[level]
        offsets = self._atlas.offsets[level]
        x = (place[..., 0] + 0.5) * scale - 0.5 + offsets[..., 0]
        y = (place[..., 1] + 0.5) * scale - 0.5 + offsets[..., 1]
        return np.asarray(cv2.remap(self._atlas.image, x, y, cv2.INTER_LINEAR), dtype=np.uint8)


def _camera_rays(intrinsics: Intrinsics) -> Float32Array:
    """Return ray directions (H, W, 3) with z = 1, so that the ray's parameter is the depth."""
    x, y = np.meshgrid(np.arange(intrinsics.width), np.arange(intrinsics.height))
    x, y = (x - intrinsics.cx) / intrinsics.fx, (y - intrinsics.cy) / intrinsics.fy
    return np.stack([x, y, np.ones_like(x)], axis=-1).astype(np.float32)


def _grazing(hits: Hits, directions: Float32Array) -> Float32Array:
    cosine = np.einsum("ijk,ijk->ij", hits.normals, directions)
    return np.asarray(np.abs(cosine) / np.sqrt(np.einsum("ijk,ijk->ij", directions, directions)))


def _lay_out(quads: Sequence[Quad]):  # type: ignore[no-untyped-def]
    """Return the atlas, each quad's corners in it (N, 4, 2), and its pixels a metre (N,)."""
    images = {id(quad.material.image): quad.material.image for quad in quads}
    atlas, places = build_atlas(list(images.values()))
    place_of = dict(zip(images, places, strict=True))
    corners = np.empty((len(quads), 4, 2))
    density = np.empty(len(quads))
    for index, quad in enumerate(quads):
        rows, columns = quad.material.image.shape[:2]
        left, top, right, bottom = quad.window
        unit = np.array([(left, top), (right, top), (right, bottom), (left, bottom)])
        corners[index] = place_of[id(quad.material.image)] - 0.5 + unit * (columns, rows)
        across = np.linalg.norm(quad.corners[1] - quad.corners[0])
        down = np.linalg.norm(quad.corners[3] - quad.corners[0])
        shown = (right - left) * columns * (bottom - top) * rows
        density[index] = np.sqrt(max(shown, 1.0) / max(float(across * down), 1e-8))
    return atlas, corners, density


def _light_corners(light: LightMap) -> FloatArray:
    """Return each quad's corners (N, 4, 2) in the light map."""
    unit = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    return np.asarray(light.places[:, None] + unit * (light.sizes[:, None] - 1), dtype=np.float64)


def _triangle_table(*corners: FloatArray) -> Float32Array:
    """Return (3, 2 N, 4): the value at each triangle's first corner, and the steps to the others."""
    both = np.concatenate(corners, axis=2)
    triangles = both[:, [(0, 1, 2), (0, 2, 3)]].reshape(-1, 3, both.shape[2])
    triangles[:, 1:] -= triangles[:, :1]
    return np.ascontiguousarray(triangles.swapaxes(0, 1), dtype=np.float32)
