"""Rendered views compared where they are, and where they are not."""

import numpy as np
import pytest

from datasets import poses
from datasets.frame import Frame
from slam.overlap import FEWEST, overlap
from slam.range_image import glance_of

LEAST = 0.7


@pytest.fixture
def pair(rendered_sequence):
    """Two views of the walk at a glance, some steps apart, and the motion between them."""
    first, second = rendered_sequence[0], rendered_sequence[4]
    T = rendered_sequence.ground_truth.T_world_camera
    return first, second, poses.inverse(T[4]) @ T[0]


def _compared(first, second, T):
    return overlap(glance_of(first), glance_of(second), T)


def _with(frame, colour=None, depth=None):
    return Frame(
        frame.index, frame.stamp_s, frame.colour if colour is None else colour,
        frame.depth if depth is None else depth, frame.intrinsics,
    )  # fmt: skip


def test_a_surface_looks_the_same_where_the_camera_is(pair):
    common = _compared(*pair)
    assert common.depth_agreement > 0.95
    assert common.likeness > 0.9
    assert common.looks_alike(LEAST)


def test_it_looks_the_same_under_another_exposure(pair):
    first, second, T = pair
    darker = _with(second, (second.colour * 0.4 + 20).astype(np.uint8))
    assert _compared(first, darker, T).likeness == pytest.approx(
        _compared(first, second, T).likeness, abs=0.01
    )


def test_it_looks_different_where_the_camera_is_not(pair):
    first, second, T = pair
    aside = poses.pose(np.eye(3), np.array([0.8, 0.0, 0.0])) @ T
    assert _compared(first, second, aside).likeness < 0.6 < LEAST
    assert not _compared(first, second, aside).looks_alike(LEAST)


def test_what_the_other_sees_through_contradicts_and_what_it_hides_does_not(pair):
    first, second, _ = pair
    near = _with(first, depth=np.full_like(first.depth, 2))
    far = _with(second, depth=np.full_like(second.depth, 3))
    through, hidden = _compared(near, far, np.eye(4)), _compared(far, near, np.eye(4))
    assert (through.same, through.depth_agreement) == (0, 0.0)
    assert through.seen_through > FEWEST
    assert (hidden.same, hidden.seen_through) == (0, 0)
    half = _with(far, depth=np.where(np.arange(far.depth.shape[1]) < 160, 2, far.depth))
    assert _compared(near, half, np.eye(4)).depth_agreement == pytest.approx(0.5, abs=0.02)


def test_bare_surface_tells_nothing(pair, rng):
    first, second, T = pair
    bare, bare_too = (
        _with(view, rng.integers(120, 130, view.colour.shape, dtype=np.uint8))
        for view in (first, second)
    )
    common = _compared(bare, bare_too, T)
    assert common.likeness is None
    assert common.looks_alike(LEAST)


def test_nothing_in_common_is_no_agreement(pair):
    first, second, _ = pair
    away = np.diag([-1.0, 1.0, -1.0, 1.0])
    common = _compared(first, second, away)
    assert (common.same, common.depth_agreement) == (0, 0.0)
    assert not common.looks_alike(LEAST)
    no_depth = _with(second, depth=np.zeros_like(second.depth))
    assert not _compared(first, no_depth, np.eye(4)).looks_alike(LEAST)
