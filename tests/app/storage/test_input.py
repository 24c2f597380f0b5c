"""How a sequence was opened is remembered with the run."""

import inspect
import shutil
from pathlib import Path

import pytest

from roomgraph.app.cli import options
from roomgraph.app.errors import AppError
from roomgraph.app.settings import AppSettings, load_settings
from roomgraph.app.storage.input import InputOptions, read_input, write_input
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.readers.registry import READERS
from tests.app.command import roomgraph


def test_options_survive_the_disk(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    chosen = InputOptions(sequence="walk", camera="c.json", depth_scale=1000, start=3, stride=2)
    write_input(tmp_path / "input.toml", chosen)
    read = read_input(tmp_path / "input.toml")
    assert read.sequence == tmp_path / "walk"
    assert read.camera == tmp_path / "c.json"
    assert (read.depth_scale, read.start, read.stride, read.frames) == (1000, 3, 2, None)


def test_a_camera_kept_with_the_run_moves_with_it(tmp_path):
    old, new = tmp_path / "old", tmp_path / "new"
    old.mkdir()
    write_input(old / "input.toml", InputOptions(sequence=tmp_path, camera=old / "camera.json"))
    old.rename(new)
    read = read_input(new / "input.toml")
    assert (read.sequence, read.camera) == (tmp_path, new / "camera.json")


@pytest.mark.parametrize("text", ["[sequence", "stride = 2\n", 'sequence = "a"\nstrid = 2\n'])
def test_what_are_no_options_is_refused(tmp_path, text):
    (tmp_path / "input.toml").write_text(text)
    with pytest.raises(AppError, match=r"input\.toml"):
        read_input(tmp_path / "input.toml")


def test_eval_opens_the_sequence_as_the_run_did(rendered_walk, tmp_path, monkeypatch, capsys):
    walk, camera, out = tmp_path / "walk", tmp_path / "camera.json", tmp_path / "out"
    shutil.copytree(rendered_walk, walk)
    (walk / "camera.json").rename(camera)
    flags = ("--camera", camera, "--stride", "2", "--frames", "12", "--no-rrd", "--quiet")
    assert roomgraph(monkeypatch, "run", walk, "-o", out, *flags) == 0
    assert len(RunFolder(out).read_input().open()) == 12
    assert roomgraph(monkeypatch, "eval", out) == 0
    ate = RunFolder(out).read_metrics()["ate_rmse_m"]
    assert f"{ate * 100:.2f} cm" in capsys.readouterr().out


def test_watching_without_a_display_leaves_nothing_behind(rendered_walk, tmp_path, monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    arguments = ("run", rendered_walk, "-o", tmp_path / "out", "-v", "--quiet")
    assert roomgraph(monkeypatch, *arguments) == 1
    assert not (tmp_path / "out").exists()


def test_settings_of_another_version_do_not_keep_a_run_from_being_read(tmp_path):
    path = tmp_path / "config.toml"
    path.write_text("seed = 4\n[slam.features]\nmax_features = 77\n[slam.bygone]\nsize = 1\n")
    with pytest.raises(AppError, match="bygone"):
        load_settings(path)
    settings = load_settings(path, only=["seed", "slam.features", "slam.noise", "seed.none"])
    assert (settings.seed, settings.slam.features.max_features) == (4, 77)
    assert settings.slam.noise == AppSettings().slam.noise


def test_flags_that_go_together_are_flags_of_their_own():
    got = {}

    @options.grouped
    def command(
        sequence: Path, *, opening: options.InputFlags, tuning: options.SettingFlags,
        quiet: bool = False,
    ) -> None:  # fmt: skip
        got.update(input=opening.of(sequence), settings=tuning.load(), quiet=quiet)

    names = list(inspect.signature(command).parameters)
    assert names[:3] == ["sequence", "dataset", "camera"]
    assert names[-4:] == ["config", "max_depth", "seed", "quiet"]
    values = {name: p.default for name, p in inspect.signature(command).parameters.items()}
    command(**values | {"sequence": Path("walk"), "stride": 3, "max_depth": 2.5, "seed": 9})
    assert got["input"] == InputOptions(sequence=Path("walk"), stride=3)
    assert (got["settings"].slam.max_depth_m, got["settings"].seed) == (2.5, 9)
    assert got["quiet"] is False


@pytest.mark.parametrize("command", ["run", "label", "bench"])
def test_the_layouts_are_listed_without_a_sequence(command, monkeypatch, capsys):
    assert roomgraph(monkeypatch, command, "--dataset", "list") == 0
    rows = [line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines()]
    assert rows == [[name, reader.files] for name, reader in READERS.items()]


def test_a_layout_that_is_none_is_one_line(tmp_path, monkeypatch, capsys):
    assert roomgraph(monkeypatch, "run", tmp_path, "--dataset", "tun") == 1
    said = capsys.readouterr().err
    assert said.startswith("roomgraph: no such layout: --dataset tun; expected rgb.txt")
    assert said.count("\n") == 1
