"""Models and a run's folder that version 0.1.0 wrote still open, and say what they said."""

import json
import shutil
from pathlib import Path

import networkx
import numpy as np
import pytest

from roomgraph import open_run
from roomgraph.app.errors import AppError
from roomgraph.app.learning.correction import corrections_of, write_corrected
from roomgraph.app.settings import load_settings
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.readers.images import read_colour
from roomgraph.semantics.recognition.exemplars import learn_more
from roomgraph.semantics.recognition.model_files import load_model, save_model
from roomgraph.slam.features.extraction import FeatureExtractor
from tests.app.command import roomgraph

pytestmark = pytest.mark.slow

FOLDER = Path(__file__).parent.parent / "fixtures" / "version_0_1"
PREDICTIONS = json.loads((FOLDER / "predictions.json").read_text())


@pytest.fixture
def old_run(tmp_path) -> RunFolder:
    """A copy that may be changed."""
    shutil.copytree(FOLDER / "run", tmp_path / "run")
    return RunFolder(tmp_path / "run")


@pytest.mark.parametrize("name", ["fisher", "words"])
def test_models_say_what_they_said(name):
    model = load_model(FOLDER / f"model_{name}")
    extractor = FeatureExtractor(model.features)
    for image, expected in PREDICTIONS[name].items():
        colour = read_colour(FOLDER / "images" / image)
        found = model.predict(colour, extractor.extract_image(colour))
        assert found.label == expected["label"]
        np.testing.assert_allclose(found.probabilities, expected["probabilities"], atol=2e-6)
        assert found.familiarity == pytest.approx(expected["familiarity"], abs=2e-6)
        words = {word: share for word, share in expected["words"]}
        assert dict(found.words) == pytest.approx(words, abs=2e-6)


@pytest.mark.parametrize("name", ["fisher", "words"])
def test_models_learn_on_and_are_written_as_of_today(name, tmp_path):
    model = load_model(FOLDER / f"model_{name}")
    colour = read_colour(FOLDER / "images" / "05.jpg")
    more = learn_more(model, [model.vector(colour)] * 3, "attic", "visit")
    save_model(tmp_path / "m", more)
    assert json.loads((tmp_path / "m" / "model.json").read_text())["version"] == 3
    again = load_model(tmp_path / "m")
    assert again.labels.names == (*model.labels.names, "attic")
    np.testing.assert_array_equal(
        again.predict(colour).probabilities, more.predict(colour).probabilities
    )


def test_a_run_opens_from_python():
    run = open_run(FOLDER / "run")
    assert run.graph.places == ("corridor1", "office1")
    assert len(run.trajectory) == run.metrics["frames_tracked"] == 60
    assert len(run.points) == run.metrics["map_points"]
    assert run.metrics["place_accuracy_per_frame_online"] == 0.9667
    assert run.route("corridor1", "office1").legs[-1].place == "office1"
    found = run.locate(read_colour(FOLDER / "images" / "05.jpg"))
    near = run.trajectory.positions[4]
    assert np.linalg.norm(found.T_world_camera[:3, 3] - near) < 0.3


@pytest.mark.parametrize(
    "arguments",
    [("places",), ("route", "corridor1", "office1"), ("report",)],
    ids=lambda arguments: arguments[0],
)
def test_commands_take_an_old_run(old_run, monkeypatch, arguments):
    command, *rest = arguments
    assert roomgraph(monkeypatch, command, old_run.root, *rest) == 0


@pytest.mark.parametrize("kind", ["nav2", "kitti", "dot", "e57", "glb", "hydra"])
def test_an_old_run_is_exported(old_run, tmp_path, monkeypatch, kind):
    suffix = {"nav2": ".yaml", "kitti": ".txt", "hydra": ".json"}.get(kind, f".{kind}")
    out = tmp_path / f"product{suffix}"
    assert roomgraph(monkeypatch, "export", old_run.root, kind, "-o", out) == 0
    assert out.stat().st_size


def test_settings_of_an_old_run_are_found_by_their_old_names(old_run):
    settings = load_settings(old_run.config, only=["slam.word_index", "semantics.labeller"])
    assert settings.slam.word_index.max_words == 512
    assert settings.semantics.labeller.change_m == 3.0


def test_an_old_settings_file_is_answered_by_the_new_name(old_run):
    with pytest.raises(AppError, match=r"slam\.loops\.verification \(its new name\)"):
        load_settings(old_run.config)


def test_an_old_run_is_corrected_by_the_settings_of_the_run(old_run):
    """Its `change_m` is 3, not the default: what follows from a correction depends on it."""
    (correction,) = corrections_of(old_run, {"office1": "library"})
    write_corrected(old_run, correction.graph)
    assert correction.place == "library1"
    graph = json.loads(old_run.graph_json.read_text())
    assert networkx.node_link_graph(graph).number_of_nodes() == 5
