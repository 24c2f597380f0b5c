"""Descriptor ``words``: an image as a histogram of visual words."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.descriptors.descriptor import Description, Image, ImageDescriptor
from roomgraph.semantics.descriptors.histogram import (
    BagOfFeatures,
    Normalisation,
    as_vectors,
    normalise,
)
from roomgraph.semantics.descriptors.neural_gas import NeuralGas
from roomgraph.semantics.errors import SemanticsError
from roomgraph.slam.features.extraction import FeatureExtractor, Features, FeatureSettings

Vectors = NDArray[np.float32]

_THREAD = threading.local()


class WordsSettings(Settings):
    """Number of visual words, and their training."""

    n_words: int = Field(
        default=100, ge=2, le=10000, description="number of visual words (paper: 100)"
    )
    n_epochs: int = Field(
        default=5, ge=1, le=1000, description="number of Neural Gas passes over the descriptors"
    )
    max_descriptors: int = Field(
        default=200_000,
        ge=100,
        description="maximum number of descriptors that the words are learned from",
    )
    normalisation: Normalisation = Field(
        default="hellinger",
        description="normalisation of the histograms: l1 (paper), l2 or hellinger",
    )
    min_features: int = Field(
        default=5, ge=1, description="images with fewer features are labelled unknown"
    )


class WordsDescriptor(ImageDescriptor):
    """Appearance-based histograms (Kostavelis & Gasteratos, 2013, section 3.2.2).

    A prepared image is its local descriptors, (N, D) float32. The words are Neural Gas
    prototypes of those.
    """

    name = "words"
    settings_class = WordsSettings
    uses_features = True

    settings: WordsSettings

    def __init__(
        self, settings: Settings | None = None, features: FeatureSettings | None = None
    ) -> None:
        super().__init__(settings, features)
        self._summary: dict[str, Any] = {}

    @property
    def length(self) -> int:
        """Number Q of visual words."""
        return self.bag_.n_words

    def can_describe(self, colour: Image | None, features: Features | None) -> bool:
        """Whether there are features, or an image to find some in."""
        return colour is not None if features is None else len(features) > 0

    def prepare(
        self, colour: Image | None, features: Features | None = None, to_fit: bool = False
    ) -> Vectors | None:
        """Return the local descriptors (N, D) float32, None if they are too few."""
        if features is None and colour is not None:
            features = _extractor(self.features or FeatureSettings()).extract_image(colour)
        if features is None or len(features) < self.settings.min_features:
            return None
        return as_vectors(features.descriptors)

    def fit(self, prepared: Sequence[Vectors], random: np.random.Generator) -> Self:
        """Learn the words from a sample of all images' descriptors."""
        sample = sample_of(prepared, self.settings.max_descriptors, random)
        gas = NeuralGas(self.settings.n_words, self.settings.n_epochs, random_state=random)
        self.bag_ = BagOfFeatures(gas.fit(sample))
        self._summary = {
            "descriptors": len(sample),
            "quantization_error": float(gas.quantization_error_),
        }
        return self

    def describe(self, prepared: Vectors) -> Description:
        """Return the histogram as the settings normalise it, and at unit length."""
        counts = self._counts(prepared)
        return Description(normalise(counts, self.settings.normalisation), normalise(counts, "l2"))

    def view(self, description: Description) -> NDArray[np.float64]:
        """Return the counts at unit length, however the classifier's histogram is normalised."""
        return description.signature

    def words(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shares as they are: each number is a word's."""
        return shares

    def summary(self) -> dict[str, Any]:
        """Return of how many descriptors the words were learned, and their mean squared error."""
        return self._summary

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the words' prototypes."""
        return {"prototypes": self.bag_.vocabulary.prototypes_}

    def with_arrays(self, arrays: Mapping[str, NDArray[Any]]) -> Self:
        """Take over the words' prototypes (Q, D)."""
        prototypes = arrays["prototypes"]
        if prototypes.ndim != 2 or not np.isfinite(prototypes).all():
            raise ValueError(f"prototypes of shape {prototypes.shape}, expected finite (Q, D)")
        self.bag_ = BagOfFeatures(NeuralGas.from_prototypes(prototypes))
        return self

    def _counts(self, descriptors: Vectors) -> NDArray[np.float64]:
        try:
            return self.bag_.counts(descriptors)
        except ValueError as error:
            raise SemanticsError(
                "local features do not fit the place model",
                expected="those of " + ("" if self.features is None else self.features.detector),
                got=str(error),
                hint="use the feature settings that the model was trained with",
            ) from error  # fmt: skip


def _extractor(settings: FeatureSettings) -> FeatureExtractor:
    """Return the extractor of this thread: OpenCV's detectors are not made to be shared."""
    extractors: dict[FeatureSettings, FeatureExtractor]
    extractors = _THREAD.__dict__.setdefault("extractors", {})
    if settings not in extractors:
        extractors[settings] = FeatureExtractor(settings)
    return extractors[settings]


def sample_of(descriptors: Sequence[Vectors], maximum: int, random: np.random.Generator) -> Vectors:
    """Return at most `maximum` of the descriptors, drawn without replacement, in order."""
    ends = np.cumsum([len(part) for part in descriptors])
    if ends[-1] <= maximum:
        return np.vstack(descriptors)
    rows = np.sort(random.choice(int(ends[-1]), maximum, replace=False))
    parts = np.split(rows, np.searchsorted(rows, ends[:-1]))
    starts = ends - [len(part) for part in descriptors]
    return np.vstack(
        [part[r - start] for part, r, start in zip(descriptors, parts, starts, strict=True)]
    )
