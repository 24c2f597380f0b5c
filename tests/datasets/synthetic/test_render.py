"""Pictures of the building: geometry, light, noise, texture."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from roomgraph.datasets.synthetic.building import build
from roomgraph.datasets.synthetic.cameras.kinect import FOCAL_BASELINE, NoiseBank, measure
from roomgraph.datasets.synthetic.motion.walk import camera_poses, walk
from roomgraph.datasets.synthetic.plans.layout import CEILING_M
from roomgraph.datasets.synthetic.renderer import Renderer
from roomgraph.datasets.synthetic.settings import LIGHTS, BuildingSettings

pytestmark = pytest.mark.slow

SMALL = BuildingSettings(seed=1, width=160, height=120)


@pytest.fixture(scope="module")
def building():
    return build(1)


@pytest.fixture(scope="module")
def renderer(building):
    return Renderer(building, SMALL.intrinsics)


@pytest.fixture(scope="module")
def trajectory(building):
    return walk(building, SMALL)


def looking(x, y, z=0.8, heading=0.0, pitch=0.0):
    angles = (np.array([a], dtype=float) for a in (heading, pitch, 0.0))
    return camera_poses(np.array([(x, y, z)], dtype=float), *angles)[0]


def test_depth_of_the_floor_is_the_plane_equation(building, renderer):
    corridor = building.rooms[0].floor
    T = looking(corridor.centre[0], corridor.centre[1], pitch=-np.pi / 2)
    depth = renderer.render(T, noise=0).depth
    middle = depth[40:80, 60:100]
    np.testing.assert_allclose(middle, 0.8, atol=1e-4)


def test_depth_of_a_tilted_view_of_the_ceiling(building, renderer):
    pitch = np.deg2rad(60)
    corridor = building.rooms[0].floor
    T = looking(*corridor.centre, heading=0.0, pitch=pitch)
    depth = renderer.render(T, noise=0).depth
    v = np.arange(50, 70)
    down = (v - SMALL.intrinsics.cy) / SMALL.intrinsics.fy
    rise = np.sin(pitch) - down * np.cos(pitch)
    expected = (CEILING_M - 0.8) / rise
    # Lamps hang 1 cm below the ceiling.
    assert np.abs(depth[50:70, 80] - expected).max() < 0.015


def test_exact_depth_lands_on_the_shell_or_inside(building, renderer, trajectory):
    u, v = np.meshgrid(np.arange(SMALL.width), np.arange(SMALL.height))
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(float)
    shares = []
    for index in range(0, len(trajectory), 200):
        T = trajectory.T_world_camera[index]
        depth = renderer.render(T, noise=0).depth.ravel()
        seen = depth > 0
        points = SMALL.intrinsics.backproject(pixels[seen], depth[seen].astype(float))
        world = points @ T[:3, :3].T + T[:3, 3]
        assert world[:, 2].min() > -1e-3
        assert world[:, 2].max() < CEILING_M + 1e-3
        outside = np.min([r.floor.distance(world[:, :2]) for r in building.rooms], axis=0)
        assert outside.max() < 0.071
        planes = [world[:, 2], CEILING_M - world[:, 2]]
        for r in (room.floor for room in building.rooms):
            planes += [
                world[:, 0] - r.x0,
                world[:, 0] - r.x1,
                world[:, 1] - r.y0,
                world[:, 1] - r.y1,
            ]
        on_shell = np.min(np.abs(planes), axis=0) < 0.002
        shares.append(on_shell.mean())
    # A view of furniture alone may see little of the shell.
    assert min(shares) > 0.05
    assert np.mean(shares) > 0.25


def test_one_cast_gives_the_same_as_lights_alone(renderer, trajectory):
    T = trajectory.T_world_camera[30]
    both = renderer.render(T, LIGHTS, seed=(1, 30))
    for light in LIGHTS:
        alone = renderer.render(T, [light], seed=(1, 30))
        assert np.array_equal(alone.colours[light], both.colours[light])
        assert np.array_equal(alone.depth, both.depth)
    again = renderer.render(T, LIGHTS, seed=(1, 31))
    assert not np.array_equal(again.depth, both.depth)
    assert not np.array_equal(again.colours["day"], both.colours["day"])


def test_night_is_darker_warmer_and_noisier_than_day(renderer, trajectory):
    views = [
        renderer.render(trajectory.T_world_camera[i], LIGHTS, seed=(1, i))
        for i in range(0, len(trajectory), 60)
    ]
    mean = {light: np.mean([v.colours[light].mean(axis=(0, 1)) for v in views], axis=0)
            for light in LIGHTS}  # fmt: skip
    assert mean["day"].mean() > mean["dusk"].mean() > mean["night"].mean()
    assert mean["night"][0] / mean["night"][2] > 1.15 * mean["day"][0] / mean["day"][2]
    clean = renderer.render(trajectory.T_world_camera[0], LIGHTS, noise=0)
    noise = {
        light: (views[0].colours[light].astype(float) - clean.colours[light]).std()
        for light in LIGHTS
    }
    assert noise["day"] < noise["dusk"] < noise["night"]


@pytest.mark.parametrize("distance", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("scale", [0.5, 1.0])
def test_depth_noise_has_the_sigma_of_a_kinect(distance, scale):
    shape = (240, 320)
    normal = NoiseBank.draw(*shape).window(np.random.default_rng(3), *shape)
    z = np.full(shape, distance, dtype=np.float32)
    facing, blind = np.ones(shape, np.float32), np.zeros(shape, bool)
    depth = measure(z, facing, blind, scale, normal)
    sigma = scale * (0.0012 + 0.0019 * (distance - 0.4) ** 2)
    error = depth[depth > 0] - distance
    assert error.std() == pytest.approx(sigma, rel=0.12)
    assert abs(error.mean()) < 0.1 * sigma
    # Disparity comes in steps: few values, whole multiples of the step.
    steps = FOCAL_BASELINE / depth[depth > 0] * 8 / scale
    np.testing.assert_allclose(steps, np.rint(steps), atol=0.02)


def test_depth_holes_and_range():
    shape = (40, 60)
    normal = np.zeros((*shape, 3), np.float32)
    facing, blind = np.ones(shape, np.float32), np.zeros(shape, bool)
    z = np.full(shape, 2.0, np.float32)
    z[:, 30:] = 3.0
    z[:5] = 0.3
    z[-5:] = 6.0
    blind[20, 10] = True
    facing[22, 10] = 0.01
    depth = measure(z, facing, blind, 1.0, normal)
    assert not depth[:5].any()
    assert not depth[-5:].any()
    assert depth[20, 10] == depth[22, 10] == 0
    assert not depth[15:25, 29:31].any()
    assert depth[21, 10] == pytest.approx(2.0, abs=0.02)
    exact = measure(z, facing, blind, 0.0, normal)
    assert exact[20, 29] == 2.0
    assert exact[20, 30] == 3.0


def test_sift_finds_hundreds_of_points_on_the_way_and_few_on_a_bare_wall(building, trajectory):
    intrinsics = BuildingSettings().intrinsics
    full = Renderer(building, intrinsics)
    sift = cv2.SIFT_create()
    counts = []
    for index in range(0, len(trajectory), 90):
        colour = full.render(trajectory.T_world_camera[index]).colours["day"]
        counts.append(len(sift.detect(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), None)))
    assert np.median(counts) > 300
    office = building.plan.room("office1").floor
    # High up over the furniture: paint and nothing else.
    bare = looking(office.centre[0], office.centre[1], z=2.35, heading=0.0)
    colour = full.render(bare).colours["day"][210:270, 240:400]
    assert len(sift.detect(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), None)) < 12
