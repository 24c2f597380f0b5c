"""What the checks find, on a walk through the rendered building made wrong."""

from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Camera, Intrinsics
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.registration import register
from roomgraph.slam.checks import CheckSettings, check_sequence, examine
from roomgraph.slam.checks.calibration import CalibrationSettings, Pair, measure_focal
from roomgraph.slam.checks.depth_scale import DepthScaleSettings, find_wrong_scale
from roomgraph.slam.checks.focal_length import find_wrong_focal
from roomgraph.slam.checks.intrinsics import IntrinsicsSettings, find_wrong_intrinsics
from roomgraph.slam.checks.registration import Alignment
from roomgraph.slam.checks.statistics import gain_error
from roomgraph.slam.geometry.noise import SensorNoise
from tests.slam.helpers import NOISE, correspondences

pytestmark = pytest.mark.slow

UNCERTAIN = SensorNoise(pixel=10, depth_floor_m=0.1, depth_quadratic=0.1)
KINECT = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
MIDDLE, STRETCH = np.array([319.5, 239.5]), np.array([4 / 3, 1.0])


@dataclass
class Bent:
    """A sequence whose frames or camera are changed on the way."""

    source: Any
    change: Any = None
    new_camera: Any = None

    def __len__(self):
        return len(self.source)

    def __getattr__(self, name):
        return getattr(self.source, name)

    @property
    def camera(self):
        return self.new_camera or self.source.camera

    def __getitem__(self, index):
        frame = self.source[index]
        frame = frame if self.change is None else self.change(frame, index)
        if self.new_camera is None:
            return frame
        camera = self.new_camera
        depth = frame.depth
        if camera.depth is not None:
            depth = register(depth, camera.depth, camera.intrinsics)
        return replace(frame, depth=depth, intrinsics=camera.intrinsics)

    def with_camera(self, camera):
        return replace(self, new_camera=camera)


def check(sequence, change=None, camera=None, noise=NOISE):
    return check_sequence(Bent(sequence, change, camera), CheckSettings(), noise)


def moved(dx, dy, scale=1.0):
    """Return a change that scales the depth about the middle and shifts it."""

    def change(frame, index):
        height, width = frame.depth.shape
        middle = np.array([width - 1, height - 1]) / 2
        offset = middle - scale * middle + (dx, dy)
        M = np.column_stack([scale * np.eye(2), offset])
        depth = cv2.warpAffine(frame.depth, M, (width, height), flags=cv2.INTER_NEAREST)
        return replace(frame, depth=depth)

    return change


def test_good_data_gives_no_warning(rendered_sequence):
    assert check(rendered_sequence) == ()


@pytest.mark.parametrize(("factor", "suggested"), [(0.2, 5000), (5, 5000), (1e-3, 5000)])
def test_wrong_depth_scales_are_named_with_the_right_one(rendered_sequence, factor, suggested):
    def change(frame, index):
        return replace(frame, depth=frame.depth * np.float32(factor))

    camera = replace(rendered_sequence.camera, depth_scale=5000 / factor)
    (finding,) = check(rendered_sequence, change, camera)
    assert finding.kind == "depth scale"
    assert f"--depth-scale {suggested} " in str(finding)


@pytest.mark.parametrize(("dx", "dy", "scale"), [(10, 0, 1), (-15, 6, 1), (6, 2, 1.1)])
def test_unregistered_depth_is_measured(rendered_sequence, dx, dy, scale):
    (finding,) = check(rendered_sequence, moved(dx, dy, scale))
    assert finding.kind == "registration"
    numbers = finding.observed.split("shifted by (")[1].split(")")[0].split(",")
    # To bring it back: the inverse of what was done, within the width of an outline.
    assert np.allclose([float(n) for n in numbers], [-dx / scale, -dy / scale], atol=3)
    found = (
        finding.observed.split("scaled by ")[1].split()[0] if "scaled" in finding.observed else 1
    )
    assert np.isclose(float(found), 1 / scale, atol=0.03)


