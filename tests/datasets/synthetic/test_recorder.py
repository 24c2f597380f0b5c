"""Recorded frames: depth sensors, real optics, threads."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import pytest

from roomgraph.datasets.readers.registration import register
from roomgraph.datasets.se3 import inverse, transform
from roomgraph.datasets.synthetic.cameras.photograph import EXPOSURE_S
from roomgraph.datasets.synthetic.recorder import READOUT_S
from roomgraph.datasets.synthetic.rendering.eye import pinhole
from tests.datasets.synthetic.worlds import recorder, suite

pytestmark = pytest.mark.slow

IDEAL = {"optics": "ideal", "frames": 60}


@pytest.fixture(scope="module")
def patch():
    with pytest.MonkeyPatch.context() as context:
        yield context


@pytest.fixture(scope="module")
def clean(patch):
    return recorder(patch, sensor="clean", **IDEAL)


@pytest.fixture(scope="module")
def real(patch):
    """A real camera's photographs by day and by night."""
    return recorder(patch, ("day", "night"), optics="real", frames=frames(), noise=0.0)


def stretches(kind):
    """The frames within the first stretch of a kind."""
    stretch = next(s for s in suite().stretches if s.kind == kind)
    stamps = suite().trajectory.stamps_s
    return np.flatnonzero((stamps >= stretch.begin_s) & (stamps <= stretch.end_s))


def frames():
    """How many frames there are up to the end of the first stretches that are looked at."""
    return 20 + int(max(stretches(kind)[-1] for kind in ("cover", "fast_turn")))


@pytest.mark.parametrize(
    ("sensor", "shape", "own"),
    [
        ("kinect", (72, 96), False), ("clean", (72, 96), False), ("stereo", (72, 96), True),
        ("tof", (43, 48), True),
    ],
)  # fmt: skip
def test_depth_lies_in_the_image_of_its_sensor(patch, sensor, shape, own):
    made = recorder(patch, sensor=sensor, noise=1.0, **IDEAL)
    frame = made.record(20)
    assert frame.depth.shape == shape
    assert frame.colours["day"].shape == (72, 96, 3)
    assert not frame.mirrors
    assert (made.depth_camera is not None) is own
    if own:
        camera = made.depth_camera.intrinsics
        assert (camera.height, camera.width) == shape
        assert 0.005 < np.linalg.norm(made.depth_camera.T_colour_depth[:3, 3]) < 0.03
    shares = [(made.record(index).depth > 0).mean() for index in (0, 20, 40)]
    assert np.mean(shares) > 0.35
    assert np.isfinite(frame.depth).all()


@pytest.mark.parametrize("sensor", ["kinect", "stereo", "tof"])
def test_registered_depth_is_the_clean_depth_within_the_noise(patch, clean, sensor):
    noises, offs = (0.0, 1.0), {}
    for noise in noises:
        made = recorder(patch, sensor=sensor, noise=noise, **IDEAL)
        errors = []
        for index in (0, 25, 50):
            depth, true = made.record(index).depth, clean.record(index).depth
            if made.depth_camera is not None:
                depth = register(depth, made.depth_camera, made.world.settings.intrinsics)
            near = cv2.erode(true, np.ones((5, 5), np.uint8))
            smooth = cv2.dilate(true, np.ones((5, 5), np.uint8)) - near < 0.12 * true
            compared = smooth & (near > 0.6) & (true < 3.0) & (depth > 0)
            errors.append((depth - true)[compared])
        error = np.concatenate(errors)
        assert len(error) > 2000
        # Medians: at such small images a pixel's slope is larger than the noise.
        assert abs(np.median(error)) < (0.004 if noise == 0 else 0.02)
        offs[noise] = float(np.median(np.abs(error)))
    # Stereo at 96 px: 0.08 px of 57.75 px * 0.05 m is 6 cm at 1.5 m, two thirds of it the median.
    most = {"kinect": 0.01, "stereo": 0.1, "tof": 0.03}[sensor]
    # Registered from 48 px: a pixel is 4 cm wide at 2 m, and half of it may slope away.
    assert offs[0.0] < 0.02
    # A time-of-flight camera's noise is less than that.
    assert offs[1.0] < most
    assert sensor == "tof" or offs[0.0] < offs[1.0]


@pytest.mark.parametrize("sensor", ["stereo", "tof"])
def test_a_sensor_sees_from_where_it_says_it_is(patch, sensor):
    made, trajectory = recorder(patch, sensor=sensor, noise=0.0, **IDEAL), suite().trajectory
    eye = pinhole(made.depth_camera.intrinsics)
    T = trajectory.T_world_camera[30]
    stamp, depth = float(trajectory.stamps_s[30]), made.record(30).depth
    # A depth camera's points come into the world by way of the colour camera.
    there = made.renderer.look(eye, T @ made.depth_camera.T_colour_depth, stamp).hits.t
    measured = depth > 0
    assert measured.mean() > 0.8
    np.testing.assert_array_equal(depth[measured], there[measured])
    here = made.renderer.look(eye, T, stamp).hits.t
    assert (np.abs(depth - here)[measured] > 1e-3).mean() > 0.3


