"""The command as a user meets it: what it writes, and what it says when something is wrong."""

import json
import shutil
import subprocess
import sys
from dataclasses import replace

import cv2
import numpy as np
import pytest

from roomgraph import open_run
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.trajectory import read_tum
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.semantics.recognition.model_files import load_model, save_model
from roomgraph.semantics.rooms.lookup import places_at
from tests.app.command import roomgraph
from tests.check_run import problems

pytestmark = pytest.mark.slow


def test_a_run_is_whole_and_accurate(mapped):
    _, run = mapped
    assert problems(run, None, max_ate=0.03) == []
    metrics = RunFolder(run).read_metrics()
    assert metrics["frames_tracked"] == metrics["frames"]
    assert metrics["place_accuracy_per_frame"] > 0.9
    assert not list(run.glob(".*"))


def test_frames_bear_the_label_of_the_room_that_they_were_taken_in(mapped):
    folder = RunFolder(mapped[1])
    graph, trajectory = read_graph_json(folder.graph_json), folder.read_trajectory()
    labels = {row["timestamp"]: row["label"] for row in folder.read_frames()}
    places = places_at(graph, trajectory.positions)
    inside = [
        (t, place) for t, place in zip(trajectory.stamps_s, places, strict=True) if place >= 0
    ]
    assert len(inside) > 0.9 * len(labels)
    for stamp, place in inside:
        assert labels[f"{stamp:.6f}"] == graph.rooms[place].label


def test_the_same_run_twice_gives_the_same_files(mapped, rendered_walk, tmp_path, monkeypatch):
    model, run = mapped
    again = tmp_path / "again"
    arguments = ("run", rendered_walk, "-o", again, "--model", model, "--quiet", "--no-rrd")
    assert roomgraph(monkeypatch, *arguments) == 0
    for name in ("trajectory.tum", "frames.csv", "graph.json", "map.ply", "pose_graph.g2o"):
        assert (again / name).read_bytes() == (run / name).read_bytes(), name
    assert not (again / "recording.rrd").exists()


def test_eval_repeats_the_runs_own_figures(mapped, tmp_path, monkeypatch, capsys):
    _, run = mapped
    assert roomgraph(monkeypatch, "eval", run, "-o", tmp_path / "errors.png") == 0
    ate = RunFolder(run).read_metrics()["ate_rmse_m"]
    assert f"{ate * 100:.2f} cm" in capsys.readouterr().out
    assert (tmp_path / "errors.png").stat().st_size > 10_000


def test_label_says_how_right_it_is(mapped, rendered_walk, tmp_path, monkeypatch, capsys):
    model, _ = mapped
    table = tmp_path / "labels.csv"
    assert roomgraph(monkeypatch, "label", model, rendered_walk, "-o", table) == 0
    rows = table.read_text().splitlines()
    assert rows[0] == "item,label,score,truth"
    assert len(rows) == 61
    assert "all" in capsys.readouterr().out


def _fails(monkeypatch, capsys, *arguments):
    """Run a command that must fail in one line; return that line."""
    assert roomgraph(monkeypatch, *arguments) == 1
    said = capsys.readouterr().err
    assert said.startswith("roomgraph: ")
    assert said.count("\n") == 1
    return said


def test_a_truncated_image_ends_the_run_and_loses_nothing(
    rendered_walk, tmp_path, monkeypatch, capsys
):
    broken = tmp_path / "broken"
    shutil.copytree(rendered_walk, broken)
    image = sorted((broken / "depth").iterdir(), key=lambda path: float(path.stem))[30]
    image.write_bytes(image.read_bytes()[:-500])
    said = _fails(monkeypatch, capsys, "run", broken, "-o", tmp_path / "out", "--quiet")
    assert image.name in said
    assert "cut short" in said
    folder = RunFolder(tmp_path / "out")
    states = [row["state"] for row in folder.read_frames()]
    assert states == ["ok"] * 30 + ["skipped"] * 30
    assert len(folder.read_trajectory()) == 30
    assert len(read_graph_json(folder.graph_json).nodes) > 0
    assert folder.read_metrics()["frames_skipped"] == 30


