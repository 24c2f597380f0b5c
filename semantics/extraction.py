"""Describing many images at once."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from datasets.errors import DatasetError
from semantics.examples import Example
from semantics.histogram import as_vectors
from slam.features import FeatureExtractor, FeatureSettings

logger = logging.getLogger(__name__)


def extract_descriptors(
    examples: Sequence[Example],
    settings: FeatureSettings,
    threads: int,
    progress: Callable[[int, int], None] | None = None,
) -> list[NDArray[np.float32] | None]:
    """Return the descriptors (N, D) of each image, or None for those that cannot be read.

    OpenCV lets go of the interpreter while it works, so threads do. Each has its own detector:
    OpenCV's are not made to be shared.
    """
    local = threading.local()

    def describe(example: Example) -> NDArray[np.float32] | None:
        if not hasattr(local, "extractor"):
            local.extractor = FeatureExtractor(settings)
        try:
            return as_vectors(local.extractor.extract_image(example.read()).descriptors)
        except DatasetError as error:
            logger.warning("left out: %s", error)
            return None

    found = []
    with ThreadPoolExecutor(threads) as pool:
        for done, descriptors in enumerate(pool.map(describe, examples), 1):
            found.append(descriptors)
            if progress is not None:
                progress(done, len(examples))
    return found
