import json

import numpy as np
import pytest

from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.recognition.model_files import load_model, save_model
from tests.semantics.helpers import descriptors_of, features


def test_predicts_the_place(model):
    for word, label in enumerate(("corridor", "kitchen", "office")):
        prediction = model.predict(None, features(descriptors_of(word)))
        assert prediction.label == label
        assert model.labels.names[prediction.label_id] == label
        assert prediction.score == prediction.probabilities[prediction.label_id] > 0.5
        assert prediction.probabilities.sum() == pytest.approx(1)
        assert prediction.probabilities[0] == 0
        assert np.linalg.norm(prediction.signature) == pytest.approx(1)


@pytest.mark.parametrize("n", [0, 4])
def test_too_few_features_are_unknown(model, n):
    prediction = model.predict(None, features(descriptors_of(0, n)))
    assert (prediction.label, prediction.label_id, prediction.score) == ("unknown", 0, 0.0)
    assert prediction.probabilities[0] == 1
    assert not prediction.signature.any()


def test_other_descriptors_are_refused(model):
    with pytest.raises(SemanticsError, match="features do not fit the place model"):
        model.predict(None, features(np.ones((10, 5), np.float32)))


def test_round_trip_without_pickle(model, tmp_path):
    save_model(tmp_path / "models" / "m", model)
    again = load_model(tmp_path / "models" / "m")
    assert sorted(p.name for p in (tmp_path / "models" / "m").iterdir()) == [
        "arrays.npz",
        "model.json",
    ]
    assert [p.name for p in (tmp_path / "models").iterdir()] == ["m"]
    assert (again.labels, again.features) == (model.labels, model.features)
    for word in range(3):
        ours, theirs = (m.predict(None, features(descriptors_of(word))) for m in (model, again))
        np.testing.assert_array_equal(ours.probabilities, theirs.probabilities)
    for array in np.load(tmp_path / "models" / "m" / "arrays.npz", allow_pickle=False).values():
        assert array.dtype != object


def test_an_existing_model_is_kept_unless_told(model, tmp_path):
    save_model(tmp_path / "m", model)
    with pytest.raises(SemanticsError, match="--overwrite"):
        save_model(tmp_path / "m", model)
    save_model(tmp_path / "m", model, overwrite=True)
    load_model(tmp_path / "m")


def test_never_replaces_something_else(model, tmp_path):
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "a.png").write_bytes(b"x")
    with pytest.raises(SemanticsError, match="refusing"):
        save_model(tmp_path / "photos", model, overwrite=True)
    assert (tmp_path / "photos" / "a.png").exists()


def test_missing_model_says_how_to_train(tmp_path):
    with pytest.raises(SemanticsError, match="roomgraph train"):
        load_model(tmp_path / "none")


def test_broken_models_are_refused(model, tmp_path):
    def broken(name):
        save_model(tmp_path / name, model)
        return tmp_path / name

    (broken("a") / "arrays.npz").write_bytes(b"PK\x03\x04 cut")
    path = broken("b") / "model.json"
    path.write_text(path.read_text().replace("place-model", "cake"))
    path = broken("c") / "model.json"
    content = json.loads(path.read_text())
    content["classifier"]["classes"] = ["corridor", "kitchen"]
    path.write_text(json.dumps(content))
    path = broken("d") / "model.json"
    content = json.loads(path.read_text())
    content["descriptor"]["features"]["detector"] = "eyes"
    path.write_text(json.dumps(content))
    (broken("e") / "arrays.npz").unlink()
    path = broken("f") / "model.json"
    path.write_text(path.read_text().replace("linear_svm", "oracle"))
    path = broken("g") / "arrays.npz"
    arrays = dict(np.load(path))
    arrays["classifier.coef"][0, 0] = np.nan
    np.savez(path, **arrays)
    for name in "abcdefg":
        with pytest.raises(SemanticsError, match=name):
            load_model(tmp_path / name)


def test_pickled_arrays_are_refused(model, tmp_path):
    save_model(tmp_path / "m", model)
    arrays = dict(np.load(tmp_path / "m" / "arrays.npz"))
    arrays["classifier.coef"] = np.array([object()], dtype=object)
    np.savez(tmp_path / "m" / "arrays.npz", **arrays)
    with pytest.raises(SemanticsError, match="allow_pickle"):
        load_model(tmp_path / "m")
