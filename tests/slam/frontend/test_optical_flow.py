"""Following a frame's corners through the rendered walk."""

import numpy as np

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.slam.features.extraction import FeatureExtractor, FeatureSettings
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.optical_flow import FlowSettings, FlowTracker
from roomgraph.slam.tracking import Anchor
from tests.slam.helpers import NOISE, motion_error

EXTRACTOR = FeatureExtractor(FeatureSettings())
TRACKER = FlowTracker(FlowSettings(), NOISE)
HERE = Anchor(0, np.eye(4))


def _view(frame):
    return View(frame, EXTRACTOR, 8.0)


def test_the_motion_between_frames_is_found(rendered_sequence):
    T = rendered_sequence.ground_truth.T_world_camera
    for i in (5, 25, 45):
        template = TRACKER.template(_view(rendered_sequence[i]), HERE)
        found = TRACKER.track(_view(rendered_sequence[i + 1]), template, np.eye(4))
        assert found is not None
        motion, pixels = found
        metres, radians = motion_error(motion.T_camera_reference, se3.inverse(T[i + 1]) @ T[i])
        assert metres < 0.02
        assert radians < 0.006
        assert len(pixels) == motion.count >= TRACKER.settings.min_inliers


def test_features_are_not_looked_for(rendered_sequence, monkeypatch):
    looked = []
    monkeypatch.setattr(FeatureExtractor, "extract_image", lambda *image: looked.append(image))
    view = _view(rendered_sequence[5])
    assert TRACKER.track(view, TRACKER.template(view, HERE), np.eye(4)) is not None
    assert not looked


def test_what_cannot_be_followed_gives_no_pose(rendered_sequence):
    frame = rendered_sequence[5]
    template = TRACKER.template(_view(frame), HERE)
    blank = Frame(0, 0.0, np.zeros_like(frame.colour), frame.depth, frame.intrinsics)
    assert TRACKER.track(_view(blank), template, np.eye(4)) is None
    assert len(TRACKER.template(_view(blank), HERE).pixels) == 0
    assert TRACKER.track(_view(frame), TRACKER.template(_view(blank), HERE), np.eye(4)) is None
    small = Frame(
        0, 0.0, np.ascontiguousarray(frame.colour[::2, ::2]),
        np.ascontiguousarray(frame.depth[::2, ::2]), frame.intrinsics,
    )  # fmt: skip
    assert TRACKER.track(_view(small), template, np.eye(4)) is None
    away = se3.pose(t=[0, 0, -20.0])
    assert TRACKER.track(_view(frame), template, away) is None
