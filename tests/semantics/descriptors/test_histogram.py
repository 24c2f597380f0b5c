import numpy as np
import pytest

from roomgraph.semantics.descriptors.histogram import BagOfFeatures, as_vectors, normalise
from roomgraph.semantics.descriptors.neural_gas import NeuralGas


@pytest.fixture
def bag():
    return BagOfFeatures(NeuralGas.from_prototypes(np.eye(3, dtype=np.float32)))


def test_counts_go_to_the_nearest_word(bag):
    descriptors = np.array([[0.9, 0, 0.1], [1, 0, 0], [0, 0.2, 0.8]], dtype=np.float32)
    np.testing.assert_array_equal(bag.counts(descriptors), [2, 0, 1])


def test_no_descriptors_no_counts(bag):
    np.testing.assert_array_equal(bag.counts(np.empty((0, 3), np.float32)), [0, 0, 0])


def test_normalisations():
    counts = np.array([[3.0, 4, 0], [0, 0, 0]])
    np.testing.assert_allclose(normalise(counts, "l1"), [[3 / 7, 4 / 7, 0], [0, 0, 0]])
    np.testing.assert_allclose(normalise(counts, "l2"), [[0.6, 0.8, 0], [0, 0, 0]])
    np.testing.assert_allclose(normalise(counts, "hellinger") ** 2, normalise(counts, "l1"))


def test_binary_descriptors_keep_hamming_distance():
    rng = np.random.default_rng(0)
    a, b = rng.integers(0, 256, (2, 5, 32), dtype=np.uint8)
    hamming = np.unpackbits(a ^ b, axis=1).sum(axis=1)
    squared = ((as_vectors(a) - as_vectors(b)) ** 2).sum(axis=1)
    np.testing.assert_array_equal(squared, hamming)
