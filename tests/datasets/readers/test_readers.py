import json

import cv2
import numpy as np
import pytest

from roomgraph.datasets.camera import Camera, DepthCamera, Intrinsics, write_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.readers.association import associate, typical_offset
from roomgraph.datasets.readers.images import (
    read_colour,
    read_depth,
    undistort_colour,
    undistort_depth,
)
from roomgraph.datasets.readers.registry import READERS, guess_layout, open_sequence
from roomgraph.datasets.sequence import Sequence, frames_of, select

WIDTH, HEIGHT = 32, 24
CAMERA = Intrinsics(WIDTH, HEIGHT, 30.0, 30.0, 15.5, 11.5)


def _write_frame(colour, depth, metres, scale):
    image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    image[..., 2] = 200  # red, for OpenCV's blue-green-red order
    cv2.imwrite(str(colour), image)
    cv2.imwrite(str(depth), np.full((HEIGHT, WIDTH), round(metres * scale), np.uint16))


@pytest.fixture
def tum(tmp_path):
    root = tmp_path / "walk"
    (root / "rgb").mkdir(parents=True)
    (root / "depth").mkdir()
    colour, depth, truth, places = [], [], [], ["timestamp,label,instance"]
    for i in range(5):
        stamp = 10 + i / 30
        _write_frame(root / f"rgb/{i}.png", root / f"depth/{i}.png", 1 + i, 5000)
        colour.append(f"{stamp:.4f} rgb/{i}.png")
        depth.append(f"{stamp + 0.01:.4f} depth/{i}.png")
        truth.append(f"{stamp:.4f} {i} 0 0 0 0 0 1")
        places.append(f"{stamp:.4f},office,office{i // 3 + 1}")
    (root / "rgb.txt").write_text("# colour\n" + "\n".join(colour))
    (root / "depth.txt").write_text("\n".join(depth[:-1]) + "\n99.0 depth/4.png\n")
    (root / "groundtruth.txt").write_text("\n".join(truth))
    (root / "places.csv").write_text("\n".join(places))
    write_camera(root / "camera.json", CAMERA, 5000)
    return root


@pytest.fixture
def scenes(tmp_path):
    root = tmp_path / "scene"
    root.mkdir()
    for i in range(3):
        stem = f"frame-{i:06d}"
        _write_frame(root / f"{stem}.color.png", root / f"{stem}.depth.png", 2, 1000)
        np.savetxt(root / f"{stem}.pose.txt", np.eye(4) if i < 2 else np.full((4, 4), -np.inf))
    np.savetxt(root / "camera-intrinsics.txt", CAMERA.K)
    return root


@pytest.fixture
def folder(tmp_path):
    root = tmp_path / "plain"
    (root / "color").mkdir(parents=True)
    (root / "depth").mkdir()
    for i in (2, 10):
        _write_frame(root / f"color/{i}.jpg", root / f"depth/{i}.png", i / 10, 1000)
    K = [30, 0, 0, 0, 30, 0, 15.5, 11.5, 1]
    camera = {"width": WIDTH, "height": HEIGHT, "intrinsic_matrix": K}
    (root / "camera.json").write_text(json.dumps(camera))
    return root


def test_tum_is_read_and_what_is_dropped_is_said(tum):
    sequence = open_sequence(tum)
    assert isinstance(sequence, Sequence)
    assert len(sequence) == 4
    assert any("dropped 1 colour and 1 depth" in note for note in sequence.notes)
    frame = sequence[2]
    assert frame.colour.shape == (HEIGHT, WIDTH, 3)
    assert frame.colour[0, 0].tolist() == [200, 0, 0]
    assert frame.depth.dtype == np.float32
    assert np.allclose(frame.depth, 3.0)
    assert sequence.ground_truth.positions[3].tolist() == [3, 0, 0]
    assert sequence.places.at(frame.stamp_s) == ("office", "office1")
    assert sequence.places.at(50.0) is None


def test_tum_associations_win(tum):
    (tum / "associations.txt").write_text("10.01 depth/1.png 10.0 rgb/0.png\n")
    sequence = open_sequence(tum)
    assert len(sequence) == 1
    assert sequence.stamps_s[0] == 10.0
    assert np.allclose(sequence[0].depth, 2.0)


def test_seven_scenes(scenes):
    sequence = open_sequence(scenes)
    assert len(sequence) == 3
    assert len(sequence.ground_truth) == 2  # the broken pose is left out
    assert np.allclose(sequence[1].depth, 2.0)
    assert sequence.camera.intrinsics == CAMERA


