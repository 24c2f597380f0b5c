import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.errors import SlamError
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.reconstruction.mesh import mesh_from_points, mesh_of

CAMERA = Intrinsics(160, 120, 131.25, 131.25, 79.5, 59.5)
VOXEL = 0.03


def _ball(T_world_camera, radius=0.6, centre=(0.0, 0.0, 2.0)):
    """Return what a camera sees of a red ball before a green wall at z = 3."""
    rows, columns = np.mgrid[: CAMERA.height, : CAMERA.width]
    pixels = np.stack([columns, rows], axis=-1).reshape(-1, 2).astype(float)
    rays = CAMERA.backproject(pixels, np.ones(len(pixels)))
    middle = se3.transform(se3.inverse(T_world_camera), np.array([centre]))[0]
    b, square = rays @ middle, (rays**2).sum(axis=1)
    under = b**2 - square * (middle @ middle - radius**2)
    hit = under > 0
    depth = (b - np.sqrt(np.maximum(under, 0))) / square
    wall = (3.0 - T_world_camera[2, 3]) / (rays @ T_world_camera[2, :3])
    depth = np.where(hit, depth, wall).reshape(rows.shape)
    colour = np.where(hit.reshape(*rows.shape, 1), (200, 0, 0), (0, 100, 0)).astype(np.uint8)
    return RangeImage(np.rint(1000 * depth).astype(np.uint16), colour, CAMERA)


@pytest.fixture
def views():
    """Four images of the ball from around, and where from."""
    T = {i: se3.exponential(np.array([0, 0.08 * i, 0, -0.25 * i, 0, 0])) for i in range(-2, 2)}
    return [(i, _ball(T[i])) for i in T], T


def _on_ball(mesh):
    distance = np.linalg.norm(mesh.vertices - (0, 0, 2.0), axis=1)
    return distance < 0.7, distance


def test_a_ball_is_round_red_and_looks_outwards(views):
    mesh = mesh_of(*views, VOXEL)
    on_ball, distance = _on_ball(mesh)
    front = on_ball & (mesh.vertices[:, 2] < 1.7)
    assert front.sum() > 300
    assert np.abs(distance[front] - 0.6).max() < VOXEL
    # Distances along the rays are longer than to the ball: a known bias of projection.
    assert np.median(np.abs(distance[front] - 0.6)) < VOXEL / 5
    assert np.median(mesh.colours[front], axis=0).tolist() == [200, 0, 0]
    outwards = (mesh.vertices[front] - (0, 0, 2.0)) / distance[front, None]
    assert np.median((mesh.normals[front] * outwards).sum(axis=1)) > 0.99
    wall = mesh.vertices[mesh.vertices[:, 2] > 2.8]
    assert len(wall) > 1000 and np.abs(wall[:, 2] - 3.0).max() < VOXEL / 2


def test_triangles_turn_the_way_their_normals_look(views):
    mesh = mesh_of(*views, VOXEL)
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    face = np.cross(b - a, c - a)
    assert ((face * mesh.normals[mesh.triangles[:, 0]]).sum(axis=1) >= 0).mean() > 0.98


def test_the_same_images_give_the_same_mesh_to_the_byte(views):
    first, second = mesh_of(*views, VOXEL), mesh_of(iter(views[0]), views[1], VOXEL)
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert first.triangles.tobytes() == second.triangles.tobytes()


def test_surfaces_seen_by_few_can_be_left_out(views):
    images, T = views
    whole, sure = mesh_of(images, T, VOXEL), mesh_of(images, T, VOXEL, min_views=4)
    assert 0 < len(sure.vertices) < 0.9 * len(whole.vertices)


def _sphere_points(rng, count=20_000):
    normals = rng.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    colours = np.where(normals[:, :1] > 0, (250, 10, 0), (0, 10, 250)).astype(np.uint8)
    points = (0.6 * normals + (1, 2, 3)).astype(np.float32)
    return points, normals.astype(np.float32), colours


def test_points_with_normals_become_a_closed_surface(rng):
    mesh = mesh_from_points(*_sphere_points(rng), VOXEL)
    offset = mesh.vertices - (1, 2, 3)
    distance = np.linalg.norm(offset, axis=1)
    assert np.abs(distance - 0.6).max() < 0.003
    assert (mesh.normals * offset / distance[:, None]).sum(axis=1).min() > 0.9
    edges = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    assert (count == 2).all()
    right, left = offset[:, 0] > 0.1, offset[:, 0] < -0.1
    assert (mesh.colours[right] == (250, 10, 0)).all()
    assert (mesh.colours[left] == (0, 10, 250)).all()


def test_nothing_is_made_up_between_pieces(rng):
    points, normals, colours = _sphere_points(rng)
    apart = np.abs(normals[:, 2]) > 0.5
    mesh = mesh_from_points(points[apart], normals[apart], colours[apart], VOXEL)
    assert np.abs(mesh.vertices[:, 2] - 3).min() > 0.6 * 0.5 - 2 * VOXEL


def test_no_surface_is_an_error_not_an_empty_mesh():
    blank = RangeImage(np.zeros((120, 160), np.uint16), np.zeros((120, 160, 3), np.uint8), CAMERA)
    for images in ([], [(0, blank)]):
        with pytest.raises(SlamError, match="mesh is empty"):
            mesh_of(images, {0: np.eye(4)}, VOXEL)
    with pytest.raises(SlamError, match="mesh is empty"):
        mesh_from_points(np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3), np.uint8), VOXEL)


def test_open3ds_threads_are_left_as_they_were(views):
    import open3d as o3d

    before = o3d.utility.get_max_threads()
    o3d.utility.set_max_threads(2)
    try:
        mesh_of(*views, VOXEL)
        assert o3d.utility.get_max_threads() == 2
    finally:
        o3d.utility.set_max_threads(before)
