"""Progress in an output that is no terminal: a file, a pipe, the log of a build."""

import pytest

from roomgraph.app import console
from roomgraph.app.console import Terminal
from tests.app.command import roomgraph


@pytest.fixture
def clock(monkeypatch):
    """A clock that stands until its one value is changed."""
    now = [100.0]
    monkeypatch.setattr(console, "perf_counter", lambda: now[0])
    return now


def lines_of(capsys, clock, seconds_each, counts=range(1, 41), total=40):
    with Terminal().progress("Mapping kitchen", "frames") as advance:
        for count in counts:
            clock[0] += seconds_each
            advance(count, total, "ok")
    return capsys.readouterr().err.splitlines()


def test_slow_work_is_told_of_at_every_tenth(capsys, clock):
    lines = lines_of(capsys, clock, seconds_each=10)
    assert lines[0] == "Mapping kitchen ..."
    assert lines[1:3] == [
        "Mapping kitchen: 4 of 40 frames, ok, 40 s",
        "Mapping kitchen: 8 of 40 frames, ok, 80 s",
    ]
    assert lines[-1] == "Mapping kitchen: 40 of 40 frames, 400 s"
    assert len(lines) == 1 + 9 + 1


def test_fast_work_is_told_of_every_fifteen_seconds(capsys, clock):
    said = [line.rsplit(", ", 1)[1] for line in lines_of(capsys, clock, seconds_each=1)[1:]]
    assert said == ["15 s", "30 s", "40 s"]


def test_work_that_fails_is_not_said_to_have_ended(capsys, clock):
    with pytest.raises(RuntimeError), Terminal().progress("Mapping kitchen") as advance:
        advance(1, 2, "")
        raise RuntimeError
    assert capsys.readouterr().err == "Mapping kitchen ...\n"


def test_work_that_nobody_counts_is_said_once(capsys, clock):
    with Terminal().working("Looking at [the] data"):
        clock[0] += 3
    with Terminal().progress("Learning"):
        clock[0] += 3
    assert capsys.readouterr().err.splitlines() == [
        "Looking at [the] data",
        "Learning ...",
        "Learning: done, 3 s",
    ]


def test_quiet_says_nothing(capsys, clock):
    terminal = Terminal(quiet=True)
    with terminal.working("Looking"), terminal.progress("Mapping") as advance:
        clock[0] += 100
        advance(5, 9, "")
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "")


@pytest.mark.slow
def test_rendering_into_a_file_tells_when_it_ended(tmp_path, monkeypatch, capsys, clock):
    flags = ("--frames", "2", "--width", "64", "--height", "48")
    assert roomgraph(monkeypatch, "synth", "-o", tmp_path / "floor", *flags) == 0
    title = "Rendering building 0 (day)"
    lines = capsys.readouterr().err.splitlines()
    assert lines == [f"{title} ...", f"{title}: 2 of 2 frames, 0 s"]
