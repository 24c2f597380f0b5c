import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.planes import Plane
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.reconstruction.dynamic_points import count_visibility
from roomgraph.slam.reconstruction.fusion import Fusion
from roomgraph.slam.reconstruction.point_map import (
    LiveMap,
    MapSettings,
    PointMap,
    build_map,
)
from tests.slam.helpers import CAMERA, NOISE

SMALL = Intrinsics(64, 48, 52.5, 52.5, 31.5, 23.5)
SETTINGS = MapSettings(voxel_m=0.05)


def _keyframe(number, image):
    return Keyframe(
        id=number, frame_index=number, stamp_s=float(number), features=Features.none(),
        points=np.empty((0, 3)), words=np.empty(0, dtype=np.intp), planes=(), image=image,
        intrinsics=CAMERA,
    )  # fmt: skip


def _image(depth_m, colour=(10, 20, 30), camera=SMALL):
    depth = np.broadcast_to(depth_m, (camera.height, camera.width))
    return RangeImage(
        np.rint(depth * 1000).astype(np.uint16),
        np.full((*depth.shape, 3), colour, np.uint8),
        camera,
    )


def _reading(depth_m, colour):
    """Return an image with one reading, in the middle."""
    camera = Intrinsics(1, 1, 50.0, 50.0, 0.0, 0.0)
    return _image(np.array([[depth_m]]), colour, camera)


def _walls(rng, count=6):
    """Return keyframes that see pieces of walls, and poses a little apart."""
    images = [
        _image(
            rng.uniform(1.5, 2.5) + rng.uniform(-0.005, 0.005) * np.arange(64),
            rng.integers(256, size=3),
        )
        for _ in range(count)
    ]
    T = {i: se3.exponential(rng.normal(0, 0.1, 6)) for i in range(count)}
    return {i: _keyframe(i, image) for i, image in enumerate(images)}, T


def _same(a, b):
    return all(
        getattr(a, name).tobytes() == getattr(b, name).tobytes()
        for name in ("points_world", "colours", "keyframes", "normals")
    )


def test_a_voxel_holds_the_mean_of_what_a_keyframe_saw_in_it(rng):
    image = _image(rng.uniform(1.5, 1.6, (48, 64)))
    found = build_map([_keyframe(0, image)], {0: np.eye(4)}, SETTINGS, NOISE)
    cells = np.floor(image.points.astype(float) / 0.05).astype(int)
    unique, inverse = np.unique(cells, axis=0, return_inverse=True)
    assert len(found) == len(unique)
    rows = {
        tuple(cell): row for row, cell in enumerate(np.floor(found.points_world / 0.05).astype(int))
    }
    for i, cell in enumerate(unique):
        mean = image.points[inverse.ravel() == i].mean(axis=0)
        # Positions are kept in 256ths of a voxel.
        assert np.abs(found.points_world[rows[tuple(cell)]] - mean).max() <= 0.05 / 256
    assert (found.colours == (10, 20, 30)).all()


def test_keyframes_weigh_by_the_inverse_variance_of_their_depth():
    near, far = _keyframe(0, _reading(1.0, (200, 0, 0))), _keyframe(1, _reading(2.0, (0, 0, 200)))
    T = {0: se3.pose(t=(0, 0, 0.01)), 1: se3.pose(t=(0, 0, -0.97))}
    found = build_map([near, far], T, MapSettings(voxel_m=0.1), NOISE)
    sigma = NOISE.depth_sigma(np.array([1.0, 2.0]))
    weight = sigma**-2 / (sigma**-2).sum()
    assert np.allclose(found.points_world[0, 2], weight @ (1.01, 1.03), atol=0.0005)
    assert np.allclose(found.colours[0], weight @ ((200, 0, 0), (0, 0, 200)), atol=2)


def test_a_point_belongs_to_the_keyframe_that_saw_it_from_nearest():
    near, far = _keyframe(0, _reading(1.02, (1, 1, 1))), _keyframe(1, _reading(3.02, (1, 1, 1)))
    T = {0: np.eye(4), 1: se3.pose(t=(0, 0, -2.0))}
    for order in ([near, far], [far, near]):
        assert build_map(order, T, SETTINGS, NOISE).keyframes.tolist() == [0]


