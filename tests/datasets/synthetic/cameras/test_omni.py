"""The omnidirectional mirror camera: where it sees what, its image, and its cuts."""

from __future__ import annotations

import json

import numpy as np
import pytest

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.synthetic.cameras.omni import (
    OmniModel,
    T_camera_omni,
    read_model,
    write_model,
)
from roomgraph.datasets.synthetic.cameras.omni_image import (
    mirror_image,
    sectors,
    unwrap,
)
from roomgraph.datasets.synthetic.motion.walk import camera_poses

MODEL = OmniModel()
SHIFTED = OmniModel(
    size_px=300, inner_px=30, outer_px=130, centre=(147.0, 152.5), gamma_px=80, front_deg=10
)
QUIET = np.zeros((600, 600, 3), dtype=np.float32)


def polar(model):
    """Radius and bearing (clockwise from the top, degrees) of every pixel."""
    v, u = np.mgrid[: model.size_px, : model.size_px].astype(float)
    u, v = u - model.centre[0], v - model.centre[1]
    return np.hypot(u, v), np.degrees(np.arctan2(u, -v))


def bearing(model, pixels):
    u, v = (pixels - model.centre).T
    return np.degrees(np.arctan2(u, -v)) % 360


def seen_along(rays, turn_deg=0.0):
    """A pattern painted far away, seen by a camera turned to the left."""
    x, y, z = np.moveaxis(rays.astype(np.float64), 2, 0)
    c, s = np.cos(np.deg2rad(turn_deg)), np.sin(np.deg2rad(turn_deg))
    x, y = c * x - s * y, s * x + c * y
    pattern = [120 + 90 * np.sin(3 * x + 2 * z), 120 + 100 * x * z, 120 + 90 * np.cos(4 * y + 1)]
    return np.stack(pattern, axis=2).astype(np.float32)


@pytest.mark.parametrize("model", [MODEL, SHIFTED])
def test_what_a_pixel_sees_is_projected_onto_it(model):
    eye = model.rays()
    assert not eye.is_pinhole
    assert np.allclose(np.linalg.norm(eye.rays, axis=2), 1, atol=1e-6)
    distance = np.random.default_rng(0).uniform(0.3, 20, eye.lengths.shape)
    points = (eye.rays * distance[..., None]).reshape(-1, 3)
    pixels = model.project(points).reshape(*eye.lengths.shape, 2)
    radius, _ = polar(model)
    ring = (radius > model.inner_px + 0.01) & (radius < model.outer_px - 0.01)
    v, u = np.mgrid[: model.size_px, : model.size_px]
    assert np.abs(pixels - np.stack([u, v], axis=2))[ring].max() < 0.01
    beside = (radius < model.inner_px - 0.01) | (radius > model.outer_px + 0.01)
    assert beside.any() and np.isnan(pixels[beside]).all()


def test_the_middle_of_the_mirror_and_the_ceiling_are_not_seen():
    points = np.array([(0, 0, 1), (0, 0, -1), (0.1, 0, 5), (0, 0, 0), (1, 1, -0.2)], dtype=float)
    assert np.isnan(MODEL.project(points)).any(axis=1).tolist() == [True, True, True, True, False]


@pytest.mark.parametrize("eccentricity", [1.2, 1.6, 2.5])
def test_rays_are_reflected_by_a_hyperbolic_mirror_into_the_camera_under_it(eccentricity):
    """Built as it stands: the viewpoint in one focus, a pinhole that looks up in the other."""
    a = 0.02
    c = a * eccentricity
    xi = 2 * eccentricity / (1 + eccentricity**2)
    model = OmniModel(xi=xi, inner_px=5, outer_px=290, gamma_px=120)
    elevation = np.deg2rad(np.linspace(-75, 5, 33))
    rays = np.column_stack([np.cos(elevation), 0 * elevation, np.sin(elevation)])
    # On the sheet around the viewpoint the foci's distances differ by 2 a.
    met = rays * ((c * c - a * a) / (a - c * rays[:, 2]))[:, None]
    from_camera = met + np.array([0, 0, 2 * c])
    lengths = np.linalg.norm(from_camera, axis=1) - np.linalg.norm(met, axis=1)
    assert np.allclose(lengths, 2 * a)
    focal = model.gamma_px * (a * a + c * c) / (c * c - a * a)
    expected = focal * from_camera[:, 0] / from_camera[:, 2]
    pixels = model.project(rays * 3)
    assert np.linalg.norm(pixels - model.centre, axis=1) == pytest.approx(expected, rel=1e-9)


