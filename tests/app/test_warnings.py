"""What is wrong with the data is said before a run, and kept with it."""

from app.run_folder import RunFolder
from tests.app.command import roomgraph


def test_good_data_is_not_warned_of(mapped):
    _, run = mapped
    assert "WARNING app.session" not in RunFolder(run).log.read_text()


def test_a_wrong_depth_scale_is_said_logged_and_kept(rendered_walk, tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    arguments = ("run", rendered_walk, "-o", out, "--depth-scale", "25000", "--no-rrd")
    assert roomgraph(monkeypatch, *arguments) == 0
    folder = RunFolder(out)
    warning = folder.read_metrics()["warnings"][0]
    assert "--depth-scale 5000 would be plausible" in warning
    assert f"warning: {warning}" in capsys.readouterr().out
    assert f"WARNING app.session depth scale: {warning}" in folder.log.read_text()


def test_an_impossible_one_is_named_by_the_error(rendered_walk, tmp_path, monkeypatch, capsys):
    arguments = ("run", rendered_walk, "-o", tmp_path / "out", "--depth-scale", "5", "--quiet")
    assert roomgraph(monkeypatch, *arguments, "--no-rrd") == 1
    said = capsys.readouterr().err
    assert "no frame could be tracked" in said
    assert "--depth-scale 5000 would be plausible" in said
    assert said.count("\n") == 1


def test_checks_can_be_left_out(rendered_walk, tmp_path, monkeypatch):
    settings = tmp_path / "settings.toml"
    settings.write_text("[checks]\nenabled = false\n")
    out = tmp_path / "out"
    arguments = ("run", rendered_walk, "-o", out, "--depth-scale", "25000", "--no-rrd", "--quiet")
    assert roomgraph(monkeypatch, *arguments, "--config", settings, "--frames", "5") == 0
    assert "depth-scale" not in str(RunFolder(out).read_metrics()["warnings"])