def test_plain_folder_sorts_numbers_as_numbers(folder):
    sequence = open_sequence(folder)
    assert [round(float(f.depth[0, 0]), 2) for f in frames_of(sequence)] == [0.2, 1.0]


def test_depth_scale_and_camera_can_be_forced(folder, tmp_path):
    write_camera(tmp_path / "other.json", CAMERA, 500)
    assert np.allclose(open_sequence(folder, camera=tmp_path / "other.json")[0].depth, 0.4)
    assert np.allclose(open_sequence(folder, depth_scale=100)[0].depth, 2.0)


def test_selection_is_a_sequence(tum):
    chosen = select(open_sequence(tum), start=1, frames=2, stride=2)
    assert len(chosen) == 2
    assert [frame.index for frame in frames_of(chosen)] == [0, 1]
    assert np.allclose(chosen[1].depth, 4.0)
    assert np.allclose(chosen.stamps_s, [frame.stamp_s for frame in frames_of(chosen)])
    with pytest.raises(DatasetError, match="no frame is left"):
        select(open_sequence(tum), start=99)


def test_association_is_one_to_one_nearest_first():
    pairs = associate(np.array([0.0, 0.015, 1.0]), np.array([0.01, 0.5, 1.019, 1.02]))
    assert pairs.tolist() == [[1, 0], [2, 2]]
    assert associate(np.array([0.0]), np.array([0.02])).shape == (0, 2)


def test_clocks_that_differ_are_told_by_how_much(tum):
    stamps = np.arange(5) / 5
    assert np.isclose(typical_offset(stamps, stamps + 0.07), 0.07)
    assert np.isclose(typical_offset(stamps, stamps - 1000), -1000)
    (tum / "depth.txt").write_text("\n".join(f"{510 + i / 30:.4f} depth/{i}.png" for i in range(5)))
    with pytest.raises(DatasetError, match=r"\+500 s off"):
        open_sequence(tum)


def test_sixteen_bit_invalid_value_is_no_reading(tmp_path):
    raw = np.array([[0, 1000], [65535, 2500]], np.uint16)
    cv2.imwrite(str(tmp_path / "d.png"), raw)
    assert read_depth(tmp_path / "d.png", 1000).tolist() == [[0, 1], [0, 2.5]]


def test_undistortion_moves_depth_with_colour():
    camera = Intrinsics(WIDTH, HEIGHT, 30, 30, 15.5, 11.5, (0.3, 0.0, 0.0, 0.0, 0.0))
    colour = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    depth = np.zeros((HEIGHT, WIDTH), np.float32)
    colour[2:5, 3:6] = 255
    depth[2:5, 3:6] = 1
    flat_colour, flat_depth = undistort_colour(colour, camera), undistort_depth(depth, camera)
    centre = np.argwhere(flat_colour[..., 0] > 127).mean(axis=0)
    assert np.linalg.norm(centre - (3, 4)) > 0.5
    assert np.linalg.norm(centre - np.argwhere(flat_depth > 0).mean(axis=0)) < 0.75


