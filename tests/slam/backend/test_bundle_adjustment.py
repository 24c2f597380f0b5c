"""Bundle adjustment of made-up cameras that see made-up landmarks."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.backend.bundle_adjustment import Observations, adjust
from tests.slam.helpers import CAMERA, NOISE, motion_error


@pytest.fixture
def scene(rng):
    """Five cameras, 200 landmarks, and what each camera sees of them, with noise."""
    points = np.column_stack([
        rng.uniform(-1.5, 1.5, 200), rng.uniform(-1, 1, 200), rng.uniform(2, 4, 200)
    ])  # fmt: skip
    T = np.array([
        se3.exponential(np.r_[rng.normal(0, 0.03, 3), rng.normal(0, 0.1, 3)]) for _ in range(5)
    ])  # fmt: skip
    cameras, landmarks = (index.ravel() for index in np.indices((5, 200)))
    local = np.concatenate([se3.transform(camera, points) for camera in T])
    pixels = CAMERA.project(local) + rng.normal(0, 0.5, (1000, 2))
    depths = local[:, 2] + rng.normal(size=1000) * NOISE.depth_sigma(local[:, 2])
    depths[::7] = np.nan
    return T, points, Observations(cameras, landmarks, pixels, depths)


def _disturbed(rng, T, held):
    moved = T.copy()
    for k in range(held, len(T)):
        moved[k] = se3.exponential(rng.normal(0, 0.02, 6)) @ T[k]
    return moved


def test_disturbed_cameras_and_landmarks_come_back(scene, rng):
    T, points, seen = scene
    start = _disturbed(rng, T, held=1)
    off = points + rng.normal(0, 0.03, points.shape)
    done = adjust(start, np.arange(5) >= 1, off, seen, CAMERA, NOISE)
    assert np.array_equal(done.T_camera_world[0], T[0])
    for found, truth in zip(done.T_camera_world[1:], T[1:], strict=True):
        metres, radians = motion_error(found, truth)
        assert metres < 0.004
        assert radians < 0.0015
    before = np.linalg.norm(off - points, axis=1).mean()
    assert np.linalg.norm(done.landmarks - points, axis=1).mean() < 0.3 * before
    assert done.inliers.mean() > 0.9


def test_wrong_observations_are_told_and_do_no_harm(scene, rng):
    T, points, seen = scene
    wrong = rng.choice(1000, 100, replace=False)
    seen.pixels[wrong] = rng.uniform((0, 0), (640, 480), (100, 2))
    done = adjust(_disturbed(rng, T, 1), np.arange(5) >= 1, points, seen, CAMERA, NOISE)
    assert max(motion_error(*pair)[0] for pair in zip(done.T_camera_world, T, strict=True)) < 0.006
    assert done.inliers[wrong].mean() < 0.1