def test_normals_are_unit_and_point_to_the_camera(rng):
    keyframes, T = _walls(rng, 1)
    found = build_map(keyframes.values(), T, SETTINGS, NOISE)
    towards = T[0][:3, 3] - found.points_world
    assert np.allclose(np.linalg.norm(found.normals, axis=1), 1, atol=1e-5)
    assert ((found.normals * towards).sum(axis=1) > 0).all()
    points, normals = found.points_world.astype(float), found.normals.astype(float)
    # The wall is flat: its own normal is that of its points.
    _, _, Vt = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    assert np.median(np.abs(normals @ Vt[2])) > np.cos(np.radians(3))


def test_the_map_moves_with_its_keyframes(rng):
    keyframes, T = _walls(rng, 1)
    # By whole blocks of voxels, so that points keep their order.
    shift = (4.0, -8.0, 20.0)
    here = build_map(keyframes.values(), T, SETTINGS, NOISE)
    there = build_map(keyframes.values(), {0: se3.pose(t=shift) @ T[0]}, SETTINGS, NOISE)
    assert np.abs(there.points_world - here.points_world - shift).max() <= 0.05 / 256


def test_the_order_of_keyframes_does_not_matter_to_the_byte(rng):
    keyframes, T = _walls(rng)
    order = list(keyframes.values())
    assert _same(build_map(order, T, SETTINGS, NOISE), build_map(order[::-1], T, SETTINGS, NOISE))


def test_nothing_of_a_keyframe_is_left_when_it_is_taken_out(rng):
    keyframes, T = _walls(rng)
    fusion, without = Fusion(0.05, NOISE), Fusion(0.05, NOISE)
    for number, keyframe in keyframes.items():
        fusion.add(number, keyframe.image, T[number])
        if number != 2:
            without.add(number, keyframe.image, T[number])
    fusion.remove(2)
    for name in ("keys", "points", "colours", "normals", "keyframes", "views"):
        a, b = getattr(fusion.voxels(), name), getattr(without.voxels(), name)
        assert a.tobytes() == b.tobytes()


def test_a_map_that_follows_loops_is_the_map_made_afresh(rng):
    keyframes, T = _walls(rng)
    settings = MapSettings(voxel_m=0.02, sketch_slack=0.0, sketch_step=1)
    live = LiveMap(settings, NOISE)
    live.update({0: keyframes[0], 1: keyframes[1]}, T)
    live.update(keyframes, T)
    moved = {i: se3.exponential(rng.normal(0, 0.3, 6)) @ T[i] for i in T}
    del keyframes[1]
    followed = live.update(keyframes, moved)
    assert len(followed) and _same(followed, LiveMap(settings, NOISE).update(keyframes, moved))
    coarse = MapSettings(voxel_m=0.05, remove_dynamic=False)
    assert _same(followed, build_map(keyframes.values(), moved, coarse, NOISE))


def test_a_live_map_leaves_alone_what_has_hardly_moved(rng):
    keyframes, T = _walls(rng, 2)
    live = LiveMap(SETTINGS, NOISE)
    before = live.update(keyframes, T)
    nudged = {0: T[0], 1: se3.pose(t=(0.01, 0, 0)) @ T[1]}
    assert _same(before, live.update(keyframes, nudged))
    pushed = {0: T[0], 1: se3.pose(t=(0.2, 0, 0)) @ T[1]}
    assert not _same(before, live.update(keyframes, pushed))


def test_memory_grows_with_new_space_not_with_time(rng):
    image = _image(2.0)
    settings = MapSettings(voxel_m=0.02)
    sizes = []
    for step in (0.0, 1.0):
        fusion = Fusion(settings.voxel_m, NOISE)
        for i in range(40):
            fusion.add(i, image, se3.pose(t=(step * i, 0, 0)))
            fusion.remove(i) if step == 0.0 and i else None
        sizes.append(fusion.nbytes)
    assert sizes[1] > 10 * sizes[0]


def test_nothing_at_all():
    assert len(build_map([], {}, SETTINGS, NOISE)) == 0
    blank = {0: _keyframe(0, _image(0.0))}
    assert len(build_map(blank.values(), {0: np.eye(4)}, SETTINGS, NOISE)) == 0
    assert len(LiveMap(SETTINGS, NOISE).update(blank, {0: np.eye(4)})) == 0


def _box_before_wall(rng, left, right, number):
    """Return a keyframe of a wall at 3 m and a box before it, between two columns, with noise."""
    depth = np.full((48, 64), 3.0)
    depth[16:40, left:right] = 1.5
    depth += NOISE.depth_sigma(depth) * rng.normal(size=depth.shape)
    return _keyframe(number, _image(depth, (number, 0, 0)))