def test_the_horizon_is_a_circle_near_the_rim():
    azimuth = np.linspace(0, 2 * np.pi, 40)
    points = np.column_stack([np.cos(azimuth), np.sin(azimuth), 0 * azimuth]) * 4
    radii = np.linalg.norm(MODEL.project(points) - MODEL.centre, axis=1)
    assert radii == pytest.approx(np.full(40, 172.2 / 0.9))
    assert MODEL.horizon_px == pytest.approx(radii[0])
    assert MODEL.elevations_deg == pytest.approx((-60, 20), abs=0.01)
    edges = np.deg2rad(np.array([-59.9, 19.9]))
    ends = MODEL.project(np.column_stack([np.cos(edges), 0 * edges, np.sin(edges)]))
    edge_radii = np.linalg.norm(ends - MODEL.centre, axis=1)
    assert edge_radii == pytest.approx([48.75, 290], abs=1.0)


@pytest.mark.parametrize("foot", [(2.0, 0.0), (-1.0, 1.5), (0.4, -1.1)])
def test_an_upright_edge_is_a_radial_line(foot):
    heights = np.linspace(-0.6, 0.1, 30)
    pixels = MODEL.project(np.column_stack([np.tile(foot, (30, 1)), heights]))
    assert np.ptp(np.unwrap(np.deg2rad(bearing(MODEL, pixels)))) < 1e-9
    assert np.all(np.diff(np.linalg.norm(pixels - MODEL.centre, axis=1)) > 0)


def test_a_level_edge_is_none():
    across = np.linspace(-2, 2, 30)
    pixels = MODEL.project(np.column_stack([np.full(30, 1.5), across, np.full(30, -0.5)]))
    middle = pixels - pixels.mean(axis=0)
    assert np.linalg.svd(middle, compute_uv=False)[1] > 20


def test_the_mirror_shows_the_left_clockwise_from_the_front():
    sides = np.array([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)], dtype=float)
    for model, front in ((MODEL, 45), (SHIFTED, 10)):
        found = bearing(model, model.project(sides))
        assert found == pytest.approx([front, front + 90, front + 180, front + 270])


def test_another_size_shows_the_same():
    small = MODEL.resized(300)
    points = np.random.default_rng(1).normal(size=(200, 3)) * (2, 2, 0.5)
    large = MODEL.project(points)
    assert np.isfinite(large).sum() > 100
    np.testing.assert_allclose(small.project(points), (large + 0.5) / 2 - 0.5, atol=1e-9)
    shares = [model.mask().mean() for model in (MODEL, small)]
    assert shares[0] == pytest.approx(shares[1], abs=0.01)


def test_turning_the_camera_moves_the_sectors_by_one_place():
    rays = MODEL.rays().rays
    before = sectors(seen_along(rays), MODEL)
    after = sectors(seen_along(rays, 90), MODEL)
    assert list(before) == ["front", "left", "back", "right"]
    for new, old in zip(before, ["left", "back", "right", "front"], strict=True):
        np.testing.assert_allclose(after[new], before[old], atol=0.01)
    assert np.abs(before["front"] - before["left"]).mean() > 10
    second = sectors(seen_along(rays), MODEL, turn_deg=45)
    half = sectors(seen_along(rays, 45), MODEL)
    # Turned by half a right angle, the corners lie outside the image.
    radius, _ = polar(MODEL)
    ring = radius[10:300, 300:590] < 285
    assert np.abs(second["left"] - half["left"])[ring].max() < 1


def test_sectors_are_the_quarters_of_the_image_turned():
    image = np.random.default_rng(2).integers(0, 255, (600, 600, 3)).astype(np.uint8)
    parts = sectors(image, MODEL)
    assert np.array_equal(parts["front"], image[10:300, 300:590])
    assert np.array_equal(parts["left"], np.rot90(image[300:590, 300:590]))
    assert np.array_equal(parts["back"], np.rot90(image[300:590, 10:300], 2))
    assert np.array_equal(parts["right"], np.rot90(image[10:300, 10:300], 3))


