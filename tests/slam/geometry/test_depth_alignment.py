import numpy as np

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.slam.geometry.depth_alignment import align_surface, surface_of
from tests.slam.helpers import NOISE, motion_error

CAMERA = Intrinsics(160, 120, 130.0, 130.0, 79.5, 59.5)
NOTHING = 1e-6 * np.eye(6)


def _corner(T_world_camera=None):
    """A frame of a room's corner: floor, left wall and back wall, by exact ray casting."""
    T = np.eye(4) if T_world_camera is None else T_world_camera
    v, u = np.indices((120, 160)).astype(float)
    rays = np.stack([(u - 79.5) / 130, (v - 59.5) / 130, np.ones_like(u)], axis=-1)
    world = rays @ T[:3, :3].T
    depth = np.full((120, 160), np.inf)
    for normal, distance in (((0, 1, 0), 0.8), ((-1, 0, 0), 1.0), ((0, 0, 1), 3.0)):
        n = np.array(normal, float)
        with np.errstate(divide="ignore"):
            z = (distance - n @ T[:3, 3]) / (world @ n)
        depth = np.where(z > 0, np.minimum(depth, z), depth)
    return Frame(0, 0.0, np.zeros((120, 160, 3), np.uint8), depth.astype(np.float32), CAMERA)


def test_normals_are_those_of_the_walls():
    normals = surface_of(_corner(), 2).normals.reshape(-1, 3)
    normals = normals[np.isfinite(normals[:, 0])]
    shares = [np.mean(np.abs(normals[:, axis]) > 0.99) for axis in range(3)]
    assert sum(shares) > 0.9
    assert min(shares) > 0.05


def test_a_corner_holds_all_six_directions():
    T = se3.exponential(np.array([0.02, -0.03, 0.01, 0.04, -0.02, 0.05]))
    cloud, target = surface_of(_corner(T), 3).cloud, surface_of(_corner(), 3)
    found, information = align_surface(cloud, target, np.eye(4), NOTHING, NOISE, 0.2)
    metres, radians = motion_error(found, T)
    assert metres < 0.003
    assert radians < 0.003
    assert np.linalg.eigvalsh(information).min() > 100


def test_a_strong_prior_holds():
    T = se3.exponential(np.array([0, 0, 0, 0.05, 0, 0]))
    cloud, target = surface_of(_corner(T), 3).cloud, surface_of(_corner(), 3)
    found, _ = align_surface(cloud, target, np.eye(4), 1e12 * np.eye(6), NOISE, 0.2)
    assert motion_error(found, np.eye(4)) < (1e-4, 1e-4)


def test_nothing_in_view_leaves_the_motion_as_it_was():
    target = surface_of(_corner(), 3)
    away = se3.pose(t=(0, 0, -10))
    found, information = align_surface(target.cloud, target, away, NOTHING, NOISE, 0.2)
    assert np.array_equal(found, away)
    assert not information.any()
