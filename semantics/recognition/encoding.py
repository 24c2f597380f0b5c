"""What a classifier sees of described images, and how that is learned."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.descriptors.dense import DenseDescriptors, DenseSettings, describe_small
from roomgraph.semantics.descriptors.fisher import FisherEncoder
from roomgraph.semantics.descriptors.histogram import BagOfFeatures, normalise
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.recognition.description import Described
from roomgraph.semantics.recognition.presets import TrainingSettings

# The encoder is learned from so many dense descriptors of an image, of so many images at most.
_DENSE_SAMPLE, _DENSE_IMAGES = 200, 500


def vectors_of(
    images: Sequence[Described],
    bag: BagOfFeatures,
    encoder: FisherEncoder | None,
    settings: TrainingSettings,
) -> NDArray[Any]:
    """Return what the classifier sees of each image (N, D)."""
    if encoder is None:
        counts = np.array([bag.counts(image.descriptors) for image in images])
        return normalise(counts, settings.normalisation)

    def encode(image: Described) -> NDArray[np.float32]:
        return encoder.encode(_densely(image, encoder.settings))

    with ThreadPoolExecutor(settings.threads) as pool:
        return np.array(list(pool.map(encode, images)))


def _densely(image: Described, settings: DenseSettings) -> DenseDescriptors:
    if image.small is None:
        raise SemanticsError("image was not kept", where=image.example.name)
    return describe_small(image.small, settings)


def learn_encoder(
    images: Sequence[Described], settings: TrainingSettings, random: np.random.Generator
) -> FisherEncoder | None:
    """Learn how images are described as a whole, from a few descriptors of each."""
    if settings.encoding == "words":
        return None
    fisher = settings.fisher
    chosen = np.linspace(0, len(images) - 1, min(_DENSE_IMAGES, len(images))).astype(int)
    most = max(1, settings.max_descriptors // len(chosen))
    parts = []
    for image in (images[i] for i in chosen):
        found = _densely(image, fisher.dense)
        rows = random.integers(0, len(found), min(_DENSE_SAMPLE, most))
        parts.append((found.descriptors[rows], found.positions[rows]))
    sample = DenseDescriptors(
        np.vstack([descriptors for descriptors, _ in parts]),
        np.vstack([positions for _, positions in parts]),
    )
    return FisherEncoder.fit(
        sample, fisher.dense, fisher.n_words, fisher.n_components, settings.n_epochs, random,
        fisher.em_steps,
    )  # fmt: skip


def sample_of(
    descriptors: Sequence[NDArray[np.float32]], most: int, random: np.random.Generator
) -> NDArray[np.float32]:
    """Return at most `most` of the descriptors, drawn without replacement, in order."""
    ends = np.cumsum([len(part) for part in descriptors])
    if ends[-1] <= most:
        return np.vstack(descriptors)
    rows = np.sort(random.choice(int(ends[-1]), most, replace=False))
    parts = np.split(rows, np.searchsorted(rows, ends[:-1]))
    starts = ends - [len(part) for part in descriptors]
    return np.vstack(
        [part[r - start] for part, r, start in zip(descriptors, parts, starts, strict=True)]
    )
