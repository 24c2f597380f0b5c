import numpy as np

from datasets import poses
from slam.features import Features
from slam.keyframe import Keyframe
from slam.map import build_map

from .helpers import CAMERA


def _keyframe(number, cloud, colour):
    return Keyframe(
        number, number, float(number), Features.none(), np.empty((0, 3)), (),
        cloud.astype(np.float32), np.tile(np.uint8(colour), (len(cloud), 1)), CAMERA,
    )  # fmt: skip


def test_a_voxel_holds_the_mean_of_its_points(rng):
    cloud = rng.uniform(0, 1, (4000, 3)).astype(np.float32)
    found = build_map([_keyframe(0, cloud, (10, 20, 30))], {0: np.eye(4)}, 0.1)
    cells = np.floor((cloud.astype(float) - cloud.min(axis=0)) / 0.1)
    _, inverse, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    means = np.array([cloud[inverse.ravel() == i].mean(axis=0) for i in range(len(count))])
    assert len(found) == len(count)
    assert np.allclose(
        np.sort(found.points_world.sum(axis=1)), np.sort(means.sum(axis=1)), atol=1e-5
    )
    assert (found.colours == (10, 20, 30)).all()


def test_a_point_belongs_to_the_keyframe_that_saw_it_from_nearest():
    near, far = np.array([[0.0, 0, 1.0]]), np.array([[0.0, 0, 3.0]])
    T = {0: np.eye(4), 1: poses.pose(t=(0, 0, -2.0))}
    found = build_map([_keyframe(1, far, (0, 0, 200)), _keyframe(0, near, (100, 0, 0))], T, 0.1)
    assert found.keyframes.tolist() == [0]
    assert found.colours.tolist() == [[50, 0, 100]]


def test_the_map_moves_with_its_keyframes(rng):
    cloud = rng.uniform(0, 1, (50, 3))
    keyframe, T = _keyframe(0, cloud, (1, 2, 3)), poses.pose(t=(5.0, 0, 0))
    here, there = (build_map([keyframe], {0: T}, 0.001) for T in (np.eye(4), T))
    moved = here.points_world[np.argsort(here.points_world[:, 0])] + (5, 0, 0)
    assert np.allclose(moved, there.points_world[np.argsort(there.points_world[:, 0])], atol=1e-5)


def test_thinning_and_nothing_at_all(rng):
    keyframe = _keyframe(0, rng.uniform(0, 1, (800, 3)), (1, 2, 3))
    assert len(build_map([keyframe], {0: np.eye(4)}, 1e-4, every=8)) == 100
    assert len(build_map([], {}, 0.1)) == 0
