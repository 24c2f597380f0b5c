import numpy as np
import pytest

from roomgraph.semantics.temporal.odometer import Odometer


def pan(count, turn_deg, noise=0.0, n=64, seed=0):
    """Unit views of a camera that turns so far in all; noise is fresh in each."""
    rng = np.random.default_rng(seed)
    angles = np.radians(np.linspace(0, turn_deg, count))
    views = np.zeros((count, n))
    views[:, 0], views[:, 1] = np.cos(angles), np.sin(angles)
    views += noise * rng.normal(size=views.shape)
    return views / np.linalg.norm(views, axis=1, keepdims=True)


def ways(views, positions=None):
    odometer = Odometer()
    positions = [None] * len(views) if positions is None else positions
    return [odometer.step(p, v) for p, v in zip(positions, views, strict=True)]


def test_known_positions_are_measured():
    positions = np.cumsum(np.full((6, 3), 0.1), axis=0)
    found = ways(pan(6, 0), positions)
    assert found[0] == 0.5
    np.testing.assert_allclose(found[1:], 0.1 * np.sqrt(3))


def test_where_a_position_is_missing_the_view_tells():
    positions = [np.zeros(3), None, np.full(3, 9.0)]
    found = ways(pan(3, 120), positions)
    assert 0 < found[1] <= 0.5
    assert 0 < found[2] <= 0.5


def test_views_with_nothing_in_common_are_independent():
    np.testing.assert_allclose(ways(np.eye(5)), 0.5)


def test_the_way_does_not_depend_on_the_frame_rate():
    slow, fast = (sum(ways(pan(count, 90, noise=0.01))[1:]) for count in (10, 300))
    assert slow == pytest.approx(fast, rel=0.3)


def test_noise_does_not_add_up_while_the_camera_stands_still():
    found = ways(pan(600, 0, noise=0.03))
    assert sum(found[1:]) < 0.1


def test_what_shows_nothing_is_no_way_and_the_next_is_compared_with_the_last():
    a, b = np.eye(2)
    assert ways([a, None, np.empty(0), a, b]) == [0.5, 0.0, 0.0, 0.0, 0.5]
