"""What tracking sees of keyframes in the making."""

import threading

import numpy as np
import pytest

from roomgraph.datasets.sequence import frames_of, select
from roomgraph.slam.backend.backend import IN_FLIGHT
from roomgraph.slam.backend.mapper import Mapper
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam


@pytest.fixture
def held(monkeypatch):
    """Hold the mapper back until the event is set."""
    free, insert = threading.Event(), Mapper.insert

    def waiting(self, *arguments):
        free.wait(30)
        return insert(self, *arguments)

    monkeypatch.setattr(Mapper, "insert", waiting)
    return free


def wide_steps():
    """Settings that make many keyframes."""
    return SlamSettings.model_validate({"keyframes": {"max_angle_deg": 1.0, "same_m": 0.001}})


def test_points_around_need_not_wait_for_the_map(rendered_sequence, held):
    slam = Slam(wide_steps())
    backend = slam._backend
    for frame in frames_of(select(rendered_sequence, stride=2)):
        tracking = slam.process(frame)
        if tracking.is_keyframe and tracking.anchor.keyframe == IN_FLIGHT - 1:
            break
    newest = tracking.anchor.keyframe
    assert set(backend.keyframes) == set()
    around = backend.around(newest)
    assert around.reference == newest
    assert len(set(around.owners.tolist())) == IN_FLIGHT
    own = around.points[around.owners == newest]
    assert own == pytest.approx(backend.known_points(newest))
    held.set()
    slam.finish()
    assert set(backend.keyframes) == set(range(IN_FLIGHT))
    assert backend.around(newest).points.shape[1] == 3


def test_a_failed_keyframe_leaves_the_map_at_rest(rendered_sequence, monkeypatch):
    """Of those after it, the one that runs comes to its end, and the waiting ones never begin."""
    failed, running, original = 2, 3, Mapper.insert
    begun, ended, runs, free = [], [], threading.Event(), threading.Event()

    def insert(self, keyframe, *arguments):
        begun.append(keyframe.id)
        if keyframe.id == failed:
            raise np.linalg.LinAlgError("made to fail")
        if keyframe.id == running:
            runs.set()
            free.wait(30)
        try:
            return original(self, keyframe, *arguments)
        finally:
            ended.append(keyframe.id)

    monkeypatch.setattr(Mapper, "insert", insert)
    slam = Slam(wide_steps())
    for frame in frames_of(select(rendered_sequence, stride=2)):
        tracking = slam.process(frame)
        if tracking.is_keyframe and tracking.anchor.keyframe == running + 1:
            break
    assert runs.wait(30)
    threading.Timer(0.5, free.set).start()
    with pytest.raises(np.linalg.LinAlgError, match="made to fail"):
        slam.finish()
    assert ended == [1, running]
    # Whatever still waited would run before this.
    assert slam._backend._mappers.submit(lambda: True).result()
    assert begun == [1, failed, running]


def test_closures_are_those_of_the_keyframes_taken_in(rendered_sequence):
    """What the mapper's thread finds meanwhile is not seen before."""
    slam = Slam(wide_steps())
    order = [*range(0, 60, 3), *range(59, -1, -3)]
    told = []
    for index in order:
        told += slam.process(rendered_sequence[index]).closures
        assert slam._backend._mappers.submit(lambda: True).result()
        assert {end for c in slam.closures for end in (c.keyframe, c.matched_keyframe)} <= set(
            slam.keyframes
        )
    told += slam.finish()
    assert told
    assert set(slam.closures) <= set(told)
    loops = {(c.second, c.first) for c in slam.pose_graph.constraints if c.is_loop}
    assert {(c.keyframe, c.matched_keyframe) for c in slam.closures} == loops