def agreement(sequence, truth):
    """Return the share of readings that are within 5 % of the true ones."""
    shares = []
    for index in range(0, len(truth), 10):
        depth, true = sequence[index].depth, truth[index].depth
        both = (depth > 0) & (true > 0)
        shares.append(np.mean(np.abs(depth - true)[both] < 0.05 * true[both]))
    return float(np.mean(shares))


@pytest.mark.parametrize(("dx", "dy", "scale"), [(10, 0, 1), (-15, 6, 1), (6, 2, 1.1)])
def test_unregistered_depth_is_laid_on_colour(rendered_sequence, dx, dy, scale):
    wrong = Bent(rendered_sequence, moved(dx, dy, scale))
    found = examine(wrong, CheckSettings(), NOISE)
    (finding,) = found.findings
    assert finding.kind == "registration"
    assert "are aligned by that" in finding.suggestion
    before, after = (agreement(sequence, rendered_sequence) for sequence in (wrong, found.sequence))
    assert 1 - after < 0.25 * (1 - before)


@pytest.mark.parametrize("factor", [0.8, 1.2])
def test_wrong_focal_lengths_are_replaced(rendered_sequence, factor):
    true = rendered_sequence.camera
    given = replace(true.intrinsics, fx=factor * true.intrinsics.fx, fy=factor * true.intrinsics.fy)
    wrong = Bent(rendered_sequence, None, replace(true, intrinsics=given))
    found = examine(wrong, CheckSettings(), NOISE)
    (finding,) = found.findings
    assert "are used instead" in finding.suggestion
    taken = found.sequence.camera.intrinsics
    assert np.allclose([taken.fx, taken.fy], [true.intrinsics.fx, true.intrinsics.fy], rtol=0.04)


def test_what_a_correction_does_not_solve_stays_as_it_was(rendered_sequence):
    class Stubborn(Bent):
        def with_camera(self, camera):
            return self

    wrong = Stubborn(rendered_sequence, moved(10, 0))
    found = examine(wrong, CheckSettings(), NOISE)
    assert found.sequence is wrong
    assert list(map(str, found.findings)) == list(
        map(str, check_sequence(wrong, CheckSettings(), NOISE))
    )
    assert "when recording" in found.findings[0].suggestion


def test_the_correction_can_be_left_out(rendered_sequence):
    wrong = Bent(rendered_sequence, moved(10, 0))
    found = examine(wrong, CheckSettings(correct_camera=False), NOISE)
    assert found.sequence is wrong
    assert [finding.kind for finding in found.findings] == ["registration"]


@pytest.mark.parametrize("late", [1, 3, -2])
def test_a_time_offset_is_counted_in_frames(rendered_sequence, late):
    def change(frame, index):
        other = min(max(index - late, 0), len(rendered_sequence) - 1)
        return replace(frame, depth=rendered_sequence[other].depth)

    (finding,) = check(rendered_sequence, change)
    assert finding.kind == "time offset"
    plural = "s" if abs(late) > 1 else ""
    assert f"{abs(late)} frame{plural} " in finding.observed
    assert ("later" if late > 0 else "earlier") in finding.observed
    assert f"add {'-' if late > 0 else '+'}{abs(late) / 30:.3g} s" in finding.suggestion


def seen_by(fx=1.0, fy=1.0):
    """Return a change, and a camera, that claim other focal lengths than the images have."""

    def change(frame, index):
        camera = replace(frame.intrinsics, fx=fx * frame.intrinsics.fx, fy=fy * frame.intrinsics.fy)
        return replace(frame, intrinsics=camera)

    return change


@pytest.mark.parametrize("factor", [0.8, 0.9, 1.1, 1.2])
def test_a_wrong_focal_length_is_measured(rendered_sequence, factor):
    (finding,) = check(rendered_sequence, seen_by(factor, factor))
    assert finding.kind == "intrinsics"
    given = rendered_sequence.camera.intrinsics.fx
    measured = float(finding.observed.split("about ")[1].split()[0])
    assert abs(measured - given) < 0.04 * given


def test_the_noise_of_the_sensor_decides_how_sure_a_focal_length_is(rendered_sequence):
    """With a sensor this uncertain, an error of 10 % is within a few standard errors."""
    assert check(rendered_sequence, seen_by(0.9, 0.9), noise=NOISE)
    assert check(rendered_sequence, seen_by(0.9, 0.9), noise=UNCERTAIN) == ()


