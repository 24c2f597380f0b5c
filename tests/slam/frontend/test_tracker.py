"""Poses by features, where a prediction leads astray."""

import numpy as np

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.slam.features.extraction import FeatureExtractor, Features, FeatureSettings
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.local_map import LocalMap
from roomgraph.slam.frontend.tracker import Tracker, TrackerSettings
from roomgraph.slam.geometry.motion import MotionSettings
from tests.slam.helpers import CAMERA, NOISE, motion_error

DEPTH_M, PERIOD_M, SIZE = 1.5, 0.15, 16


class _Given(FeatureExtractor):
    """Finds the features that it was given."""

    def __init__(self, features: Features) -> None:
        super().__init__(FeatureSettings())
        self.features = features

    def extract_image(self, colour):
        return self.features


def _described(rng, descriptors):
    return (descriptors + 0.02 * rng.normal(size=descriptors.shape)).astype(np.float32)


def _wall(rng):
    """A wall with 200 marks, and 7 x 20 slats of which those in a row look all the same."""
    marks = np.column_stack([rng.uniform(-0.9, 0.9, 200), rng.uniform(-0.7, 0.0, 200)])
    columns, rows = np.meshgrid(np.arange(7) - 3, np.arange(20))
    slats = np.column_stack([PERIOD_M * columns.ravel(), 0.03 * rows.ravel() + 0.05])
    looks = np.vstack([rng.random((200, SIZE)), rng.random((20, SIZE))[rows.ravel()]])
    places = np.vstack([marks, slats])
    return np.column_stack([places, np.full(len(places), DEPTH_M)]), looks


def test_a_prediction_off_by_a_period_is_noticed(rng):
    points, looks = _wall(rng)
    T = se3.pose(t=(-0.1, 0.0, 0.0))
    astray = se3.pose(t=(-0.1 - PERIOD_M, 0.0, 0.0))
    count, owners = len(points), np.zeros(len(points), dtype=np.intp)
    around = LocalMap(0, points, _described(rng, looks), owners, np.arange(count))
    seen = CAMERA.project(se3.transform(T, points)) + rng.normal(0, 0.5, (count, 2))
    # Where the marks are looked for in vain, other things look a little like them.
    decoys = CAMERA.project(se3.transform(astray, points[:200])) + rng.uniform(-20, 20, (200, 2))
    pixels = np.vstack([seen, decoys])
    descriptors = np.vstack([looks, looks[:200] + 0.15 * rng.normal(size=(200, SIZE))])
    inside = np.all((pixels > 2) & (pixels < (637, 477)), axis=1)
    features = Features(
        pixels[inside], _described(rng, descriptors[inside]), np.ones(inside.sum(), np.float32)
    )
    frame = Frame(
        0, 0.0, np.zeros((480, 640, 3), np.uint8), np.full((480, 640), DEPTH_M, np.float32), CAMERA
    )
    view = View(frame, _Given(features), 8.0)
    tracker = Tracker(TrackerSettings(), MotionSettings(), NOISE)
    guided = tracker.guided(view, around, astray)
    assert guided is not None
    assert guided.inliers >= tracker.settings.guided_inliers
    assert motion_error(guided.motion.T_camera_reference, T)[0] > 0.1
    found = tracker.track(view, around, astray)
    assert found is not None
    assert motion_error(found.motion.T_camera_reference, T)[0] < 0.005
    assert found.inliers > guided.inliers
