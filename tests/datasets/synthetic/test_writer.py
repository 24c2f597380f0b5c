"""Sequences of the building on disk."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from roomgraph.datasets.camera import read_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.places import read_places
from roomgraph.datasets.readers.images import read_colour, read_depth
from roomgraph.datasets.synthetic.building import build
from roomgraph.datasets.synthetic.motion.walk import walk
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.writer import write_sequences
from roomgraph.datasets.trajectory import read_tum

pytestmark = pytest.mark.slow

QUICK = BuildingSettings(seed=2, width=48, height=36, step_m=0.5, turn_deg=20)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    root = tmp_path_factory.mktemp("building")
    directories = {"day": root / "day", "night": root / "night"}
    calls: list[tuple[int, int]] = []
    write_sequences(directories, QUICK, lambda done, count: calls.append((done, count)))
    return directories, calls


def test_layout_is_readable(folders):
    directories, calls = folders
    expected = walk(build(QUICK.seed), QUICK)
    assert calls == [(i + 1, len(expected)) for i in range(len(expected))]
    for directory in directories.values():
        truth = read_tum(directory / "groundtruth.txt")
        np.testing.assert_allclose(truth.T_world_camera, expected.T_world_camera, atol=1e-7)
        camera = read_camera(directory / "camera.json")
        assert camera.intrinsics == QUICK.intrinsics
        assert camera.depth_scale == 5000
        for kind in ("rgb", "depth"):
            rows = _rows(directory / f"{kind}.txt")
            assert len(rows) == len(expected) == len(list((directory / kind).iterdir()))
            assert all((directory / name).is_file() for _, name in rows)
        colour = read_colour(directory / _rows(directory / "rgb.txt")[5][1])
        depth = read_depth(directory / _rows(directory / "depth.txt")[5][1], 5000)
        assert colour.shape == (36, 48, 3)
        assert depth.shape == (36, 48)
        assert 0.5 <= depth[depth > 0].min() <= depth.max() <= 5.0


def test_places_are_the_rooms_at_the_true_poses(folders):
    directory = folders[0]["day"]
    places, truth = read_places(directory / "places.csv"), read_tum(directory / "groundtruth.txt")
    np.testing.assert_allclose(places.stamps_s, truth.stamps_s, atol=1e-6)
    described = json.loads((directory / "building.json").read_text())
    rooms = {room["name"]: room for room in described["rooms"]}
    assert set(places.instances) == set(rooms)
    for xy, label, name in zip(
        truth.positions[:, :2], places.labels, places.instances, strict=True
    ):
        assert rooms[name]["label"] == label
        corners = np.array(rooms[name]["polygon"])
        assert (xy > corners.min(axis=0) - 0.0701).all()
        assert (xy < corners.max(axis=0) + 0.0701).all()
    assert len(described["doorways"]) == len(rooms) - 1


def test_lights_share_the_depth_but_not_the_colours(folders):
    day, night = folders[0].values()
    for kind, same in (("depth", True), ("rgb", False)):
        for _, name in _rows(day / f"{kind}.txt")[::20]:
            assert ((day / name).read_bytes() == (night / name).read_bytes()) is same


def test_same_settings_same_bytes_other_seed_other_bytes(folders, tmp_path):
    write_sequences({"day": tmp_path / "again"}, QUICK)
    write_sequences({"day": tmp_path / "other"}, QUICK.model_copy(update={"seed": 3}))
    first, again, other = (
        {p.relative_to(d).as_posix(): p.read_bytes() for p in d.rglob("*") if p.is_file()}
        for d in (folders[0]["day"], tmp_path / "again", tmp_path / "other")
    )
    assert first == again
    assert not any(first[name] == other.get(name) for name in first if name.startswith("rgb/"))


def test_folder_in_use_is_left_alone(tmp_path):
    (tmp_path / "mine.txt").write_text("kept")
    with pytest.raises(DatasetError, match="there already"):
        write_sequences({"day": tmp_path}, QUICK)
    assert (tmp_path / "mine.txt").read_text() == "kept"


def test_interrupted_writing_leaves_nothing_behind(tmp_path):
    def stop(done: int, count: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_sequences({"day": tmp_path / "half"}, QUICK, stop)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "wrong", [{"light": "noon"}, {"noise": -1}, {"width": 0}, {"step_m": 0}, {"laps": 0}, {"x": 1}]
)
def test_settings_are_checked(wrong):
    with pytest.raises(ValidationError):
        BuildingSettings(**wrong)


def _rows(path: Path) -> list[list[str]]:
    return [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
