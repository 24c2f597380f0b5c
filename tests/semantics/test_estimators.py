"""scikit-learn's own checks of estimators."""

import warnings

import pytest
from sklearn.base import clone
from sklearn.pipeline import make_pipeline
from sklearn.utils.estimator_checks import check_estimator

from roomgraph.semantics.classifiers.linear_svm import LinearSvm
from roomgraph.semantics.descriptors.neural_gas import NeuralGas


@pytest.mark.slow
@pytest.mark.parametrize(
    "estimator", [NeuralGas(n_vectors=3, random_state=0), LinearSvm(random_state=0)]
)
def test_estimator_checks(estimator):
    with warnings.catch_warnings():
        # The checks warn that the classes do not inherit from BaseEstimator, which is intended.
        warnings.simplefilter("ignore")
        results = check_estimator(estimator, on_fail=None, on_skip=None)
    failed = [(r["check_name"], r["exception"]) for r in results if r["status"] == "failed"]
    assert not failed
    assert sum(r["status"] == "passed" for r in results) > 30


def test_they_clone_and_join_pipelines():
    pipeline = clone(make_pipeline(NeuralGas(4, random_state=0), LinearSvm(C=1.0)))
    X = [[i % 2, i / 20] for i in range(20)]
    y = ["ab"[i % 2] for i in range(20)]
    assert pipeline.fit(X, y).score(X, y) == 1.0
