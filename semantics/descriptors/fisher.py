"""Descriptor ``fisher``: an image as a Fisher vector over dense descriptors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.descriptors.dense import (
    DenseDescriptors,
    DenseSettings,
    describe_small,
    small_grey,
)
from roomgraph.semantics.descriptors.descriptor import Description, Image, ImageDescriptor
from roomgraph.semantics.descriptors.fisher_encoder import FisherEncoder
from roomgraph.semantics.descriptors.words import Vectors, WordsDescriptor, WordsSettings
from roomgraph.slam.features.extraction import Features, FeatureSettings

# Dense descriptors per image, and maximum number of images, that the encoder is learned from.
_PER_IMAGE, _IMAGES = 200, 500
# Before the names of the arrays of the words.
_SIGNATURE = "signature_"


class FisherSettings(Settings):
    """How images are described as a whole."""

    n_words: int = Field(
        default=64,
        ge=2,
        le=4096,
        description="number of Gaussians, initialised from Neural Gas words",
    )
    n_components: int = Field(
        default=64, ge=2, le=128, description="number of principal components of the descriptors"
    )
    em_steps: int = Field(
        default=10, ge=0, le=1000, description="number of steps of expectation maximisation"
    )
    dense: DenseSettings = DenseSettings()
    signature: WordsSettings = WordsSettings()


@dataclass(frozen=True, slots=True)
class PreparedImage:
    """A small grey image (h, w) uint8, and the local descriptors (N, D), None where too few."""

    small: NDArray[np.uint8]
    descriptors: Vectors | None


class FisherDescriptor(ImageDescriptor):
    """Fisher vectors of dense RootSIFT (see `FisherEncoder`), compared by visual words.

    What a classifier sees is the Fisher vector of the whole image. Views of a place are compared
    by a histogram of visual words of local features, as in the paper: its threshold is made for
    those. Only an image that comes with its features has such a signature; they are not
    extracted for it.
    """

    name = "fisher"
    settings_class = FisherSettings
    uses_features = True

    settings: FisherSettings

    def __init__(
        self, settings: Settings | None = None, features: FeatureSettings | None = None
    ) -> None:
        super().__init__(settings, features)
        self._words = WordsDescriptor(self.settings.signature, self.features)

    @property
    def length(self) -> int:
        """Numbers of a Fisher vector."""
        return self.encoder_.length

    @property
    def signature_length(self) -> int:
        """Number of visual words of the signature."""
        return self._words.length

    def prepare(
        self, colour: Image | None, features: Features | None = None, to_fit: bool = False
    ) -> PreparedImage | None:
        """Return a small grey image and the local descriptors.

        To be learned from, an image must have enough of these.
        """
        if colour is None:
            return None
        known = features is not None or to_fit
        descriptors = self._words.prepare(colour, features) if known else None
        if to_fit and descriptors is None:
            return None
        return PreparedImage(small_grey(colour, self.settings.dense), descriptors)

    def fit(self, prepared: Sequence[PreparedImage], random: np.random.Generator) -> Self:
        """Learn the words of the signature, then axes and Gaussians of the dense descriptors."""
        self._words.fit([p.descriptors for p in prepared if p.descriptors is not None], random)
        settings = self.settings
        self.encoder_ = FisherEncoder.fit(
            self._dense_sample(prepared, random), settings.dense, n_words=settings.n_words,
            n_components=settings.n_components, n_epochs=settings.signature.n_epochs,
            random=random, em_steps=settings.em_steps,
        )  # fmt: skip
        return self

    def describe(self, prepared: PreparedImage) -> Description | None:
        """Return the Fisher vector and, of an image with features, its histogram of words."""
        vector = self.encoder_.encode(describe_small(prepared.small, self.settings.dense))
        if not vector.any():
            return None
        if prepared.descriptors is None:
            return Description(vector, np.zeros(self.signature_length))
        return Description(vector, self._words.describe(prepared.descriptors).signature)

    def words(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the sums over each word's numbers: of its mean and of its width, several each."""
        by_word = shares.reshape(2, self.encoder_.n_words, -1)
        return np.asarray(by_word.sum(axis=(0, 2)))

    def summary(self) -> dict[str, Any]:
        """Return what the words of the signature were learned from."""
        return self._words.summary()

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the encoder's arrays and those of the words."""
        words = {_SIGNATURE + name: array for name, array in self._words.arrays().items()}
        return {**self.encoder_.arrays, **words}

    def with_arrays(self, arrays: Mapping[str, NDArray[Any]]) -> Self:
        """Take over the encoder's arrays and those of the words."""
        own = {n.removeprefix(_SIGNATURE): a for n, a in arrays.items() if n.startswith(_SIGNATURE)}
        self._words.with_arrays(own)
        self.encoder_ = FisherEncoder(self.settings.dense, arrays)
        return self

    def _dense_sample(
        self, prepared: Sequence[PreparedImage], random: np.random.Generator
    ) -> DenseDescriptors:
        """Return a few dense descriptors of each of some images, evenly spread."""
        chosen = np.linspace(0, len(prepared) - 1, min(_IMAGES, len(prepared))).astype(int)
        maximum = max(1, self.settings.signature.max_descriptors // len(chosen))
        descriptors, positions = [], []
        for image in (prepared[i] for i in chosen):
            found = describe_small(image.small, self.settings.dense)
            rows = random.integers(0, len(found), min(_PER_IMAGE, maximum))
            descriptors.append(found.descriptors[rows])
            positions.append(found.positions[rows])
        return DenseDescriptors(np.vstack(descriptors), np.vstack(positions))
