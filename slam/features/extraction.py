"""Local features of a frame, computed once and shared by both layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.slam.errors import SlamError

Detector = Literal["sift", "rootsift", "orb", "surf"]


class FeatureSettings(Settings):
    """What is detected, and how finely."""

    detector: Detector = Field(
        default="rootsift",
        description="sift, rootsift, orb, or surf (only in builds of OpenCV that have it)",
    )
    max_features: int = Field(
        default=1000,
        ge=50,
        le=20000,
        description="maximum number of features per frame; the strongest are kept",
    )
    contrast_threshold: float = Field(
        default=0.01,
        gt=0,
        le=0.2,
        description="SIFT's contrast threshold; higher keeps fewer features",
    )
    working_width: int = Field(
        default=320,
        ge=80,
        description="wider images are halved before detection until they are no wider than this, "
        "pixels",
    )
    min_features: int = Field(
        default=200,
        ge=0,
        description="with fewer features on the halved image, the full image is searched",
    )


@dataclass(frozen=True, slots=True)
class Features:
    """Features of one image, the strongest first.

    Attributes
    ----------
    pixels : (N, 2) float64
        Positions in the full-resolution image.
    descriptors : (N, D) float32, or uint8 for binary descriptors
        One a feature.
    sizes : (N,) float32
        Diameters, full-resolution pixels.
    """

    pixels: NDArray[np.float64]
    descriptors: NDArray[Any]
    sizes: NDArray[np.float32]

    @classmethod
    def none(cls, is_binary: bool = False) -> Features:
        """Return no features, of descriptors like SIFT's or like ORB's."""
        descriptors = np.empty((0, 32), np.uint8) if is_binary else np.empty((0, 128), np.float32)
        return cls(np.empty((0, 2)), descriptors, np.empty(0, np.float32))

    def __len__(self) -> int:
        return len(self.pixels)


class FeatureExtractor:
    """Detects and describes features on a working copy of bounded width.

    SIFT (Lowe, 2004) doubles its input before the first octave. On an image halved beforehand
    the first octave is therefore the full resolution: the finest features, which are the least
    repeatable, are left out, at a quarter of the time. Where little is to be seen they are taken.

    Raises
    ------
    SlamError
        The detector is not in this build of OpenCV.
    """

    def __init__(self, settings: FeatureSettings) -> None:
        self.settings = settings
        self._detector = _create(settings)

    @property
    def is_binary(self) -> bool:
        """Whether descriptors are compared by Hamming distance."""
        return self.settings.detector == "orb"

    def extract_image(self, colour: NDArray[np.uint8]) -> Features:
        """Return the features of a (H, W, 3) RGB or (H, W) grey image."""
        grey = cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY) if colour.ndim == 3 else colour
        scale = 1
        while grey.shape[1] / scale > self.settings.working_width:
            scale *= 2
        features = self._extract(grey, scale)
        if scale > 1 and len(features) < self.settings.min_features:
            features = self._extract(grey, 1)
        return features

    def _extract(self, grey: NDArray[np.uint8], scale: int) -> Features:
        """Return the features of an image made smaller by a whole number."""
        if scale > 1:
            size = (grey.shape[1] // scale, grey.shape[0] // scale)
            grey = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
        keypoints, descriptors = self._detector.detectAndCompute(grey, None)
        if descriptors is None:
            return Features.none(self.is_binary)
        order = np.argsort([-keypoint.response for keypoint in keypoints], kind="stable")
        pixels = np.array([keypoint.pt for keypoint in keypoints])[order]
        sizes = np.array([keypoint.size for keypoint in keypoints], dtype=np.float32)[order]
        descriptors = descriptors[order]
        # Pixel centres lie on whole numbers, in the small image and in the large one.
        pixels = (pixels + 0.5) * scale - 0.5
        if self.settings.detector == "rootsift":
            descriptors = root(descriptors)
        return Features(pixels, descriptors, sizes * scale)


def root(descriptors: NDArray[np.float32]) -> NDArray[np.float32]:
    """Turn SIFT descriptors (N, 128) into RootSIFT of SIFT's norm, 512 (Arandjelovic, 2012)."""
    total = np.maximum(descriptors.sum(axis=1, keepdims=True), 1e-6)
    return np.asarray(np.sqrt(descriptors / total) * 512.0, dtype=np.float32)


def _create(settings: FeatureSettings) -> Any:
    if settings.detector == "orb":
        return cv2.ORB_create(settings.max_features, fastThreshold=12)
    if settings.detector == "surf":
        try:
            return cv2.xfeatures2d.SURF_create(100.0, extended=True)
        except (AttributeError, cv2.error) as error:
            raise SlamError(
                "this build of OpenCV has no SURF", where="features.detector",
                expected="sift, rootsift or orb", got="surf",
                hint="SURF needs OpenCV built with OPENCV_ENABLE_NONFREE",
            ) from error  # fmt: skip
    return cv2.SIFT_create(
        nfeatures=settings.max_features,
        contrastThreshold=settings.contrast_threshold,
        enable_precise_upscale=True,
    )
