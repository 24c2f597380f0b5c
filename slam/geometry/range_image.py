"""A keyframe's depth, thinned and packed: what maps and meshes are made of."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.geometry.noise import SensorNoise

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
UNITS_PER_M = 1000
# Readings whose neighbours differ by more than this share lie on an edge, where they may belong to
# either side.
EDGE_SHARE = 0.05
# Cells across a thumbnail, about.
THUMBNAIL_CELLS = 80
# Normals are fitted to windows of this many cells a side, and to no fewer readings than this.
WINDOW, MIN_READINGS = 5, 12


@dataclass(frozen=True, slots=True)
class RangeImage:
    """A depth image of few cells with its colours, five bytes a cell.

    Attributes
    ----------
    depth_mm : (H, W) uint16
        Along the optical axis, millimetres; 0 where there is no reading.
    colour : (H, W, 3) uint8
        Red, green, blue.
    intrinsics : Intrinsics
        Of these cells: those of the camera, scaled.
    """

    depth_mm: NDArray[np.uint16]
    colour: NDArray[np.uint8]
    intrinsics: Intrinsics

    @property
    def depth(self) -> NDArray[np.float32]:
        """Depth (H, W), metres; 0 where there is no reading."""
        return self.depth_mm.astype(np.float32) / np.float32(UNITS_PER_M)

    @property
    def nbytes(self) -> int:
        """Bytes held."""
        return self.depth_mm.nbytes + self.colour.nbytes

    @property
    def points(self) -> NDArray[np.float32]:
        """The points seen (M, 3) in the camera's frame, metres, row by row."""
        seen = np.flatnonzero(self.depth_mm)
        row, column = np.divmod(seen, self.depth_mm.shape[1])
        x, y = self._rays()
        z = self.depth_mm.ravel()[seen] / np.float32(UNITS_PER_M)
        points = np.empty((len(seen), 3), np.float32)
        points[:, 0], points[:, 1], points[:, 2] = z * x[column], z * y[row, 0], z
        return points

    @property
    def colours(self) -> NDArray[np.uint8]:
        """Of the points (M, 3)."""
        return np.ascontiguousarray(self.colour[self.depth_mm > 0])

    def every(self, step: int) -> RangeImage:
        """Return an image of every `step`-th row and column."""
        if step == 1:
            return self
        first = step // 2
        depth_mm = np.ascontiguousarray(self.depth_mm[first::step, first::step])
        colour = np.ascontiguousarray(self.colour[first::step, first::step])
        return RangeImage(depth_mm, colour, _scaled(self.intrinsics, step, first, depth_mm.shape))

    @property
    def thumbnail(self) -> RangeImage:
        """The image in few cells, their colours averaged."""
        small = self.every(_stride(self.depth_mm.shape[1]))
        height, width = small.depth_mm.shape
        colour = cv2.resize(self.colour, (width, height), interpolation=cv2.INTER_AREA)
        return replace(small, colour=colour)

    def normals(self, noise: SensorNoise) -> NDArray[np.float32]:
        """Return the points' normals (M, 3), unit length, towards the camera.

        A plane's inverse depth is linear in the pixel, so each comes from a line fitted to the
        inverse depths of a small window (as in Holzer et al., 2012, the sums by box filters).
        (0, 0, 0) where the readings around are few or do not lie on one plane to within three
        standard deviations.
        """
        depth, (x, y), K = self.depth, self._rays(), self.intrinsics
        a, b, c, residual = _inverse_depth_planes(depth)
        # 1 / z = a u + b v + c is n . K^-1 (u, v, 1) for the plane n . p = 1.
        a *= np.float32(-K.fx)
        b *= np.float32(-K.fy)
        normals = np.stack([a, b, -a * x - b * y - c], axis=-1)[self.depth_mm > 0]
        length = np.sqrt(np.einsum("ij,ij->i", normals, normals))
        z = depth[self.depth_mm > 0]
        sound = (residual[self.depth_mm > 0] * z**2 < 3 * noise.depth_sigma(z)) & (length > 0)
        length[~sound] = np.inf
        normals /= length[:, None]
        return normals

    def _rays(self) -> tuple[Float32Array, Float32Array]:
        """Return x / z (W,) of the columns and y / z (H, 1) of the rows."""
        K, (height, width) = self.intrinsics, self.depth_mm.shape
        x, y = (np.arange(width) - K.cx) / K.fx, (np.arange(height) - K.cy) / K.fy
        return x.astype(np.float32), y.astype(np.float32)[:, None]


