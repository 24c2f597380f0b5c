import numpy as np
import pytest

from roomgraph.slam.errors import SlamError
from roomgraph.slam.reconstruction.mesh import mesh_from_points

VOXEL = 0.03


def test_triangles_turn_the_way_their_normals_look(rng):
    mesh = mesh_from_points(*_sphere_points(rng), VOXEL)
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    face = np.cross(b - a, c - a)
    assert ((face * mesh.normals[mesh.triangles[:, 0]]).sum(axis=1) >= 0).mean() > 0.98


def test_the_same_points_give_the_same_mesh_to_the_byte(rng):
    points = _sphere_points(rng)
    first, second = (mesh_from_points(*points, VOXEL) for _ in range(2))
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert first.triangles.tobytes() == second.triangles.tobytes()


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
    with pytest.raises(SlamError, match="mesh is empty"):
        mesh_from_points(np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3), np.uint8), VOXEL)


def test_open3ds_threads_are_left_as_they_were(rng):
    import open3d as o3d

    before = o3d.utility.get_max_threads()
    o3d.utility.set_max_threads(2)
    try:
        mesh_from_points(*_sphere_points(rng), VOXEL)
        assert o3d.utility.get_max_threads() == 2
    finally:
        o3d.utility.set_max_threads(before)
