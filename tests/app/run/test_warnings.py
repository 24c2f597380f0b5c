"""What is wrong with the data is said before a run, and kept with it."""

import shutil

import cv2
import numpy as np

from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.slam.checks import CheckSettings, examine
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
    assert "--depth-scale 5000 would be plausible" in warning
    assert f"warning: {warning}" in capsys.readouterr().out
    assert f"WARNING roomgraph.app.run.session depth scale: {warning}" in folder.log.read_text()


def test_an_impossible_one_is_named_by_the_error(rendered_walk, tmp_path, monkeypatch, capsys):
    arguments = ("run", rendered_walk, "-o", tmp_path / "out", "--depth-scale", "5", "--quiet")
    assert roomgraph(monkeypatch, *arguments, "--no-rrd") == 1
    said = capsys.readouterr().err
    assert "no frame could be tracked" in said
    assert "--depth-scale 5000 would be plausible" in said
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
    assert "it is laid there" in said
    assert f"--camera {out / 'camera.json'}" in said
    folder = RunFolder(out)
    assert "it is laid there" in folder.read_metrics()["warnings"][0]
    # Whoever opens the sequence again sees what was mapped, with nothing left to warn of.
    again = folder.read_input().open()
    assert again.camera.depth is not None
    assert not examine(again, CheckSettings()).findings
    assert roomgraph(monkeypatch, "eval", out) == 0
    corrected = folder.read_metrics()["ate_rmse_m"]

    settings, plain = tmp_path / "settings.toml", tmp_path / "plain"
    settings.write_text("[checks]\ncorrect_camera = false\n")
    arguments = ("run", walk, "-o", plain, "--no-rrd", "--quiet", "--config", settings)
    assert roomgraph(monkeypatch, *arguments) == 0
    assert not RunFolder(plain).camera.exists()
    assert corrected < RunFolder(plain).read_metrics()["ate_rmse_m"]


def test_checks_can_be_left_out(rendered_walk, tmp_path, monkeypatch):
    settings = tmp_path / "settings.toml"
    settings.write_text("[checks]\nenabled = false\n")
    out = tmp_path / "out"
    arguments = ("run", rendered_walk, "-o", out, "--depth-scale", "25000", "--no-rrd", "--quiet")
    assert roomgraph(monkeypatch, *arguments, "--config", settings, "--frames", "5") == 0
    assert "depth-scale" not in str(RunFolder(out).read_metrics()["warnings"])