def test_depth_of_a_camera_of_its_own_is_laid_on_the_colour(folder):
    own = {"width": WIDTH // 2, "height": HEIGHT // 2}
    camera = json.loads((folder / "camera.json").read_text()) | {"depth": own}
    (folder / "camera.json").write_text(json.dumps(camera))
    with pytest.raises(DatasetError, match=r"16x12.*32x24"):
        open_sequence(folder)[0]
    for path in (folder / "depth").iterdir():
        cv2.imwrite(str(path), np.full((HEIGHT // 2, WIDTH // 2), 2000, np.uint16))
    sequence = open_sequence(folder)
    assert np.allclose(sequence[0].depth, 2)
    assert any("registered" in note for note in sequence.notes)


@pytest.mark.parametrize("suffix", ["png", "jpg"])
@pytest.mark.parametrize("share", [0.0, 0.5, 0.95])
def test_truncated_image_is_named(tmp_path, rng, suffix, share):
    path = tmp_path / f"cut.{suffix}"
    cv2.imwrite(str(path), rng.integers(0, 255, (60, 80, 3), dtype=np.uint8))
    data = path.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(DatasetError, match=r"cut\."):
        read_colour(path)


def test_colour_is_not_depth(tum):
    with pytest.raises(DatasetError, match="one channel of 16 bits; got 3"):
        read_depth(tum / "rgb/0.png", 5000)


def test_wrong_image_size_is_named(tum):
    write_camera(tum / "camera.json", Intrinsics(64, 48, 60, 60, 31.5, 23.5), 5000)
    with pytest.raises(DatasetError, match="expected 64x48; got 32x24"):
        open_sequence(tum)[0]


def _without(root, name):
    (root / name).unlink()
    return root


def test_folders_that_are_no_sequence(tmp_path, tum, folder):
    with pytest.raises(DatasetError, match="no such folder"):
        open_sequence(tmp_path / "nowhere")
    (tmp_path / "empty").mkdir()
    with pytest.raises(DatasetError, match="an empty folder"):
        open_sequence(tmp_path / "empty")
    with pytest.raises(DatasetError, match=r"depth\.txt"):
        open_sequence(_without(tum, "depth.txt"))
    with pytest.raises(DatasetError, match="camera unknown"):
        open_sequence(_without(folder, "camera.json"))


def test_tum_without_camera_needs_a_kinects_size(tum):
    with pytest.raises(DatasetError, match="camera unknown"):
        open_sequence(_without(tum, "camera.json"))


def test_bad_list_line_is_named(tum):
    (tum / "rgb.txt").write_text("10.0 rgb/0.png\nten rgb/1.png\n")
    with pytest.raises(DatasetError, match=r"rgb\.txt:2"):
        open_sequence(tum)


def test_stamps_too_far_apart(tum):
    (tum / "depth.txt").write_text("99.0 depth/0.png\n")
    with pytest.raises(DatasetError, match=r"within 0\.02 s"):
        open_sequence(tum)


def test_layout_can_be_guessed(tum, scenes, folder):
    assert [guess_layout(r) for r in (tum, scenes, folder)] == ["tum", "7scenes", "folder"]


class Bag:
    """A sequence that is one file on disk, its frames in memory; no dataclass."""

    ground_truth = places = None

    def __init__(self, root, camera, notes=("from a bag",)):
        self.name, self.root, self.camera, self.notes = root.stem, root, camera, notes
        self.stamps_s = np.arange(4) / 10

    def __len__(self):
        return len(self.stamps_s)

    def __iter__(self):
        return frames_of(self)

    def __getitem__(self, index):
        depth = np.full((HEIGHT, WIDTH), index / self.camera.depth_scale, np.float32)
        colour = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        return Frame(index, self.stamps_s[index], colour, depth, self.camera.intrinsics)

    def with_camera(self, camera):
        return Bag(self.root, camera, self.notes)

    def with_notes(self, *notes):
        return Bag(self.root, self.camera, (*self.notes, *notes))


class BagReader:
    name, files = "bag", "NAME.bag"

    def recognises(self, root):
        return root.suffix == ".bag"

    def open(self, root, camera=None):
        return Bag(root, camera or Camera(CAMERA, 1.0, "the bag"))


@pytest.fixture
def bag(tmp_path, monkeypatch):
    monkeypatch.setitem(READERS, "bag", BagReader())
    (tmp_path / "walk.bag").write_bytes(b"bag")
    return tmp_path / "walk.bag"


def test_a_new_layout_is_one_line_of_the_registry(bag, tmp_path):
    assert guess_layout(bag) == "bag"
    sequence = open_sequence(bag, depth_scale=100)
    assert isinstance(sequence, Sequence)
    assert sequence.notes == ("from a bag",)
    chosen = select(sequence, start=1, stride=2).with_notes("every other frame")
    assert [frame.depth.max() for frame in frames_of(chosen)] == pytest.approx([0.01, 0.03])
    assert chosen.notes == ("from a bag", "every other frame")
    (tmp_path / "empty").mkdir()
    with pytest.raises(DatasetError, match=r"depth\.txt \(tum\).*NAME\.bag \(bag\).*folder\|bag"):
        guess_layout(tmp_path / "empty")


def test_a_depth_camera_is_told_of_whatever_the_layout(bag, tmp_path):
    apart = np.eye(4)
    apart[0, 3] = 0.05
    write_camera(tmp_path / "rig.json", CAMERA, 10.0, DepthCamera(CAMERA, apart))
    sequence = open_sequence(bag, camera=tmp_path / "rig.json", depth_scale=1)
    assert sequence.camera.depth_scale == 1
    assert len(sequence.notes) == 2
    assert "50 mm beside" in sequence.notes[1]


def test_layouts_and_files_of_no_layout(tmp_path, tum):
    with pytest.raises(DatasetError, match=r"--dataset tmu; expected .* or color/ .*\(folder\)"):
        open_sequence(tum, "tmu")
    (tmp_path / "notes.txt").write_text("")
    with pytest.raises(DatasetError, match=r"known layout.*got a file"):
        open_sequence(tmp_path / "notes.txt")
    assert all(reader.name == name for name, reader in READERS.items())