def test_inputs_that_are_none(tmp_path, monkeypatch, capsys):
    assert "no such folder" in _fails(monkeypatch, capsys, "run", tmp_path / "nowhere")
    (tmp_path / "empty").mkdir()
    assert "an empty folder" in _fails(monkeypatch, capsys, "run", tmp_path / "empty")
    assert "an empty folder" not in _fails(monkeypatch, capsys, "view", tmp_path / "empty")
    assert "not the folder of a finished run" in _fails(
        monkeypatch, capsys, "eval", tmp_path / "empty"
    )
    model = tmp_path / "empty"
    assert str(model) in _fails(monkeypatch, capsys, "label", model, tmp_path)
    assert "no training images" in _fails(
        monkeypatch, capsys, "train", tmp_path / "empty", "-o", tmp_path / "m"
    )
    assert "--light" in _fails(
        monkeypatch, capsys, "synth", "-o", tmp_path / "s", "--light", "noon"
    )


def test_synth_writes_what_run_reads(tmp_path, monkeypatch):
    walk = tmp_path / "walk"
    size = ("--width", "160", "--height", "120")
    arguments = ("synth", "-o", walk, "--seed", "5", "--frames", "3", "--light", "night", *size)
    assert roomgraph(monkeypatch, *arguments, "--quiet") == 0
    assert len(open_sequence(walk)) == 3
    assert roomgraph(monkeypatch, *arguments, "--quiet") == 1
    assert roomgraph(monkeypatch, *arguments, "--quiet", "--overwrite") == 0


def test_missing_parts_of_a_sequence(rendered_walk, tmp_path, monkeypatch, capsys):
    broken = tmp_path / "walk"
    shutil.copytree(rendered_walk, broken)
    (broken / "camera.json").unlink()
    assert "camera unknown" in _fails(monkeypatch, capsys, "run", broken, "-o", tmp_path / "o")
    (broken / "depth.txt").unlink()
    assert "depth.txt" in _fails(monkeypatch, capsys, "run", broken, "-o", tmp_path / "o")
    assert not (tmp_path / "o").exists()


def test_outputs_are_not_overwritten_unasked(mapped, rendered_walk, tmp_path, monkeypatch, capsys):
    _, run = mapped
    said = _fails(monkeypatch, capsys, "run", rendered_walk, "-o", run)
    assert "--overwrite" in said
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/thesis.tex").write_text("dear to me")
    said = _fails(monkeypatch, capsys, "run", rendered_walk, "-o", tmp_path / "mine", "--overwrite")
    assert "refusing to overwrite what is not roomgraph output" in said
    # A model is refused before anything is learned: here there is nothing to learn from.
    (tmp_path / "empty").mkdir()
    said = _fails(monkeypatch, capsys, "train", tmp_path / "empty", "-o", tmp_path / "mine")
    assert "exists already" in said
    assert (tmp_path / "mine/thesis.tex").exists()


def test_wrong_settings_are_named(rendered_walk, tmp_path, monkeypatch, capsys):
    path = tmp_path / "settings.toml"
    path.write_text("[slam.features]\nmax_featurs = 10\n")
    said = _fails(monkeypatch, capsys, "run", rendered_walk, "--config", path)
    assert "expected slam.features.max_features; got slam.features.max_featurs" in said
    path.write_text("[slamm]\nx = 10\n")
    said = _fails(monkeypatch, capsys, "run", rendered_walk, "--config", path)
    assert "no such setting" in said and "expected slam; got slamm" in said
    path.write_text("[slam.features]\nmax_features = 3\n")
    said = _fails(monkeypatch, capsys, "run", rendered_walk, "--config", path)
    assert "greater than or equal to 50" in said
    path.write_text("[slam")
    assert "TOML" in _fails(monkeypatch, capsys, "run", rendered_walk, "--config", path)


def test_usage_errors_exit_with_two(monkeypatch):
    assert roomgraph(monkeypatch, "run") == 2
    assert roomgraph(monkeypatch, "no-such-command") == 2


def test_printed_settings_are_the_defaults(tmp_path, monkeypatch, capsys):
    from roomgraph.app.settings import AppSettings, load_settings

    assert roomgraph(monkeypatch, "config") == 0
    path = tmp_path / "settings.toml"
    path.write_text(capsys.readouterr().out)
    assert load_settings(path) == AppSettings()
    assert load_settings(path, {"slam.max_depth_m": 3.0}).slam.max_depth_m == 3.0


@pytest.mark.parametrize("command", ["demo", "run", "train", "label", "eval", "view", "export",
                                     "places", "route", "locate",
                                     "synth", "config"])  # fmt: skip
