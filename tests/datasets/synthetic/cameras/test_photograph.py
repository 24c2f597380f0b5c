"""What a phone's camera does: exposure, white balance, motion blur, noise and highlights."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.se3 import exponential
from roomgraph.datasets.synthetic.cameras.photograph import (
    READ_NOISE,
    SHOT_NOISE,
    develop_real,
    exposure_series,
    motion_blur,
    white_balance_series,
)

CAMERA = Intrinsics(320, 240, 260.0, 260.0, 159.5, 119.5)
FAR = np.zeros((240, 320), dtype=np.float32)
NEUTRAL = np.ones(3)


def motion(turn=(0.0, 0.0, 0.0), shift=(0.0, 0.0, 0.0)):
    return exponential(np.concatenate([np.asarray(turn, float), np.asarray(shift, float)]))


def line(column=160, dtype=np.float32):
    """A bright column, one pixel wide, on black."""
    image = np.zeros((240, 320, 3), dtype=dtype)
    image[:, column] = 240
    return image


def smear(profile):
    """Length of the even smear (px) with a profile's variance, and its middle.

    A line one pixel wide, drawn between pixels, has a variance of its own: up to 1/4.
    """
    places = np.arange(len(profile))
    middle = np.sum(places * profile) / profile.sum()
    variance = np.sum((places - middle) ** 2 * profile) / profile.sum()
    return np.sqrt(12 * variance), middle


@pytest.mark.parametrize("rate_hz", [10.0, 30.0])
def test_the_exposure_lags_by_four_tenths_of_a_second(rate_hz):
    before, after, start = 150.0, 60.0, 20
    series = exposure_series(np.r_[np.full(start, before), np.full(80, after)], rate_hz)
    gains = np.log(series.gain)
    ends = np.log(115 / before), np.log(115 / after)
    assert np.allclose(gains[: start + 1], ends[0])
    done = (gains - ends[0]) / (ends[1] - ends[0])
    late = round(0.4 * rate_hz)
    assert done[start + late] == pytest.approx(1 - np.exp(-1), abs=1e-6)
    assert np.all(np.diff(done[start:]) > 0)


def test_time_comes_before_amplification_and_both_have_limits():
    brightness = np.array([2000.0, 450.0, 115.0, 60.0, 30.0, 0.5])
    each = [exposure_series(np.full(3, level), 30.0) for level in brightness]
    gain, time = (np.array([getattr(s, key)[-1] for s in each]) for key in ("gain", "exposure_s"))
    np.testing.assert_allclose(gain[1:5] * brightness[1:5], 115)
    assert np.all(np.diff(gain) > 0)
    assert time[0] == pytest.approx(1 / 250)
    np.testing.assert_allclose(time[4:], 1 / 25)
    # Between the limits the time alone makes the image brighter.
    np.testing.assert_allclose(gain[:4] / time[:4], gain[2] / time[2])
    assert time[3] < 1 / 25
    assert gain[4] / time[4] > gain[2] / time[2]
    assert gain[5] * brightness[5] < 60


def test_an_empty_sequence_has_empty_series():
    assert exposure_series(np.zeros(0), 30.0).gain.shape == (0,)
    assert white_balance_series(np.zeros((0, 3)), 30.0).shape == (0, 3)


def test_white_balance_goes_half_the_way_to_grey_with_a_lag_of_a_second():
    rate_hz, start = 20.0, 10
    means = np.vstack([np.full((start, 3), 100.0), np.tile([150.0, 100.0, 70.0], (300, 1))])
    gains = white_balance_series(means, rate_hz)
    np.testing.assert_allclose(gains[: start + 1], 1)
    balanced = means[-1] * gains[-1]
    np.testing.assert_allclose(
        balanced[0] / balanced[2], np.sqrt(means[-1, 0] / means[-1, 2]), rtol=1e-3
    )
    done = np.log(gains[:, 2]) / np.log(gains[-1, 2])
    assert done[start + round(rate_hz)] == pytest.approx(1 - np.exp(-1), abs=1e-3)


def test_white_balance_is_limited():
    gains = white_balance_series(np.tile([250.0, 60.0, 5.0], (4, 1)), 30.0)
    assert gains.min() == 0.7
    assert gains.max() == 1.45


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
@pytest.mark.parametrize("turn", [0.0, 0.4 / 260])
def test_nothing_blurs_when_the_camera_hardly_moves(dtype, turn):
    image = np.random.default_rng(0).integers(0, 255, (240, 320, 3)).astype(dtype)
    blurred = motion_blur(image, FAR, CAMERA, motion(turn=(0, turn, 0)))
    np.testing.assert_array_equal(blurred, image)
    moved = motion_blur(image, FAR, CAMERA, motion(turn=(0, turn + 0.8 / 260, 0)))
    assert np.mean(np.abs(moved.astype(float) - image)) > 3


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
@pytest.mark.parametrize("degrees", [1.0, 2.5, 4.0])
def test_a_turning_camera_smears_by_the_focal_length_times_the_angle(dtype, degrees):
    angle = np.deg2rad(degrees)
    blurred = motion_blur(line(dtype=dtype), FAR, CAMERA, motion(turn=(0, angle, 0)))
    assert blurred.dtype == dtype
    length, middle = smear(blurred[120, :, 0].astype(float))
    assert length == pytest.approx(2 * CAMERA.fx * np.tan(angle / 2), abs=1.0)
    assert middle == pytest.approx(160, abs=0.2)
    total = blurred[120, :, 0].astype(float).sum()
    assert total == pytest.approx(240, rel=0.05)


def test_a_rolling_camera_smears_the_corners_and_not_the_middle():
    image = np.random.default_rng(0).uniform(0, 255, (240, 320, 3)).astype(np.float32)
    blurred = motion_blur(image, FAR, CAMERA, motion(turn=(0, 0, np.deg2rad(3))))
    change = np.abs(blurred - image).mean(axis=2)
    assert change[118:122, 158:162].mean() < 15
    assert change[10:30, 10:30].mean() > 40


def test_a_camera_that_slides_smears_what_is_near_and_not_what_is_far():
    image = line(100) + line(250)
    depth = np.full((240, 320), 1.0, dtype=np.float32)
    depth[:, 180:] = 50.0
    shift = 0.04
    blurred = motion_blur(image, depth, CAMERA, motion(shift=(shift, 0, 0)))
    near, _ = smear(blurred[120, :180, 0])
    assert near == pytest.approx(CAMERA.fx * shift / 1.0, abs=1.0)
    far, _ = smear(blurred[120, 180:, 0])
    assert far < 1.8
    depth[:, 180:] = 0
    endless = motion_blur(image, depth, CAMERA, motion(shift=(shift, 0, 0)))
    np.testing.assert_allclose(endless[:, 200:], image[:, 200:], atol=0.1)


def grey(level, shape=(200, 200, 3)):
    return np.full(shape, level, dtype=np.float32)


def noise_of(level, gain, noise=1.0):
    normal = np.random.default_rng(0).standard_normal((200, 200, 3), dtype=np.float32)
    clean, noisy = (develop_real(grey(level), gain, NEUTRAL, n, normal) for n in (0.0, noise))
    return (noisy.astype(float) - clean)[80:120, 80:120].std()


def test_noise_is_that_of_shot_and_read_and_grows_with_amplification():
    # Up to the longest exposure time only the time grows: the image of a level has one noise.
    assert noise_of(100, 1.0) == pytest.approx(noise_of(50, 2.0), rel=0.05)
    for gain in (1.0, 4.8, 9.6):
        amplification = max(gain / 2.4, 1.0)
        variance = SHOT_NOISE * 100 * amplification + (READ_NOISE * amplification) ** 2
        # Two roundings to whole levels add their own.
        expected = np.sqrt(variance + 1 / 12)
        assert noise_of(100 / gain, gain) == pytest.approx(expected, rel=0.08)
    assert noise_of(100, 1.0, noise=2.0) > 1.8 * noise_of(100, 1.0)
    assert noise_of(10, 1.0) < 0.7 * noise_of(100, 1.0)


def test_highlights_bend_gently_up_to_white():
    # The pixel in the middle loses nothing to the vignetting.
    tone = np.array([develop_real(grey(level, (3, 3, 3)), 1.0, NEUTRAL, 0.0, None)[1, 1, 0]
                     for level in range(601)], dtype=int)  # fmt: skip
    clear = tone[:170]
    np.testing.assert_array_equal(np.diff(clear), 1)
    assert np.all(np.diff(tone) >= 0)
    assert 215 < tone[240] < 240
    assert tone[300] > tone[260] > tone[220]
    assert tone[340:].min() == tone[-1] == 255


def test_the_corners_are_darker_and_alike():
    photo = develop_real(grey(150, (240, 320, 3)), 1.0, NEUTRAL, 0.0, None).astype(int)
    corners = photo[[0, 0, -1, -1], [0, -1, 0, -1]]
    assert photo[120, 160, 0] == 150
    assert np.ptp(corners) == 0
    assert corners[0, 0] == pytest.approx(150 * 0.78, abs=2)
    middle = photo[120, :, 0]
    assert np.all(np.diff(middle[160:]) <= 0)


def test_white_balance_and_gain_multiply_the_channels():
    photo = develop_real(grey(50), 2.0, np.array([1.2, 1.0, 0.8]), 0.0, None)
    np.testing.assert_array_equal(photo[100, 100], [120, 100, 80])


def test_noise_in_the_dark_is_cut_at_black():
    normal = np.full((20, 20, 3), -3.0, dtype=np.float32)
    assert develop_real(grey(0.0, (20, 20, 3)), 20.0, NEUTRAL, 1.0, normal).max() == 0