def test_a_correction_is_made_with_the_noise_of_the_sensor(rendered_sequence):
    true = rendered_sequence.camera
    given = replace(true.intrinsics, fx=0.9 * true.intrinsics.fx, fy=0.9 * true.intrinsics.fy)
    wrong = Bent(rendered_sequence, None, replace(true, intrinsics=given))
    assert examine(wrong, CheckSettings(), NOISE).sequence is not wrong
    found = examine(wrong, CheckSettings(), UNCERTAIN)
    assert found.sequence is wrong
    assert found.findings == ()


def made_pairs(rng, motions, count=150):
    """Pairs of frames that a Kinect's camera (525, 525) takes before and after each motion."""
    pairs = []
    for T in motions:
        found, T, _ = correspondences(rng, count, T=T)
        pixels = KINECT.project(found.points)
        pairs.append(Pair(KINECT, pixels, found.points[:, 2], found.pixels, found.depths))
    return pairs


def given_as(pairs, camera):
    return [replace(pair, camera=camera) for pair in pairs]


def taken_by(intrinsics):
    return Camera(intrinsics, 1000.0, "test")


def turned(rng, count=8):
    return [
        se3.exponential(np.r_[rng.normal(0, 0.12, 3), rng.normal(0, 0.1, 3)]) for _ in range(count)
    ]


def test_focal_lengths_are_measured_with_the_error_said(rng):
    estimates = []
    for _ in range(12):
        pairs = made_pairs(rng, turned(rng))
        found = measure_focal(pairs, CalibrationSettings(), NOISE)
        estimates.append(np.log([found.fx / 525, found.fy / 525]) / found.sigma)
    assert np.abs(np.mean(estimates)) < 1
    assert 0.5 < np.std(estimates) < 2


def test_swapped_focal_lengths_are_named(rng):
    pairs = made_pairs(rng, turned(rng))
    wide = replace(KINECT, fx=525.0 * 4 / 3)
    # As if the image had been stretched: then its camera has another fx than fy.
    stretched = [
        replace(p, camera=wide, pixels=(p.pixels - MIDDLE) * STRETCH + MIDDLE,
                seen=(p.seen - MIDDLE) * STRETCH + MIDDLE)
        for p in pairs
    ]  # fmt: skip
    settings, noise = CalibrationSettings(), NOISE
    given = taken_by(wide)
    assert find_wrong_focal(stretched, given, settings, noise) is None
    swapped = given_as(stretched, replace(wide, fx=wide.fy, fy=wide.fx))
    finding = find_wrong_focal(swapped, taken_by(swapped[0].camera), settings, noise)
    assert "swapped" in finding.suggestion
    assert finding.correction.camera.intrinsics == wide
    assert "(fx 525, fy 700 pixels) do not fit the images: about fx" in finding.observed


def test_where_one_focal_length_is_told_pixels_keep_their_shape(rng):
    """Matches along a line tell nothing of the other."""
    motions = [
        se3.exponential(np.r_[rng.normal(0, 0.1, 3), 0, angle, 0])
        for angle in rng.uniform(0.1, 0.3, 8)
    ]
    given = replace(KINECT, fx=1.2 * 525, fy=1.2 * 525)
    pairs = [
        Pair(given, *(values[np.abs(pair.pixels[:, 1] - 239.5) < 8] for values in (
            pair.pixels, pair.depths, pair.seen, pair.depths_seen
        )))
        for pair in made_pairs(rng, motions, 2500)
    ]  # fmt: skip
    settings, noise = CalibrationSettings(tolerance=0.03), NOISE
    assert measure_focal(pairs, settings, noise).sigma[1] > settings.tolerance / 2
    finding = find_wrong_focal(pairs, taken_by(given), settings, noise)
    corrected = finding.correction.camera.intrinsics
    assert np.isclose(corrected.fx, 525, rtol=0.03)
    assert np.isclose(corrected.fx, corrected.fy)


