"""Gates for what is drawn as it grows, and as time goes on."""

import numpy as np
import pytest

from roomgraph.app.pacing import GrowthGate, TimeGate


def test_it_opens_for_the_first_and_then_by_steps_and_shares():
    gate = GrowthGate(5, 10)
    assert [size for size in range(0, 31) if gate.opens(size)] == [1, 6, 11, 16, 21, 26]
    large = [size for size in range(30, 200) if gate.opens(size)]
    assert large[:6] == [31, 36, 41, 46, 51, 56]
    assert large[-3:] == [151, 166, 182]


def test_all_drawings_of_a_large_thing_are_a_few_times_the_last():
    gate = GrowthGate(1, 16)
    drawn = [size for size in range(5000) if gate.opens(size)]
    assert sum(drawn) < 18 * drawn[-1]
    assert not gate.opens(drawn[-1] - 1)


@pytest.mark.parametrize(
    ("rate_hz", "shown_hz"), [(30, 20 / 3), (10, 20 / 3), (60, 20 / 3), (5, 5)]
)
def test_frames_are_shown_at_the_rate_asked_for_or_all_of_them(rate_hz, shown_hz, rng):
    gate = TimeGate(0.15)
    stamps = 1.7e9 + np.arange(60 * rate_hz) / rate_hz + rng.uniform(-0.004, 0.004, 60 * rate_hz)
    shown = sum(gate.opens(stamp) for stamp in stamps)
    assert shown == pytest.approx(60 * shown_hz, rel=0.03)


def test_what_matters_is_shown_out_of_turn_and_time_may_begin_anew():
    gate = TimeGate(1.0)
    opened = [gate.opens(t, t == 0.4) for t in (0.0, 0.2, 0.4, 0.6, 1.2, 1.4, 0.1, 0.2, 1.2)]
    assert opened == [True, False, True, False, False, True, True, False, True]


def test_after_a_long_gap_it_goes_on_as_before():
    gate = TimeGate(1.0)
    assert [gate.opens(t) for t in (0.0, 10.5, 11.0, 11.5, 12.0)] == [
        True,
        True,
        False,
        True,
        False,
    ]
