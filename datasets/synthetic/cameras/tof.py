"""A time-of-flight camera, like an Azure Kinect's narrow view or a phone's."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from roomgraph.datasets.camera import DepthCamera, Intrinsics
from roomgraph.datasets.synthetic.cameras.depth_sensor import (
    Float32Array,
    Mask,
    Sighted,
    blobs,
    in_range,
    own_camera,
)

# For colour images 640 px wide.
EYE = Intrinsics(320, 288, 252.0, 252.0, 160.6, 142.9)
SHIFT_M = -0.008, 0.002, 0.001
TURN_DEG = -0.22, 0.14, 0.11


@dataclass(frozen=True, slots=True)
class TimeOfFlight:
    """Depth from the phase of modulated light.

    Attributes
    ----------
    nearest_m, farthest_m : float
        The range.
    sigma_m, growth_per_m : float
        Standard deviation at no distance, and what the distance squared adds on medium grey.
    wiggle_m, wiggle_period_m : float
        Height and period of the error that repeats with the depth.
    multipath_m : float
        Largest error in a corner: light that came by way of the other wall is late.
    faintest : float
        Weakest light that is measured; 1 is from a medium grey wall, one metre ahead.
    """

    nearest_m: float = 0.25
    farthest_m: float = 5.5
    sigma_m: float = 0.003
    growth_per_m: float = 0.0015
    wiggle_m: float = 0.002
    wiggle_period_m: float = 0.75
    multipath_m: float = 0.035
    faintest: float = 0.012

    def camera(self, colour: Intrinsics) -> DepthCamera | None:
        """Return the sensor's eye; see `DepthSensor.camera`."""
        return own_camera(colour, EYE, SHIFT_M, TURN_DEG)

    def measure(self, view: Sighted, noise: float, normal: Float32Array) -> Float32Array:
        """Return the depth image; see `DepthSensor.measure`."""
        if not noise:
            return in_range(view.z, self.nearest_m, self.farthest_m)
        z = np.where(np.isfinite(view.z), view.z, np.float32(0))
        mixed, edge = _flying(view, z, normal[..., 1])
        echo = view.grey * np.float32(1 / 128) * view.grazing
        error = self._systematic(view, z) + self._sigma(z, echo) * normal[..., 0]
        depth = np.asarray(mixed + np.float32(noise) * error, dtype=np.float32)
        patch = blobs(normal[..., 2], 2)
        faint = echo < np.float32(self.faintest) * z**2 * np.exp(np.float32(0.3) * patch)
        # One mirror in six shows something; so do half the pixels on edges.
        holes = faint | (view.blind & (patch < 1)) | (edge & (normal[..., 2] < 0)) | (z == 0)
        depth[holes] = 0
        return in_range(depth, self.nearest_m, self.farthest_m)

    def _sigma(self, z: Float32Array, echo: Float32Array) -> Float32Array:
        """Return the standard deviation of the depth, larger where little light comes back."""
        darkness = np.clip(1 / np.maximum(echo, np.float32(0.01)), 0.7, 5)
        sigma = self.sigma_m + self.growth_per_m * z**2 * darkness
        return np.asarray(sigma, dtype=np.float32)

    def _systematic(self, view: Sighted, z: Float32Array) -> Float32Array:
        """Return the errors that stay the same from image to image, metres."""
        phase = z * np.float32(2 * np.pi / self.wiggle_period_m)
        wiggle = np.float32(self.wiggle_m) * np.sin(phase)
        return np.asarray(wiggle + np.float32(self.multipath_m) * corner(view, z), dtype=np.float32)


def _flying(view: Sighted, z: Float32Array, normal: Float32Array) -> tuple[Float32Array, Mask]:
    """Mix near and far depths where both fall into one pixel; return also where.

    Two neighbours of a plane differ by its slope, which the normal tells; more is an edge. There
    is none towards nothing at all, for no light comes from there.
    """
    kernel = np.ones((3, 3), dtype=np.uint8)
    near = cv2.erode(np.where(z > 0, z, np.float32(np.inf)), kernel)
    far = cv2.dilate(z, kernel)
    across = np.abs(view.normals[..., 0]) + np.abs(view.normals[..., 1])
    slope = across / (np.maximum(view.grazing, np.float32(0.05)) * np.float32(view.focal_px))
    jump = far - near
    edge = (z > 0) & (jump > 0.02 + 0.02 * near + np.minimum(2.5 * slope, 0.3) * z)
    # A logistic curve spreads normal values over 0 to 1.
    share = 1 / (1 + np.exp(np.float32(-1.7) * normal[edge]))
    mixed = z.copy()
    mixed[edge] = near[edge] + share * jump[edge]
    return mixed, np.asarray(edge, dtype=np.bool_)


def corner(view: Sighted, z: Float32Array) -> Float32Array:
    """Return how far each pixel (H, W) lies in a corner that closes in on it, 0 to 1.

    An approximation of light that takes the way over another surface: it takes surroundings that
    stand out in front of the pixel's own plane, and that face another way. The mean point around
    a pixel lies in its plane if all the surroundings do, and in front of it in a corner that
    opens towards the camera; the mean normal is shorter along its own there. A thing before a
    parallel wall passes the first test but not the second. Nothing out of the image counts, and
    the optical axis is taken to be in its middle.
    """
    rows, columns = z.shape
    x = (np.arange(columns, dtype=np.float32) - (columns - 1) / 2) / np.float32(view.focal_px)
    y = (np.arange(rows, dtype=np.float32) - (rows - 1) / 2) / np.float32(view.focal_px)
    points = np.dstack([z * x.astype(np.float32), z * y[:, None].astype(np.float32), z])
    towards = np.einsum("hwc,hwc->hw", view.normals, points) > 0
    normals = np.where(towards[..., None], -view.normals, view.normals)
    normals[z == 0] = 0
    window = 2 * (columns // 14) + 1
    weight = np.maximum(cv2.blur((z > 0).astype(np.float32), (window, window)), np.float32(1e-3))
    stands_out = np.einsum("hwc,hwc->hw", normals, _around(points, weight, window) - points)
    alike = np.einsum("hwc,hwc->hw", normals, _around(normals, weight, window))
    closeness = 1 - np.exp(-np.maximum(stands_out, 0) / np.float32(0.015))
    facing = np.clip(2 * (1 - alike), 0, 1)
    return np.where(z > 0, closeness * facing, np.float32(0)).astype(np.float32)


def _around(values: Float32Array, weight: Float32Array, window: int) -> Float32Array:
    """Return the mean of `values` (H, W, 3) around each pixel, of those that hold something."""
    mean = cv2.blur(values, (window, window), borderType=cv2.BORDER_REFLECT)
    return np.asarray(mean / weight[..., None], dtype=np.float32)