@pytest.mark.parametrize("model", [MODEL, SHIFTED])
def test_the_middle_of_each_sector_looks_its_way(model):
    parts = sectors(model.rays().rays, model)
    for name, way in (("front", 0), ("left", 90), ("back", 180), ("right", -90)):
        side = len(parts[name])
        x, y, _ = parts[name][side - 1 - side // 2, side // 2]
        off = np.degrees(np.arctan2(y, x)) - way
        assert (off + 180) % 360 - 180 == pytest.approx(0, abs=0.5)


@pytest.mark.parametrize("model", [MODEL, SHIFTED])
def test_columns_of_the_panorama_are_azimuths_and_rows_tangents(model):
    panorama = unwrap(model.rays().rays, model, width=720)[2:-2].astype(np.float64)
    x, y, z = np.moveaxis(panorama, 2, 0)
    expected = 180 - (np.arange(720) + 0.5) / 2
    off = (np.degrees(np.arctan2(y, x)) - expected + 180) % 360 - 180
    assert np.abs(off).max() < 0.1
    low, high = np.tan(np.deg2rad(model.elevations_deg))
    rise = high - (np.arange(2, len(panorama) + 2) + 0.5) * 2 * np.pi / 720
    assert np.abs(z / np.hypot(x, y) - rise[:, None]).max() < 0.02
    assert rise[-1] == pytest.approx(low, abs=0.05)


def test_the_mask_covers_the_camera_the_helmet_the_arms_and_the_outside():
    mask, (radius, angle) = MODEL.mask(), polar(MODEL)
    assert mask.shape == (600, 600) and mask.dtype == np.bool_
    assert not mask[radius < 48].any() and not mask[radius > 290.5].any()
    azimuth = (angle - 45) % 360
    arms = [60.0, 180.0, 300.0]
    for way in range(0, 360, 10):
        off = np.abs((azimuth - way + 180) % 360 - 180)
        thin = (off < 0.3) & (radius > 120) & (radius < 285)
        assert mask[thin].any() != (way in arms), way
    # The helmet hides more of the ground behind than ahead.
    behind = (np.abs(azimuth - 160) < 5) & (radius > 52) & (radius < 72)
    ahead = ((azimuth + 20) % 360 < 40) & (radius > 52) & (radius < 72)
    assert not mask[behind].any() and mask[ahead].all()
    ring = (radius > 49) & (radius < 290)
    assert 0.9 < mask[ring].mean() < 0.98
    bare = OmniModel(struts_deg=(), helmet_px=0).mask()
    assert bare[ring].all()


def test_masks_are_cut_and_unrolled_like_images():
    mask = MODEL.mask()
    front = sectors(mask, MODEL)["front"]
    assert np.array_equal(front, mask[10:300, 300:590])
    seen = unwrap(mask, MODEL, width=720)
    assert seen.dtype == np.bool_
    # Arms at 60 degrees to the left and the right of the middle.
    assert not seen[20, [239, 240, 479, 480]].any() and seen[20, 300:420].all()
    assert not seen[-10, :60].any()


def test_the_image_is_black_outside_and_dark_where_the_mask_is():
    light = np.full((600, 600, 3), 150, dtype=np.float32)
    image = mirror_image(light, MODEL, QUIET, gain=1.0, noise=0)
    radius, _ = polar(MODEL)
    assert image.dtype == np.uint8 and image[radius > 292].max() == 0
    clear = MODEL.mask() & (radius > 150) & (radius < 200)
    covered = ~MODEL.mask() & (radius < 289)
    assert np.median(image[clear]) > 110
    assert image[covered].mean() < 30
    assert image[covered].max() > image[covered].min() + 20


def test_the_rim_is_darker_and_less_sharp_than_the_middle():
    light = np.full((600, 600, 3), 150, dtype=np.float32)
    bare = OmniModel(struts_deg=(), helmet_px=0)
    even = mirror_image(light, bare, QUIET, gain=1.0, noise=0).astype(float)
    assert even[300, 580].mean() < 0.8 * even[300, 360].mean()
    light[:, ::4] = 50
    image = mirror_image(light, bare, QUIET, gain=1.0, noise=0).astype(float)
    contrast = [np.ptp(image[300, a : a + 24, 0]) for a in (360, 450, 555)]
    # What the vignetting takes from the contrast is less.
    dimmer = [even[300, a, 0] for a in (360, 450, 555)]
    sharpness = np.divide(contrast, dimmer)
    assert sharpness[0] > 1.2 * sharpness[1] > 1.4 * sharpness[2]


def test_gain_and_noise_are_the_photographs():
    light = np.full((600, 600, 3), 60, dtype=np.float32)
    normal = np.random.default_rng(3).standard_normal((600, 600, 3)).astype(np.float32)
    images = [
        mirror_image(light, MODEL, normal, gain, noise).astype(float)[280:320, 400:440]
        for gain, noise in ((1.0, 0.0), (2.0, 0.0), (2.0, 1.0))
    ]
    assert images[1].mean() == pytest.approx(2 * images[0].mean(), rel=0.02)
    # The variance is 3 % of the level, and the read noise's.
    assert (images[2] - images[1]).std() == pytest.approx(np.sqrt(0.03 * 112 + 0.8**2), rel=0.1)


def test_the_camera_stands_over_the_forward_one_and_tilts_with_it():
    heading, place = np.array([0.7]), np.array([[1.0, 2.0, 1.4]])
    level = camera_poses(place, heading, np.zeros(1), np.zeros(1))[0] @ T_camera_omni()
    assert level[:3, 3] == pytest.approx([1, 2, 1.65])
    assert level[:3, 2] == pytest.approx([0, 0, 1], abs=1e-12)
    assert level[:3, 0] == pytest.approx([np.cos(0.7), np.sin(0.7), 0], abs=1e-12)
    assert np.linalg.det(level[:3, :3]) == pytest.approx(1)
    pitched = camera_poses(place, heading, np.full(1, 0.1), np.zeros(1))[0] @ T_camera_omni(0.5)
    assert pitched[2, 0] == pytest.approx(np.sin(0.1))
    assert np.linalg.norm(pitched[:3, 3] - place[0]) == pytest.approx(0.5)


@pytest.mark.parametrize("model", [MODEL, SHIFTED, OmniModel(struts_deg=())])
def test_a_model_is_read_as_it_was_written(tmp_path, model):
    path = tmp_path / "omni.json"
    write_model(path, model)
    assert read_model(path) == model


BAD = {
    "lacking": lambda values: values.pop("xi"),
    "text": lambda values: values.update(gamma_px="wide"),
    "not finite": lambda values: values.update(front_deg=float("nan")),
    "endless": lambda values: values.update(size_px=float("inf")),
    "a part of a pixel": lambda values: values.update(size_px=600.5),
    "too large": lambda values: values.update(size_px=10**6),
    "inside out": lambda values: values.update(inner_px=295),
    "no hyperbola": lambda values: values.update(xi=1.2),
    "no focal length": lambda values: values.update(gamma_px=0),
    "centre of one number": lambda values: values.update(centre=[300]),
    "ring leaves": lambda values: values.update(centre=[250, 299.5]),
    "struts of none": lambda values: values.update(struts_deg=None),
    "negative": lambda values: values.update(strut_px=-1),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_values_are_refused(tmp_path, name):
    path = tmp_path / "omni.json"
    write_model(path, MODEL)
    values = json.loads(path.read_text())
    BAD[name](values)
    path.write_text(json.dumps(values))
    with pytest.raises(DatasetError, match="invalid omnidirectional camera file"):
        read_model(path)


@pytest.mark.parametrize("text", ["", "[1, 2]", "7", "null", "{"])
def test_what_is_no_model_is_refused(tmp_path, text):
    path = tmp_path / "omni.json"
    path.write_text(text)
    with pytest.raises(DatasetError, match=r"omni\.json"):
        read_model(path)


def test_a_missing_file_is_told(tmp_path):
    with pytest.raises(DatasetError, match="cannot be read"):
        read_model(tmp_path / "none.json")