def test_help_has_examples(monkeypatch, capsys, command):
    assert roomgraph(monkeypatch, command, "--help") == 0
    assert f"roomgraph {command}" in capsys.readouterr().out.split("Examples")[1]


@pytest.mark.parametrize("keyframe", [3, 10])
def test_a_keyframe_that_fails_loses_nothing_before_it(
    rendered_walk, tmp_path, monkeypatch, keyframe
):
    """In the middle of a run the failure ends it; whatever was mapped is on disk."""
    from roomgraph.slam.backend.mapper import Mapper

    insert = Mapper.insert

    def failing(self, inserted, *arguments):
        if inserted.id == keyframe:
            raise np.linalg.LinAlgError("made to fail")
        return insert(self, inserted, *arguments)

    monkeypatch.setattr(Mapper, "insert", failing)
    out = tmp_path / "out"
    with pytest.raises(np.linalg.LinAlgError, match="made to fail"):
        roomgraph(monkeypatch, "run", rendered_walk, "-o", out, "--quiet", "--no-rrd")
    assert len(read_tum(out / "trajectory.tum")) >= keyframe
    assert json.loads((out / "metrics.json").read_text())["keyframes"] == keyframe
    assert (out / "map.ply").exists()
    assert len((out / "frames.csv").read_text().splitlines()) == 61


def test_interruption_keeps_what_was_done(rendered_walk, tmp_path, monkeypatch, capsys):
    from roomgraph.app.run.pipeline import Pipeline

    label = Pipeline._label

    def interrupted(self, tracking):
        label(self, tracking)
        if tracking.index == 20:
            raise KeyboardInterrupt

    monkeypatch.setattr(Pipeline, "_label", interrupted)
    out = tmp_path / "out"
    assert roomgraph(monkeypatch, "run", rendered_walk, "-o", out, "--no-rrd") == 130
    said = capsys.readouterr()
    assert "on disk" in said.err
    assert f"roomgraph report {out}" in said.out.replace("\n", "")
    assert len(read_tum(out / "trajectory.tum")) == 21
    assert json.loads((out / "metrics.json").read_text())["frames"] == 60


