"""Keyframes."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.geometry.planes import Plane
from roomgraph.slam.geometry.range_image import RangeImage

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Keyframe:
    """A view that serves as a reference; every pose in the world is relative to one.

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
    words : (W,) int
        What it looks like: the words of its strongest features.
    planes : tuple of Plane
        The large surfaces seen.
    image : RangeImage
        The thinned depth image with its colours.
    intrinsics : Intrinsics
        The camera.
    """

    id: int
    frame_index: int
    stamp_s: float
    features: Features
    points: FloatArray
    words: NDArray[np.intp]
    planes: tuple[Plane, ...]
    image: RangeImage
    intrinsics: Intrinsics

    @property
    def cloud(self) -> NDArray[np.float32]:
        """The points (M, 3) of the thinned depth image, in the keyframe's camera, metres."""
        return self.image.points

    @property
    def thumbnail(self) -> RangeImage:
        """The depth image and its colours in few cells."""
        return self.image.thumbnail

    @property
    def nbytes(self) -> int:
        """Bytes held: the image, the features with their points, the planes."""
        features = (getattr(self.features, field.name) for field in fields(self.features))
        arrays = [self.points, self.words, *features, *(plane.points for plane in self.planes)]
        return self.image.nbytes + sum(a.nbytes for a in arrays if isinstance(a, np.ndarray))
