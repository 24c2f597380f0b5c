"""What is said, and when: the wearable's rules."""

import shutil
import stat
import subprocess
from types import SimpleNamespace

import numpy as np
import pytest

from roomgraph.app.answers.answers import answer
from roomgraph.app.answers.locating import Whereabouts
from roomgraph.app.answers.queries import Query
from roomgraph.app.answers.speech import Announcer, Voice, spoken
from roomgraph.app.errors import AppError


def _said(answers, rate_hz=8.0, **settings):
    announcer = Announcer(**settings)
    sentences = (
        (i / rate_hz, announcer.hear(place, i / rate_hz)) for i, place in enumerate(answers)
    )
    return [(stamp, sentence) for stamp, sentence in sentences if sentence is not None]


def test_an_answer_is_said_once_it_has_held_for_five_frames():
    assert _said(["office2"] * 4) == []
    assert _said(["office2"] * 5) == [(0.5, "you are in office 2")]
    walk = ["office2"] * 10 + ["corridor1"] * 10
    assert _said(walk)[1:] == [(1.75, "you are entering corridor 1")]


def test_flicker_is_not_said():
    walk = ["office2"] * 10 + ["corridor1", "corridor1", "office2", "kitchen1"] * 5
    assert _said(walk) == [(0.5, "you are in office 2")]


def test_frames_without_an_answer_are_passed_over():
    assert _said(["unknown"] * 50) == []
    walk = ["office2"] * 3 + ["unknown"] * 4 + ["office2"] * 2
    assert _said(walk) == [(1.0, "you are in office 2")]


def test_every_ten_seconds_it_is_said_again():
    said = _said(["office2"] * 240)
    assert said == [(t, "you are in office 2") for t in (0.5, 10.5, 20.5)]
    walk = ["office2"] * 60 + ["corridor1"] * 120
    assert [t for t, _ in _said(walk)] == [0.5, 8.0, 18.0]


@pytest.mark.parametrize(
    ("place", "said"),
    [("office2", "office 2"), ("meeting_room12", "meeting room 12"), ("corridor", "corridor")],
)
def test_names_as_they_are_said(place, said):
    assert spoken(place) == said


def test_no_voice_is_said_so(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(AppError, match="espeak-ng"):
        Voice()


def _program(folder, monkeypatch, script):
    program = folder / "espeak-ng"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")


def test_sentences_are_handed_to_the_program(tmp_path, monkeypatch):
    _program(tmp_path, monkeypatch, f'echo "$@" >> {tmp_path}/said')
    voice = Voice()
    voice.say("you are in office 2")
    voice.say("-- odd; name")
    assert (tmp_path / "said").read_text() == "-- you are in office 2\n-- -- odd; name\n"


def test_a_voice_that_fails_is_an_error(tmp_path, monkeypatch):
    _program(tmp_path, monkeypatch, "echo no sound card >&2; exit 3")
    with pytest.raises(AppError, match="no sound card"):
        Voice().say("you are in office 2")


def test_a_voice_that_ends_well_but_complains_is_an_error(tmp_path, monkeypatch):
    _program(tmp_path, monkeypatch, "echo 'ALSA lib: no card\nerror: No such file' >&2")
    with pytest.raises(AppError, match="error: No such file"):
        Voice().say("you are in office 2")


def _walk(places):
    frames = [SimpleNamespace(stamp_s=i / 2) for i in range(len(places))]
    return (
        (Query(str(i), frame), Whereabouts(place, place, 0, 0.9, 40, np.eye(4)))
        for i, (frame, place) in enumerate(zip(frames, places, strict=True))
    )


def test_a_walk_goes_on_in_writing_when_the_voice_fails(tmp_path, monkeypatch, capsys):
    _program(tmp_path, monkeypatch, f"echo x >> {tmp_path}/asked; exit 1")
    places = ["office2"] * 6 + ["corridor1"] * 6
    answer(None, _walk(places), is_walk=True, speak=True, as_json=False)
    out, error = capsys.readouterr()
    assert "2.00 s: you are in office 2 (90% sure)" in out
    assert "you are entering corridor 1" in out
    assert "12 frames: place found for 12, pose found for 12" in out
    assert error.count("speech output failed") == 1
    assert (tmp_path / "asked").read_text() == "x\n"


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="needs espeak-ng")
def test_the_real_program_says_it_or_why_not():
    try:
        Voice().say("you are entering office 2")
    except AppError as error:
        assert "speech output failed" in str(error)
    wave = subprocess.run(
        ["espeak-ng", "--stdout", "--", "you are entering office 2"], capture_output=True,
        check=True,
    ).stdout  # fmt: skip
    assert wave[:4] == b"RIFF" and len(wave) > 20_000
