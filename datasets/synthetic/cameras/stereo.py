"""Two infrared eyes with a projector between them, like a RealSense D435 held in the hand."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from roomgraph.datasets.camera import DepthCamera, Intrinsics
from roomgraph.datasets.synthetic.cameras.depth_sensor import (
    Float32Array,
    Grey,
    Mask,
    Sighted,
    blobs,
    in_range,
    own_camera,
    patches,
)

# The left eye, in whose image the depth lies, for colour images 640 px wide.
EYE = Intrinsics(640, 480, 385.0, 385.0, 317.8, 241.3)
SHIFT_M = 0.015, 0.0003, -0.0004
TURN_DEG = 0.12, -0.31, 0.09


@dataclass(frozen=True, slots=True)
class ActiveStereo:
    """Depth from the disparity of two eyes.

    All sizes in pixels are the matcher's, whatever the size of the image: at half the width,
    depth is twice as uncertain, as with the real one.

    Attributes
    ----------
    baseline_m : float
        From the left eye to the right one.
    nearest_m, farthest_m : float
        The range.
    sigma_px : float
        Standard deviation of the disparity where there is enough texture.
    step_px : float
        Smallest step of the disparity.
    patch_px : float
        Size (sigma) of the patches over which the error is alike: the matching window's.
    pattern : float
        Contrast of the projector's pattern on a medium grey wall, one metre ahead, out of 255.
    weak : float
        Contrast along the row, out of 255, below which nothing is matched.
    """

    baseline_m: float = 0.05
    nearest_m: float = 0.3
    farthest_m: float = 6.0
    sigma_px: float = 0.08
    step_px: float = 1 / 32
    patch_px: float = 1.6
    pattern: float = 22.0
    weak: float = 3.0

    def camera(self, colour: Intrinsics) -> DepthCamera | None:
        """Return the left eye; see `DepthSensor.camera`."""
        return own_camera(colour, EYE, SHIFT_M, TURN_DEG)

    def measure(self, view: Sighted, noise: float, normal: Float32Array) -> Float32Array:
        """Return the depth image; see `DepthSensor.measure`."""
        if not noise:
            return in_range(view.z, self.nearest_m, self.farthest_m)
        scale = np.float32(view.focal_px * self.baseline_m)
        # No disparity where there is nothing: it is as good as infinitely far away.
        exact = np.asarray(scale / np.maximum(view.z, np.float32(0.05)), dtype=np.float32)
        matched, fat = _fattened(exact, patches(normal[..., 2], self.patch_px))
        signal = self._signal(view)
        threshold = self.weak * np.exp(np.float32(0.35) * blobs(normal[..., 1], 5))
        holes = ((view.blind | _hidden(exact)) & ~fat) | (signal < threshold)
        disparity = self._noisy(matched, signal, noise, patches(normal[..., 0], self.patch_px))
        depth = in_range(scale / disparity, self.nearest_m, self.farthest_m)
        depth[holes | _beyond_the_border(matched)] = 0
        return depth

    def _signal(self, view: Sighted) -> Float32Array:
        """Return the contrast (H, W) that can be matched: the surface's and the projector's."""
        lit = view.grey * np.float32(self.pattern / 128) * view.grazing
        pattern = lit / np.maximum(view.z, np.float32(0.3)) ** 2
        return np.asarray(np.hypot(_contrast(view.grey), pattern), dtype=np.float32)

    def _noisy(
        self, disparity: Float32Array, signal: Float32Array, noise: float, patch: Float32Array
    ) -> Float32Array:
        """Add the error, up to twice as large where the texture is hardly enough, in steps."""
        step = np.float32(self.step_px * noise)
        # Rounding to steps is noise too; what it adds is taken off.
        sigma = np.float32(noise * np.sqrt(max(self.sigma_px**2 - self.step_px**2 / 12, 0.0)))
        doubt = np.clip(np.float32(2 * self.weak) / np.maximum(signal, np.float32(0.1)), 1, 2)
        steps = np.maximum(np.rint((disparity + sigma * doubt * patch) / step), 1)
        return np.asarray(step * steps, dtype=np.float32)


def _contrast(grey: Grey) -> Float32Array:
    """Return the mean change from one pixel to the next along the row, in 7 x 7 windows.

    What only changes down the column (a shelf's edge) looks the same at every disparity.
    """
    steps = np.abs(cv2.Sobel(grey, cv2.CV_32F, 1, 0, ksize=1, scale=0.5))
    return np.asarray(cv2.blur(steps, (7, 7)), dtype=np.float32)


def _fattened(disparity: Float32Array, patch: Float32Array) -> tuple[Float32Array, Mask]:
    """Let near surfaces grow by half a matching window; return also where they have grown.

    A window that straddles an edge matches the near side. How far is ragged: 2 or 3 px.
    """
    narrow = cv2.dilate(disparity, np.ones((5, 5), dtype=np.uint8))
    wide = cv2.dilate(disparity, np.ones((7, 7), dtype=np.uint8))
    nearest = np.where(patch > 0, wide, narrow)
    # A slanted plane's disparity changes by less over half a window.
    fat = nearest > disparity + 1
    return np.where(fat, nearest, disparity), fat


def _hidden(disparity: Float32Array) -> Mask:
    """Return which pixels of the left eye the right eye cannot see, for something is before them.

    The right eye's image is made of the nearest surface at each of its pixels.
    """
    rows, columns = disparity.shape
    landing = np.rint(np.arange(columns, dtype=np.float32) - disparity).astype(np.int32)
    place = np.maximum(landing, 0) + np.arange(rows, dtype=np.int32)[:, None] * columns
    right = np.zeros(rows * columns, dtype=np.float32)
    np.maximum.at(right, place.ravel(), np.where(landing >= 0, disparity, 0).ravel())
    # A surface that the right eye sees wider leaves gaps in its image.
    closed = cv2.dilate(right.reshape(rows, columns), np.ones((1, 3), dtype=np.uint8))
    return np.asarray(closed.ravel()[place] > disparity + 1, dtype=np.bool_)


def _beyond_the_border(disparity: Float32Array) -> Mask:
    """Return which pixels (or half their window) lie left of the right eye's image."""
    columns = np.arange(disparity.shape[1], dtype=np.float32)
    return np.asarray(columns < disparity + 3, dtype=np.bool_)
