"""Outlines in the depth and in the colour image, to be laid over each other."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.frame import Frame

# Both images are looked at about this wide, between two thirds and one and a half times:
# outlines are a few pixels broad.
WORKING_WIDTH = 320
# The background is this much further off than the outline before it. A slanted floor and ten
# standard deviations of a Kinect's noise (Nguyen et al., 2012) stay below at 5 m.
JUMP_SHARE = 0.15
# Pixels of the foreground are within this share of the nearest reading beside them.
FOREGROUND_SHARE = 0.07
# Brightness edges are judged against what is usual this many working pixels around.
NEIGHBOURHOOD = 31


@dataclass(frozen=True, slots=True)
class Outlines:
    """Where the depth jumps, and how sharp the edges of the colour image are.

    Attributes
    ----------
    pixels : (N, 2) float32
        Foreground pixels beside a jump of the depth, x and y, in working pixels.
    edges : (h, w) float32
        Strength of the brightness edges: mean 0 around each pixel, standard deviation 1.
    step : int
        Image pixels in a working pixel.
    """

    pixels: NDArray[np.float32]
    edges: NDArray[np.float32]
    step: int


def outlines(frame: Frame) -> Outlines:
    """Return the outlines of a frame's two images."""
    step = working_step(frame.depth.shape[1])
    return Outlines(depth_outline(frame.depth, step), colour_edges(frame.colour, step), step)


def working_step(width: int) -> int:
    """Return how many image pixels make a working pixel."""
    return max(1, round(width / WORKING_WIDTH))


def depth_outline(depth: NDArray[np.float32], step: int) -> NDArray[np.float32]:
    """Return the foreground pixels (N, 2) beside jumps of a depth image (H, W)."""
    z = cv2.medianBlur(_without_shadows(np.ascontiguousarray(depth[::step, ::step])), 3)
    kernel = np.ones((3, 3), np.uint8)
    near, far = cv2.erode(z, kernel), cv2.dilate(z, kernel)
    jump = (near > 0) & (far > (1 + JUMP_SHARE) * near) & (z < (1 + FOREGROUND_SHARE) * near)
    y, x = np.nonzero(jump)
    return np.column_stack([x, y]).astype(np.float32)


def colour_edges(colour: NDArray[np.uint8], step: int) -> NDArray[np.float32]:
    """Return how strong the brightness edges of an image (H, W, 3) are, for their surroundings."""
    grey = cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY)
    grey = cv2.GaussianBlur(grey, (0, 0), float(step))[::step, ::step].astype(np.float32)
    gradient = np.hypot(cv2.Sobel(grey, cv2.CV_32F, 1, 0), cv2.Sobel(grey, cv2.CV_32F, 0, 1))
    strength = np.log1p(gradient)
    strength -= cv2.blur(strength, (NEIGHBOURHOOD, NEIGHBOURHOOD))
    return np.asarray(strength / max(float(strength.std()), 1e-6), dtype=np.float32)


def _without_shadows(z: NDArray[np.float32]) -> NDArray[np.float32]:
    """Fill holes (H, W) along the rows with the farther neighbour.

    A camera with a projector beside it sees nothing in the shadow of what is near: the outline is
    where the near surface ends, the hole belongs to what is behind.
    """
    hole_rows, hole_columns = np.nonzero(z == 0)
    if not len(hole_rows):
        return z
    last = z.shape[1] - 1
    columns = np.arange(last + 1, dtype=np.int32)
    left = np.maximum.accumulate(np.where(z > 0, columns, 0), axis=1)
    right = np.minimum.accumulate(np.where(z > 0, columns, last)[:, ::-1], axis=1)[:, ::-1]
    beside = (z[hole_rows, side[hole_rows, hole_columns]] for side in (left, right))
    filled = z.copy()
    filled[hole_rows, hole_columns] = np.maximum(*beside)
    return filled
