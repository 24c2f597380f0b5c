"""A sequence played forward and backward."""

import numpy as np

from roomgraph.datasets.replay import PingPongReplay


def test_frames_run_back_and_forth_while_time_goes_on(rendered_sequence):
    laps = PingPongReplay(rendered_sequence, 2)
    last = len(rendered_sequence) - 1
    assert len(laps) == 2 * 2 * last
    steps = np.diff(laps.stamps_s)
    assert np.allclose(steps, np.median(np.diff(rendered_sequence.stamps_s)), atol=1e-4)
    for there, back in ((3, 2 * last - 3), (10, 2 * last + 10)):
        assert np.array_equal(laps[there].colour, laps[back].colour)
        assert laps[back].index == back
        assert laps[back].stamp_s == laps.stamps_s[back]


def test_true_poses_are_repeated_with_the_frames(rendered_sequence):
    laps, truth = PingPongReplay(rendered_sequence, 1), rendered_sequence.ground_truth
    last = len(rendered_sequence) - 1
    assert len(laps.ground_truth) == len(laps)
    T = laps.ground_truth.T_world_camera
    assert np.array_equal(T[2 * last - 7], T[7])
    nearest = truth.nearest(rendered_sequence.stamps_s[[7]], 0.01)[0]
    assert np.array_equal(T[7], truth.T_world_camera[nearest])
