"""A model learns more kinds of place beside those that it knows."""

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.recognition.exemplars import learn_more
from roomgraph.semantics.recognition.model import Exemplars
from roomgraph.semantics.recognition.model_files import load_model, save_model
from tests.semantics.helpers import descriptors_of, features, tiny_model


def with_exemplars():
    model = tiny_model()
    vectors, labels = [], []
    for k, name in enumerate(("corridor", "kitchen", "office")):
        for n in range(12, 32):
            vectors.append(model.vector(None, features(descriptors_of(k, n))))
            labels.append(name)
    groups = np.array([str(i) for i in range(60)])
    exemplars = Exemplars(np.array(vectors, dtype=np.float16), np.array(labels), groups)
    return replace(model, exemplars=exemplars)


def test_the_model_takes_in_a_new_class_and_keeps_the_old(tmp_path):
    model = with_exemplars()
    # The fourth word alone: nothing that the model was shown.
    new = [model.vector(None, features(descriptors_of(3, n))) for n in range(12, 32)]
    learned = learn_more(model, new, "attic", "visit")
    assert learned.labels.names == ("unknown", "corridor", "kitchen", "office", "attic")
    assert learned.predict(None, features(descriptors_of(3, 40))).label == "attic"
    for k, name in enumerate(("corridor", "kitchen", "office")):
        assert learned.predict(None, features(descriptors_of(k, 40))).label == name
    np.testing.assert_allclose(learned.transitions.sum(axis=1), 1)
    save_model(tmp_path / "m", learned)
    again = load_model(tmp_path / "m")
    assert again.predict(None, features(descriptors_of(3, 40))).label == "attic"
    np.testing.assert_array_equal(again.exemplars.vectors, learned.exemplars.vectors)
    more = learn_more(again, new, "attic", "another visit")
    assert more.labels == learned.labels


def test_without_exemplars_or_images_nothing_is_learned():
    with pytest.raises(SemanticsError, match="exemplars"):
        learn_more(tiny_model(), [np.ones(4)], "attic", "visit")
    with pytest.raises(SemanticsError, match="no image to learn from"):
        learn_more(with_exemplars(), [], "attic", "visit")