def test_a_camera_that_does_not_turn_says_nothing_of_its_focal_length(rng):
    """A wrong focal length stretches points and way alike."""
    slides = [se3.pose(t=(x, 0.5 * x, 0)) for x in (-0.3, -0.2, -0.1, 0.1, 0.2, 0.3)]
    wrong = replace(KINECT, fx=1.2 * 525, fy=1.2 * 525)
    pairs = given_as(made_pairs(rng, slides), wrong)
    found = measure_focal(pairs, CalibrationSettings(), NOISE)
    assert found.sigma.min() > 0.05
    assert find_wrong_focal(pairs, taken_by(wrong), CalibrationSettings(), NOISE) is None


def test_nothing_is_said_of_images_without_outlines(rendered_sequence):
    def flat(frame, index):
        return replace(frame, depth=np.full_like(frame.depth, 2.0))

    def dark(frame, index):
        return replace(frame, colour=np.zeros_like(frame.colour))

    assert check(rendered_sequence, flat) == ()
    assert check(rendered_sequence, dark) == ()


def test_unreadable_frames_are_left_to_the_run(rendered_sequence):
    def broken(frame, index):
        raise DatasetError("image is cut short")

    assert check(rendered_sequence, broken) == ()


def test_swapped_principal_point():
    finding = find_wrong_intrinsics(replace(KINECT, cx=239.5, cy=319.5), IntrinsicsSettings())
    assert "swapped" in finding.suggestion


@pytest.mark.parametrize("factor", [0.5, 2.0, 1.5])
def test_intrinsics_of_another_resolution(factor):
    other = replace(KINECT, cx=factor * 320 - 0.5, cy=factor * 240 - 0.5)
    finding = find_wrong_intrinsics(other, IntrinsicsSettings())
    assert f"{640 * factor:.0f}x{480 * factor:.0f}" in finding.suggestion


def test_a_focal_length_in_other_units():
    finding = find_wrong_intrinsics(replace(KINECT, fx=0.82, fy=1.09), IntrinsicsSettings())
    assert "field of view" in finding.observed


@pytest.mark.parametrize(
    "camera",
    [
        KINECT,
        replace(KINECT, fx=517.3, fy=516.5, cx=318.6, cy=255.3),
        Intrinsics(512, 512, 256.0, 256.0, 255.5, 255.5),
        Intrinsics(1920, 1440, 1447.0, 1447.0, 953.0, 729.0),
        Intrinsics(512, 424, 365.0, 365.0, 258.0, 206.0),
        Intrinsics(1280, 720, 605.0, 605.0, 640.0, 366.0),
    ],
)
def test_usual_cameras_are_fine(camera):
    assert find_wrong_intrinsics(camera, IntrinsicsSettings()) is None


def test_close_ups_and_halls_are_no_mistake(rng):
    settings = DepthScaleSettings()
    close_up, hall = rng.uniform(0.3, 0.6, 1000), rng.uniform(3, 9.5, 1000)
    assert find_wrong_scale(close_up, 1000, settings) is None
    assert find_wrong_scale(hall, 1000, settings) is None
    assert find_wrong_scale(np.empty(0), 1000, settings) is None


def test_displacement_is_the_mean_over_the_image():
    y, x = np.mgrid[:48, :64]
    pixels = np.column_stack([x.ravel(), y.ravel()]).astype(np.float32)
    alignment = Alignment(0.9, 2.0, -1.0)
    far = np.linalg.norm(alignment.apply(pixels, (48, 64)) - pixels, axis=1)
    assert np.isclose(alignment.displacement((48, 64)), np.sqrt(np.mean(far**2)), rtol=1e-3)


def test_gains_by_chance_have_the_error_said(rng):
    counts = np.array([[8, 3], [7, 2], [8, 8], [4, 5]])
    gains, errors = [], []
    for _ in range(400):
        first, second = (rng.normal(size=4) / np.sqrt(counts[:, k]) for k in (0, 1))
        gains.append(np.mean(first - second))
        errors.append(gain_error(rng.normal(size=(4, 9)), counts))
    assert np.isclose(np.std(gains), np.mean(errors), rtol=0.1)
