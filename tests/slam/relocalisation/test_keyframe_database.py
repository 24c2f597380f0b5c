"""Keyframes kept on disk, and images located against them."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.errors import SlamError
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.frontend.tracker import Tracker
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
from roomgraph.slam.slam import Slam, SlamSettings

CAMERA = Intrinsics(640, 480, 525.0, 526.0, 319.5, 239.5)


def _database(rng, random_poses, is_binary):
    keyframes = []
    for i, count in enumerate((7, 0, 3)):
        descriptors = rng.integers(0, 256, (count, 32 if is_binary else 128)).astype(
            np.uint8 if is_binary else np.float32
        )
        features = Features(
            rng.uniform(0, 480, (count, 2)), descriptors, rng.uniform(2, 60, count).astype("f4")
        )
        points = rng.uniform(0.5, 6, (count, 3))
        keyframes.append(StoredKeyframe(3 * i, 0.1 * i, random_poses[i], features, points))
    return KeyframeDatabase(tuple(keyframes), CAMERA)


@pytest.mark.parametrize("is_binary", [False, True])
def test_a_memory_survives_the_disk(rng, random_poses, tmp_path, is_binary):
    database = _database(rng, random_poses, is_binary)
    write_keyframe_database(tmp_path / "keyframes.npz", database)
    read = read_keyframe_database(tmp_path / "keyframes.npz")
    assert read.intrinsics == CAMERA
    assert np.array_equal(read.positions, database.positions)
    for ours, theirs in zip(database.keyframes, read.keyframes, strict=True):
        assert (ours.id, ours.stamp_s) == (theirs.id, theirs.stamp_s)
        assert np.array_equal(ours.T_world_keyframe, theirs.T_world_keyframe)
        assert np.allclose(ours.points, theirs.points, atol=1e-6)
        assert np.allclose(ours.features.pixels, theirs.features.pixels, atol=1e-4)
        assert np.allclose(ours.features.sizes, theirs.features.sizes, rtol=1e-3)
        assert np.array_equal(ours.features.descriptors, theirs.features.descriptors)
        assert ours.features.descriptors.dtype == theirs.features.descriptors.dtype


def test_what_is_no_memory_is_refused(tmp_path):
    path = tmp_path / "keyframes.npz"
    with pytest.raises(SlamError, match="no keyframes"):
        read_keyframe_database(path)
    path.write_bytes(b"PK nonsense")
    with pytest.raises(SlamError, match="not understood"):
        read_keyframe_database(path)
    np.savez(path, schema=np.array("something/else"))
    with pytest.raises(SlamError, match=r"something/else[\s\S]*roomgraph run"):
        read_keyframe_database(path)
    np.savez(path, schema=np.array([{}], dtype=object))
    with pytest.raises(SlamError, match="not understood"):
        read_keyframe_database(path)


def test_joined_keyframes_share_one_frame(rng, random_poses):
    database = _database(rng, random_poses, is_binary=False)
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


def test_the_same_memory_gives_the_same_answers(mapped):
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
