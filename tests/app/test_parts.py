"""The application's small parts."""

import logging
import threading
import time

import numpy as np
import pytest

from roomgraph.app.clock import StageClock
from roomgraph.app.console import Terminal
from roomgraph.app.errors import AppError
from roomgraph.app.prefetch import prefetch
from roomgraph.app.settings import load_settings, to_toml, write_settings
from roomgraph.app.storage.building_cache import building_settings
from roomgraph.app.storage.cloud import read_cloud, read_normals, write_cloud
from roomgraph.app.storage.run_folder import RUN_MARKS, RunFolder, clear_output, make_run_folder


def test_prefetch_keeps_the_order_and_works_ahead():
    done = []

    def work(i):
        done.append(i)
        return i * i

    results = prefetch(work, range(20), ahead=3)
    assert next(results) == 0
    time.sleep(0.1)
    assert 3 <= len(done) <= 5
    assert list(results) == [i * i for i in range(1, 20)]


def test_prefetch_gives_all_results_before_an_error():
    def work(i):
        if i == 5:
            raise AppError("broken")
        return i

    results, found = prefetch(work, range(9)), []
    with pytest.raises(AppError, match="broken"):
        while True:
            found.append(next(results))
    assert found == [0, 1, 2, 3, 4]


def test_prefetch_left_early_ends_its_thread():
    before = threading.active_count()
    results = prefetch(lambda i: i, range(1000))
    next(results)
    results.close()
    assert threading.active_count() == before


def test_clock_tells_median_and_tail():
    clock = StageClock()
    for seconds in (0.0, 0.0, 0.02):
        with clock.stage("track"):
            time.sleep(seconds)
    summary = clock.summary()["track"]
    assert summary["count"] == 3
    assert summary["median"] < 10 < summary["p95"] < summary["total"] + 1
    assert clock.elapsed_s >= 0.02


def test_a_stage_that_fails_is_timed_too():
    clock = StageClock()
    with pytest.raises(ValueError, match="no"), clock.stage("read"):
        raise ValueError("no")
    assert clock.summary()["read"]["count"] == 1


def test_cloud_round_trip(tmp_path, rng):
    points = rng.normal(size=(50, 3)).astype(np.float32)
    colours = rng.integers(0, 255, (50, 3), dtype=np.uint8)
    labels = rng.integers(0, 9, 50)
    write_cloud(tmp_path / "map.ply", points, colours, labels)
    for ours, theirs in zip(
        (points, colours, labels), read_cloud(tmp_path / "map.ply"), strict=True
    ):
        assert np.array_equal(ours, theirs)
    assert read_normals(tmp_path / "map.ply") is None
    normals = rng.normal(size=(50, 3)).astype(np.float32)
    write_cloud(tmp_path / "map.ply", points, colours, labels, normals)
    assert np.array_equal(read_normals(tmp_path / "map.ply"), normals)
    assert np.array_equal(read_cloud(tmp_path / "map.ply")[2], labels)
    with pytest.raises(AppError, match="no such file"):
        read_cloud(tmp_path / "none.ply")
    with pytest.raises(AppError, match="no such file"):
        read_normals(tmp_path / "none.ply")
    with pytest.raises(AppError, match="0 points"):
        write_cloud(tmp_path / "empty.ply", points[:0], colours[:0], labels[:0])


def test_settings_round_trip(tmp_path):
    settings = load_settings(
        None, {"seed": 3, "slam.max_depth_m": 4.5, "slam.features.detector": "orb"}
    )
    write_settings(tmp_path / "config.toml", settings)
    assert load_settings(tmp_path / "config.toml") == settings
    assert "orb" in to_toml(settings)


def test_flags_win_over_the_file_and_the_file_over_defaults(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text("seed = 4\n[slam]\nmax_depth_m = 3.0\n")
    settings = load_settings(path, {"slam.max_depth_m": 2.0, "seed": None})
    assert (settings.seed, settings.slam.max_depth_m) == (4, 2.0)


def test_run_folders_are_dated_and_the_latest_linked(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = make_run_folder(None, "kitchen", overwrite=False)
    assert folder.root.is_dir()
    assert (tmp_path / "results/kitchen/latest").resolve() == folder.root.resolve()


def test_only_our_own_output_is_ever_removed(tmp_path):
    ours, other = tmp_path / "ours", tmp_path / "other"
    for root, names in (
        (ours, ("run.log", "config.toml", "input.toml")),  # killed before the first frame
        (other, ("config.toml", "thesis.tex")),
    ):
        root.mkdir()
        for name in names:
            (root / name).write_text("")
    with pytest.raises(AppError, match="exists already"):
        clear_output(ours, overwrite=False, marks=RUN_MARKS)
    clear_output(ours, overwrite=True, marks=RUN_MARKS)
    assert not ours.exists()
    with pytest.raises(AppError, match="refusing to overwrite what is not roomgraph output"):
        clear_output(other, overwrite=True, marks=RUN_MARKS)
    assert other.exists()


def test_unfinished_run_is_said(tmp_path):
    with pytest.raises(AppError, match="not the folder of a finished run"):
        RunFolder(tmp_path).read_metrics()


def test_terminal_can_be_quiet_and_logs_to_a_file(tmp_path, capsys):
    terminal = Terminal(quiet=True)
    terminal.say("hello")
    with terminal.progress("working") as advance:
        advance(1, 2, "half")
    assert capsys.readouterr().out == ""
    with terminal.logging(tmp_path / "run.log"):
        logging.getLogger("roomgraph.slam.slam").info("lost")
    logging.getLogger("roomgraph.slam.slam").info("not logged any more")
    assert (tmp_path / "run.log").read_text().count("\n") == 1


def test_building_settings_out_of_range_are_named():
    with pytest.raises(AppError, match="--noise"):
        building_settings(noise=-1.0)
