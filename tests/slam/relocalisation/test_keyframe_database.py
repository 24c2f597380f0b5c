"""Keyframes kept on disk, and images located against them."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.errors import SlamError
from roomgraph.slam.features.extraction import Features, root
from roomgraph.slam.frontend.tracker import Tracker
from roomgraph.slam.relocalisation.descriptor_storage import stored
from roomgraph.slam.relocalisation.keyframe_database import (
    MAX_FEATURES,
    KeyframeDatabase,
    StoredKeyframe,
    database_of,
    joined,
    read_keyframe_database,
    write_keyframe_database,
)
from roomgraph.slam.relocalisation.relocaliser import Relocaliser, RelocaliserSettings
from roomgraph.slam.relocalisation.word_index import WordIndex, WordIndexSettings
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam

CAMERA = Intrinsics(640, 480, 525.0, 526.0, 319.5, 239.5)


def _binary(rng, count):
    return rng.integers(0, 256, (count, 32)).astype(np.uint8)


def _unit(rng, count):
    """As SURF and learned features are: of norm 1, with negative values."""
    values = rng.normal(size=(count, 64))
    return (values / np.linalg.norm(values, axis=1, keepdims=True)).astype(np.float32)


def _root_sift(rng, count):
    return root(rng.exponential(40, (count, 128)).astype(np.float32))


def _sift(rng, count):
    return np.rint(_root_sift(rng, count))


def _large(rng, count):
    """Beyond what float16 can hold."""
    return 1e6 * _unit(rng, count)


def _database(rng, random_poses, make):
    keyframes = []
    for i, count in enumerate((7, 0, 3)):
        descriptors = make(rng, count)
        features = Features(
            rng.uniform(0, 480, (count, 2)), descriptors, rng.uniform(2, 60, count).astype("f4")
        )
        points = rng.uniform(0.5, 6, (count, 3))
        keyframes.append(StoredKeyframe(3 * i, 0.1 * i, random_poses[i], features, points))
    return KeyframeDatabase(tuple(keyframes), CAMERA)


def _make_first_form(path):
    """Turn a file into one of the first form."""
    with np.load(path) as file:
        values = dict(file)
    is_binary = str(values.pop("descriptor_storage")) == "binary"
    values |= {"schema": np.array("roomgraph/keyframes/1"), "is_binary": np.array(is_binary)}
    assert values["descriptors"].dtype == np.uint8
    np.savez(path, **values)


@pytest.mark.parametrize(
    ("make", "storage", "error"),
    [
        (_binary, "binary", 0),
        (_sift, "bytes", 0),
        (_root_sift, "bytes", 0.5),
        (_unit, "float16", 5e-4),
        (_large, "float32", 0),
    ],
)
def test_a_database_survives_the_disk(rng, random_poses, tmp_path, make, storage, error):
    database, path = _database(rng, random_poses, make), tmp_path / "keyframes.npz"
    write_keyframe_database(path, database)
    with np.load(path) as file:
        assert str(file["schema"]) == "roomgraph/keyframes/2"
        assert str(file["descriptor_storage"]) == storage
        assert file["descriptors"].dtype == (storage if "float" in storage else np.uint8)
    _assert_alike(database, read_keyframe_database(path), error)


@pytest.mark.parametrize("make", [_binary, _sift])
def test_files_of_the_first_form_still_open(rng, random_poses, tmp_path, make):
    database, path = _database(rng, random_poses, make), tmp_path / "keyframes.npz"
    write_keyframe_database(path, database)
    _make_first_form(path)
    _assert_alike(database, read_keyframe_database(path), 0)


@pytest.mark.parametrize("storage", ["float64", "float16"])
def test_descriptors_stored_otherwise_than_said_are_refused(rng, random_poses, tmp_path, storage):
    path = tmp_path / "keyframes.npz"
    write_keyframe_database(path, _database(rng, random_poses, _sift))
    with np.load(path) as file:
        values = dict(file)
    np.savez(path, **values | {"descriptor_storage": np.array(storage)})
    with pytest.raises(SlamError, match=f"stored as {storage} in uint8"):
        read_keyframe_database(path)


@pytest.mark.parametrize(
    "change", [lambda d: -d, lambda d: d / 512, lambda d: 2 * d, lambda d: 256 * (d == d.max())]
)
def test_only_what_sift_makes_is_stored_as_bytes(rng, change):
    descriptors = _sift(rng, 5)
    assert stored(descriptors)[0] == "bytes"
    assert stored(change(descriptors).astype(np.float32))[0] == "float16"


def _assert_alike(database, read, error):
    assert read.intrinsics == CAMERA
    assert np.array_equal(read.positions, database.positions)
    for ours, theirs in zip(database.keyframes, read.keyframes, strict=True):
        assert (ours.id, ours.stamp_s) == (theirs.id, theirs.stamp_s)
        assert np.array_equal(ours.T_world_keyframe, theirs.T_world_keyframe)
        assert np.allclose(ours.points, theirs.points, atol=1e-6)
        assert np.allclose(ours.features.pixels, theirs.features.pixels, atol=1e-4)
        assert np.allclose(ours.features.sizes, theirs.features.sizes, rtol=1e-3)
        off = np.abs(ours.features.descriptors.astype(float) - theirs.features.descriptors)
        assert off.max(initial=0) <= error
        assert ours.features.descriptors.dtype == theirs.features.descriptors.dtype


def test_what_is_no_database_is_refused(tmp_path):
    path = tmp_path / "keyframes.npz"
    with pytest.raises(SlamError, match="keyframe database not found"):
        read_keyframe_database(path)
    path.write_bytes(b"PK nonsense")
    with pytest.raises(SlamError, match="keyframe database cannot be read"):
        read_keyframe_database(path)
    np.savez(path, schema=np.array("something/else"))
    with pytest.raises(SlamError, match=r"something/else[\s\S]*roomgraph run"):
        read_keyframe_database(path)
    np.savez(path, schema=np.array([{}], dtype=object))
    with pytest.raises(SlamError, match="keyframe database cannot be read"):
        read_keyframe_database(path)


def test_joined_keyframes_share_one_frame(rng, random_poses):
    database = _database(rng, random_poses, _sift)
    around = joined([database.keyframes[2], database.keyframes[0]])
    world = se3.transform(database.keyframes[2].T_world_keyframe, around.points)
    expected = np.concatenate(
        [se3.transform(k.T_world_keyframe, k.points) for k in database.keyframes[::-1]]
    )
    assert np.allclose(world, expected)
    assert around.owners.tolist() == [6] * 3 + [0] * 7


def test_words_of_a_query_leave_the_vocabulary_alone(rng):
    index = WordIndex(WordIndexSettings())
    assert len(index.words_of(rng.uniform(0, 90, (5, 128)).astype("f4"), grow=False)) == 0
    known = rng.uniform(0, 90, (50, 128)).astype("f4")
    words = index.words_of(known)
    assert len(index.words_of(1000 + known, grow=False)) == 0
    assert np.array_equal(index.words_of(known, grow=False), words)


@pytest.fixture(scope="module")
def mapped(rendered_walk):
    """Every other frame of the walk, mapped; the walk itself; the database."""
    from roomgraph.datasets.readers.registry import open_sequence

    walk = open_sequence(rendered_walk)
    slam = Slam(SlamSettings())
    for index in range(0, len(walk), 2):
        slam.process(walk[index])
    slam.finish()
    database = database_of(slam.keyframes.values(), slam.keyframe_poses)
    return slam, walk, database


def _relocaliser(database):
    settings = SlamSettings()
    tracker = Tracker(settings.tracker, settings.motion, settings.noise)
    return Relocaliser(database, tracker, RelocaliserSettings(), settings.word_index)


@pytest.mark.parametrize("with_depth", [True, False])
def test_held_back_frames_are_located(mapped, tmp_path, with_depth):
    slam, walk, database = mapped
    write_keyframe_database(tmp_path / "keyframes.npz", database)
    relocaliser = _relocaliser(read_keyframe_database(tmp_path / "keyframes.npz"))
    T_true = walk.ground_truth.T_world_camera
    right = 0
    held_back = range(1, len(walk), 2)
    for index in held_back:
        frame = walk[index]
        depth = frame.depth if with_depth else np.zeros_like(frame.depth)
        view = slam.prepare(Frame(0, 0.0, frame.colour, depth, frame.intrinsics))
        T = relocaliser.locate(view).T_world_camera
        if T is not None:
            error = se3.inverse(se3.inverse(T_true[0]) @ T_true[index]) @ T
            near = np.linalg.norm(error[:3, 3]) < 0.1
            right += bool(near and np.degrees(se3.rotation_angle(error)) < 3)
    assert right >= 0.9 * len(held_back)


def test_the_same_database_gives_the_same_answers(mapped):
    slam, walk, database = mapped
    views = [slam.prepare(frame) for frame in (walk[11], walk[41])]
    forward = [_relocaliser(database).locate(view).T_world_camera for view in views]
    one = _relocaliser(database)
    backward = [one.locate(view).T_world_camera for view in views[::-1]][::-1]
    assert all(np.array_equal(a, b) for a, b in zip(forward, backward, strict=True))


def test_an_image_of_nothing_has_no_pose(mapped):
    slam, walk, database = mapped
    blank = Frame(
        0, 0.0, np.full((240, 320, 3), 90, np.uint8), np.ones((240, 320), "f4"),
        walk.camera.intrinsics,
    )  # fmt: skip
    found = _relocaliser(database).locate(slam.prepare(blank))
    assert found.T_world_camera is None


def test_no_more_features_are_kept_than_is_said(mapped):
    database = mapped[2]
    assert all(len(k.features) <= MAX_FEATURES for k in database.keyframes)