def test_points_of_one_frame_are_where_another_sees_them(clean):
    trajectory, camera = suite().trajectory, clean.world.settings.intrinsics
    still = 2 * len(suite().building.quads)
    shares, count = [], 0
    for first, second in ((0, 9), (20, 30), (55, 40)):
        a, b = clean.record(first), clean.record(second)
        v, u = np.nonzero((a.depth > 0) & (a.sight.hits.triangle < still))
        pixels = np.column_stack([u, v]).astype(float)
        points = camera.backproject(pixels, a.depth[v, u].astype(float))
        T = trajectory.T_world_camera
        points = transform(inverse(T[second]) @ T[first], points)
        points = points[points[:, 2] > 0.3]
        at = camera.project(points)
        inside = ((at >= 1) & (at <= (camera.width - 2, camera.height - 2))).all(axis=1)
        points, at = points[inside], at[inside].astype(np.float32)
        nearness = np.divide(1, b.depth, out=np.zeros_like(b.depth), where=b.depth > 0)
        # Pixels next to an edge mix two surfaces.
        spread = cv2.morphologyEx(b.depth, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
        z, edge = (
            cv2.remap(image, at[:, :1], at[:, 1:], cv2.INTER_LINEAR).ravel()
            for image in (nearness, spread)
        )
        z = 1 / np.maximum(z, 1e-6)
        compared = (points[:, 2] < z + 0.05) & (edge < 0.3)
        count += compared.sum()
        shares.append((np.abs(points[compared, 2] - z[compared]) < 0.01).mean())
    assert count > 5000
    assert min(shares) > 0.9


def test_rows_of_a_photograph_are_read_one_after_the_other(real):
    index = int(stretches("fast_turn")[5])
    world, renderer = suite(), real.renderer
    sight = real.record(index).sight
    stamp = float(world.trajectory.stamps_s[index])
    far = []
    for row in (0, 20, 51, 71):
        at = stamp + ((row + 0.5) / 72 - 0.5) * READOUT_S
        (T,) = world.motion.poses(np.array([at]))
        alone = renderer.look(renderer.eye, T, stamp).hits.t[row]
        assert (np.abs(sight.hits.t[row] - alone) < 2e-3).mean() > 0.9
        middle = renderer.look(renderer.eye, world.trajectory.T_world_camera[index], stamp)
        far.append((np.abs(middle.hits.t[row] - alone) > 2e-3).mean())
    assert max(far) > 0.3


def test_exposure_follows_the_light(real, patch):
    ideal = recorder(patch, ("day", "night"), optics="ideal", frames=frames(), noise=0.0)
    index = 60
    photos, pictures = (made.record(index).colours for made in (real, ideal))
    day, night = (float(pictures[light].mean()) for light in ("day", "night"))
    assert day > 1.15 * night
    taken = [float(photos[light].mean()) for light in ("day", "night")]
    assert min(taken) > 60
    assert max(taken) < 170
    assert 0.92 < taken[0] / taken[1] < 1.08


def test_a_covered_lens_is_blank_and_the_next_picture_too_bright(real):
    covered = stretches("cover")
    before, after = (real.record(int(index)) for index in (covered[0] - 1, covered[-1] + 1))
    for index in covered[:: len(covered) // 3]:
        blank = real.record(int(index))
        assert not blank.depth.any()
        for light in ("day", "night"):
            # The exposure opens in the dark; a little gets through in the end.
            assert blank.colours[light].mean() < 40
            assert gradient(blank.colours[light]) < 0.15 * gradient(before.colours[light])
    for frame in (before, after):
        assert (frame.depth > 0).mean() > 0.2
    # The exposure has opened in the dark.
    assert after.colours["day"].mean() > before.colours["day"].mean() + 25


def test_nothing_of_the_scene_is_seen_through_a_cover(real, patch):
    ideal = recorder(patch, optics="ideal", frames=frames(), noise=0.0)
    for index in stretches("cover")[5::4]:
        photo, picture = (
            made.record(int(index)).colours["day"].astype(float).mean(axis=2).ravel()
            for made in (real, ideal)
        )
        alike = np.corrcoef(photo, picture)[0, 1] if photo.std() else 0.0
        # Only the fall of the light towards the corners may be like it.
        assert abs(alike) < 0.5


def gradient(image):
    grey = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY).astype(float)
    return float(np.square(np.diff(grey, axis=1)).mean())


def test_fast_turns_blur(real, patch):
    """Against a camera without faults: less is left of its gradients in a fast turn."""
    ideal = recorder(patch, optics="ideal", frames=frames(), noise=0.0)
    calm = range(5, 50, 12)
    turning = stretches("fast_turn")[3:-3:3]
    turning = turning[turning < frames()]

    def kept(index):
        photo = real.record(index).colours["day"]
        picture = ideal.record(index).colours["day"]
        # Whatever the exposure: both by their own contrast.
        return gradient(photo) / photo.var() / (gradient(picture) / picture.var())

    assert np.median([kept(int(i)) for i in turning]) < 0.6 * np.median([kept(i) for i in calm])
    # Long enough to blur: the photograph is not the mean of an instant.
    assert real._photos["day"].exposure_s.min() > EXPOSURE_S / 10


@pytest.mark.parametrize("sensor", ["kinect", "stereo"])
def test_threads_take_the_same_frames(patch, sensor):
    made = recorder(patch, sensor=sensor, optics="real", frames=12, noise=1.0, omni=True)
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(made.record, range(6)))
    for index, frame in enumerate(together):
        alone = made.record(index)
        assert np.array_equal(alone.depth, frame.depth)
        assert np.array_equal(alone.colours["day"], frame.colours["day"])
        assert np.array_equal(alone.mirrors["day"], frame.mirrors["day"])
    assert not np.array_equal(together[0].depth, together[1].depth)
    size = together[0].mirrors["day"].shape
    assert size == (90, 90, 3)
