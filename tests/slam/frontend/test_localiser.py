"""Which means carries the camera, on frames of the rendered walk that were made worse."""

import cv2
import numpy as np

from roomgraph.datasets.frame import Frame
from roomgraph.slam.evaluation import compare
from roomgraph.slam.features.extraction import FeatureExtractor
from roomgraph.slam.frontend.motion_model import MotionModel
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import Anchor, TrackingState
from tests.slam.helpers import dark, way_of


def _track(sequence, frames, change):
    slam = Slam(SlamSettings())
    trackings = [slam.process(change(sequence[i])) for i in range(frames)]
    slam.finish()
    return trackings, compare(way_of(slam, trackings), sequence.ground_truth)


def _without_depth(frame):
    return Frame(
        frame.index, frame.stamp_s, frame.colour, np.zeros_like(frame.depth), frame.intrinsics
    )


def _blurred(frame):
    """As in a quick turn: a twentieth of the image's width."""
    return Frame(
        frame.index, frame.stamp_s, cv2.blur(frame.colour, (15, 1)), frame.depth, frame.intrinsics
    )


def test_blurred_frames_are_followed_from_one_to_the_next(rendered_sequence):
    trackings, error = _track(
        rendered_sequence, 26, lambda f: _blurred(f) if 10 <= f.index < 18 else f
    )
    # Where blur begins and ends nothing looks like the frame before; in between it does.
    assert [t.method for t in trackings[11:18]] == ["flow"] * 7
    assert all(t.state is TrackingState.OK for t in trackings)
    assert error.ate_rmse_m < 0.02


def test_frames_without_depth_are_followed_and_make_no_keyframes(rendered_sequence):
    trackings, error = _track(
        rendered_sequence, 20, lambda f: _without_depth(f) if 5 <= f.index < 9 else f
    )
    assert [t.state for t in trackings] == [TrackingState.OK] * 20
    assert not any(t.is_keyframe for t in trackings[5:9])
    assert error.ate_rmse_m < 0.02


def test_no_features_are_looked_for_where_there_is_no_depth(rendered_sequence, monkeypatch):
    slam = Slam(SlamSettings())
    for i in range(3):
        slam.process(rendered_sequence[i])
    slam.finish()
    monkeypatch.setattr(FeatureExtractor, "extract_image", None)
    for _ in range(3):
        # Far from the walk's beginning: flow cannot follow, and nothing else is tried.
        view = slam.prepare(_without_depth(rendered_sequence[55]))
        assert slam.process(view).state is TrackingState.SKIPPED


def test_motion_across_an_interruption_neither_counts_nor_holds(rendered_sequence, monkeypatch):
    slam, used = Slam(SlamSettings()), []
    for name in ("moved", "hold"):
        method = getattr(MotionModel, name)

        def noting(self, *arguments, method=method, name=name):
            used.append(name)
            return method(self, *arguments)

        monkeypatch.setattr(MotionModel, name, noting)
    both = ["hold", "moved"]
    for i, expected in ((0, []), (1, both), (None, []), (2, []), (3, both)):
        used.clear()
        frame = dark(rendered_sequence[2]) if i is None else rendered_sequence[i]
        state = slam.process(frame).state
        assert state is (TrackingState.SKIPPED if i is None else TrackingState.OK)
        assert used == expected


def _featured():
    """A run without optical flow: each pose is by features."""
    return Slam(SlamSettings.model_validate({"flow": {"enabled": False}}))


def test_views_by_features_are_believed_where_they_look_right(rendered_sequence):
    slam = _featured()
    trackings = [slam.process(rendered_sequence[i]) for i in range(0, 30, 3)]
    assert {t.method for t in trackings} == {"features"}
    assert all(t.state is TrackingState.OK for t in trackings)


def test_a_wrong_pose_is_put_right_by_features(rendered_sequence):
    """What a view is compared with must not depend on where the last one was believed to be."""
    slam = _featured()
    for i in range(12):
        slam.process(rendered_sequence[i])
    last = slam._localiser._last
    aside = last.T_keyframe_camera.copy()
    aside[0, 3] += 0.1
    slam._localiser._last = Anchor(last.keyframe, aside)
    tracking = slam.process(rendered_sequence[12])
    assert tracking.method == "features"
    true = rendered_sequence.ground_truth.T_world_camera
    moved = np.linalg.inv(true[0]) @ true[12]
    assert np.linalg.norm((tracking.T_world_camera - moved)[:3, 3]) < 0.01
