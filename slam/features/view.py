"""A frame as SLAM sees it: features with their depth."""

from __future__ import annotations

from threading import Lock

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.frame import Frame
from roomgraph.slam.features.extraction import FeatureExtractor, Features
from roomgraph.slam.geometry.range_image import EDGE_SHARE, RangeImage, thumbnail_of


class View:
    """A frame with its grey image, and its features once they are asked for.

    Features are found only once, by whichever thread first asks. Most frames are tracked without.

    Parameters
    ----------
    frame : Frame
        Depth beyond `max_depth_m` counts as no reading.
    extractor : FeatureExtractor
        Finds the features.
    max_depth_m : float
        Metres.

    Attributes
    ----------
    frame : Frame
        Where it comes from; depth beyond the range is 0.
    grey : (H, W) uint8
        Its image.
    """

    def __init__(self, frame: Frame, extractor: FeatureExtractor, max_depth_m: float) -> None:
        depth = np.where(frame.depth <= max_depth_m, frame.depth, np.float32(0))
        self.frame = Frame(frame.index, frame.stamp_s, frame.colour, depth, frame.intrinsics)
        self.grey = cv2.cvtColor(frame.colour, cv2.COLOR_RGB2GRAY)
        self._extractor = extractor
        self._described: tuple[Features, NDArray[np.float64]] | None = None
        self._thumbnail: RangeImage | None = None
        self._lock = Lock()

    @property
    def features(self) -> Features:
        """N features."""
        return self.describe()[0]

    @property
    def points_camera(self) -> NDArray[np.float64]:
        """Where the features lie (N, 3), metres; NaN where there is no trustworthy depth."""
        return self.describe()[1]

    @property
    def has_point(self) -> NDArray[np.bool_]:
        """Which features (N,) have depth."""
        return np.isfinite(self.points_camera[:, 2])

    @property
    def has_depth(self) -> bool:
        """Whether there is any reading at all."""
        return bool(self.frame.depth.any())

    @property
    def thumbnail(self) -> RangeImage:
        """Depth and colours in few cells."""
        if self._thumbnail is None:
            self._thumbnail = thumbnail_of(self.frame)
        return self._thumbnail

    def describe(self) -> tuple[Features, NDArray[np.float64]]:
        """Find the features and their points now, if that has not been done."""
        with self._lock:
            if self._described is None:
                features = self._extractor.extract_image(self.grey)
                z = depth_at(self.frame.depth, features.pixels)
                points = self.frame.intrinsics.backproject(features.pixels, z)
                points[z <= 0] = np.nan
                self._described = features, points
            return self._described


def depth_at(depth: NDArray[np.float32], pixels: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the depth (N,) at pixels (N, 2), metres; 0 in holes and on depth edges."""
    if not len(pixels):
        return np.empty(0)
    height, width = depth.shape
    x = np.clip(np.rint(pixels[:, 0]).astype(np.intp), 1, width - 2)
    y = np.clip(np.rint(pixels[:, 1]).astype(np.intp), 1, height - 2)
    offsets = np.arange(-1, 2)
    patch = depth[y[:, None, None] + offsets[:, None], x[:, None, None] + offsets].reshape(-1, 9)
    known = patch > 0
    low = np.where(known, patch, np.inf).min(axis=1)
    high = patch.max(axis=1)
    total = known.sum(axis=1)
    centre = patch.sum(axis=1) / np.maximum(total, 1)
    sound = (total >= 5) & (high - low < EDGE_SHARE * centre)
    return np.where(sound, centre, 0.0).astype(np.float64)
