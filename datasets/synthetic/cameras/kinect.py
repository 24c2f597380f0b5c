"""What a Kinect makes of a scene: noise in the colours, noise and holes in the depth."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.settings import Light

Float32Array = NDArray[np.float32]
Mask = NDArray[np.bool_]

MIN_DEPTH_M, MAX_DEPTH_M = 0.5, 5.0
# A Kinect's focal length times its baseline (580 px, 7.5 cm) and its smallest step of disparity.
FOCAL_BASELINE = 43.5
DISPARITY_STEP = 1 / 8
# Standard deviation of the colours' noise, out of 255, before the exposure's gain.
COLOUR_NOISE: dict[Light, float] = {"day": 2.2, "dusk": 3.2, "night": 4.2}
MEAN_COLOUR = 118.0


@dataclass(frozen=True, slots=True, eq=False)
class NoiseBank:
    """Normal deviates, drawn once; each image takes a window of them at a random place."""

    values: Float32Array

    @classmethod
    def draw(cls, height: int, width: int) -> NoiseBank:
        """Draw enough for images of a size."""
        rng = np.random.default_rng((height, width))
        return cls(rng.standard_normal((height + 331, width + 433, 3), dtype=np.float32))

    def window(self, rng: np.random.Generator, height: int, width: int) -> Float32Array:
        """Return (height, width, 3) standard normal values."""
        top = int(rng.integers(self.values.shape[0] - height + 1))
        left = int(rng.integers(self.values.shape[1] - width + 1))
        flip = slice(None, None, -1 if rng.random() < 0.5 else 1)
        return self.values[top : top + height, left : left + width][:, flip]


def develop(
    albedo: Image,
    light_rgb: Float32Array,
    light: Light,
    noise: float,
    normal: Float32Array,
) -> Image:
    """Return the photograph of surfaces `albedo` (H, W, 3) under `light_rgb` (H, W, 3).

    The exposure follows the mean brightness half the way, as an automatic one does, and noise
    grows with it.
    """
    image = cv2.multiply(albedo, light_rgb, dtype=cv2.CV_32F)
    mean = float(np.mean(cv2.mean(image[::8, ::8])[:3]))
    gain = float(np.clip((MEAN_COLOUR / max(mean, 1.0)) ** 0.5, 0.7, 1.8))
    if noise:
        image = cv2.scaleAdd(normal, noise * COLOUR_NOISE[light], image)
    return np.asarray(cv2.convertScaleAbs(image, alpha=gain), dtype=np.uint8)


def measure(
    z: Float32Array, grazing: Float32Array, blind: Mask, noise: float, normal: Float32Array
) -> Float32Array:
    """Return the depth image that a Kinect gives for exact depths.

    Parameters
    ----------
    z : (H, W) float32
        Exact depth, metres; infinite where there is nothing.
    grazing : (H, W) float32
        Cosine of the angle between the ray and the surface's normal.
    blind : (H, W) bool
        Surfaces that send nothing back: mirrors, steel, black.
    noise : float
        Scale; at 0 only the range is limited, and the depth is exact.
    normal : (H, W, 3) float32
        Standard normal values.
    """
    depth = np.where(np.isfinite(z), z, 0).astype(np.float32)
    if noise:
        holes = blind | (grazing < 0.12 + 0.03 * normal[..., 1]) | _edges(depth, normal[..., 2])
        depth = _quantised_noise(depth, noise, normal[..., 0])
        depth[holes] = 0
    depth[(depth < MIN_DEPTH_M) | (depth > MAX_DEPTH_M)] = 0
    return depth


def _quantised_noise(depth: Float32Array, noise: float, normal: Float32Array) -> Float32Array:
    """Add axial noise (Nguyen et al., 2012, equation 3) with the steps of the disparity in it."""
    step = DISPARITY_STEP / FOCAL_BASELINE * noise
    sigma = noise * (0.0012 + 0.0019 * (depth - 0.4) ** 2)
    # Rounding to steps is noise too; what it adds is taken off, so that the sum has this sigma.
    rounding = step / np.sqrt(12) * depth**2
    sigma = np.sqrt(np.maximum(sigma**2 - rounding**2, 0, dtype=np.float32))
    noisy = np.maximum(depth + sigma * normal, np.float32(0.05))
    steps = np.maximum(np.rint(np.float32(1 / step) / noisy), 1)
    return np.asarray(np.float32(1 / step) / steps, dtype=np.float32)


def _edges(depth: Float32Array, normal: Float32Array) -> Mask:
    """Return where the depth jumps within a ragged pixel or two: one eye of the two sees past."""
    kernel = np.ones((3, 3), dtype=np.uint8)
    near, far = cv2.erode(depth, kernel), cv2.dilate(depth, kernel)
    jump = (far - near > 0.05 + 0.03 * near).astype(np.uint8)
    wide = cv2.dilate(jump, np.ones((1, 5), dtype=np.uint8)) > 0
    return np.asarray((jump > 0) | (wide & (normal > 0.2)), dtype=np.bool_)
