"""What moves, in pictures: against rays cast by hand, and windows against whole images."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.se3 import inverse, transform
from roomgraph.datasets.synthetic.cameras.omni import OmniModel
from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.synthetic.people.figure import draw_figure
from roomgraph.datasets.synthetic.people.person import Person, Schedule
from roomgraph.datasets.synthetic.recorder import READOUT_S
from roomgraph.datasets.synthetic.renderer import Renderer
from roomgraph.datasets.synthetic.rendering.eye import pinhole
from roomgraph.datasets.synthetic.rendering.mesh import Material, Surfaces
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from roomgraph.datasets.synthetic.rendering.stand import Stand
from roomgraph.datasets.synthetic.structure.moving import Stiff, turned
from tests.datasets.synthetic.worlds import BOX, box_room, suite

CAMERA = Intrinsics(120, 90, 100.0, 100.0, 59.5, 44.5)


def person(way=((4.0, 2.5), (4.0, 2.5)), doing="stand", end_s=10.0):
    schedule = Schedule(
        np.array([0.0, end_s]), np.array(way, dtype=float), np.full(2, 1.0), np.zeros(2), (doing,)
    )
    return Person(draw_figure(np.random.default_rng(2)), schedule)


def door():
    """A leaf of 0.9 x 2 m that turns about (4, 1) by 9 degrees a second."""
    surfaces = Surfaces(np.random.default_rng(0))
    wood = Material(np.full((8, 8, 3), 90, np.uint8))
    Stand(surfaces, (4.0, 1.0, 0.0), np.pi).box((0, 0.9), (-0.02, 0.02), (0.01, 2.0), wood)
    return Stiff(surfaces.quads, lambda stamp: turned((4.0, 1.0), np.deg2rad(9) * stamp))


def looking(x, y, heading=0.0, pitch=0.0, roll=0.0, z=1.2):
    angles = (np.array([value], dtype=float) for value in (heading, pitch, roll))
    return camera_poses(np.array([(x, y, z)], dtype=float), *angles)[0]


def cast_by_hand(corners, T):
    """The depth (H, W) of quads by Moeller and Trumbore, without Open3D; infinite where none."""
    v, u = np.mgrid[: CAMERA.height, : CAMERA.width].reshape(2, -1)
    pixels = np.column_stack([u, v]).astype(float)
    rays = CAMERA.backproject(pixels, np.ones(len(pixels))) @ T[:3, :3].T
    nearest = np.full(len(rays), np.inf)
    for a, b, c in corners[:, [(0, 1, 2), (0, 2, 3)]].reshape(-1, 3, 3):
        normal = np.cross(rays, c - a)
        volume = normal @ (b - a)
        with np.errstate(divide="ignore", invalid="ignore"):
            s = normal @ (T[:3, 3] - a) / volume
            across = np.cross(T[:3, 3] - a, b - a)
            r, t = rays @ across / volume, (c - a) @ across / volume
            hit = (s >= 0) & (r >= 0) & (s + r <= 1) & (t > 0)
        nearest[hit] = np.minimum(nearest[hit], t[hit])
    return nearest.reshape(CAMERA.height, CAMERA.width)


@pytest.fixture(scope="module")
def renderer():
    walker = person(((3.2, 2.0), (5.0, 3.4)), "walk")
    return Renderer(box_room(), CAMERA, [door()], [person(), walker])


@pytest.mark.parametrize("stamp", [0.0, 3.3, 7.1])
@pytest.mark.parametrize("view", [(1.0, 2.4, 0.0), (1.4, 4.2, -0.6), (3.0, 2.3, 0.2)])
def test_depth_is_that_of_the_nearest_surface(renderer, stamp, view):
    T = looking(*view, pitch=-0.05, roll=0.03)
    sight = renderer.look(renderer.eye, T, stamp)
    still = cast_by_hand(np.array([quad.corners for quad in box_room().quads]), T)
    assert np.isfinite(still).all()
    moving = np.array([cast_by_hand(body.corners(stamp), T) for body in renderer.bodies])
    expected = np.minimum(still, moving.min(axis=0))
    # Rays that graze the edge of a triangle may go either way.
    assert (np.abs(sight.hits.t - expected) < 1e-3).mean() > 0.995
    seen = np.where(moving.min(axis=0) < still, moving.argmin(axis=0), -1)
    assert (seen >= 0).sum() > 200
    bounds = [*renderer._first, renderer._first[-1] + 2 * len(renderer.bodies[-1].quads)]
    owner = np.digitize(sight.hits.triangle, bounds) - 1
    assert (owner == seen).mean() > 0.99
    mask = renderer.people_mask(sight)
    assert ((seen >= 1) == mask).mean() > 0.99
    assert np.array_equal(mask, owner >= 1)


def test_a_mask_is_the_outline_of_the_body():
    body = person()
    renderer = Renderer(box_room(), CAMERA, [], [body])
    T = looking(1.5, 2.4)
    mask = renderer.people_mask(renderer.look(renderer.eye, T, 4.0))
    points = transform(inverse(T), body.corners(4.0).reshape(-1, 3))
    pixels = np.rint(CAMERA.project(points) * 16).astype(np.int32).reshape(-1, 4, 2)
    outline = np.zeros(mask.shape, np.uint8)
    for quad in pixels:
        cv2.fillPoly(outline, [quad], 1, cv2.LINE_8, 4)
    grown = cv2.dilate(outline, np.ones((3, 3), np.uint8))
    shrunk = cv2.erode(outline, np.ones((3, 3), np.uint8))
    assert mask.sum() > 500
    assert not (mask & (grown == 0)).any()
    # Filling closes gaps of a pixel, such as that between an arm and the body.
    assert (shrunk > 0).sum() > 350
    assert mask[shrunk > 0].mean() > 0.98


def test_who_has_gone_is_not_seen():
    body = person(end_s=5.0)
    renderer = Renderer(box_room(), CAMERA, [], [body])
    T = looking(1.5, 2.4)
    there, gone = (renderer.look(renderer.eye, T, stamp) for stamp in (4.9, 5.1))
    assert renderer.people_mask(there).any()
    assert not renderer.people_mask(gone).any()
    empty = Renderer(box_room(), CAMERA)
    assert np.array_equal(gone.hits.t, empty.look(empty.eye, T, 5.1).hits.t)


def test_windows_never_cut_a_body_off(rng):
    bodies, eye, cut, whole = [person(), door()], pinhole(CAMERA), 0, 0
    for _ in range(300):
        body, stamp = bodies[int(rng.integers(2))], float(rng.uniform(0, 10))
        heading = rng.uniform(-np.pi, np.pi)
        off = body.centre(stamp)[:2] - rng.uniform(0.3, 12) * np.array(
            [np.cos(heading), np.sin(heading)]
        )
        T = looking(*off, heading + rng.normal(0, 0.35), *rng.normal(0, 0.25, 2), rng.uniform(0, 2))
        hit = np.isfinite(Scene.of(body.corners(stamp)).cast(eye.world_rays(T)).t)
        rows, columns = eye.window(body.centre(stamp), body.radius_m, T)
        inside = np.zeros(hit.shape, bool)
        inside[rows, columns] = True
        assert not (hit & ~inside).any()
        cut += hit.any() and not inside.all()
        whole += inside.all()
    assert cut > 60
    # Else it were no window at all.
    assert whole < 150


def test_an_eye_of_another_kind_looks_everywhere():
    eye = OmniModel().resized(60).rays()
    rows, columns = eye.window(np.array([-3.0, 0, 1]), 1.0, looking(0, 0))
    assert (rows, columns) == (slice(0, 60), slice(0, 60))
    rows, columns = pinhole(CAMERA).window(np.array([-3.0, 0, 1]), 1.0, looking(0, 0))
    assert rows.stop == rows.start


@pytest.mark.slow
def test_windows_hold_for_a_rolling_shutter_in_a_shaken_hand(rng):
    world, body, found = suite(), person(), 0
    camera = Intrinsics(160, 120, 131.25, 131.25, 79.5, 59.5)
    eye = pinhole(camera)
    centre = body.centre(3.0)
    for stretch in world.stretches:
        if stretch.kind not in ("fast_turn", "shake"):
            continue
        for middle in rng.uniform(stretch.begin_s, stretch.end_s, 10):
            rows_s = middle + ((np.arange(120) + 0.5) / 120 - 0.5) * READOUT_S
            T = world.motion.poses(rows_s)
            # Put the body before the camera, near enough or far, anywhere in the image.
            u, v = rng.uniform(-10, 170), rng.uniform(20, 100)
            ray = camera.backproject(np.array([(u, v)]), np.array([rng.uniform(1.5, 14)]))
            shift = transform(T[60], ray)[0] - centre
            corners = body.corners(3.0) + shift
            hit = np.isfinite(Scene.of(corners).cast(eye.world_rays(T)).t)
            window = np.zeros(hit.shape, bool)
            window[eye.window(centre + shift, body.radius_m, T[60])] = True
            assert not (hit & ~window).any(), (stretch.kind, middle, u, v)
            found += hit.any()
    assert found > 50


def test_each_row_of_a_rolling_shutter_has_its_own_pose(renderer):
    eye, count = renderer.eye, CAMERA.height
    headings = np.linspace(-0.1, 0.1, count)
    level = np.zeros(count)
    places = np.column_stack([np.linspace(1.0, 1.1, count), level + 2.4, level + 1.2])
    T = camera_poses(places, headings, level, level)
    rays = eye.world_rays(T)
    rolling = renderer.look(eye, T, 3.0)
    for row in range(0, count, 7):
        np.testing.assert_allclose(rays[row], eye.world_rays(T[row])[row], atol=1e-6)
        alone = renderer.look(eye, T[row], 3.0)
        assert (np.abs(rolling.hits.t[row] - alone.hits.t[row]) < 1e-3).mean() > 0.97
        assert (rolling.hits.triangle[row] == alone.hits.triangle[row]).mean() > 0.95
    assert not np.allclose(rolling.hits.t, renderer.look(eye, T[count // 2], 3.0).hits.t, atol=0.01)


def test_points_of_one_image_are_where_another_sees_them(renderer):
    """Exact depth carried from one view into another, through the empty room with a door."""
    views = [looking(1.2, 1.6, 0.1), looking(1.9, 2.6, -0.15, -0.1)]
    depths = [renderer.look(renderer.eye, T, 2.0).hits.t.astype(float) for T in views]
    v, u = np.mgrid[: CAMERA.height, : CAMERA.width].reshape(2, -1)
    pixels = np.column_stack([u, v]).astype(float)
    world = transform(views[0], CAMERA.backproject(pixels, depths[0].ravel()))
    assert (BOX.distance(world[:, :2]) < 1e-3).all()
    points = transform(inverse(views[1]), world)
    points = points[points[:, 2] > 0.3]
    at = CAMERA.project(points)
    inside = ((at >= 1) & (at <= (CAMERA.width - 2, CAMERA.height - 2))).all(axis=1)
    points, at = points[inside], at[inside].astype(np.float32)
    # Between pixels of a plane 1 / depth is linear.
    other = 1 / cv2.remap((1 / depths[1]).astype(np.float32), at[:, :1], at[:, 1:],
                          cv2.INTER_LINEAR).ravel()  # fmt: skip
    visible = points[:, 2] < other + 0.05
    assert visible.sum() > 2000
    assert (np.abs(points[visible, 2] - other[visible]) < 0.01).mean() > 0.9
