"""A frame's images, small enough to record."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame

# Steps of the recorded depth: a centimetre compresses to half of what a millimetre takes.
DEPTH_UNITS_PER_M = 100.0
# Twice as fast as zlib's usual strategy, and hardly larger on depth.
_PNG = (cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE)


def encode_colour(frame: Frame, quality: int) -> NDArray[np.uint8]:
    """Return the colour image as JPEG, the bytes of the file."""
    bgr = cv2.cvtColor(frame.colour, cv2.COLOR_RGB2BGR)
    # Rerun takes an array eight times as fast as Python's bytes.
    return np.asarray(cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, quality])[1])


def encode_depth(frame: Frame, step: int) -> NDArray[np.uint8]:
    """Return every `step`-th row and column of the depth as 16-bit PNG in centimetres, as bytes."""
    raw = frame.depth[::step, ::step] * DEPTH_UNITS_PER_M + 0.5
    image = np.minimum(raw, np.iinfo(np.uint16).max).astype(np.uint16)
    return np.asarray(cv2.imencode(".png", image, _PNG)[1])


def thinned(intrinsics: Intrinsics, step: int) -> Intrinsics:
    """Return the camera of an image of which every `step`-th row and column is left."""
    return Intrinsics(
        -(-intrinsics.width // step), -(-intrinsics.height // step),
        intrinsics.fx / step, intrinsics.fy / step, intrinsics.cx / step, intrinsics.cy / step,
    )  # fmt: skip


def has_depth(frame: Frame, pixels: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels (N, 2) have a depth reading (N,)."""
    columns, rows = np.rint(pixels).astype(np.intp).T
    height, width = frame.depth.shape
    inside = frame.depth[np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)]
    return np.asarray(inside > 0)
