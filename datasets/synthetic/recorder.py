"""Recording a world: each frame's colour, depth, and what is truly seen in it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import DepthCamera
from roomgraph.datasets.se3 import inverse
from roomgraph.datasets.synthetic.cameras.depth_sensor import Sighted
from roomgraph.datasets.synthetic.cameras.omni import OmniModel, T_camera_omni
from roomgraph.datasets.synthetic.cameras.omni_image import mirror_image
from roomgraph.datasets.synthetic.cameras.photograph import (
    develop_real,
    exposure_series,
    motion_blur,
    white_balance_series,
)
from roomgraph.datasets.synthetic.cameras.registry import sensor
from roomgraph.datasets.synthetic.renderer import DEPTH_STREAM, Renderer, Sight
from roomgraph.datasets.synthetic.rendering.eye import Eye, pinhole
from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.settings import LIGHTS, Light
from roomgraph.datasets.synthetic.world import World

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
# A rolling shutter reads the first row so long before the last.
READOUT_S = 0.018
# The light meter's image, and how many frames lie between two of its readings.
METER_PX, METER_EVERY = (48, 36), 3
# The mirror image's side by the colour image's shorter one, its mean brightness, its noise's seed.
OMNI_SHARE, OMNI_MEAN, OMNI_STREAM = 1.25, 140.0, 98
# What a covered lens lets through.
COVERED = 0.012


@dataclass(frozen=True, slots=True, eq=False)
class Recorded:
    """One frame.

    Attributes
    ----------
    colours : mapping of light to (H, W, 3) uint8
    depth : (h, w) float32
        As the sensor gives it, in its own image, metres.
    sight : Sight
        What the colour image shows.
    mirrors : mapping of light to (N, N, 3) uint8
        The omnidirectional camera's images; empty without one.
    """

    colours: Mapping[Light, Image]
    depth: Float32Array
    sight: Sight
    mirrors: Mapping[Light, Image]


@dataclass(frozen=True, slots=True, eq=False)
class _Photo:
    """How a real camera takes each frame under one light."""

    gain: FloatArray
    exposure_s: FloatArray
    white_balance: FloatArray


class Recorder:
    """Takes the frames of a world. May be used by several threads.

    Parameters
    ----------
    world : World
    lights : sequence of {"day", "dusk", "night"}
        The lights to record under.
    cache : Path, optional
        A folder where baked light is kept for the next time.
    """

    def __init__(self, world: World, lights: Sequence[Light], cache: Path | None = None) -> None:
        self.world, self.lights = world, lights
        settings, moving = world.settings, world.animation
        self.renderer = Renderer(
            world.building,
            settings.intrinsics,
            moving.bodies,
            moving.people,
            moving.lamps,
            cache,
        )
        self.sensor = sensor(settings.sensor)
        self.depth_camera: DepthCamera | None = self.sensor.camera(settings.intrinsics)
        seen_by = settings.intrinsics if self.depth_camera is None else self.depth_camera.intrinsics
        self._depth_eye = pinhole(seen_by)
        self._photos = self._meter() if settings.has_real_optics else {}
        size = round(OMNI_SHARE * min(settings.width, settings.height))
        self.omni = OmniModel().resized(size) if settings.omni else None
        self._omni_eye = None if self.omni is None else self.omni.rays()

    def record(self, index: int) -> Recorded:
        """Take a frame."""
        world, eye = self.world, self.renderer.eye
        settings, stamp_s = world.settings, float(world.trajectory.stamps_s[index])
        T = world.trajectory.T_world_camera[index]
        if not self._photos:
            sight = self.renderer.look(eye, T, stamp_s)
            seed = (settings.seed, index)
            colours, albedo = self.renderer.colours(eye, sight, self.lights, settings.noise, seed)
            own = None if self.depth_camera is not None else (sight, albedo)
            depth = self._depth(index, T, stamp_s, own)
            return Recorded(colours, depth, sight, self._mirrors(index, T, stamp_s))
        height = settings.height
        rows_s = stamp_s + ((np.arange(height) + 0.5) / height - 0.5) * READOUT_S
        sight = self.renderer.look(eye, world.motion.poses(rows_s), stamp_s)
        covered = self._is_covered(stamp_s)
        photos = {
            light: self._photograph(index, light, sight, stamp_s, covered) for light in self.lights
        }
        depth = self._depth(index, T, stamp_s, None)
        depth = np.zeros_like(depth) if covered else depth
        return Recorded(photos, depth, sight, self._mirrors(index, T, stamp_s))

    def _is_covered(self, stamp_s: float) -> bool:
        return any(
            stretch.kind == "cover" and stretch.begin_s <= stamp_s <= stretch.end_s
            for stretch in self.world.stretches
        )

    def _photograph(
        self, index: int, light: Light, sight: Sight, stamp_s: float, covered: bool
    ) -> Image:
        """Take a photograph with a real camera: blurred, exposed and balanced by itself."""
        settings, photo = self.world.settings, self._photos[light]
        radiance = self.renderer.radiance(self.renderer.eye, sight, light)
        half = float(photo.exposure_s[index]) / 2
        begin, end = self.world.motion.poses(np.array([stamp_s - half, stamp_s + half]))
        if covered:
            # A finger spreads what it lets through: nothing of the scene is left.
            radiance[:] = np.float32(COVERED) * radiance.mean(axis=(0, 1))
        else:
            t = np.where(np.isfinite(sight.hits.t), sight.hits.t, 0).astype(np.float32)
            T_start_end = inverse(begin) @ end
            radiance = motion_blur(radiance, t, settings.intrinsics, T_start_end)
        normal = self.renderer.normal((settings.seed, index, LIGHTS.index(light)))
        gain, balance = float(photo.gain[index]), photo.white_balance[index]
        return develop_real(radiance, gain, balance, settings.noise, normal)

    def _mirrors(self, index: int, T: FloatArray, stamp_s: float) -> dict[Light, Image]:
        """Take the omnidirectional camera's image under each light, well exposed."""
        if self.omni is None or self._omni_eye is None:
            return {}
        sight = self.renderer.look(self._omni_eye, T @ T_camera_omni(), stamp_s)
        seen, size, noise = self.omni.mask(), self.omni.size_px, self.world.settings.noise
        images = {}
        for light in self.lights:
            radiance = self.renderer.radiance(self._omni_eye, sight, light)
            gain = OMNI_MEAN / max(float(radiance[seen].mean()), 1.0)
            seed = (self.world.settings.seed, index, OMNI_STREAM, LIGHTS.index(light))
            normal = self.renderer.normal(seed, (size, size))
            images[light] = mirror_image(radiance, self.omni, normal, gain, noise)
        return images

    def _depth(
        self, index: int, T: FloatArray, stamp_s: float, seen: tuple[Sight, Image] | None
    ) -> Float32Array:
        """Measure depth: with the colour camera's view, if given, or with an eye of its own."""
        settings, eye = self.world.settings, self._depth_eye
        if self.depth_camera is not None:
            T = T @ self.depth_camera.T_colour_depth
        if seen is None:
            sight = self.renderer.look(eye, T, stamp_s)
            seen = sight, self.renderer.surfaces(eye, sight)[0]
        sight, albedo = seen
        shape = sight.hits.t.shape[0], sight.hits.t.shape[1]
        normals = cv2.transform(sight.hits.normals, np.ascontiguousarray(T[:3, :3].T))
        view = Sighted(
            z=sight.hits.t, grazing=sight.grazing, blind=self.renderer.blind(sight, albedo),
            grey=np.asarray(cv2.cvtColor(albedo, cv2.COLOR_RGB2GRAY), dtype=np.uint8),
            focal_px=float(np.mean(eye.focal_px)), normals=np.asarray(normals, dtype=np.float32),
        )  # fmt: skip
        normal = self.renderer.normal((settings.seed, index, DEPTH_STREAM), shape)
        return self.sensor.measure(view, settings.noise, normal)

    def _meter(self) -> dict[Light, _Photo]:
        """Measure the light along the way, and let exposure and white balance follow it."""
        world = self.world
        whole = world.journey.trajectory
        settings = world.settings
        small = pinhole(settings.intrinsics.resized(*METER_PX))
        count = min(len(whole), (settings.frames or len(whole)) + METER_EVERY)
        taken = np.arange(0, count, METER_EVERY)
        means = {light: np.empty((len(taken), 3)) for light in self.lights}
        for row, index in enumerate(taken):
            self._read_meter(small, int(index), row, means)
        photos = {}
        frames = np.arange(len(world.trajectory))
        for light, values in means.items():
            if light in self.lights:
                colours = np.column_stack(
                    [np.interp(frames, taken, values[:, channel]) for channel in range(3)]
                )
                series = exposure_series(colours.mean(axis=1), settings.rate_hz)
                balance = white_balance_series(colours, settings.rate_hz)
                photos[light] = _Photo(series.gain, series.exposure_s, balance)
        return photos

    def _read_meter(
        self, eye: Eye, index: int, row: int, means: Mapping[Light, FloatArray]
    ) -> None:
        whole = self.world.journey.trajectory
        stamp_s = float(whole.stamps_s[index])
        sight = self.renderer.look(eye, whole.T_world_camera[index], stamp_s)
        factor = COVERED if self._is_covered(stamp_s) else 1.0
        for light, values in means.items():
            values[row] = factor * self.renderer.radiance(eye, sight, light).mean(axis=(0, 1))
