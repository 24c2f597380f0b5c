"""Pictures of a building: one cast of rays serves the colours under every light, and the depth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from threading import Lock

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.synthetic.atlas import LEVELS, Atlas, build_atlas
from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.lighting import LightMap, bake, shade
from roomgraph.datasets.synthetic.mesh import Image, Quad
from roomgraph.datasets.synthetic.raycast import Scene
from roomgraph.datasets.synthetic.sensor import NoiseBank, develop, measure
from roomgraph.datasets.synthetic.settings import LIGHTS, Light

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
# Where no channel of a surface is brighter than this, out of 255, it swallows the infrared.
BLACK = 12
# How far the texture is blurred where it is seen at a slant: 0.5 would keep its area, 1 its length.
SLANT = 0.6
DEPTH_STREAM = 99


@dataclass(frozen=True, slots=True, eq=False)
class Rendered:
    """One view: colour (H, W, 3) uint8 for each light asked for, and depth (H, W) in metres."""

    colours: Mapping[Light, Image]
    depth: Float32Array


class Renderer:
    """A camera in a building. May be used by several threads.

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
        self._atlas, corners, density = _lay_out(quads)
        self._light = bake(quads, building.lamps, self.scene, building.seed)
        self._table = _triangle_table(corners, _light_corners(self._light))
        # One entry more than triangles: rays that hit nothing carry the index -1.
        detail = np.log2(np.repeat(density, 2) / intrinsics.fx)
        self._detail = np.append(detail, 0).astype(np.float32)
        self._shiny = np.append(np.repeat([quad.material.shiny for quad in quads], 2), True)
        self._rays = _camera_rays(intrinsics)
        self._lengths = np.linalg.norm(self._rays, axis=2)
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
        cosine = cv2.transform(cv2.multiply(hits.normals, rays[..., 3:]), np.ones((1, 3)))
        grazing = np.abs(cosine) / self._lengths
        place = self._places(hits.triangle, hits.uv)
        albedo = self._albedo(place, hits.triangle, hits.t, grazing)
        received = cv2.remap(self._light.image, place[..., 2], place[..., 3], cv2.INTER_LINEAR)
        colours: dict[Light, Image] = {}
        for light in lights:
            normal = self._normal((*seed, LIGHTS.index(light)))
            light_rgb = shade(np.asarray(received, dtype=np.float32), light)
            colours[light] = develop(albedo, light_rgb, light, noise, normal)
        blind = self._shiny[hits.triangle] | (albedo.max(axis=2) < BLACK)
        normal = self._normal((*seed, DEPTH_STREAM))
        return Rendered(colours, measure(hits.t, grazing, blind, noise, normal))

    def _normal(self, seed: tuple[int, ...]) -> Float32Array:
        camera = self.intrinsics
        return self._bank.window(np.random.default_rng(seed), camera.height, camera.width)

    def _world_rays(self, T_world_camera: FloatArray) -> Float32Array:
        rays = np.empty((*self._rays.shape[:2], 6), dtype=np.float32)
        rays[..., :3] = T_world_camera[:3, 3]
        rays[..., 3:] = cv2.transform(self._rays, T_world_camera[:3, :3])
        return rays

    def _places(self, triangle: NDArray[np.int32], uv: Float32Array) -> Float32Array:
        """Return for each pixel where it looks in the atlas (x, y) and in the light map (x, y)."""
        first, to_second, to_third = self._table
        place = to_second.take(triangle, axis=0, mode="wrap")
        place *= uv[..., :1]
        other = to_third.take(triangle, axis=0, mode="wrap")
        other *= uv[..., 1:]
        place += other
        first.take(triangle, axis=0, mode="wrap", out=other)
        place += other
        return np.asarray(place)

    def _albedo(
        self,
        place: Float32Array,
        triangle: NDArray[np.int32],
        t: Float32Array,
        grazing: Float32Array,
    ) -> Image:
        """Look the texture up in the level whose pixels are as large as the image's.

        The lens blurs a little, too.
        """
        slanted = np.maximum(grazing, np.float32(0.05)) ** np.float32(SLANT)
        detail = self._detail.take(triangle, mode="wrap") + np.log2(t / slanted)
        level = np.asarray(cv2.convertScaleAbs(np.clip(detail, 0, LEVELS - 1)))
        x, y = _in_level(self._atlas, place, level)
        image = cv2.remap(self._atlas.image, x, y, cv2.INTER_LINEAR)
        return np.asarray(cv2.GaussianBlur(image, (3, 3), 0.55), dtype=np.uint8)


def _in_level(
    atlas: Atlas, place: Float32Array, level: NDArray[np.uint8]
) -> tuple[Float32Array, Float32Array]:
    """Return the pixels x, y (H, W) of the atlas's image that show places of a level."""
    tables = np.zeros((3, 256), dtype=np.float32)
    tables[0, :LEVELS] = scales = np.exp2(-np.arange(LEVELS))
    tables[1:, :LEVELS] = (atlas.offsets + 0.5 * scales[:, None] - 0.5).T
    scale, left, top = (cv2.LUT(level, table) for table in tables)
    return (
        np.asarray(cv2.add(cv2.multiply(place[..., 0], scale), left), dtype=np.float32),
        np.asarray(cv2.add(cv2.multiply(place[..., 1], scale), top), dtype=np.float32),
    )


def _camera_rays(intrinsics: Intrinsics) -> Float32Array:
    """Return ray directions (H, W, 3) with z = 1, so that the ray's parameter is the depth."""
    x = (np.arange(intrinsics.width) - intrinsics.cx) / intrinsics.fx
    y = (np.arange(intrinsics.height) - intrinsics.cy) / intrinsics.fy
    return np.stack([*np.meshgrid(x, y), np.ones((len(y), len(x)))], axis=-1).astype(np.float32)


def _lay_out(quads: Sequence[Quad]) -> tuple[Atlas, FloatArray, FloatArray]:
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
    """Return (3, 2 N, 4): the value at a triangle's first corner, and the steps to the others."""
    both = np.concatenate(corners, axis=2)
    triangles = both[:, [(0, 1, 2), (0, 2, 3)]].reshape(-1, 3, both.shape[2])
    triangles[:, 1:] -= triangles[:, :1]
    return np.ascontiguousarray(triangles.swapaxes(0, 1), dtype=np.float32)
