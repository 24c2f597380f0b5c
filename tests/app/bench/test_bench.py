"""What the bench measures, and how it sums it up."""

import json
import time
from multiprocessing import active_children
from threading import Thread

import numpy as np
import pytest

from roomgraph.app.bench.bench import bench_alone, labelling_cost, summarise
from roomgraph.app.bench.worker import BenchJob, BenchRun, resident_mb
from roomgraph.app.clock import StageClock
from roomgraph.app.errors import AppError
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.input import InputOptions
from tests.app.command import roomgraph

FRAMES = 40


def run_of(frame_ms, sha="a", **metrics):
    stage = {"median": 2.0, "p95": 3.0, "total": 80.0, "count": FRAMES}
    figures = {
        "frames": FRAMES, "frames_tracked": 38, "path_length_m": 3.0, "fps": 20.0,
        "seconds_total": 2.0, "keyframes": 5, "stage_ms": {"track": stage},
    }  # fmt: skip
    values = [float(v) for v in frame_ms]
    memory = [100.0] * FRAMES
    return BenchRun("walk", figures | metrics, values, values, values, memory, 120.0, 1.0, sha)


@pytest.fixture
def job(tmp_path):
    return BenchJob(InputOptions(sequence=tmp_path), AppSettings())


def test_growth_is_the_last_tenth_over_the_first(job):
    flat, doubling = np.full(FRAMES, 30.0), np.linspace(20, 40, FRAMES)
    assert summarise([run_of(flat)], job)["frame_ms"]["growth"] == 1
    found = summarise([run_of(doubling)], job)["frame_ms"]
    assert found["first_tenth"] == pytest.approx(np.median(doubling[:4]))
    assert found["growth"] == pytest.approx(np.median(doubling[-4:]) / np.median(doubling[:4]))


def test_repeats_are_summed_up_by_their_medians(job):
    runs = [run_of(np.full(FRAMES, ms), fps=fps) for ms, fps in ((30, 10), (31, 30), (90, 20))]
    summary = summarise(runs, job)
    assert summary["frame_ms"]["median"] == 31
    assert summary["fps"] == 20
    assert summary["repeats"] == 3
    assert summary["share_lost"] == pytest.approx(0.05)
    assert "ate_rmse_m" not in summary


def test_one_other_byte_is_not_deterministic(job):
    frame_ms = np.ones(FRAMES)
    same, other = run_of(frame_ms), run_of(frame_ms, sha="b")
    assert summarise([same, same, same], job)["deterministic"] is True
    assert summarise([same, other, same], job)["deterministic"] is False
    assert summarise([same], job)["deterministic"] is None


def test_labelling_cost_compares_the_same_sequence():
    rows = [
        {"sequence": "a", "model": None, "seconds_total": 10.0},
        {"sequence": "a", "model": "m", "seconds_total": 10.5},
        {"sequence": "b", "model": None, "seconds_total": 4.0},
        {"sequence": "b", "model": "m", "seconds_total": 5.0},
    ]
    assert labelling_cost(rows) == {"a": 0.05, "b": 0.25}
    assert labelling_cost(rows[:1]) == {}


def test_the_clock_keeps_the_order_and_tells_work_from_waiting():
    clock = StageClock()
    for work in (300_000, 3_000_000):
        with clock.stage("work"):
            sum(range(work))
    with clock.stage("wait"):
        import time

        time.sleep(0.05)
    first, second = clock.samples_s("work", cpu=True)
    assert first < second
    assert clock.samples_s("wait")[0] >= 0.05
    assert clock.samples_s("wait", cpu=True)[0] < 0.03
    assert clock.samples_s("never") == []


def test_memory_at_most_is_no_less_than_now():
    assert 0 < resident_mb("VmRSS") <= resident_mb("VmHWM")


def test_bench_prints_json_alone_and_writes_pictures(rendered_walk, tmp_path, monkeypatch, capfd):
    out = tmp_path / "bench"
    arguments = ("bench", rendered_walk, "--frames", "6", "--laps", "1", "--repeat", "2")
    assert roomgraph(monkeypatch, *arguments, "--json", "-o", out) == 0
    found = json.loads(capfd.readouterr().out)
    assert found["schema"] == "roomgraph/bench/1"
    (summary,) = found["sequences"]
    assert summary["frames"] == 10
    assert summary["deterministic"] is True
    assert summary["ate_rmse_m"] < 0.03
    assert 50 < summary["memory_mb"]["last_tenth"] <= summary["peak_rss_mb"]
    assert {"features", "track"} <= set(summary["stage_ms"])
    written = json.loads((out / "bench.json").read_text())
    assert [len(r["frame_ms"]) for r in written["frame_times"][0]] == [10, 10]
    assert (out / "1-walk.png").stat().st_size > 10_000
    assert roomgraph(monkeypatch, *arguments, "-o", out) == 1
    assert "--overwrite" in capfd.readouterr().err


@pytest.mark.slow
def test_bench_tells_what_cannot_be_opened_in_one_line(tmp_path, monkeypatch, capfd):
    assert roomgraph(monkeypatch, "bench", tmp_path / "nowhere", "--repeat", "1", "--quiet") == 1
    said = capfd.readouterr().err
    assert said.startswith("roomgraph: no such folder")
    assert said.count("\n") == 1


def test_help_has_examples(monkeypatch, capsys):
    assert roomgraph(monkeypatch, "bench", "--help") == 0
    assert "roomgraph bench" in capsys.readouterr().out.split("Examples")[1]


def test_a_measuring_process_that_is_killed_is_said(job):
    """As by a system that has no memory left."""

    def kill_the_first():
        while not (children := active_children()):
            time.sleep(0.01)
        children[0].kill()

    killer = Thread(target=kill_the_first)
    killer.start()
    with pytest.raises(AppError, match="the benchmark process was killed"):
        bench_alone(job)
    killer.join()
