"""``roomgraph synth``: its options reach the building, and its errors say what to do."""

from __future__ import annotations

import json

import pytest

from tests.app.command import roomgraph

SMALL = ("--width", "96", "--height", "72", "--frames", "4", "--quiet")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--plan", "castle"), "--plan; expected 'corridor', 'ring'"),
        (("--floors", "2"), "--plan ring, suite, open or house; got plan corridor, floors 2"),
        (("--visit", "1"), "one floor and visit 0 for the corridor plan"),
        (("--plan", "house", "--floors", "9"), "--floors; expected less than or equal to 4"),
        (("--sensor", "radar"), "--sensor; expected 'kinect', 'stereo', 'tof' or 'clean'"),
        (("--optics", "foggy"), "--optics; expected 'ideal' or 'real'"),
        (("--people", "99"), "--people; expected less than or equal to 20; got 99"),
    ],
)
def test_a_wrong_option_is_told_in_one_line(tmp_path, monkeypatch, capsys, arguments, told):
    assert roomgraph(monkeypatch, "synth", "-o", tmp_path / "s", *arguments) == 1
    said = capsys.readouterr().err
    assert told in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_options_reach_the_recording(tmp_path, monkeypatch):
    monkeypatch.setenv("ROOMGRAPH_CACHE", str(tmp_path / "cache"))
    walk = tmp_path / "walk"
    options = ("--plan", "house", "--floors", "2", "--visit", "1", "--people", "1", "--hand",
               "--sensor", "stereo", "--imu", "--omni", "--seed", "2")  # fmt: skip
    assert roomgraph(monkeypatch, "synth", "-o", walk, *options, *SMALL) == 0
    told = json.loads((walk / "building.json").read_text())["settings"]
    expected = {"plan": "house", "floors": 2, "visit": 1, "people": 1, "hand": True,
                "sensor": "stereo", "imu": True, "omni": True, "step_m": 0.035}  # fmt: skip
    assert {name: told[name] for name in expected} == expected
    assert {"imu.csv", "odometry.txt", "omni", "masks", "objects.csv", "boxes.csv"} <= {
        path.name for path in walk.iterdir()
    }
    assert len(list((tmp_path / "cache/scenes").iterdir())) == 1


@pytest.mark.slow
def test_a_sheet_is_a_page_beside_others(tmp_path, monkeypatch, capsys):
    pages = tmp_path / "pages"
    arguments = ("synth", "-o", pages, "--plan", "house", "--seed", "2", "--sheet")
    assert roomgraph(monkeypatch, *arguments, "--quiet") == 0
    assert [path.name for path in pages.iterdir()] == ["house2.jpg"]
    assert roomgraph(monkeypatch, *arguments) == 1
    assert "--overwrite" in capsys.readouterr().err
