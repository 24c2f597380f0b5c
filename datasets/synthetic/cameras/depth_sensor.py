"""What every depth sensor sees of a scene, and what it does with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import DepthCamera, Intrinsics
from roomgraph.datasets.se3 import exponential

Float32Array = NDArray[np.float32]
Grey = NDArray[np.uint8]
Mask = NDArray[np.bool_]

# The colour camera's width that the sensors' own sizes in pixels belong to.
COLOUR_WIDTH = 640


@dataclass(frozen=True, slots=True, eq=False)
class Sighted:
    """What lies before a depth sensor's own eye, exactly.

    Attributes
    ----------
    z : (H, W) float32
        Exact depth, metres; infinite where there is nothing.
    grazing : (H, W) float32
        Cosine of the angle between the ray and the surface's normal.
    blind : (H, W) bool
        Surfaces that send nothing back: mirrors, polished steel, black.
    grey : (H, W) uint8
        Brightness of the surfaces' texture as the sensor's eye sees it.
    focal_px : float
        Focal length of the eye, pixels.
    normals : (H, W, 3) float32
        Unit normals of the surfaces in the camera's frame, of either sign.
    """

    z: Float32Array
    grazing: Float32Array
    blind: Mask
    grey: Grey
    focal_px: float
    normals: Float32Array


class DepthSensor(Protocol):
    """A kind of depth camera."""

    def camera(self, colour: Intrinsics) -> DepthCamera | None:
        """Return the sensor's own camera; None if its depth lies on the colour image."""
        ...

    def measure(self, view: Sighted, noise: float, normal: Float32Array) -> Float32Array:
        """Return the depth image (H, W) in metres that the sensor gives; 0 where it has none.

        Parameters
        ----------
        view : Sighted
            What lies before the sensor's eye.
        noise : float
            Scale of the errors; at 0 only the range is limited, and the depth is exact.
        normal : (H, W, 3) float32
            Standard normal values.
        """
        ...


def in_range(depth: Float32Array, nearest_m: float, farthest_m: float) -> Float32Array:
    """Return a depth image with 0 where it is out of range, infinite or no number."""
    inside = (depth >= nearest_m) & (depth <= farthest_m)
    return np.where(inside, depth, np.float32(0))


def own_camera(
    colour: Intrinsics,
    depth: Intrinsics,
    shift_m: tuple[float, float, float],
    turn_deg: tuple[float, float, float],
) -> DepthCamera:
    """Return a camera beside the colour camera, scaled with the width of the colour images.

    Parameters
    ----------
    colour : Intrinsics
        The colour camera.
    depth : Intrinsics
        The depth camera that goes with colour images `COLOUR_WIDTH` wide.
    shift_m, turn_deg : three floats
        Where the depth camera stands in the colour camera's frame, and its rotation vector.
    """
    scale = colour.width / COLOUR_WIDTH
    size = (max(round(side * scale), 1) for side in (depth.width, depth.height))
    step = np.concatenate([np.deg2rad(turn_deg), np.zeros(3)])
    T_colour_depth = exponential(step)
    T_colour_depth[:3, 3] = shift_m
    return DepthCamera(depth.resized(*size), T_colour_depth)


def patches(normal: Float32Array, sigma_px: float) -> Float32Array:
    """Return standard normal values (H, W) that are alike over patches of a size.

    `sigma_px` is the Gaussian's that smooths `normal` (H, W); its loss of variance is made good.
    """
    size = 2 * int(np.ceil(2.5 * sigma_px)) + 1
    smooth = cv2.GaussianBlur(np.ascontiguousarray(normal), (size, size), sigma_px)
    kept = float(np.sum(cv2.getGaussianKernel(size, sigma_px) ** 2))
    return np.asarray(smooth / np.float32(kept), dtype=np.float32)


def blobs(normal: Float32Array, size_px: int) -> Float32Array:
    """Return roughly standard normal values (H, W) that change over some times `size_px`."""
    rows, columns = normal.shape
    coarse = patches(normal[::size_px, ::size_px], 1.5)
    return np.asarray(cv2.resize(coarse, (columns, rows)), dtype=np.float32)
