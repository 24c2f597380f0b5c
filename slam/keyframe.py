"""A view that is kept, and what hangs on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from datasets.camera import Intrinsics
from slam.features import Features
from slam.planes import Plane
from slam.view import View, without_edges

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Keyframe:
    """A view that others are measured against; everything in the world hangs on one.

    Attributes
    ----------
    id : int
        Counts up from 0.
    frame_index, stamp_s : int, float
        The frame that it was made of.
    features : Features
        The frame's N features.
    points : (N, 3) float64
        Where they lie in the keyframe's camera, metres; NaN without depth.
    planes : tuple of Plane
        The large surfaces seen.
    cloud : (M, 3) float32
        A thinned depth image, in the keyframe's camera, metres.
    colours : (M, 3) uint8
        Of the cloud.
    intrinsics : Intrinsics
        The camera.
    """

    id: int
    frame_index: int
    stamp_s: float
    features: Features
    points: FloatArray
    planes: tuple[Plane, ...]
    cloud: NDArray[np.float32]
    colours: NDArray[np.uint8]
    intrinsics: Intrinsics


def cloud_of(
    view: View, stride: int, max_depth_m: float
) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """Return every `stride`-th pixel's point (M, 3), float32 metres, and colour (M, 3) uint8.

    Readings on depth edges and beyond `max_depth_m` are left out.
    """
    frame = view.frame
    depth = without_edges(frame.depth)[stride // 2 :: stride, stride // 2 :: stride]
    rows, columns = np.nonzero((depth > 0) & (depth <= max_depth_m))
    pixels = np.column_stack([columns, rows]) * float(stride) + stride // 2
    points = frame.intrinsics.backproject(pixels, depth[rows, columns])
    colours = frame.colour[stride // 2 :: stride, stride // 2 :: stride][rows, columns]
    return points.astype(np.float32), np.ascontiguousarray(colours)
