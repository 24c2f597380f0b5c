"""What is expected of a camera's motion, and what that is worth beside a measurement."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.frontend.estimate import inverted
from roomgraph.slam.frontend.motion_model import MotionModel, PredictionSettings
from tests.slam.helpers import motion_error

DT = 1 / 30
STEP = se3.exponential(np.array([0.0, 0.01, 0.0, 0.02, 0.0, 0.01]))
KNOWN = np.diag(np.repeat([0.001, 0.001], 3) ** -2.0)


def _steady(settings=None, error=0.002, rng=None, frames=30):
    """A model that has seen predictions err by so many metres (and a tenth in radians)."""
    rng = rng or np.random.default_rng(1)
    model = MotionModel(settings or PredictionSettings())
    for _ in range(frames):
        off = rng.normal(size=6) * np.repeat([0.1 * error, error], 3)
        model.hold(se3.exponential(off), 1e2 * KNOWN, np.eye(4), DT)
        model.moved(STEP, DT)
    return model


def test_motion_goes_on_as_it_was_for_as_long_as_it_takes():
    model = _steady()
    assert np.array_equal(model.step(DT), STEP)
    assert np.array_equal(model.step(1.05 * DT), STEP)
    missed, radians = motion_error(model.step(2 * DT), STEP @ STEP)
    assert missed < 1e-3
    assert radians < 1e-6
    assert np.array_equal(model.step(0.0), STEP)  # stamps that say nothing
    model.stand_still()
    assert np.array_equal(model.step(DT), np.eye(4))


def test_an_hour_between_frames_carries_nowhere():
    settings = PredictionSettings()
    far, _ = motion_error(_steady().step(3600.0), np.eye(4))
    assert far < 1.01 * settings.longest * np.linalg.norm(STEP[:3, 3])


def test_a_sure_measurement_stays_as_it_is():
    predicted = se3.exponential(np.array([0.01, 0, 0, 0, 0.02, 0]))
    held = _steady().hold(np.eye(4), KNOWN, predicted, DT)
    metres, radians = motion_error(held, np.eye(4))
    assert metres < 0.001
    assert radians < 0.0005


def test_what_a_view_leaves_open_is_taken_from_the_prediction():
    information = KNOWN.copy()
    information[3] = information[:, 3] = 0.0
    information[3, 3] = 0.2**-2  # sideways by 20 cm
    wrong = se3.pose(t=(0.15, 0.0, 0.0))
    held = _steady().hold(wrong, information, np.eye(4), DT)
    assert abs(held[0, 3]) < 0.02
    assert np.abs(held[1:3, 3]).max() < 0.001


def test_a_prediction_far_from_the_measurement_counts_little():
    """A knock at the camera: both are sure of themselves, and the view is right."""
    struck = se3.pose(t=(0.5, 0.0, 0.0))
    held = _steady().hold(struck, KNOWN, np.eye(4), DT)
    assert motion_error(held, struck)[0] < 0.005


@pytest.mark.parametrize("error", [0.01, 0.2])
def test_predictions_are_worth_what_they_were(error):
    """Frames wide apart (0.2 m): next to nothing; the poorer they were, the less."""
    information = KNOWN / 400  # 2 cm
    measured = se3.pose(t=(2 * error, 0.0, 0.0))
    pulled = motion_error(_steady(error=error).hold(measured, information, np.eye(4), DT), measured)
    assert pulled[0] < {0.01: 0.012, 0.2: 0.002}[error]


def test_nothing_is_held_before_anything_was_predicted_or_when_switched_off():
    wrong = se3.pose(t=(0.15, 0.0, 0.0))
    weak = KNOWN / 1e6
    assert np.array_equal(MotionModel(PredictionSettings()).hold(wrong, weak, np.eye(4), DT), wrong)
    off = _steady(PredictionSettings(enabled=False))
    assert np.array_equal(off.hold(wrong, weak, np.eye(4), DT), wrong)


def test_information_of_nothing_is_a_large_covariance():
    assert np.all(np.isfinite(inverted(np.zeros((6, 6)))))
    assert np.allclose(inverted(KNOWN), np.linalg.inv(KNOWN), rtol=1e-6)
