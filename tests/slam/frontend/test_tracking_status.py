"""Which phase each kind of frame leads to, and what is counted on the way."""

import logging

import numpy as np
import pytest

from roomgraph.datasets.frame import Frame
from roomgraph.slam.frontend.tracking_status import TrackingPhase, TrackingStatus
from tests.slam.helpers import CAMERA

INITIALISING, TRACKING, INTERRUPTED, LOST = TrackingPhase


def _frame(index):
    return Frame(index, 100.0 + index, np.zeros((1, 1, 3), np.uint8), np.zeros((1, 1)), CAMERA)


def _after(*transitions):
    """The status after one transition a frame."""
    status = TrackingStatus()
    for index, transition in enumerate(transitions):
        name, _, by = transition.partition(" by ")
        getattr(status, name)(_frame(index), **({"by_flow": by == "flow"} if by else {}))
    return status


@pytest.mark.parametrize(
    ("transitions", "phase"),
    [
        ((), INITIALISING),
        (("began",), TRACKING),
        (("began", "interrupted"), INTERRUPTED),
        (("began", "interrupted", "found by flow"), TRACKING),
        (("began", "interrupted", "lost"), LOST),
        (("began", "lost", "interrupted"), LOST),
        (("began", "lost", "interrupted", "found by features"), TRACKING),
        (("began", "lost", "began_submap"), TRACKING),
        (("began", "lost", "began_submap", "interrupted"), INTERRUPTED),
    ],
)
def test_each_kind_of_frame_leads_to_its_phase(transitions, phase):
    status = _after(*transitions)
    assert status.phase is phase
    assert status.is_initialising == (phase is INITIALISING)
    assert status.is_tracking == (phase is TRACKING)
    assert status.is_lost == (phase is LOST)


def test_the_moment_last_seen_is_that_of_the_last_frame_with_a_pose():
    assert _after("began").last_seen_s == 100.0
    assert _after("began", "found by flow", "lost", "interrupted").last_seen_s == 101.0
    assert _after("began", "lost", "began_submap").last_seen_s == 102.0


def test_lost_frames_are_counted_until_the_camera_is_found():
    lost = ["began", "lost", "lost", "interrupted"]
    assert _after(*lost).lost_in_a_row == 2
    assert _after(*lost, "began_submap").lost_in_a_row == 2
    assert _after(*lost, "began_submap", "lost").lost_in_a_row == 3
    assert _after(*lost, "found by features").lost_in_a_row == 0


@pytest.mark.parametrize(
    ("last", "expected"),
    [("found by flow", False), ("found by features", True), ("interrupted", True), ("lost", True)],
)
def test_features_will_be_needed_unless_flow_is_enough(last, expected):
    assert not _after("began").needs_features
    for before in ("found by flow", "found by features"):
        assert _after("began", before, last).needs_features is expected


def test_only_changes_are_logged_with_the_frame(caplog):
    with caplog.at_level(logging.INFO, "roomgraph.slam.frontend.tracking_status"):
        _after("began", "found by flow", "lost", "lost", "found by features")
    assert caplog.messages == [
        "frame 0: initialising -> tracking",
        "frame 2: tracking -> lost",
        "frame 4: lost -> tracking",
    ]
