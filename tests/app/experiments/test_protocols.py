import json

import cv2
import numpy as np
import pytest

from roomgraph.app.experiments.data import turned
from tests.app.command import roomgraph
from tests.semantics.recognition.test_training import image

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def photos(tmp_path_factory):
    root = tmp_path_factory.mktemp("photos")
    for part, first, count in (("train", 0, 12), ("test", 100, 6), ("other", 200, 8)):
        for kind in ("discs", "boxes", "strokes"):
            (root / part / kind).mkdir(parents=True)
            for i in range(count):
                cv2.imwrite(str(root / part / kind / f"{i:02}.png"), image(kind, first + i))
    return root


@pytest.mark.parametrize("preset", ["paper", "best"])
def test_recognition_of_photographs(photos, tmp_path, monkeypatch, preset):
    out = tmp_path / "out"
    arguments = ("eval", "--protocol", "recognition", "--data", photos, "--preset", preset)
    assert roomgraph(monkeypatch, *arguments, "-o", out, "--quiet") == 0
    content = json.loads((out / "recognition.json").read_text())
    assert content["accuracy_mean"] > 0.6
    assert content["accuracy_std"] >= 0
    assert set(content["per_class"]) == {"discs", "boxes", "strokes"}
    assert np.sum(content["confusion"]["counts"]) == 18
    assert "tested on" in (out / "recognition.md").read_text()
    assert cv2.imread(str(out / "recognition.png")) is not None
    assert roomgraph(monkeypatch, *arguments, "-o", out, "--quiet") == 1


def test_another_building_with_ones_own_folders(photos, tmp_path, monkeypatch):
    monkeypatch.setattr("roomgraph.app.experiments.protocols.PERMUTATIONS", 4)
    folders = [f for part in ("train", "test", "other") for f in ("--data", photos / part)]
    code = roomgraph(
        monkeypatch, "eval", "--protocol", "building", *folders, "-o", tmp_path, "--quiet"
    )
    assert code == 0
    content = json.loads((tmp_path / "building.json").read_text())
    assert content["accuracy_mean"] > 0.6
    assert 0 <= content["ece"] <= 1
    assert 0 <= content["unknown_auroc_mean"] <= 1
    assert [row["results"] for row in content["rows"]] == [2, 2]


def test_route_along_a_rendered_walk(rendered_walk, photos, tmp_path, monkeypatch):
    code = roomgraph(
        monkeypatch, "eval", "--protocol", "route", "--data", photos / "train",
        "--data", rendered_walk, "-o", tmp_path, "--quiet",
    )  # fmt: skip
    assert code == 0
    content = json.loads((tmp_path / "route.json").read_text())
    rows = content["rows"]
    assert rows[0]["name"] == "frames alone"
    assert rows[0]["images"] == 60
    assert 2 <= rows[3]["images"] < 20
    assert [row["name"] for row in rows[-2:]] == ["nodes, finished run", "frames, finished run"]
    assert rows[-1]["images"] == 60
    assert 2 <= rows[-2]["images"] < 20
    assert content["rooms"] >= content["rooms_told_apart"] >= 0
    # The photographs show other kinds of place than the walk.
    assert any(
        "Not in the training data of the model" in note and "elevator_area" in note
        for note in content["notes"]
    )


def test_vocabulary(photos, tmp_path, monkeypatch):
    monkeypatch.setattr("roomgraph.app.experiments.vocabulary.NUMBERS", (4, 100))
    monkeypatch.setattr("roomgraph.app.experiments.vocabulary.SEEDS", (0,))
    monkeypatch.setattr("roomgraph.app.experiments.vocabulary.IMAGE_STRIDE", 1)
    code = roomgraph(
        monkeypatch, "eval", "--protocol", "vocabulary", "--data", photos / "train",
        "-o", tmp_path, "--quiet",
    )  # fmt: skip
    assert code == 0
    rows = json.loads((tmp_path / "vocabulary.json").read_text())["rows"]
    gas = [row["accuracy_mean"] for row in rows if row["method"] == "Neural Gas"]
    assert 0 < gas[0] < gas[1] <= 1


@pytest.mark.parametrize(
    "arguments",
    [("--protocol", "alchemy"), ("--protocol", "light", "--preset", "worst"), ()],
)
def test_wrong_arguments_are_told_in_a_line(tmp_path, monkeypatch, capsys, arguments):
    assert roomgraph(monkeypatch, "eval", *arguments, "-o", tmp_path, "--quiet") == 1
    assert capsys.readouterr().err.count("\n") == 1


def test_turning_changes_no_product_of_two():
    X = np.random.default_rng(0).normal(size=(20, 90))
    np.testing.assert_allclose(turned(X) @ turned(X).T, X @ X.T, atol=1e-9)
    assert turned(X).shape == (20, 20)
    np.testing.assert_array_equal(turned(X.T), X.T)
