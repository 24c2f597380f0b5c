import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roomgraph.semantics.classifiers.folds import assign_folds
from roomgraph.semantics.classifiers.linear_svm import LinearSvm
from roomgraph.semantics.classifiers.platt import fit_sigmoid, sigmoid


@pytest.fixture(scope="module")
def overlapping():
    rng = np.random.default_rng(0)
    y = rng.integers(0, 3, 900)
    X = np.eye(3)[y] + rng.normal(0, 0.6, (900, 3))
    return X, np.array(["hall", "office", "kitchen"])[y]


def test_agrees_with_sklearn_one_against_all(overlapping):
    from sklearn.multiclass import OneVsRestClassifier
    from sklearn.svm import LinearSVC

    X, y = overlapping
    ours = LinearSvm(C=10, random_state=0).fit(X, y)
    theirs = OneVsRestClassifier(LinearSVC(C=10, dual=False)).fit(X, y)
    np.testing.assert_allclose(ours.decision_function(X), theirs.decision_function(X), atol=1e-3)
    np.testing.assert_array_equal(ours.classes_, theirs.classes_)


def test_probabilities_are_calibrated(overlapping):
    X, y = overlapping
    classifier = LinearSvm(random_state=0).fit(X[:600], y[:600])
    probability = classifier.predict_proba(X[600:])
    np.testing.assert_allclose(probability.sum(axis=1), 1)
    right = classifier.predict(X[600:]) == y[600:]
    assert probability.max(axis=1).mean() == pytest.approx(right.mean(), abs=0.1)
    assert classifier.cross_validated_accuracy_ == pytest.approx(right.mean(), abs=0.05)


def test_two_classes():
    X = np.array([[0.0], [0.1], [0.2], [0.8], [0.9], [1.0]] * 3)
    y = np.array(["a", "a", "a", "b", "b", "b"] * 3)
    classifier = LinearSvm(random_state=0).fit(X, y)
    assert classifier.decision_function(X).shape == (18,)
    assert classifier.score(X, y) == 1


def test_a_class_of_one_sample_has_no_cross_validation():
    classifier = LinearSvm().fit([[0.0], [1.0], [1.1]], ["a", "b", "b"])
    assert np.isnan(classifier.cross_validated_accuracy_)
    assert list(classifier.predict([[-1.0], [2.0]])) == ["a", "b"]


def test_stored_arrays_predict_the_same(overlapping):
    X, y = overlapping
    fitted = LinearSvm(random_state=0).fit(X, y)
    stored = LinearSvm().with_arrays(list(fitted.classes_), fitted.arrays())
    np.testing.assert_array_equal(stored.predict_proba(X), fitted.predict_proba(X))


@pytest.mark.parametrize(
    ("X", "y", "message"),
    [
        ([[0.0], [1.0]], ["a", "a"], "one class"),
        ([[0.0], [1.0]], ["a"], "1d array of 2 classes"),
        ([[0.0], [np.nan]], ["a", "b"], "NaN"),
        ([0.0, 1.0], ["a", "b"], "2D array"),
        ([[0.0], [1.0]], [0.5, 1.5], "continuous"),
    ],
)
def test_wrong_input(X, y, message):
    with pytest.raises(ValueError, match=message):
        LinearSvm().fit(X, y)


def test_platt_recovers_a_known_sigmoid():
    rng = np.random.default_rng(1)
    decisions = rng.normal(0, 2, 20000)
    positive = rng.random(20000) < sigmoid(1.7 * decisions - 0.6)
    assert fit_sigmoid(decisions, positive) == pytest.approx((1.7, -0.6), abs=0.08)


def test_platt_does_not_turn_margins_round():
    slope, _ = fit_sigmoid(np.array([-1.0, -2, 1, 2]), np.array([True, True, False, False]))
    assert slope == 0


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 6)), min_size=1, max_size=60))
def test_a_group_stays_in_one_fold(pairs):
    labels = [label for label, _ in pairs]
    groups = [f"{label}/{group}" for label, group in pairs]
    folds = assign_folds(labels, groups, 3, np.random.default_rng(0))
    assert set(folds) <= {0, 1, 2}
    for label in set(labels):
        own = {g for g, other in zip(groups, labels, strict=True) if other == label}
        for group in own if len(own) > 1 else ():
            members = [f for f, g in zip(folds, groups, strict=True) if g == group]
            assert len(set(members)) == 1


def test_a_single_group_is_split_into_blocks():
    folds = assign_folds(["a"] * 9, ["visit"] * 9, 3, np.random.default_rng(0))
    assert list(folds) == [0, 0, 0, 1, 1, 1, 2, 2, 2]


def test_samples_without_groups_are_dealt_evenly():
    folds = assign_folds(["a"] * 10 + ["b"] * 5, None, 5, np.random.default_rng(0))
    assert list(np.bincount(folds[:10])) == [2] * 5
    assert list(np.bincount(folds[10:])) == [1] * 5
