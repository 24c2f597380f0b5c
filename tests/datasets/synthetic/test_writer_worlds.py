"""Folders of the wider worlds: what is in them, and that it fits together."""

from __future__ import annotations

import csv
import json
from itertools import pairwise

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from roomgraph.datasets.camera import read_camera
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.synthetic.cameras.omni import read_model
from roomgraph.datasets.synthetic.motion.imu import ImuNoise, read_imu
from roomgraph.datasets.synthetic.motion.spline import MotionSpline
from roomgraph.datasets.synthetic.settings import ADDED, BuildingSettings
from roomgraph.datasets.synthetic.writer import BOXES_EVERY, write_sequences
from roomgraph.datasets.trajectory import read_tum

pytestmark = pytest.mark.slow

FULL = BuildingSettings(
    seed=1, plan="house", people=2, sensor="stereo", hand=True, omni=True, imu=True, width=96,
    height=72, step_m=0.5, turn_deg=20, frames=30,
)  # fmt: skip
PUSHED = BuildingSettings(
    seed=3, plan="suite", sensor="clean", imu=True, width=48, height=36, frames=100
)
OMNI = ("mirror", "panorama", "front", "left", "back", "right")


@pytest.fixture(scope="module", autouse=True)
def quickly_lit():
    """Fewer rays for the ambient light: how bright a wall is does not matter here."""
    with pytest.MonkeyPatch.context() as context:
        context.setattr("roomgraph.datasets.synthetic.rendering.lighting.OCCLUSION_RAYS", 2)
        yield


def written(tmp_path_factory, settings):
    root = tmp_path_factory.mktemp("world") / "day"
    write_sequences({"day": root}, settings)
    return root


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    return written(tmp_path_factory, FULL)


@pytest.fixture(scope="module")
def pushed(tmp_path_factory):
    return written(tmp_path_factory, PUSHED)


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    return written(tmp_path_factory, BuildingSettings(seed=2, width=48, height=36, frames=3))


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_everything_asked_for_is_there(full):
    stamps = [f"{stamp:.6f}" for stamp in read_tum(full / "groundtruth.txt").stamps_s]
    assert len(stamps) == 30
    folders = {"rgb": "jpg", "depth": "png", "masks": "png"}
    folders |= {f"omni/{name}": "jpg" for name in OMNI}
    for folder, suffix in folders.items():
        assert {p.name for p in (full / folder).iterdir()} == {f"{s}.{suffix}" for s in stamps}
    files = {p.name for p in full.iterdir() if p.is_file()}
    assert files == {
        "rgb.txt", "depth.txt", "groundtruth.txt", "camera.json", "places.csv", "building.json",
        "objects.csv", "boxes.csv", "imu.csv", "odometry.txt", "omni.json", "omni_mask.png",
    }  # fmt: skip
    told = json.loads((full / "building.json").read_text())
    assert set(ADDED) < set(told["settings"])
    assert told["floors"]["count"] == 1
    assert told["gravity"] == [0, 0, -9.81]
    assert {"kind", "state", "floor"} < set(told["doorways"][0])
    assert {"shape", "size", "base", "ceiling"} < set(told["rooms"][0])


def test_masks_and_mirrors_are_images_of_the_right_size(full):
    for path in (full / "masks").iterdir():
        mask = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        assert mask.shape == (72, 96)
        assert set(np.unique(mask)) <= {0, 255}
    model = read_model(full / "omni.json")
    mirror = cv2.imread(str(next((full / "omni/mirror").iterdir())))
    assert mirror.shape == (model.size_px, model.size_px, 3) == (90, 90, 3)
    mask = cv2.imread(str(full / "omni_mask.png"), cv2.IMREAD_UNCHANGED)
    assert np.array_equal(mask > 0, model.mask())
    assert mirror[mask > 0].mean() > mirror[mask == 0].mean() + 30


def test_places_have_floor_and_transition(full):
    table = rows(full / "places.csv")
    assert list(table[0]) == ["timestamp", "label", "instance", "floor", "transition"]
    assert len(table) == 30
    assert {row["floor"] for row in table} == {"0"}
    assert {row["transition"] for row in table} <= {"", "door", "jamb"}
    rooms = {room["name"]: room["label"] for room in json.loads(
        (full / "building.json").read_text())["rooms"]}  # fmt: skip
    assert all(rooms[row["instance"]] == row["label"] for row in table)


def test_the_folder_opens_with_depth_laid_on_the_colour(full):
    sequence = open_sequence(full)
    assert len(sequence) == 30
    assert any("separate camera" in note for note in sequence.notes)
    assert sequence.places.floors == (0,) * 30
    camera = read_camera(full / "camera.json")
    assert camera.depth is not None
    assert camera.depth.intrinsics != camera.intrinsics
    for index in (0, 14):
        frame = sequence[index]
        assert frame.colour.shape == (72, 96, 3)
        assert frame.depth.shape == (72, 96)
        assert (frame.depth > 0).mean() > 0.4


