"""Keyframes in a row that see the same points, their landmarks, and their adjustment."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.backend.local_bundle_adjustment import (
    LocalBundleAdjustment,
    LocalBundleAdjustmentSettings,
)
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.keyframe import Keyframe
from tests.slam.helpers import CAMERA, NOISE, motion_error

COUNT, POINTS = 6, 150


def _keyframe(number, points, rng):
    """A keyframe that measures points (N, 3), given in its camera, with noise."""
    pixels = CAMERA.project(points) + rng.normal(0, 0.5, (len(points), 2))
    z = points[:, 2] + rng.normal(size=len(points)) * NOISE.depth_sigma(points[:, 2])
    features = Features(pixels, np.zeros((len(points), 8), np.float32), np.ones(len(points), "f4"))
    nothing = RangeImage(np.zeros((3, 4), np.uint16), np.zeros((3, 4, 3), np.uint8), CAMERA)
    return Keyframe(
        id=number,
        frame_index=number,
        stamp_s=float(number),
        features=features,
        points=CAMERA.backproject(pixels, z),
        words=np.empty(0, dtype=np.intp),
        planes=(),
        image=nothing,
        intrinsics=CAMERA,
    )


@pytest.fixture
def row(rng):
    """Six keyframes a hand's breadth apart, and where they are."""
    points = np.column_stack([
        rng.uniform(-1.5, 1.5, POINTS), rng.uniform(-1, 1, POINTS), rng.uniform(2, 4, POINTS)
    ])  # fmt: skip
    T_world = {k: se3.pose(t=(0.1 * k, 0.0, 0.0)) for k in range(COUNT)}
    keyframes = {
        k: _keyframe(k, se3.transform(se3.inverse(T), points), rng) for k, T in T_world.items()
    }
    return keyframes, T_world


def _window(keyframes, **settings):
    """A window to which each keyframe is matched with the one before."""
    window, same = (
        LocalBundleAdjustment(LocalBundleAdjustmentSettings(**settings), NOISE),
        np.arange(POINTS),
    )
    for k, keyframe in keyframes.items():
        window.add(keyframe)
        if k:
            window.match(keyframe, keyframes[k - 1], np.column_stack([same, same]))
    return window


def _disturbed(T_world, rng, moving):
    return {
        k: se3.exponential(rng.normal(0, 0.01, 6)) @ T if k in moving else T
        for k, T in T_world.items()
    }


def _errors(found, T_world):
    return {k: motion_error(T, T_world[k])[0] for k, T in found.items()}


def test_the_latest_come_back_and_the_older_are_held(row, rng):
    keyframes, T_world = row
    window = _window(keyframes, size=3)
    start = _disturbed(T_world, rng, moving={3, 4, 5})
    found = window.adjust(5, set(keyframes), keyframes, start)
    assert set(found) == set(keyframes)
    for k in (0, 1, 2):
        assert np.allclose(found[k], T_world[k], atol=1e-12)
    assert max(_errors(start, T_world).values()) > 0.01
    assert max(_errors(found, T_world).values()) < 0.005


def test_without_older_ones_the_first_is_held(row, rng):
    keyframes, T_world = row
    start = _disturbed(T_world, rng, moving=set(range(1, COUNT)))
    found = _window(keyframes, size=COUNT).adjust(5, set(keyframes), keyframes, start)
    assert np.allclose(found[0], T_world[0], atol=1e-12)
    assert max(_errors(found, T_world).values()) < 0.005


def test_wrong_matches_lose_their_landmarks(row):
    keyframes, T_world = row
    window, same = _window({k: keyframes[k] for k in range(5)}), np.arange(POINTS)
    window.add(keyframes[5])
    rows = np.column_stack([same, np.r_[np.roll(same[:20], 7), same[20:]]])
    window.match(keyframes[5], keyframes[4], rows)
    found = window.adjust(5, set(keyframes), keyframes, T_world)
    assert _errors(found, T_world)[5] < 0.006
    # What was wrong is free again: matched rightly it becomes the landmark that the others see.
    window.match(keyframes[5], keyframes[4], np.column_stack([same, same]))
    again = window.adjust(5, set(keyframes), keyframes, found)
    assert _errors(again, T_world)[5] < 0.005
    assert len(set(window._landmark[5][:20].tolist()) & set(window._landmark[4].tolist())) >= 15


def test_few_shared_landmarks_are_not_adjusted(row, rng):
    keyframes, T_world = row
    window = _window({k: keyframes[k] for k in range(5)})
    window.add(keyframes[5])
    window.match(keyframes[5], keyframes[4], np.column_stack([np.arange(10), np.arange(10)]))
    assert window.adjust(5, set(keyframes), keyframes, T_world) == {}


def test_no_more_landmarks_than_asked_for_while_many_have_many_views(row):
    keyframes, _ = row
    few = np.arange(60)
    window = _window({k: keyframes[k] for k in range(5)}, landmarks=50)
    window.add(keyframes[5])
    window.match(keyframes[5], keyframes[4], np.column_stack([few, few]))
    # 150 landmarks have five views, 60 of them six: with 50 wanted and 150 more than twice that,
    # those with six views are taken.
    _, _, landmarks = window._observations(list(range(COUNT)))
    assert len(np.unique(landmarks)) == 60


def test_a_landmark_moves_with_the_keyframe_that_owns_it(row):
    keyframes, T_world = row
    window = _window(keyframes, size=3)
    shift = se3.exponential(np.array([0.1, -0.2, 0.3, 4.0, 5.0, -6.0]))
    moved = {k: shift @ T for k, T in T_world.items()}
    here = window.adjust(5, set(keyframes), keyframes, T_world)
    there = _window(keyframes, size=3).adjust(5, set(keyframes), keyframes, moved)
    for k, T in here.items():
        assert np.allclose(shift @ T, there[k], atol=1e-6)
