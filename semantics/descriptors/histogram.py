"""Bag of features: an image as a histogram of visual words."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.descriptors.neural_gas import NeuralGas

Normalisation = Literal["l1", "l2", "hellinger"]


class BagOfFeatures:
    """Turns an image's descriptors into its appearance-based histogram (paper, section 3.2.2).

    Parameters
    ----------
    vocabulary : NeuralGas
        Fitted quantiser; its prototypes are the Q visual words.
    """

    def __init__(self, vocabulary: NeuralGas) -> None:
        self.vocabulary = vocabulary

    @property
    def n_words(self) -> int:
        """Number Q of visual words."""
        return len(self.vocabulary.prototypes_)

    def counts(self, descriptors: NDArray[Any]) -> NDArray[np.float64]:
        """Return how many of the descriptors (N, D) lie nearest, by L2, to each word (Q,)."""
        if not len(descriptors):
            return np.zeros(self.n_words)
        words = self.vocabulary.predict(as_vectors(descriptors))
        return np.bincount(words, minlength=self.n_words).astype(np.float64)


def as_vectors(descriptors: NDArray[Any]) -> NDArray[np.float32]:
    """Return descriptors (N, D) as float32 vectors; binary ones (uint8) as their N x 8D bits.

    Between vectors of bits the squared L2 distance is the Hamming distance.
    """
    if descriptors.dtype == np.uint8:
        descriptors = np.unpackbits(descriptors, axis=1)
    return np.asarray(descriptors, dtype=np.float32)


def normalise(counts: NDArray[np.float64], how: Normalisation) -> NDArray[np.float64]:
    """Normalise histograms (..., Q) of counts; an empty one stays zero.

    ``l1``: sums to 1, the share of each word. ``l2``: unit length, so that two images lie between
    0 (same words) and sqrt(2) (no common word) of each other, whatever their number of features;
    the scale on which the paper's threshold 0.8 separates. ``hellinger``: root of ``l1``.
    """
    if how == "l2":
        length = np.linalg.norm(counts, axis=-1, keepdims=True)
    else:
        length = counts.sum(axis=-1, keepdims=True)
    shares = counts / np.where(length > 0, length, 1)
    return np.asarray(np.sqrt(shares) if how == "hellinger" else shares)
