"""What holds for every classifier, beside scikit-learn's own checks."""

import numpy as np
import pytest

from roomgraph.semantics.classifiers.registry import CLASSIFIERS


@pytest.fixture(params=list(CLASSIFIERS))
def fitted(request):
    rng = np.random.default_rng(0)
    y = rng.integers(0, 3, 300)
    X = np.eye(5)[y] + rng.normal(0, 0.3, (300, 5))
    names = np.array(["hall", "kitchen", "office"])[y]
    return CLASSIFIERS[request.param](random_state=0).fit(X, names), X, names


def test_decisions_probabilities_and_classes_agree(fitted):
    classifier, X, y = fitted
    decisions = classifier.decisions(X)
    probabilities = classifier.probabilities(decisions)
    assert decisions.shape == probabilities.shape == (300, 3)
    np.testing.assert_allclose(probabilities.sum(axis=1), 1)
    found = classifier.classes_[decisions.argmax(axis=1)]
    np.testing.assert_array_equal(classifier.predict(X), found)
    assert np.mean(found == y) > 0.9
    assert classifier.cross_validated_accuracy_ > 0.9


def test_what_lies_between_all_classes_is_less_familiar(fitted):
    classifier, X, _ = fitted
    known = classifier.familiarity(classifier.decisions(X))
    middle = np.array([[1 / 3, 1 / 3, 1 / 3, 0, 0]])
    assert classifier.familiarity(classifier.decisions(middle))[0] < 0.5 < known.mean()


def test_it_comes_back_from_its_arrays(fitted):
    classifier, X, _ = fitted
    arrays = classifier.arrays()
    again = classifier.clone().with_arrays(list(classifier.classes_), arrays)
    assert again.n_features_in_ == 5
    np.testing.assert_array_equal(again.decisions(X), classifier.decisions(X))
    for name, array in arrays.items():
        with pytest.raises(ValueError, match=name):
            classifier.clone().with_arrays(
                list(classifier.classes_), arrays | {name: array[..., None]}
            )


def test_contributions_add_up_to_the_margin_over_the_others(fitted):
    classifier, X, _ = fitted
    shares = classifier.contributions(X[0], 1)
    if shares is None:
        pytest.skip("its decision is no sum over the numbers of a vector")
    at, zero = classifier.decisions(np.stack([X[0], np.zeros(5)]))
    over = at - zero
    assert shares.sum() == pytest.approx(over[1] - (over[0] + over[2]) / 2)


def test_its_settings_are_arguments_of_its_constructor(fitted):
    classifier, _, _ = fitted
    settings = classifier.settings_class()
    for name, value in settings.model_dump().items():
        assert getattr(classifier, name) == value
