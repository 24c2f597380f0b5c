import numpy as np
import pytest

from roomgraph.semantics.classifiers.platt import fit_softmax, softmax
from roomgraph.semantics.evaluation.calibration import (
    auroc,
    brier_score,
    expected_calibration_error,
    rejection_curve,
    reliability,
)


def test_fair_probabilities_have_no_error():
    rng = np.random.default_rng(0)
    confidence = rng.uniform(0.2, 1, 50000)
    right = rng.random(50000) < confidence
    assert expected_calibration_error(confidence, right) < 0.01
    assert expected_calibration_error(confidence, right & (rng.random(50000) < 0.8)) > 0.1
    table = reliability(confidence, right)
    assert table[:, 2].sum() == 50000
    np.testing.assert_allclose(table[2:, 0], table[2:, 1], atol=0.03)


def test_by_hand():
    confidence, right = np.array([0.95, 0.95, 0.55, 0.55]), np.array([True, True, True, False])
    assert expected_calibration_error(confidence, right) == pytest.approx(0.05)
    assert brier_score(np.array([[0.8, 0.2], [0.4, 0.6]]), np.array([0, 0])) == pytest.approx(
        (0.08 + 0.72) / 2
    )
    np.testing.assert_allclose(
        rejection_curve(confidence, right), [[0.25, 1], [0.5, 1], [0.75, 1], [1, 0.75]]
    )


def test_auroc_agrees_with_sklearn():
    from sklearn.metrics import roc_auc_score

    rng = np.random.default_rng(1)
    known, novel = rng.normal(1, 1, 300).round(1), rng.normal(0, 1, 200).round(1)
    truth = np.repeat([1, 0], [300, 200])
    expected = roc_auc_score(truth, np.concatenate([known, novel]))
    assert auroc(known, novel) == pytest.approx(expected)


def test_softmax_recovers_known_scaling():
    rng = np.random.default_rng(2)
    decisions = rng.normal(0, 1.5, (20000, 3))
    chance = softmax(1.8 * decisions + np.array([0.5, 0.0, -0.5]))
    index = (rng.random((20000, 1)) > chance.cumsum(axis=1)).sum(axis=1)
    found = fit_softmax(decisions, index)
    assert found[0] == pytest.approx(1.8, abs=0.08)
    np.testing.assert_allclose(found[1:] - found[1:].mean(), [0.5, 0, -0.5], atol=0.08)


def test_softmax_does_not_turn_margins_round():
    assert fit_softmax(np.array([[1.0, 0], [0, 1.0]] * 20), np.array([1, 0] * 20))[0] == 0
