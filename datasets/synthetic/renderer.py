"""Pictures of a building: one cast of rays serves the colours under every light, and the depth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from threading import Lock

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.cameras.kinect import NoiseBank, develop, measure
from roomgraph.datasets.synthetic.rendering.atlas import LEVELS
from roomgraph.datasets.synthetic.rendering.eye import Eye, pinhole
from roomgraph.datasets.synthetic.rendering.light_cache import cached_light, light_key
from roomgraph.datasets.synthetic.rendering.lighting import LightMap, bake, shade
from roomgraph.datasets.synthetic.rendering.mesh import Image, Lamp, Quad
from roomgraph.datasets.synthetic.rendering.raycast import Hits, Scene
from roomgraph.datasets.synthetic.rendering.texturing import (
    in_level,
    lay_out,
    light_corners,
    triangle_table,
)
from roomgraph.datasets.synthetic.settings import LIGHTS, Light
from roomgraph.datasets.synthetic.structure.moving import Body

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
# Where no channel of a surface is brighter than this, out of 255, it swallows the infrared.
BLACK = 12
# How far the texture is blurred where it is seen at a slant: 0.5 would keep its area, 1 its length.
SLANT = 0.6
DEPTH_STREAM = 99
# Farther than this, nothing that moves is looked for.
MOVING_REACH_M = 15.0
# What moves is hidden if it is this much farther than all that is seen before it: rows that are
# read one after the other, while the camera turns, measure its depth differently.
HIDDEN_M = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Rendered:
    """One view: colour (H, W, 3) uint8 for each light asked for, and depth (H, W) in metres."""

    colours: Mapping[Light, Image]
    depth: Float32Array


@dataclass(frozen=True, slots=True, eq=False)
class Sight:
    """What an eye sees from a place: where its rays end, and how they meet the surfaces.

    Attributes
    ----------
    hits : Hits
        Triangles are numbered through the building's quads, two each, then the bodies'.
    grazing : (H, W) float32
        Cosine of the angle between the ray and the surface's normal.
    """

    hits: Hits
    grazing: Float32Array


class Renderer:
    """A building ready to be looked at. May be used by several threads.

    Parameters
    ----------
    building : Building
        What there is to see.
    intrinsics : Intrinsics
        The camera of `render`; without distortion.
    bodies : sequence of Body
        What moves in it. Stiff ones are lit where they are at rest.
    people : sequence of Body
        Bodies that are lit evenly, as they go everywhere.
    lamps : sequence of Lamp
        More lamps than the building's.
    cache : Path, optional
        A folder where baked light is kept for the next time.
    """

    def __init__(
        self,
        building: Building,
        intrinsics: Intrinsics,
        bodies: Sequence[Body] = (),
        people: Sequence[Body] = (),
        lamps: Sequence[Lamp] = (),
        cache: Path | None = None,
    ) -> None:
        stiff = [quad for body in bodies for quad in body.quads]
        lit = [*building.quads, *stiff]
        quads = [*lit, *(quad for body in people for quad in body.quads)]
        self.intrinsics = intrinsics
        self.scene = Scene(building.quads)
        self.bodies = (*bodies, *people)
        self._first = _first_triangles(len(building.quads), self.bodies)
        self._people = 2 * len(lit)
        self._atlas, corners, density = lay_out(quads)
        self._light = self._lit(building, quads, [*building.lamps, *lamps], len(lit), cache)
        self._tint = building.tint
        self._table = triangle_table(corners, light_corners(self._light))
        # One entry more than triangles: rays that hit nothing carry the index -1.
        self._density = np.append(np.log2(np.repeat(density, 2)), 0)
        self._shiny = np.append(np.repeat([quad.material.shiny for quad in quads], 2), True)
        self.eye = pinhole(intrinsics)
        self._bank = NoiseBank.draw(intrinsics.height, intrinsics.width)
        self._lock = Lock()

    def _lit(
        self, building: Building, quads: Sequence[Quad], lamps: Sequence[Lamp], still: int,
        cache: Path | None,
    ) -> LightMap:  # fmt: skip
        """Return the light on all quads, the first `still` of which keep their places."""
        rest = building.seed, still, building.sun, building.plan.kind
        key = light_key(quads, lamps, *rest) if cache is not None else ""
        scene = self.scene if still == len(building.quads) else Scene(quads[:still])
        is_smooth = building.plan.kind != "corridor"
        return cached_light(
            cache, key,
            lambda: bake(
                quads, lamps, scene, building.seed, still, building.sun, smooth=is_smooth
            ),
        )  # fmt: skip

    def render(
        self,
        T_world_camera: FloatArray,
        lights: Sequence[Light] = ("day",),
        noise: float = 1.0,
        seed: Sequence[int] = (0,),
    ) -> Rendered:
        """Render a view with an ideal colour camera, and a Kinect's depth that lies on it.

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
        sight = self.look(self.eye, T_world_camera)
        colours, albedo = self.colours(self.eye, sight, lights, noise, seed)
        blind = self.blind(sight, albedo)
        normal = self.normal((*seed, DEPTH_STREAM))
        return Rendered(colours, measure(sight.hits.t, sight.grazing, blind, noise, normal))

    def look(self, eye: Eye, T_world_camera: FloatArray, stamp_s: float = 0.0) -> Sight:
        """Cast the rays of an eye from a place (4, 4), or from places by row (H, 4, 4)."""
        rays = eye.world_rays(T_world_camera)
        middle = T_world_camera
        if middle.ndim == 3:
            middle = T_world_camera[len(T_world_camera) // 2]
        with self._lock:
            hits = self.scene.cast(rays)
            if self.bodies:
                self._cast_moving(eye, rays, middle, stamp_s, hits)
        cosine = cv2.transform(cv2.multiply(hits.normals, rays[..., 3:]), np.ones((1, 3)))
        return Sight(hits, np.abs(cosine) / eye.lengths)

    def _cast_moving(
        self, eye: Eye, rays: Float32Array, T: FloatArray, stamp_s: float, hits: Hits
    ) -> None:
        """Put what moves before what does not, in place."""
        for body, first in zip(self.bodies, self._first, strict=True):
            if not body.is_there(stamp_s):
                continue
            centre = body.centre(stamp_s)
            if np.linalg.norm(centre - T[:3, 3]) > MOVING_REACH_M:
                continue
            rows, columns = eye.window(centre, body.radius_m, T)
            if rows.stop <= rows.start or columns.stop <= columns.start:
                continue
            if hits.t[rows, columns].max() < eye.depth(centre, T) - body.radius_m - HIDDEN_M:
                continue  # It is behind a wall.
            near = Scene.of(body.corners(stamp_s)).cast(np.ascontiguousarray(rays[rows, columns]))
            closer = near.t < hits.t[rows, columns]
            hits.t[rows, columns][closer] = near.t[closer]
            hits.triangle[rows, columns][closer] = near.triangle[closer] + first
            hits.uv[rows, columns][closer] = near.uv[closer]
            hits.normals[rows, columns][closer] = near.normals[closer]

    def colours(
        self, eye: Eye, sight: Sight, lights: Sequence[Light], noise: float, seed: Sequence[int]
    ) -> tuple[dict[Light, Image], Image]:
        """Return an ideal camera's image under each light, and the surfaces' own colours."""
        albedo, received = self.surfaces(eye, sight)
        colours: dict[Light, Image] = {}
        for light in lights:
            normal = self.normal((*seed, LIGHTS.index(light)))
            light_rgb = shade(received, light, self._tint)
            colours[light] = develop(albedo, light_rgb, light, noise, normal)
        return colours, albedo

    def surfaces(self, eye: Eye, sight: Sight) -> tuple[Image, Float32Array]:
        """Return the surfaces' own colours (H, W, 3) and the light they receive (H, W, 4)."""
        place = self._places(sight.hits.triangle, sight.hits.uv)
        albedo = self._albedo(place, sight, eye)
        received = cv2.remap(self._light.image, place[..., 2], place[..., 3], cv2.INTER_LINEAR)
        return albedo, np.asarray(received, dtype=np.float32)

    def radiance(self, eye: Eye, sight: Sight, light: Light) -> Float32Array:
        """Return the light (H, W, 3) that comes from the surfaces; 255 is white in full light."""
        albedo, received = self.surfaces(eye, sight)
        lit = shade(received, light, self._tint)
        return np.asarray(cv2.multiply(albedo, lit, dtype=cv2.CV_32F), dtype=np.float32)

    def blind(self, sight: Sight, albedo: Image) -> NDArray[np.bool_]:
        """Return where a depth sensor gets nothing back (H, W): mirrors, polished steel, black."""
        return np.asarray(self._shiny[sight.hits.triangle] | (albedo.max(axis=2) < BLACK))

    def people_mask(self, sight: Sight) -> NDArray[np.bool_]:
        """Return where people are seen (H, W)."""
        return np.asarray(sight.hits.triangle >= self._people)

    def normal(self, seed: tuple[int, ...], shape: tuple[int, int] | None = None) -> Float32Array:
        """Return standard normal values (H, W, 3) for the camera's image, or one not larger."""
        camera = self.intrinsics
        height, width = shape or (camera.height, camera.width)
        return self._bank.window(np.random.default_rng(seed), height, width)

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

    def _albedo(self, place: Float32Array, sight: Sight, eye: Eye) -> Image:
        """Look the texture up in the level whose pixels are as large as the image's.

        The lens blurs a little, too.
        """
        slanted = np.maximum(sight.grazing, np.float32(0.05)) ** np.float32(SLANT)
        pixels = np.log2(eye.focal_px)
        if isinstance(eye.focal_px, float):
            table = (self._density - pixels).astype(np.float32)
            table[-1] = 0
            detail = table.take(sight.hits.triangle, mode="wrap")
        else:
            detail = self._density.astype(np.float32).take(sight.hits.triangle, mode="wrap")
            detail -= pixels
        detail = detail + np.log2(sight.hits.t / slanted)
        level = np.asarray(cv2.convertScaleAbs(np.clip(detail, 0, LEVELS - 1)))
        x, y = in_level(self._atlas, place, level)
        image = cv2.remap(self._atlas.image, x, y, cv2.INTER_LINEAR)
        return np.asarray(cv2.GaussianBlur(image, (3, 3), 0.55), dtype=np.uint8)


def _first_triangles(static: int, bodies: Sequence[Body]) -> list[int]:
    """Return the number of each body's first triangle."""
    counts = np.cumsum([static, *(len(body.quads) for body in bodies)])
    return [2 * int(count) for count in counts[:-1]]
