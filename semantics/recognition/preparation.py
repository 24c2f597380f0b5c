"""Parallel preparation of images by a descriptor."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

from roomgraph.datasets.errors import DatasetError
from roomgraph.semantics.descriptors.descriptor import ImageDescriptor
from roomgraph.semantics.recognition.examples import Example

logger = logging.getLogger(__name__)

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class Prepared:
    """A prepared image, for training and evaluation.

    Attributes
    ----------
    example : Example
        Where it comes from and what it shows.
    content : object
        What the descriptor prepared of it; None where there is too little to see.
    """

    example: Example
    content: Any


def prepare_images(
    examples: Sequence[Example],
    descriptor: ImageDescriptor,
    threads: int,
    to_fit: bool = False,
    progress: Progress | None = None,
) -> list[Prepared | None]:
    """Return each image prepared, None for those that cannot be read.

    OpenCV and NumPy let go of the interpreter while they work, so threads help.

    Parameters
    ----------
    examples : sequence of Example
        The images.
    descriptor : ImageDescriptor
        What prepares them.
    threads : int
        Images read and prepared at once.
    to_fit : bool
        Whether the descriptor is to learn from them.
    progress : callable, optional
        Called with (images prepared, images).
    """

    def prepare(example: Example) -> Prepared | None:
        try:
            colour = example.read()
        except DatasetError as error:
            logger.warning("left out: %s", error)
            return None
        return Prepared(example, descriptor.prepare(colour, to_fit=to_fit))

    found = []
    with ThreadPoolExecutor(threads) as pool:
        for done, prepared in enumerate(pool.map(prepare, examples), 1):
            found.append(prepared)
            if progress is not None:
                progress(done, len(examples))
    return found