def range_image_of(frame: Frame, stride: int, max_depth_m: float) -> RangeImage:
    """Thin a frame's depth to the mean of each `stride` by `stride` pixels.

    The mean is that of the inverse depths, which on a plane is the one in the middle. Readings on
    depth edges are left out, and so are cells with readings in less than half of their pixels or
    a mean beyond `max_depth_m`.
    """
    height, width = (size // stride for size in frame.depth.shape)
    depth = without_edges(frame.depth[: height * stride, : width * stride])
    known = (depth > 0).astype(np.float32)
    inverse = np.divide(1, depth, out=np.zeros_like(depth), where=depth > 0)
    share, inverse, colour = (
        cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
        for image in (known, inverse, frame.colour[: height * stride, : width * stride])
    )
    farthest = min(max_depth_m, np.iinfo(np.uint16).max / UNITS_PER_M)
    seen = (share >= 0.5) & (inverse * farthest >= share)
    mean = np.divide(share, inverse, out=np.zeros_like(share), where=seen)
    return RangeImage(
        np.rint(mean * UNITS_PER_M).astype(np.uint16), colour,
        _scaled(frame.intrinsics, stride, (stride - 1) / 2, mean.shape),
    )  # fmt: skip


def thumbnail_of(frame: Frame) -> RangeImage:
    """Return a frame in few cells, depth and colours averaged."""
    return range_image_of(frame, _stride(frame.depth.shape[1]), np.inf)


def without_edges(depth: NDArray[np.float32]) -> NDArray[np.float32]:
    """Clear the readings (H, W) beside depth edges, where cameras report points in mid-air."""
    kernel = np.ones((3, 3), np.uint8)
    far = cv2.dilate(depth, kernel)
    near = cv2.erode(np.where(depth > 0, depth, np.float32(np.inf)), kernel)
    return np.where(far - near < EDGE_SHARE * depth, depth, np.float32(0))


def _stride(width: int) -> int:
    return max(1, round(width / THUMBNAIL_CELLS))


def _scaled(camera: Intrinsics, step: int, first: float, shape: tuple[int, ...]) -> Intrinsics:
    """Return the camera of (H, W) pixels that lie at every `step`-th of another's, from `first`."""
    return Intrinsics(
        shape[1], shape[0], camera.fx / step, camera.fy / step,
        (camera.cx - first) / step, (camera.cy - first) / step,
    )  # fmt: skip


def _inverse_depth_planes(
    depth: Float32Array,
) -> tuple[Float32Array, Float32Array, Float32Array, Float32Array]:
    """Fit ``1 / z = a du + b dv + c`` around each cell (H, W), by least squares.

    Returns
    -------
    a, b, c, residual : (H, W) float32
        1 / metres; the residual is a standard deviation, infinite where no plane can be fitted.
    """
    known = (depth > 0).astype(np.float32)
    d = np.divide(1.0, depth, out=np.zeros_like(depth), where=depth > 0)
    one: FloatArray = np.ones(WINDOW)
    ramp: FloatArray = np.arange(WINDOW, dtype=np.float64) - WINDOW // 2

    def summed(image: Float32Array, across: FloatArray, down: FloatArray) -> Any:
        return cv2.sepFilter2D(image, cv2.CV_32F, across, down, borderType=cv2.BORDER_CONSTANT)

    n = np.maximum(summed(known, one, one), np.float32(1))
    mu, mv, md = (
        total / n
        for total in (summed(known, ramp, one), summed(known, one, ramp), summed(d, one, one))
    )
    uu = summed(known, ramp * ramp, one) - n * mu * mu
    vv = summed(known, one, ramp * ramp) - n * mv * mv
    uv = summed(known, ramp, ramp) - n * mu * mv
    ud = summed(d, ramp, one) - n * mu * md
    vd = summed(d, one, ramp) - n * mv * md
    dd = summed(d * d, one, one) - n * md * md
    determinant = uu * vv - uv * uv
    fits = (n >= MIN_READINGS) & (determinant > 1e-6)
    determinant[~fits] = 1.0
    a, b = (ud * vv - vd * uv) / determinant, (vd * uu - ud * uv) / determinant
    left = np.maximum(dd - a * ud - b * vd, 0.0) / np.maximum(n - 3, np.float32(1))
    return a, b, md - a * mu - b * mv, np.where(fits, np.sqrt(left), np.float32(np.inf))
