"""Rendered views compared where they are, and where they are not."""

import cv2
import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.slam.backend.alignment import KeyframeAligner
from roomgraph.slam.backend.loop_closing import LoopCloser
from roomgraph.slam.frontend.tracker import Tracker
from roomgraph.slam.geometry.overlap import FEWEST, overlap
from roomgraph.slam.geometry.range_image import thumbnail_of
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam

LEAST = 0.7


@pytest.fixture
def pair(rendered_sequence):
    """Two views of the walk at a glance, some steps apart, and the motion between them."""
    first, second = rendered_sequence[0], rendered_sequence[4]
    T = rendered_sequence.ground_truth.T_world_camera
    return first, second, se3.inverse(T[4]) @ T[0]


def _compared(first, second, T):
    return overlap(thumbnail_of(first), thumbnail_of(second), T)


def _with(frame, colour=None, depth=None):
    return Frame(
        frame.index, frame.stamp_s, frame.colour if colour is None else colour,
        frame.depth if depth is None else depth, frame.intrinsics,
    )  # fmt: skip


def test_a_surface_looks_the_same_where_the_camera_is(pair):
    common = _compared(*pair)
    assert common.depth_agreement > 0.95
    assert common.correlation > 0.9
    assert common.looks_alike(LEAST)


@pytest.mark.parametrize("gain", [0.1, 0.4, 1.5])
def test_it_looks_the_same_under_another_gain(pair, gain):
    first, second, T = pair
    other = _with(second, np.clip(second.colour * gain + 3, 0, 255).astype(np.uint8))
    assert _compared(first, other, T).correlation > 0.85


def test_it_looks_different_where_the_camera_is_not(pair):
    first, second, T = pair
    aside = se3.pose(np.eye(3), np.array([0.8, 0.0, 0.0])) @ T
    assert _compared(first, second, aside).correlation < 0.6 < LEAST
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


def test_a_wall_that_darkens_downwards_is_not_alike_for_that(pair, rng):
    """Most walls do; what hangs on them counts."""
    first, second, _ = pair
    height, width = first.depth.shape
    shade = np.linspace(190, 60, height)[:, None, None]
    flat = np.full_like(first.depth, 2)

    def wall():
        pictures = cv2.resize(rng.normal(0, 35, (24, 32, 1)), (width, height))[:, :, None]
        return np.clip(shade + pictures, 0, 255).astype(np.uint8).repeat(3, axis=2)

    views = [_with(view, wall(), flat) for view in (first, second)]
    # As they are, the views correlate well.
    assert np.corrcoef(views[0].colour.mean(2).ravel(), views[1].colour.mean(2).ravel())[0, 1] > 0.6
    assert abs(_compared(*views, np.eye(4)).correlation) < 0.4


def test_bare_surface_tells_nothing_but_that_it_is_bare(pair, rng):
    first, second, T = pair
    bare, bare_too = (
        _with(view, rng.integers(120, 130, view.colour.shape, dtype=np.uint8))
        for view in (first, second)
    )
    common = _compared(bare, bare_too, T)
    assert common.correlation is None
    assert common.looks_alike(LEAST)
    assert not _compared(first, bare_too, T).looks_alike(LEAST)
    grey = _with(second, np.full_like(second.colour, 128))
    assert not _compared(first, grey, T).looks_alike(LEAST)


def test_clipped_cells_tell_nothing(pair):
    first, second, T = pair
    white = second.colour.copy()
    white[:, 152:] = 255
    assert _compared(first, _with(second, white), T).correlation > 0.7


def test_nothing_in_common_is_no_agreement(pair):
    first, second, _ = pair
    away = np.diag([-1.0, 1.0, -1.0, 1.0])
    no_depth = _with(second, depth=np.zeros_like(second.depth))
    for common in (_compared(first, second, away), _compared(first, no_depth, np.eye(4))):
        assert (common.same, common.seen_through, common.depth_agreement) == (0, 0, 0.0)
        assert common.correlation is None


def test_a_loop_rests_on_matches_on_depth_and_on_looks(pair):
    frame, _, _ = pair
    slam = Slam(SlamSettings())
    slam.process(frame)
    slam.finish()
    keyframe, s = slam.keyframes[0], slam.settings
    aligner = KeyframeAligner(Tracker(s.tracker, s.motion, s.noise), s.icp, s.noise)
    loops = LoopCloser(s.loops, s.word_index, aligner)

    def is_sound(other, inliers=100):
        return loops.is_sound(inliers, np.eye(4), slam.prepare(other), keyframe)

    assert is_sound(frame)
    assert not is_sound(frame, inliers=loops.settings.min_inliers - 1)
    assert not is_sound(_with(frame, depth=frame.depth + 1))
    assert not is_sound(_with(frame, colour=np.ascontiguousarray(frame.colour[:, ::-1])))