def _box_points(found):
    return int((found.points_world[:, 2] < 2.2).sum())


@pytest.mark.parametrize("voxel_m", [0.02, 0.05])
def test_a_thing_that_goes_away_is_dropped_and_the_wall_stays(rng, voxel_m):
    there = [_box_before_wall(rng, 20, 40, i) for i in range(3)]
    gone = [_box_before_wall(rng, 0, 0, 3 + i) for i in range(5)]
    T = {i: se3.pose(t=(0.02 * i, 0, 0)) for i in range(8)}
    settings = MapSettings(voxel_m=voxel_m)
    with_box = build_map(there, T, settings, NOISE)
    found = build_map(there + gone, T, settings, NOISE)
    whole = build_map(there + gone, T, settings.model_copy(update={"remove_dynamic": False}), NOISE)
    assert _box_points(with_box) > 100 and _box_points(whole) > 100
    assert _box_points(found) < 0.1 * _box_points(whole)
    assert len(found) - _box_points(found) > 0.999 * (len(whole) - _box_points(whole))


def test_a_thing_that_walks_through_leaves_no_trail(rng):
    walk = [_box_before_wall(rng, 6 * i, 6 * i + 10, i) for i in range(9)]
    T = {i: np.eye(4) for i in range(9)}
    found = build_map(walk, T, SETTINGS, NOISE)
    whole = build_map(walk, T, SETTINGS.model_copy(update={"remove_dynamic": False}), NOISE)
    assert _box_points(found) < 0.1 * _box_points(whole)


def test_a_thing_that_stays_stays(rng):
    front = [_box_before_wall(rng, 20, 40, i) for i in range(4)]
    T = {i: np.eye(4) for i in range(4)}
    found = build_map(front, T, SETTINGS, NOISE)
    whole = build_map(front, T, SETTINGS.model_copy(update={"remove_dynamic": False}), NOISE)
    assert _same(found, whole)


def test_noise_alone_makes_no_surface_empty(rng):
    noise = SensorNoise(depth_quadratic=0.005)
    images = []
    for i in range(10):
        depth = np.linspace(1.0, 4.0, 64)[None, :] * np.ones((48, 1))
        images.append((i, _image(depth + noise.depth_sigma(depth) * rng.normal(size=depth.shape))))
    T = {i: se3.pose(t=(0.01 * i, 0, 0)) for i in range(10)}
    fusion = Fusion(0.02, noise)
    for number, image in images:
        fusion.add(number, image, T[number])
    voxels = fusion.voxels()
    seen = count_visibility(voxels, 0.02, images, T, noise)
    assert seen.on.sum() > 10 * len(voxels.keys) * 0.5
    assert seen.is_empty.mean() < 0.01


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 1, 1), (1, 1, 1), (0.2, -0.5, 0.7)])
def test_the_area_of_a_surface_is_known_however_it_lies(rng, normal):
    normal = np.array(normal) / np.linalg.norm(normal)
    across = np.linalg.svd(normal[None])[2][1:]
    points = rng.uniform(0, 4, (200_000, 2)) @ across + 0.03 * normal
    count = len(points)
    plane = PointMap(
        points.astype(np.float32), np.zeros((count, 3), np.uint8), np.zeros(count, np.int32),
        np.tile(normal, (count, 1)).astype(np.float32),
    )  # fmt: skip
    # Cells at the border count whole.
    assert plane.surface_m2() == pytest.approx(16, rel=0.08)
    assert plane.chosen(np.arange(0)).surface_m2() == 0


def test_a_keyframes_bytes_are_counted():
    keyframe = _keyframe(0, _image(2.0))
    assert keyframe.nbytes == 5 * 64 * 48
    features = Features(
        np.zeros((10, 2)), np.zeros((10, 128), np.float32), np.zeros(10, np.float32)
    )
    more = Keyframe(
        id=0, frame_index=0, stamp_s=0.0, features=features, points=np.zeros((10, 3)),
        words=np.zeros(7, dtype=np.intp), planes=(Plane(np.zeros(3), 0.0, np.zeros((100, 3))),),
        image=_image(2.0), intrinsics=CAMERA,
    )  # fmt: skip
    assert more.nbytes == 5 * 64 * 48 + 10 * (16 + 512 + 4 + 24) + 7 * 8 + 2400
