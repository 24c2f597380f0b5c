"""A camera that is cut off: sub-maps begin, wait, and are joined where they meet."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.slam.evaluation import compare
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import TrackingState
from tests.slam.helpers import dark


def _run(sequence, order, change=lambda frame: frame, settings=None):
    """Track frames of a sequence in another order, stamped as they come."""
    slam, trackings = Slam(settings or SlamSettings()), []
    for n, i in enumerate(order):
        frame = change(sequence[i])
        trackings.append(
            slam.process(Frame(n, 100.0 + n / 30, frame.colour, frame.depth, frame.intrinsics))
        )
    slam.finish()
    return slam, trackings


def _ate(slam, trackings, sequence, order):
    placed = [
        (t, i)
        for t, i in zip(trackings, order, strict=True)
        if t.anchor is not None and slam.is_placed(t.anchor)
    ]
    stamps = np.array([t.stamp_s for t, _ in placed])
    truth = sequence.ground_truth.T_world_camera[[i for _, i in placed]]
    estimate = Trajectory(stamps, np.array([slam.pose_of(t.anchor) for t, _ in placed]))
    return compare(estimate, Trajectory(stamps, truth)).ate_rmse_m, len(placed)


def _mirrored(frame):
    """A world that is nowhere in the map: left and right exchanged."""
    return Frame(
        frame.index, frame.stamp_s, np.ascontiguousarray(frame.colour[:, ::-1]),
        np.ascontiguousarray(frame.depth[:, ::-1]), frame.intrinsics,
    )  # fmt: skip


@pytest.fixture(scope="module")
def rejoined(rendered_walk):
    """A jump, which begins a sub-map, and the way back, which joins it to the map."""
    sequence = open_sequence(rendered_walk)
    order = [*range(18), *range(48, 60), *range(59, 5, -1)]
    return (*_run(sequence, order), sequence, order)


def test_a_jump_and_the_way_back_are_one_map_in_the_end(rejoined):
    slam, trackings, sequence, order = rejoined
    assert trackings[18].state is not TrackingState.OK
    assert slam.pose_graph.components == 1
    error, placed = _ate(slam, trackings, sequence, order)
    assert placed == len(order)
    assert error < 0.03


def test_what_is_anchored_moves_with_its_keyframe(rejoined):
    """The sub-map moves to its place at last: frames stay where they are before their keyframe."""
    slam, trackings, sequence, order = rejoined
    true = sequence.ground_truth.T_world_camera[order]
    first = trackings[18].anchor.keyframe
    begun = next(t for t in trackings if t.is_keyframe and t.anchor.keyframe == first)
    hung = [t for t in trackings if t.anchor.keyframe == first and not t.is_keyframe]
    assert hung
    for tracking in hung:
        T_then, T_now = tracking.T_world_camera, slam.pose_of(tracking.anchor)
        assert np.linalg.norm((T_now - T_then)[:3, 3]) > 0.5
        before = se3.inverse(begun.T_world_camera) @ T_then
        now = se3.inverse(slam.keyframe_poses[first]) @ T_now
        assert now == pytest.approx(before, abs=1e-6)
        seen = se3.inverse(true[begun.index]) @ true[tracking.index]
        assert now == pytest.approx(seen, abs=0.01)


def test_what_never_meets_the_map_is_kept_apart(rendered_sequence):
    order = [*range(25), *range(30, 45)]
    slam, trackings = _run(rendered_sequence, order, lambda f: f if f.index < 25 else _mirrored(f))
    assert trackings[25].state is TrackingState.LOST
    assert slam.pose_graph.components >= 2
    error, placed = _ate(slam, trackings, rendered_sequence, order)
    assert placed == 25
    assert error < 0.02
    assert all(slam.is_placed(t.anchor) for t in trackings[:25])
    in_map = set(slam.build_map().keyframes.tolist())
    assert in_map <= {t.anchor.keyframe for t in trackings[:25]}


def test_a_cut_of_blank_frames_is_bridged(rendered_sequence):
    order = list(range(60))
    slam, trackings = _run(rendered_sequence, order, lambda f: dark(f) if 20 <= f.index < 30 else f)
    assert all(t.state is TrackingState.SKIPPED for t in trackings[20:30])
    error, placed = _ate(slam, trackings, rendered_sequence, order)
    assert all(slam.is_placed(t.anchor) for t in trackings[:20])
    assert error < 0.03
    assert placed >= 20


def test_the_outcome_does_not_depend_on_which_thread_is_faster(rendered_sequence, monkeypatch):
    """With keyframes made at once instead of in the background, every byte is the same."""
    import time

    from roomgraph.slam.backend.mapper import Mapper

    order = list(range(30))
    slam, trackings = _run(rendered_sequence, order)
    insert = Mapper.insert

    def slow(self, *arguments):
        time.sleep(0.2)
        return insert(self, *arguments)

    monkeypatch.setattr(Mapper, "insert", slow)
    slow_slam, slow_trackings = _run(rendered_sequence, order)
    for one, other in zip(trackings, slow_trackings, strict=True):
        assert np.array_equal(one.T_world_camera, other.T_world_camera)
        assert np.array_equal(slam.pose_of(one.anchor), slow_slam.pose_of(other.anchor))
