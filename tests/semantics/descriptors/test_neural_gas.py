import subprocess
import sys

import numpy as np
import pytest

from roomgraph.semantics.descriptors.neural_gas import NeuralGas


@pytest.fixture(scope="module")
def blobs():
    rng = np.random.default_rng(3)
    centres = rng.uniform(-100, 100, (20, 16))
    return (centres[rng.integers(0, 20, 6000)] + rng.normal(0, 40, (6000, 16))).astype(np.float32)


def test_is_no_worse_than_k_means(blobs):
    from sklearn.cluster import KMeans, MiniBatchKMeans

    gas = NeuralGas(20, random_state=0).fit(blobs)
    mini = MiniBatchKMeans(20, random_state=0, n_init=3).fit(blobs).inertia_ / len(blobs)
    full = KMeans(20, random_state=0, n_init=1).fit(blobs).inertia_ / len(blobs)
    assert gas.quantization_error_ <= 1.01 * min(mini, full)


def test_settling_takes_the_jitter_off(blobs):
    errors = [
        NeuralGas(20, settling=n, random_state=0).fit(blobs).quantization_error_ for n in (0, 1, 4)
    ]
    assert errors[0] > errors[1] >= errors[2]


def test_quantisation_error_is_the_mean_squared_distance(blobs):
    gas = NeuralGas(10, 1, random_state=0).fit(blobs)
    assert gas.quantization_error_ == pytest.approx(
        float(np.mean(gas.transform(blobs).min(axis=1) ** 2)), rel=1e-3
    )


def test_more_vectors_quantise_better(blobs):
    errors = [NeuralGas(n, random_state=0).fit(blobs).quantization_error_ for n in (2, 5, 15, 40)]
    assert errors == sorted(errors, reverse=True)


def test_same_seed_same_prototypes(blobs):
    first, second, other = (NeuralGas(8, random_state=s).fit(blobs).prototypes_ for s in (1, 1, 2))
    np.testing.assert_array_equal(first, second)
    assert not np.array_equal(first, other)


def test_a_batch_of_one_follows_the_published_update():
    from roomgraph.semantics.descriptors.neural_gas import _adapt

    w = np.array([[0.0, 0], [1, 0], [5, 0]], dtype=np.float32)
    x = np.array([[0.9, 1.0]], dtype=np.float32)
    ranks = np.array([[1], [0], [2]])
    h = np.exp(-ranks / 2.0)
    expected = w + 0.01 * h * (x - w)
    _adapt(w, x, step=0.01, reach=2.0)
    np.testing.assert_allclose(w, expected, atol=2e-4)


def test_predict_is_the_nearest_prototype(blobs):
    gas = NeuralGas(12, 1, random_state=0).fit(blobs)
    np.testing.assert_array_equal(gas.predict(blobs), gas.transform(blobs).argmin(axis=1))
    difference = blobs[:50, None] - gas.prototypes_
    np.testing.assert_allclose(
        gas.transform(blobs[:50]), np.linalg.norm(difference, axis=2), rtol=1e-3, atol=1e-2
    )


def test_prototypes_do_not_depend_on_where_the_origin_is(blobs):
    here = NeuralGas(6, 2, random_state=0).fit(blobs)
    there = NeuralGas(6, 2, random_state=0).fit(blobs + 300)
    np.testing.assert_allclose(here.prototypes_ + 300, there.prototypes_, atol=0.5)


def test_fewer_samples_than_vectors():
    gas = NeuralGas(10, random_state=0).fit(np.array([[0.0, 0], [4, 4], [9, 0]]))
    assert gas.quantization_error_ < 1


@pytest.mark.parametrize(
    "bad",
    [
        {"n_vectors": 0},
        {"n_epochs": 0},
        {"batch_size": 0},
        {"initial_step": 0},
        {"final_step": 1.5},
        {"initial_range": 0},
        {"final_range": -1},
    ],
)
def test_parameters_are_checked(blobs, bad):
    with pytest.raises(ValueError, match=next(iter(bad))):
        NeuralGas(**bad).fit(blobs)


def test_unknown_parameter():
    with pytest.raises(ValueError, match="no parameter 'k'"):
        NeuralGas().set_params(k=3)


@pytest.mark.slow
def test_prediction_does_not_import_sklearn():
    code = (
        "import sys, numpy as np; "
        "from roomgraph.semantics.descriptors.neural_gas import NeuralGas; "
        "NeuralGas.from_prototypes(np.eye(3, dtype=np.float32)).predict(np.eye(3)); "
        "import roomgraph.semantics.settings, roomgraph.semantics.recognition.model_files; "
        "import roomgraph.semantics.temporal.labeller, roomgraph.semantics.graph.files; "
        "sys.exit('sklearn' in sys.modules or 'networkx' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_partial_fit_follows_new_data_without_forgetting(blobs):
    gas = NeuralGas(6, 2, final_step=0.05, random_state=0).partial_fit(blobs)
    np.testing.assert_array_equal(
        gas.prototypes_, NeuralGas(6, 2, final_step=0.05, random_state=0).fit(blobs).prototypes_
    )
    elsewhere = blobs.mean(axis=0) + 50 + 0.1 * (blobs - blobs.mean(axis=0))
    before = gas.transform(elsewhere).min(axis=1).mean()
    known = gas.transform(blobs).min(axis=1).mean()
    for _ in range(20):
        gas.partial_fit(elsewhere)
    assert gas.transform(elsewhere).min(axis=1).mean() < 0.2 * before
    # Only the prototypes nearest to the new samples went there.
    assert np.median(gas.transform(blobs).min(axis=1)) < 3 * known


def test_partial_fit_refuses_other_features(blobs):
    gas = NeuralGas(6, 2, random_state=0).fit(blobs)
    with pytest.raises(ValueError, match="expecting"):
        gas.partial_fit(np.ones((4, blobs.shape[1] + 1)))
