"""What holds for every image descriptor."""

import pickle

import cv2
import numpy as np
import pytest

from roomgraph.datasets.plugins import classes_by_name
from roomgraph.semantics.descriptors.descriptor import ImageDescriptor, vectors_of
from roomgraph.semantics.descriptors.registry import DESCRIPTORS
from roomgraph.semantics.descriptors.words import WordsSettings
from roomgraph.semantics.recognition.settings import TrainingSettings
from roomgraph.slam.features.extraction import FeatureExtractor, FeatureSettings

FEATURES = FeatureSettings(max_features=200)
# Small enough to be learned in a moment.
SMALL = {
    "words": {"n_words": 8, "n_epochs": 1},
    "fisher": {"n_words": 4, "n_components": 8, "signature": {"n_words": 8, "n_epochs": 1}},
}


def picture(seed):
    rng = np.random.default_rng(seed)
    canvas = np.full((120, 160, 3), 90, np.uint8)
    for x, y, size, tone in rng.integers((5, 5, 4, 120), (155, 115, 14, 255), (25, 4)).tolist():
        cv2.circle(canvas, (x, y), size, (tone, 255 - tone, tone), -1)
    return canvas


@pytest.fixture(scope="module", params=list(DESCRIPTORS))
def fitted(request):
    """A descriptor that learned from a few pictures, and how to make another like it."""
    name = request.param
    settings = TrainingSettings.model_validate(
        {"descriptor": name, "descriptors": {name: SMALL.get(name, {})}}
    )
    descriptor = settings.make_descriptor(FEATURES)
    images = [descriptor.prepare(picture(i), to_fit=True) for i in range(8)]
    return descriptor.fit(images, np.random.default_rng(0)), settings


def test_a_description_has_the_lengths_told_and_is_the_same_each_time(fitted):
    descriptor, _ = fitted
    colour = picture(100)
    features = FeatureExtractor(FEATURES).extract_image(colour)
    assert descriptor.can_describe(colour, features)
    found = descriptor.describe(descriptor.prepare(colour, features))
    assert found.vector.shape == (descriptor.length,)
    assert found.signature.shape == (descriptor.signature_length,)
    assert np.linalg.norm(found.signature) == pytest.approx(1)
    again = descriptor.describe(descriptor.prepare(colour, features))
    np.testing.assert_array_equal(found.vector, again.vector)
    assert np.isfinite(found.vector).all()


def test_it_comes_back_from_its_arrays(fitted):
    descriptor, settings = fitted
    arrays = descriptor.arrays()
    assert all(array.dtype != object for array in arrays.values())
    again = settings.make_descriptor(FEATURES).with_arrays(arrays)
    prepared = descriptor.prepare(picture(101))
    np.testing.assert_array_equal(
        again.describe(prepared).vector, descriptor.describe(prepared).vector
    )


def test_arrays_of_another_shape_are_refused(fitted):
    descriptor, settings = fitted
    for name, array in descriptor.arrays().items():
        broken = descriptor.arrays() | {name: array[..., None]}
        with pytest.raises(ValueError, match="shape"):
            settings.make_descriptor(FEATURES).with_arrays(broken)


def test_many_images_are_described_as_one_by_one(fitted):
    descriptor, _ = fitted
    prepared = [descriptor.prepare(picture(i)) for i in range(110, 114)]
    together = vectors_of(descriptor, [*prepared, None], threads=2)
    assert together.pop() is None
    for item, vector in zip(prepared, together, strict=True):
        np.testing.assert_array_equal(descriptor.describe(item).vector, vector)


def test_nothing_to_see_is_told(fitted):
    descriptor, _ = fitted
    assert not descriptor.can_describe(None, None)
    assert descriptor.prepare(None) is None


def test_settings_and_local_features_are_kept(fitted):
    descriptor, settings = fitted
    assert descriptor.settings == getattr(settings.descriptors, descriptor.name)
    assert descriptor.features == (FEATURES if descriptor.uses_features else None)


def test_two_of_one_name_are_refused():
    with pytest.raises(ValueError, match="two classes are called 'words'"):
        classes_by_name(
            "roomgraph.semantics.descriptors", "words.WordsDescriptor", "words.WordsDescriptor"
        )


def test_it_can_be_copied_for_another_process(fitted):
    descriptor, _ = fitted
    prepared = descriptor.prepare(picture(102))
    again = pickle.loads(pickle.dumps(descriptor))
    np.testing.assert_array_equal(
        again.describe(prepared).vector, descriptor.describe(prepared).vector
    )


def test_change_is_measured_by_vectors_of_unit_length(fitted):
    descriptor, _ = fitted
    colour = picture(103)
    features = FeatureExtractor(FEATURES).extract_image(colour)
    view = descriptor.view(descriptor.describe(descriptor.prepare(colour, features)))
    assert np.linalg.norm(view) == pytest.approx(1)


def test_words_measure_change_by_counts_whatever_the_classifier_sees():
    descriptor = DESCRIPTORS["words"](WordsSettings(n_words=4, normalisation="hellinger"))
    descriptor.with_arrays({"prototypes": np.eye(4, dtype=np.float32)})
    found = descriptor.describe(np.eye(4, dtype=np.float32)[[0, 0, 0, 1, 2]])
    np.testing.assert_allclose(descriptor.view(found), np.array([3, 1, 1, 0]) / np.sqrt(11))
    np.testing.assert_allclose(found.vector, np.sqrt([0.6, 0.2, 0.2, 0]))


def test_a_descriptor_without_its_methods_is_refused():
    class Forgetful(ImageDescriptor):
        name = "forgetful"

    with pytest.raises(TypeError, match="length"):
        Forgetful()
