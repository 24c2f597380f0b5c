"""Depth sensors on planes, steps, corners and a furnished box of a room."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.synthetic.cameras import kinect
from roomgraph.datasets.synthetic.cameras.depth_sensor import Sighted, blobs, patches
from roomgraph.datasets.synthetic.cameras.registry import SENSORS, sensor
from roomgraph.datasets.synthetic.cameras.stereo import ActiveStereo
from roomgraph.datasets.synthetic.cameras.tof import TimeOfFlight, corner

COLOUR = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
STEREO, TOF = ActiveStereo(), TimeOfFlight()
STEREO_EYE, TOF_EYE = STEREO.camera(COLOUR).intrinsics, TOF.camera(COLOUR).intrinsics
HALL = ((-2, 2), (-1.2, 1.2), (-1, 3.5))
FURNITURE = (
    ((-1.6, -0.6), (0.2, 1.2), (2.2, 3.0)),
    ((0.5, 1.3), (-0.3, 1.2), (1.6, 2.1)),
    ((-0.2, 0.1), (-1.0, 1.2), (3.0, 3.4)),
)


def normals_of(eye, seed=0):
    shape = eye.height, eye.width, 3
    return np.random.default_rng(seed).standard_normal(shape, dtype=np.float32)


def texture(shape, mean=128, spread=30, seed=0):
    values = np.random.default_rng(seed).normal(mean, spread, shape)
    return np.clip(values, 1, 255).astype(np.uint8)


def facing(eye, z, grey=None):
    """Surfaces (H, W) that all face the camera, along its axis."""
    z = np.broadcast_to(np.asarray(z, dtype=np.float32), (eye.height, eye.width)).copy()
    normals = np.zeros((*z.shape, 3), dtype=np.float32)
    normals[..., 2] = -1
    grey = texture(z.shape) if grey is None else np.full(z.shape, grey, dtype=np.uint8)
    return Sighted(z, np.ones_like(z), np.zeros(z.shape, bool), grey, eye.fx, normals)


def step(eye, near=1.0, far=3.0, grey=None):
    """A near surface in the middle third of the image, a far one beside it."""
    third = eye.width // 3
    row = np.full(eye.width, far)
    row[third : 2 * third] = near
    return facing(eye, row, grey), third


def inside(eye, hall=HALL, boxes=(), turn=0.0, paint=0.8):
    """A hall with boxes in it: plain walls (contrast `paint`), floor and boxes with texture."""
    pixels = np.meshgrid(np.arange(eye.width), np.arange(eye.height))
    x, y = (pixels[0] - eye.cx) / eye.fx, (pixels[1] - eye.cy) / eye.fy
    rays = np.dstack([x, y, np.ones_like(x)])
    R = cv2.Rodrigues(np.array([0.0, turn, 0.0]))[0]
    world = rays @ R.T
    z, sides = np.full(x.shape, np.inf), np.zeros(x.shape, int)
    normals = np.zeros_like(rays)
    for index, bounds in enumerate((hall, *boxes)):
        with np.errstate(divide="ignore"):
            t = np.array(bounds, dtype=float) / world[..., None]
        enter, leave = t.min(axis=3), t.max(axis=3)
        hit = enter.max(axis=2) if index else leave.min(axis=2)
        axis = enter.argmax(axis=2) if index else leave.argmin(axis=2)
        seen = (hit > 0) & (hit < z) & ((hit < leave.min(axis=2)) | (index == 0))
        away = np.sign(np.take_along_axis(world, axis[..., None], axis=2))
        normals[seen] = (-away * np.eye(3)[axis])[seen] @ R
        z[seen], sides[seen] = hit[seen], (3 * index + axis)[seen]
    grazing = np.abs(np.sum(normals * rays, axis=2)) / np.linalg.norm(rays, axis=2)
    plain = (sides < 3) & ~((sides == 1) & (y > 0))
    spread = np.where(plain, paint, 14.0)
    grey = texture(z.shape, np.where(plain, 195, 105), spread)
    return Sighted(
        z.astype(np.float32), grazing.astype(np.float32), np.zeros(z.shape, bool), grey, eye.fx,
        normals.astype(np.float32),
    )  # fmt: skip


def eye_of(name):
    own = SENSORS[name].camera(COLOUR)
    return COLOUR if own is None else own.intrinsics


@pytest.mark.parametrize(
    ("name", "nearest", "farthest"),
    [("kinect", 0.5, 5.0), ("stereo", 0.3, 6.0), ("tof", 0.25, 5.5), ("clean", 0.3, 10.0)],
)
def test_without_noise_the_depth_is_exact_within_the_range(name, nearest, farthest):
    eye = eye_of(name)
    view = facing(eye, np.linspace(0.05, 12, eye.width))
    view.z[:5] = np.inf
    view.blind[5:10] = True
    depth = sensor(name).measure(view, 0.0, normals_of(eye))
    assert depth.dtype == np.float32
    valid = (view.z >= nearest) & (view.z <= farthest)
    np.testing.assert_array_equal(depth, np.where(valid, view.z, 0))


@pytest.mark.parametrize("name", ["kinect", "stereo", "tof"])
def test_noise_never_leaves_the_range_and_measures_nothing_where_nothing_is(name):
    eye = eye_of(name)
    view = inside(eye, hall=((-3, 3), (-1.2, 1.2), (-1, 9)), boxes=FURNITURE)
    view.z[:60] = np.inf
    depth = sensor(name).measure(view, 3.0, normals_of(eye))
    assert np.all(np.isfinite(depth))
    assert np.all(depth[:55] == 0)
    assert np.count_nonzero(depth) > depth.size / 4
    exact = sensor(name).measure(view, 0.0, normals_of(eye))
    smallest = exact[exact > 0].min()
    assert depth[depth > 0].min() > 0.8 * smallest
    assert depth.max() <= 6.0


def test_structured_light_is_the_kinect_to_the_bit():
    view, normal = inside(COLOUR, boxes=FURNITURE), normals_of(COLOUR)
    view.blind[100:200, 300:400] = True
    expected = kinect.measure(view.z, view.grazing, view.blind, 1.0, normal)
    assert 0.005 < np.mean(expected == 0) < 0.5
    np.testing.assert_array_equal(sensor("kinect").measure(view, 1.0, normal), expected)


def test_an_unknown_sensor_is_named_with_those_there_are():
    with pytest.raises(ValueError, match=r"radar.*kinect, stereo, tof, clean"):
        sensor("radar")


@pytest.mark.parametrize(("name", "farthest_m"), [("stereo", 0.0151), ("tof", 0.009)])
def test_the_sensors_own_camera_stands_beside_the_colour_and_scales_with_it(name, farthest_m):
    full, half = (sensor(name).camera(colour) for colour in (COLOUR, COLOUR.resized(320, 240)))
    assert half.intrinsics.width == full.intrinsics.width / 2
    assert half.intrinsics.fx == pytest.approx(full.intrinsics.fx / 2)
    T = full.T_colour_depth
    np.testing.assert_allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-12)
    angle = np.degrees(np.arccos((np.trace(T[:3, :3]) - 1) / 2))
    assert 0.1 < angle < 1.0
    assert 0.004 < np.linalg.norm(T[:3, 3]) < farthest_m
    assert sensor("kinect").camera(COLOUR) is None
    assert sensor("clean").camera(COLOUR) is None


def test_smoothed_noise_keeps_its_variance_and_is_alike_among_neighbours():
    normal = normals_of(COLOUR)[..., 0]
    for smooth, near, far in ((patches(normal, 1.6), 2, 10), (blobs(normal, 5), 5, 60)):
        assert smooth.std() == pytest.approx(1.0, abs=0.1)
        together = [np.mean(smooth[:, k:] * smooth[:, :-k]) for k in (near, far)]
        assert together[0] > 0.5
        assert abs(together[1]) < 0.1


@pytest.mark.parametrize("z", [0.8, 1.5, 3.0])
def test_stereo_noise_grows_with_the_square_of_the_depth(z):
    view = facing(STEREO_EYE, z)
    depth = STEREO.measure(view, 1.0, normals_of(STEREO_EYE))
    expected = z**2 * STEREO.sigma_px / (STEREO_EYE.fx * STEREO.baseline_m)
    error = depth[depth > 0] - z
    assert error.std() == pytest.approx(expected, rel=0.08)
    assert abs(error.mean()) < 0.15 * expected


def test_stereo_disparity_comes_in_steps_and_errors_in_patches():
    view = facing(STEREO_EYE, 1.5)
    depth = STEREO.measure(view, 1.0, normals_of(STEREO_EYE))[:, 60:]
    steps = 32 * STEREO_EYE.fx * STEREO.baseline_m / depth[depth > 0]
    np.testing.assert_allclose(steps, np.rint(steps), atol=1e-3)
    assert 10 < len(np.unique(np.rint(steps))) < 40
    error = depth - depth[depth > 0].mean()
    together = np.mean(error[:, 2:] * error[:, :-2]) / error.var()
    assert together > 0.5


def test_stereo_near_edges_are_fat_and_what_one_eye_cannot_see_is_missing():
    view, third = step(STEREO_EYE)
    depth = STEREO.measure(view, 1.0, normals_of(STEREO_EYE))[20:-20]
    near = (depth > 0.8) & (depth < 1.2)
    left, right = near[:, :third].sum(axis=1), near[:, 2 * third :].sum(axis=1)
    # Half a window of 5 to 7 px.
    for grown in (left, right):
        assert 2 <= grown.mean() <= 3
        assert set(np.unique(grown)) <= {2, 3}
    # The disparities at 1 and 3 m differ by so much; the right eye stands on the right.
    shadow = round(STEREO_EYE.fx * STEREO.baseline_m * (1 - 1 / 3))
    holes = depth[:, third - shadow : third - 3] == 0
    assert holes.mean() > 0.9
    assert (depth[:, third - shadow - 20 : third - shadow - 3] == 0).mean() < 0.05
    assert (depth[:, 2 * third + 4 : 2 * third + 20] == 0).mean() < 0.05


def test_stereo_sees_past_both_sides_of_a_thin_pole():
    row = np.full(STEREO_EYE.width, 3.0)
    row[300:305] = 0.6
    depth = STEREO.measure(facing(STEREO_EYE, row), 1.0, normals_of(STEREO_EYE))
    apart = round(STEREO_EYE.fx * STEREO.baseline_m * (1 / 0.6 - 1 / 3))
    assert (depth[:, 301 - apart : 304 - apart] == 0).mean() > 0.9
    assert (depth[:, 285:295] == 0).mean() < 0.05


def test_stereo_misses_plain_walls_from_afar_but_not_from_near_nor_with_texture():
    shares = {}
    for z in (1.0, 2.0, 5.0):
        for grey in (160, None):
            view = facing(STEREO_EYE, z, grey)
            depth = STEREO.measure(view, 1.0, normals_of(STEREO_EYE))[:, 40:]
            shares[z, grey] = np.mean(depth == 0)
    assert shares[1.0, 160] < 0.01
    assert shares[2.0, 160] < 0.1
    assert shares[5.0, 160] > 0.95
    assert shares[5.0, None] < 0.05


def test_stereo_finds_nothing_in_stripes_along_the_row():
    stripes = facing(STEREO_EYE, 5.0)
    stripes.grey[:] = np.where(np.arange(STEREO_EYE.height) % 8 < 4, 60, 180)[:, None]
    upright = facing(STEREO_EYE, 5.0)
    upright.grey[:] = np.where(np.arange(STEREO_EYE.width) % 8 < 4, 60, 180)
    normal = normals_of(STEREO_EYE)
    assert np.mean(STEREO.measure(stripes, 1.0, normal) == 0) > 0.9
    assert np.mean(STEREO.measure(upright, 1.0, normal) == 0) < 0.05


@pytest.mark.parametrize("z", [0.5, 1.0])
def test_stereo_has_no_depth_at_the_left_border(z):
    depth = STEREO.measure(facing(STEREO_EYE, z), 1.0, normals_of(STEREO_EYE))
    border = int(STEREO_EYE.fx * STEREO.baseline_m / z)
    assert np.all(depth[:, :border] == 0)
    assert np.all(depth[:, border + 5 :] > 0)


def test_stereo_misses_what_a_depth_camera_misses_in_rooms():
    normal = normals_of(STEREO_EYE)
    for turn in (-0.3, 0.0, 0.3):
        view = inside(STEREO_EYE, boxes=FURNITURE, turn=turn)
        assert 0.15 < np.mean(STEREO.measure(view, 1.0, normal) == 0) < 0.40


def test_stereo_has_holes_where_surfaces_are_blind():
    view = facing(STEREO_EYE, 1.0)
    view.blind[200:300, 100:300] = True
    depth = STEREO.measure(view, 1.0, normals_of(STEREO_EYE))
    np.testing.assert_array_equal(depth[:, 30:] == 0, view.blind[:, 30:])


@pytest.mark.parametrize("z", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("grey", [128, 64])
def test_tof_noise_grows_with_the_square_of_the_depth_and_on_dark_surfaces(z, grey):
    depth = TOF.measure(facing(TOF_EYE, z, grey), 1.0, normals_of(TOF_EYE))
    error = depth[depth > 0] - z
    expected = 0.003 + 0.0015 * z**2 * 128 / grey
    assert error.std() == pytest.approx(expected, rel=0.03)


def test_tof_wiggles_with_the_depth():
    errors = []
    for z in np.arange(1.0, 2.5, 0.0625):
        depth = TOF.measure(facing(TOF_EYE, z, 128), 1.0, normals_of(TOF_EYE))
        errors.append(depth.mean() - z)
    spectrum = np.abs(np.fft.rfft(errors)) / len(errors) * 2
    # Two periods in 1.5 m, of 2 mm; nothing else.
    assert spectrum.argmax() == 2
    assert spectrum[2] == pytest.approx(0.002, rel=0.1)


def test_tof_pixels_fly_at_edges_only():
    view, third = step(TOF_EYE, grey=160)
    depth = TOF.measure(view, 1.0, normals_of(TOF_EYE))
    edges = np.concatenate([depth[:, [c - 1, c]] for c in (third, 2 * third)], axis=1)
    assert np.mean(edges == 0) == pytest.approx(0.5, abs=0.05)
    between = (edges > 1.1) & (edges < 2.9)
    assert 0.35 < np.mean(between) < 0.5
    columns = np.r_[: third - 1, third + 1 : 2 * third - 1, 2 * third + 1 : TOF_EYE.width]
    others = depth[:, columns]
    assert np.all((np.abs(others - 1) < 0.15) | (np.abs(others - 3) < 0.15))


def test_tof_sees_corners_too_far():
    quiet = np.zeros((TOF_EYE.height, TOF_EYE.width, 3), dtype=np.float32)
    quiet[..., 2] = 0.5
    view = inside(TOF_EYE, turn=np.arctan2(2, 3.5))
    bias = TOF.measure(view, 1.0, quiet) - view.z
    wiggle = 0.002
    middle = slice(130, 156)
    at_corner = bias[middle, 150:170]
    assert at_corner.max() == pytest.approx(0.035, abs=0.012)
    assert at_corner.min() > 0.005
    assert np.abs(bias[middle, 20:60]).max() < wiggle + 0.001


def test_tof_has_no_corners_on_planes_steps_and_outer_edges():
    slanted = inside(TOF_EYE, hall=((-50, 2), (-50, 50), (-1, 50)), turn=0.6)
    assert corner(slanted, np.where(slanted.z < 10, slanted.z, 0)).max() < 1e-3
    stepped, _ = step(TOF_EYE)
    assert corner(stepped, stepped.z).max() < 1e-3
    outer = inside(TOF_EYE, (((-9, 9),) * 3), [((-0.5, 0.5), (-9, 9), (2.0, 3.0))], turn=0.5)
    on_box = outer.z < 4
    assert on_box.sum() > 5000
    assert corner(outer, np.where(on_box, outer.z, 0)).max() < 1e-3


def test_tof_misses_little_in_rooms_but_most_of_what_is_blind():
    view, normal = inside(TOF_EYE, boxes=FURNITURE), normals_of(TOF_EYE)
    assert 0.003 < np.mean(TOF.measure(view, 1.0, normal) == 0) < 0.08
    view.blind[:] = True
    assert 0.7 < np.mean(TOF.measure(view, 1.0, normal) == 0) < 0.95


@pytest.mark.parametrize("name", ["stereo", "tof"])
def test_what_was_seen_is_left_as_it_was(name):
    eye = eye_of(name)
    view, normal = inside(eye, boxes=FURNITURE), normals_of(eye)
    parts = view.z, view.grazing, view.blind, view.grey, view.normals, normal
    before = [part.copy() for part in parts]
    first = sensor(name).measure(view, 1.0, normal)
    for part, copy in zip(parts, before, strict=True):
        np.testing.assert_array_equal(part, copy)
    np.testing.assert_array_equal(sensor(name).measure(view, 1.0, normal), first)