def test_boxes_are_of_objects_in_the_table(full):
    listed = {row["object"]: row for row in rows(full / "objects.csv")}
    boxes = rows(full / "boxes.csv")
    stamps = read_tum(full / "groundtruth.txt").stamps_s
    assert {row["timestamp"] for row in boxes} <= {f"{s:.6f}" for s in stamps[::BOXES_EVERY]}
    assert len({row["timestamp"] for row in boxes}) >= 4
    for row in boxes:
        assert listed[row["object"]]["class"] == row["class"]
        left, top, right, bottom = (int(row[k]) for k in ("left", "top", "right", "bottom"))
        assert 0 <= left < right <= 96
        assert 0 <= top < bottom <= 72
        assert 40 <= int(row["pixels"]) <= (right - left) * (bottom - top)
    assert len({row["class"] for row in listed.values()}) >= 30


def test_same_settings_same_bytes_whatever_the_threads(full, tmp_path, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    write_sequences({"day": tmp_path / "again"}, FULL)
    first, again = (
        {p.relative_to(d).as_posix(): p.read_bytes() for p in d.rglob("*") if p.is_file()}
        for d in (full, tmp_path / "again")
    )
    assert first == again
    assert len(first) == 12 + 30 * 9


def test_the_plain_corridor_is_as_it_was(plain):
    files = {p.name for p in plain.iterdir()}
    assert files == {
        "rgb", "depth", "rgb.txt", "depth.txt", "groundtruth.txt", "camera.json", "places.csv",
        "building.json",
    }  # fmt: skip
    told = json.loads((plain / "building.json").read_text())
    assert set(told) == {"settings", "rooms", "doorways"}
    assert set(told["settings"]) == {
        "seed", "light", "noise", "width", "height", "step_m", "turn_deg", "laps", "frames",
        "rate_hz",
    }  # fmt: skip
    assert set(told["rooms"][0]) == {"name", "label", "polygon", "area"}
    assert set(told["doorways"][0]) == {"rooms", "xy", "width", "height"}
    assert list(rows(plain / "places.csv")[0]) == ["timestamp", "label", "instance"]
    assert "depth" not in json.loads((plain / "camera.json").read_text())


def test_readings_of_the_imu_lead_along_the_true_poses(pushed):
    """From the files alone: one second by one second, begun with the true state."""
    readings, noise = read_imu(pushed / "imu.csv"), ImuNoise()
    truth = read_tum(pushed / "groundtruth.txt")
    motion = MotionSpline(truth)
    stamps = readings.stamps_s
    assert stamps[0] == pytest.approx(truth.stamps_s[0])
    assert truth.stamps_s[-1] - 0.01 < stamps[-1] <= truth.stamps_s[-1] + 1e-6
    assert np.allclose(np.diff(stamps), 1 / noise.rate_hz)
    gravity = np.array(json.loads((pushed / "building.json").read_text())["gravity"])
    for begin in (0.3, 0.9, 1.5, 2.0):
        window = np.flatnonzero((stamps >= begin - 1e-6) & (stamps <= begin + 1 + 1e-6))
        (T,), (velocity,) = motion.poses(stamps[window[:1]]), motion.velocity(stamps[window[:1]])
        R, p, v = T[:3, :3], T[:3, 3].copy(), velocity.copy()
        for k, following in pairwise(window):
            step = stamps[following] - stamps[k]
            mean = readings.angular_velocity[[k, following]].mean(axis=0)
            turned = R @ Rotation.from_rotvec(mean * step).as_matrix()
            force = R @ readings.specific_force[k] + turned @ readings.specific_force[following]
            p += v * step + (force / 2 + gravity) * step**2 / 2
            v += (force / 2 + gravity) * step
            R = turned
        (end,) = motion.poses(stamps[window[-1:]])
        turn = Rotation.from_matrix(end[:3, :3].T @ R).magnitude()
        # Four sigmas of the biases, which the files do not tell; the rest is smaller by far.
        assert turn < 4 * np.sqrt(3) * noise.gyro_bias
        tilt = 9.81 * noise.gyro_bias / 6
        assert np.linalg.norm(p - end[:3, 3]) < 4 * np.sqrt(3) * (noise.accel_bias / 2 + tilt)
        # Without gravity, or with its sign turned, one were metres off.
        assert np.linalg.norm(end[:3, 3] - T[:3, 3]) < 3


def test_odometry_is_a_trajectory_on_the_plane(pushed):
    odometry = read_tum(pushed / "odometry.txt")
    truth = read_tum(pushed / "groundtruth.txt")
    np.testing.assert_allclose(odometry.stamps_s, truth.stamps_s, atol=1e-6)
    np.testing.assert_allclose(odometry.T_world_camera[0], np.eye(4), atol=1e-6)
    assert not odometry.positions[:, 2].any()
    assert odometry.length_m == pytest.approx(truth.length_m, rel=0.1)
    assert truth.length_m > 1