def test_another_package_named_datasets_is_not_in_the_way(tmp_path):
    """As Hugging Face's: found first on the path, imported, and left alone."""
    (tmp_path / "datasets").mkdir()
    (tmp_path / "datasets/__init__.py").write_text("name = 'another'\n")
    code = (
        "import sys; sys.path.insert(0, sys.argv.pop(1)); import datasets; "
        "from roomgraph.app.cli.main import main; from roomgraph.datasets.camera import Camera; "
        "assert datasets.name == 'another'; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path), "--version"],
        capture_output=True, text=True, check=False, cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("roomgraph ")


def test_a_folder_with_ones_own_labels_is_never_overwritten(tmp_path, monkeypatch, capsys):
    precious = tmp_path / "precious"
    precious.mkdir()
    (precious / "places.csv").write_text("timestamp,label\n")
    said = _fails(monkeypatch, capsys, "synth", "-o", precious, "--overwrite")
    assert "refusing to overwrite what is not roomgraph output" in said
    assert (precious / "places.csv").exists()


def test_names_with_brackets_are_only_names(rendered_walk, tmp_path, monkeypatch, capsys):
    odd = tmp_path / "a[/b]c"
    shutil.copytree(rendered_walk, odd)
    arguments = ("run", odd, "-o", tmp_path / "out[x]", "--frames", "5", "--no-rrd")
    assert roomgraph(monkeypatch, *arguments) == 0
    assert f"roomgraph view {tmp_path / 'out[x]'}\n" in capsys.readouterr().out


def test_nothing_to_track_is_an_error_that_leaves_a_whole_folder(
    rendered_walk, tmp_path, monkeypatch, capsys
):
    dark = tmp_path / "dark"
    shutil.copytree(rendered_walk, dark)
    for image in (dark / "depth").iterdir():
        cv2.imwrite(str(image), np.zeros((240, 320), np.uint16))
    for image in (dark / "rgb").iterdir():
        cv2.imwrite(str(image), np.zeros((240, 320, 3), np.uint8))
    arguments = ("run", dark, "-o", tmp_path / "out", "--frames", "5", "--no-rrd", "--quiet")
    assert "no frame could be tracked" in _fails(monkeypatch, capsys, *arguments)
    folder = RunFolder(tmp_path / "out")
    assert folder.labels.exists()
    assert [row["state"] for row in folder.read_frames()] == ["skipped"] * 5


def test_files_that_cannot_be_written_or_read(mapped, rendered_walk, tmp_path, monkeypatch, capsys):
    model, run = mapped
    nowhere = tmp_path / "nowhere" / "file.png"
    assert "no such folder" in _fails(monkeypatch, capsys, "eval", run, "-o", nowhere)
    assert "no such folder" in _fails(monkeypatch, capsys, "label", model, run, "-o", nowhere)
    assert str(nowhere) in _fails(monkeypatch, capsys, "eval", run, "--places", nowhere)
    (tmp_path / "file").write_text("")
    inside = tmp_path / "file" / "out"
    assert str(tmp_path / "file") in _fails(monkeypatch, capsys, "run", rendered_walk, "-o", inside)
    assert "camera file cannot be read" in _fails(
        monkeypatch, capsys, "run", rendered_walk, "--camera", tmp_path
    )


def test_training_one_level_too_high_is_noticed(tmp_path, monkeypatch, capsys):
    for split in ("train", "test"):
        for name in ("office", "kitchen"):
            folder = tmp_path / "photos" / split / name
            folder.mkdir(parents=True)
            cv2.imwrite(str(folder / "a.png"), np.zeros((8, 8), np.uint8))
    said = _fails(monkeypatch, capsys, "train", tmp_path / "photos", "-o", tmp_path / "model")
    assert "did you mean" in said


def test_watching_without_a_display_is_refused_at_once(
    rendered_walk, tmp_path, monkeypatch, capsys
):
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    arguments = ("run", rendered_walk, "-o", tmp_path / "out", "-v", "--quiet")
    assert "leave out -v" in _fails(monkeypatch, capsys, *arguments)


@pytest.mark.parametrize(
    "arguments",
    [
        ("eval", "RUN", "--descriptor", "words"),
        ("eval", "--protocol", "vocabulary", "--preset", "paper"),
        ("label", "MODEL", "RUN", "--set", "a=b", "--dataset", "tum"),
    ],
    ids=lambda arguments: arguments[0] + arguments[-1],
)
def test_an_option_without_effect_is_refused(tmp_path, monkeypatch, capsys, arguments):
    assert "option has no effect here" in _fails(monkeypatch, capsys, *arguments)


def test_the_working_folder_is_never_replaced(tmp_path, rendered_walk, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for command in (("run", rendered_walk), ("train", rendered_walk), ("synth",)):
        said = _fails(monkeypatch, capsys, *command, "-o", ".", "--overwrite")
        assert "the working folder cannot be replaced" in said


def test_a_preset_and_settings_that_say_otherwise_are_refused(tmp_path, monkeypatch, capsys):
    (tmp_path / "s.toml").write_text("[semantics.training]\nstride = 2\n")
    arguments = ("train", tmp_path, "-o", tmp_path / "m", "--config", tmp_path / "s.toml")
    said = _fails(monkeypatch, capsys, *arguments, "--preset", "paper")
    assert "leave one of them out" in said


def test_a_name_that_is_none_is_answered_by_those_that_are(tmp_path, monkeypatch, capsys):
    (tmp_path / "s.toml").write_text("[semantics.training]\ndescriptor = 'wrods'\n")
    arguments = ("train", tmp_path, "-o", tmp_path / "m", "--config", tmp_path / "s.toml")
    assert "expected one of words, fisher; got 'wrods'" in _fails(monkeypatch, capsys, *arguments)


def test_a_correction_that_cannot_be_learned_changes_nothing(mapped, tmp_path, monkeypatch, capsys):
    model, run = mapped
    shutil.copytree(run, tmp_path / "run")
    plain = tmp_path / "plain"
    save_model(plain, replace(load_model(model), exemplars=None))
    before = (tmp_path / "run" / "graph.json").read_bytes()
    place = open_run(run).graph.places[0]
    arguments = ("label", plain, tmp_path / "run", "--set", f"{place}=attic", "-o", tmp_path / "n")
    assert "keeps no exemplars" in _fails(monkeypatch, capsys, *arguments, "--quiet")
    assert (tmp_path / "run" / "graph.json").read_bytes() == before
