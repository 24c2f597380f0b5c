"""SLAM on a real short sequence: the rendered walk."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.sequence import frames_of, select
from roomgraph.slam.evaluation import compare
from roomgraph.slam.reconstruction.point_map import LiveMap
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import TrackingState
from tests.slam.helpers import way_of


def _track(sequence, settings=None, change=lambda frame: frame):
    slam = Slam(settings or SlamSettings())
    return slam, [slam.process(change(frame)) for frame in frames_of(sequence)]


def _error(slam, trackings, sequence):
    return compare(way_of(slam, trackings), sequence.ground_truth)


def _blank(frame):
    return Frame(
        frame.index, frame.stamp_s, np.full_like(frame.colour, 90), np.zeros_like(frame.depth),
        frame.intrinsics,
    )  # fmt: skip


def _textureless(frame):
    return Frame(
        frame.index, frame.stamp_s, np.full_like(frame.colour, 90), frame.depth, frame.intrinsics
    )


@pytest.fixture(scope="module")
def tracked(rendered_walk):
    from roomgraph.datasets.readers.registry import open_sequence

    sequence = open_sequence(rendered_walk)
    return (*_track(sequence), sequence)


def test_every_frame_is_tracked_to_centimetres(tracked):
    slam, trackings, sequence = tracked
    assert [t.state for t in trackings] == [TrackingState.OK] * len(sequence)
    assert _error(slam, trackings, sequence).ate_rmse_m < 0.02
    assert 2 <= len(slam.keyframes) < 0.6 * len(sequence)


@pytest.mark.parametrize("detector", ["sift", "orb"])
def test_other_detectors_track_too(rendered_sequence, detector):
    settings = SlamSettings.model_validate({"features": {"detector": detector}})
    sequence = select(rendered_sequence, frames=25)
    slam, trackings = _track(sequence, settings)
    assert all(t.state is TrackingState.OK for t in trackings)
    assert _error(slam, trackings, sequence).ate_rmse_m < 0.03


def test_procrustes_tracks_too(rendered_sequence):
    settings = SlamSettings.model_validate({"motion": {"method": "procrustes"}})
    sequence = select(rendered_sequence, frames=15)
    slam, trackings = _track(sequence, settings)
    assert all(t.state is TrackingState.OK for t in trackings)
    assert _error(slam, trackings, sequence).ate_rmse_m < 0.03


def test_blank_frames_are_skipped_and_the_camera_found_again(rendered_sequence):
    sequence = select(rendered_sequence, frames=30)
    slam, trackings = _track(sequence, change=lambda f: _blank(f) if 12 <= f.index < 17 else f)
    states = [t.state for t in trackings]
    assert states[12:17] == [TrackingState.SKIPPED] * 5
    assert all(t.T_world_camera is None and t.anchor is None for t in trackings[12:17])
    assert all(s.has_pose for s in states[17:])
    assert _error(slam, trackings, sequence).ate_rmse_m < 0.02


def test_depth_carries_on_where_there_is_no_texture(rendered_sequence):
    sequence = select(rendered_sequence, frames=24)
    slam, trackings = _track(
        sequence, change=lambda f: _textureless(f) if 10 <= f.index < 14 else f
    )
    assert [t.method for t in trackings[10:14]] == ["depth"] * 4
    error = _error(slam, trackings, sequence)
    assert error.errors_m[10:14].max() < 0.1
    assert error.ate_rmse_m < 0.05


def test_a_jump_elsewhere_is_lost_and_said_so(rendered_sequence):
    """Turned to noise, nothing fits: no pose may be made up."""
    rng = np.random.default_rng(0)

    def noise(frame):
        if frame.index < 5:
            return frame
        return Frame(
            frame.index, frame.stamp_s,
            rng.integers(0, 255, frame.colour.shape, dtype=np.uint8),
            rng.uniform(0.5, 5, frame.depth.shape).astype(np.float32), frame.intrinsics,
        )  # fmt: skip

    _, trackings = _track(select(rendered_sequence, frames=8), change=noise)
    assert [t.state for t in trackings[5:]] == [TrackingState.LOST] * 3
    assert all(t.anchor is None and t.T_world_camera is None for t in trackings[5:])


@pytest.mark.parametrize("submaps", [True, False])
def test_a_lost_camera_is_found_again(rendered_sequence, submaps):
    """A glance elsewhere and back, with a sub-map of its own for the glance and without."""
    order = [*range(6), 40, *range(3, 9)]
    slam = Slam(SlamSettings.model_validate({"loss": {"submaps": submaps}}))
    trackings = [slam.process(rendered_sequence[i]) for i in order]
    ok, lost, found = TrackingState.OK, TrackingState.LOST, TrackingState.RELOCALISED
    assert [t.state for t in trackings] == [*[ok] * 6, lost, found, *[ok] * 5]
    assert (trackings[6].anchor is not None) == submaps
    true = rendered_sequence.ground_truth.T_world_camera
    for tracking, i in zip(trackings[7:], order[7:], strict=True):
        assert slam.is_placed(tracking.anchor)
        moved = se3.inverse(true[0]) @ true[i]
        assert np.linalg.norm((slam.pose_of(tracking.anchor) - moved)[:3, 3]) < 0.02


def test_a_sketch_shows_the_map_as_it_was_when_it_was_asked_for(rendered_sequence):
    slam, draw = Slam(SlamSettings()), None
    for frame in frames_of(select(rendered_sequence, frames=60)):
        slam.process(frame)
        if draw is None and len(slam.keyframes) >= 3:
            draw = slam.map_sketcher()
            then, T_then = dict(slam.keyframes), slam.placed_poses
    slam.finish()
    assert draw is not None and len(then) < len(slam.keyframes)
    with ThreadPoolExecutor(1) as another:
        shown = another.submit(draw).result()
    every = slam.settings.map.sketch_every
    sketched = {k: keyframe for k, keyframe in then.items() if k % every == 0}
    wanted = LiveMap(slam.settings.map, slam.settings.noise).update(sketched, T_then)
    assert len(shown) and np.array_equal(shown.points_world, wanted.points_world)
    assert len(slam.map_sketcher()()) > len(shown)


def test_map_lies_on_the_rooms_surfaces(tracked):
    """Points seen in one frame's depth and mapped from many keyframes agree."""
    from scipy.spatial import cKDTree

    slam, trackings, sequence = tracked
    points = slam.build_map()
    assert len(points) > 5000
    assert points.points_world.dtype == np.float32
    assert set(np.unique(points.keyframes)) <= set(slam.keyframes)
    frame = sequence[30]
    rows, columns = np.nonzero((frame.depth > 0) & (frame.depth < 3.5))
    pick = np.random.default_rng(0).choice(len(rows), 500)
    pixels = np.column_stack([columns, rows])[pick].astype(float)
    seen = frame.intrinsics.backproject(pixels, frame.depth[rows, columns][pick])
    world = se3.transform(slam.pose_of(trackings[30].anchor), seen)
    distance, _ = cKDTree(points.points_world).query(world)
    assert np.median(distance) < 0.03


def test_noise_for_features_makes_no_keyframes_of_a_camera_at_rest(rendered_sequence):
    """What is not found again without a change of place would not be by a new keyframe."""
    rng = np.random.default_rng(0)
    first = rendered_sequence[0]

    def flickering(index):
        noise = rng.normal(0, 25, first.colour.shape)
        colour = np.clip(first.colour + noise, 0, 255).astype(np.uint8)
        return Frame(index, index / 30, colour, first.depth, first.intrinsics)

    # Features alone: corners could be followed all the same.
    settings = SlamSettings.model_validate({"flow": {"enabled": False}})
    slam = Slam(settings)
    trackings = [slam.process(flickering(i)) for i in range(10)]
    assert all(t.state is TrackingState.OK for t in trackings)
    assert sum(t.is_keyframe for t in trackings) == 1
