"""Describing many images at once."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.errors import DatasetError
from roomgraph.semantics.descriptors.dense import DenseSettings, small_grey
from roomgraph.semantics.descriptors.histogram import as_vectors
from roomgraph.semantics.recognition.examples import Example
from roomgraph.slam.features.extraction import FeatureExtractor, FeatureSettings

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Described:
    """An image as training and evaluation keep it.

    Attributes
    ----------
    example : Example
        Where it comes from and what it shows.
    descriptors : (N, D) float32
        Of its features.
    small : (h, w) uint8 or None
        What dense descriptors are made from, where they are asked for: much smaller than they.
    """

    example: Example
    descriptors: NDArray[np.float32]
    small: NDArray[np.uint8] | None = None


def describe_images(
    examples: Sequence[Example],
    features: FeatureSettings | None,
    dense: DenseSettings | None,
    threads: int,
    progress: Callable[[int, int], None] | None = None,
) -> list[Described | None]:
    """Return each image described, or None for those that cannot be read.

    Without settings of features, or of dense descriptors, those are left out.

    OpenCV lets go of the interpreter while it works, so threads do. Each has its own detector:
    OpenCV's are not made to be shared.
    """
    local = threading.local()

    def describe(example: Example) -> Described | None:
        try:
            colour = example.read()
        except DatasetError as error:
            logger.warning("left out: %s", error)
            return None
        small = None if dense is None else small_grey(colour, dense)
        if features is None:
            return Described(example, np.empty((0, 0), dtype=np.float32), small)
        if not hasattr(local, "extractor"):
            local.extractor = FeatureExtractor(features)
        descriptors = as_vectors(local.extractor.extract_image(colour).descriptors)
        return Described(example, descriptors, small)

    found = []
    with ThreadPoolExecutor(threads) as pool:
        for done, described in enumerate(pool.map(describe, examples), 1):
            found.append(described)
            if progress is not None:
                progress(done, len(examples))
    return found
