"""What is wrong with the data is said before a run, and kept with it."""

import shutil
from dataclasses import replace

import cv2
import numpy as np

from roomgraph.app.run.session import examined
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.slam.checks import CheckSettings, examine
from roomgraph.slam.geometry.noise import SensorNoise
from tests.app.command import roomgraph


def test_good_data_is_not_warned_of(mapped):
    _, run = mapped
    assert "WARNING roomgraph.app.run.session" not in RunFolder(run).log.read_text()


def test_a_wrong_depth_scale_is_said_logged_and_kept(rendered_walk, tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    arguments = ("run", rendered_walk, "-o", out, "--depth-scale", "25000", "--no-rrd")
    assert roomgraph(monkeypatch, *arguments) == 0
    folder = RunFolder(out)
    warning = folder.read_metrics()["warnings"][0]
    assert "--depth-scale 5000 gives typical indoor distances" in warning
    assert f"warning: {warning}" in capsys.readouterr().out
    assert f"WARNING roomgraph.app.run.session depth scale: {warning}" in folder.log.read_text()


def test_an_impossible_one_is_named_by_the_error(rendered_walk, tmp_path, monkeypatch, capsys):
    arguments = ("run", rendered_walk, "-o", tmp_path / "out", "--depth-scale", "5", "--quiet")
    assert roomgraph(monkeypatch, *arguments, "--no-rrd") == 1
    said = capsys.readouterr().err
    assert "no frame could be tracked" in said
    assert "--depth-scale 5000 gives typical indoor distances" in said
    assert said.count("\n") == 1


def test_depth_beside_the_colour_is_laid_there_and_the_camera_kept(
    rendered_walk, tmp_path, monkeypatch, capsys
):
    walk, out = tmp_path / "walk", tmp_path / "out"
    shutil.copytree(rendered_walk, walk)
    for path in (walk / "depth").iterdir():
        depth = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        cv2.imwrite(str(path), np.pad(depth, ((0, 0), (14, 0)))[:, :-14])
    assert roomgraph(monkeypatch, "run", walk, "-o", out, "--no-rrd") == 0
    said = capsys.readouterr().out
    assert "are aligned by that" in said
    assert f"--camera {out / 'camera.json'}" in said
    folder = RunFolder(out)
    assert "are aligned by that" in folder.read_metrics()["warnings"][0]
    # Whoever opens the sequence again sees what was mapped, with nothing left to warn of.
    again = folder.read_input().open()
    assert again.camera.depth is not None
    assert not examine(again, CheckSettings(), SensorNoise()).findings
    assert roomgraph(monkeypatch, "eval", out) == 0
    corrected = folder.read_metrics()["ate_rmse_m"]

    settings, plain = tmp_path / "settings.toml", tmp_path / "plain"
    settings.write_text("[checks]\ncorrect_camera = false\n")
    arguments = ("run", walk, "-o", plain, "--no-rrd", "--quiet", "--config", settings)
    assert roomgraph(monkeypatch, *arguments) == 0
    assert not RunFolder(plain).camera.exists()
    assert corrected < RunFolder(plain).read_metrics()["ate_rmse_m"]


def test_checks_use_the_noise_that_is_set(rendered_walk):
    """With a sensor this uncertain, an error of 10 % is within a few standard errors."""
    walk = open_sequence(rendered_walk)
    true = walk.camera.intrinsics
    given = replace(true, fx=0.9 * true.fx, fy=0.9 * true.fy)
    wrong = walk.with_camera(replace(walk.camera, intrinsics=given))
    assert examined(wrong, AppSettings()).findings
    noise = {"pixel": 10, "depth_floor_m": 0.1, "depth_quadratic": 0.1}
    uncertain = AppSettings.model_validate({"slam": {"noise": noise}})
    assert not examined(wrong, uncertain).findings


def test_checks_can_be_left_out(rendered_walk, tmp_path, monkeypatch):
    settings = tmp_path / "settings.toml"
    settings.write_text("[checks]\nenabled = false\n")
    out = tmp_path / "out"
    arguments = ("run", rendered_walk, "-o", out, "--depth-scale", "25000", "--no-rrd", "--quiet")
    assert roomgraph(monkeypatch, *arguments, "--config", settings, "--frames", "5") == 0
    assert "depth-scale" not in str(RunFolder(out).read_metrics()["warnings"])
