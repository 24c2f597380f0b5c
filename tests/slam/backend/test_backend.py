"""What tracking sees of keyframes in the making."""

import threading

import numpy as np
import pytest

from roomgraph.datasets.sequence import select
from roomgraph.slam.backend.backend import IN_FLIGHT
from roomgraph.slam.backend.mapper import Mapper
from roomgraph.slam.slam import Slam, SlamSettings
from tests.helpers import frames_of


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
    insert, running = Mapper.insert, threading.Semaphore(0)

    def failing(self, keyframe, *arguments):
        if keyframe.id == 2:
            raise np.linalg.LinAlgError("made to fail")
        try:
            return insert(self, keyframe, *arguments)
        finally:
            running.release()

    monkeypatch.setattr(Mapper, "insert", failing)
    slam = Slam(wide_steps())
    with pytest.raises(np.linalg.LinAlgError):
        for frame in frames_of(select(rendered_sequence, stride=2)):
            slam.process(frame)
        slam.finish()
    constraints = slam.mapper.graph.constraints
    assert slam._backend._mappers.submit(lambda: True).result()
    assert slam.mapper.graph.constraints == constraints
