import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.geometry.icp import IcpSettings, align_planes
from roomgraph.slam.geometry.planes import PlaneSettings, extract_planes, fit_plane
from tests.slam.helpers import NOISE, motion_error, room_cloud

PRIOR = np.diag(np.repeat([0.05, 0.05], 3) ** -2.0)


def test_planes_of_a_room_are_found(rng):
    planes = extract_planes(room_cloud(rng, noise=0.003), NOISE, PlaneSettings())
    assert len(planes) == 3
    normals = np.array([p.normal for p in planes])
    # Floor below, wall to the left, wall ahead: each normal points back at the camera.
    for expected in ((0, -1, 0), (1, 0, 0), (0, 0, -1)):
        assert (normals @ np.array(expected)).max() > 0.999
    assert sorted(round(p.offset, 1) for p in planes) == [0.8, 1.5, 3.8]
    assert all(len(p.points) > 700 for p in planes)


def test_no_plane_in_scattered_points(rng):
    assert extract_planes(rng.uniform(0.5, 4, (3000, 3)), NOISE, PlaneSettings()) == ()


def test_too_few_points_are_no_plane(rng):
    assert extract_planes(room_cloud(rng)[:20], NOISE, PlaneSettings()) == ()


def test_fit_is_exact_on_a_plane(rng):
    points = np.column_stack([rng.normal(size=(50, 2)), np.full(50, 2.0)])
    normal, offset = fit_plane(points)
    assert np.allclose(normal, (0, 0, -1))
    assert np.isclose(offset, 2)


def test_same_seed_same_planes(rng):
    cloud = room_cloud(rng, noise=0.005)
    first, second = (extract_planes(cloud, NOISE, PlaneSettings(), seed=3) for _ in range(2))
    assert all(np.array_equal(a.normal, b.normal) for a, b in zip(first, second, strict=True))


def _aligned(rng, source, target, start):
    planes = [extract_planes(cloud, NOISE, PlaneSettings()) for cloud in (source, target)]
    return align_planes(*planes, start, PRIOR, NOISE, IcpSettings())


def test_icp_recovers_the_motion_from_three_planes(rng):
    truth = se3.exponential(np.array([0.05, -0.04, 0.03, 0.1, -0.05, 0.08]))
    start = se3.exponential(np.array([0.02, 0.01, -0.02, 0.03, 0.02, -0.03])) @ truth
    found = _aligned(rng, room_cloud(rng, noise=0.002), room_cloud(rng, truth, noise=0.002), start)
    assert found.pairs == 3
    assert found.improves
    before, after = motion_error(start, truth), motion_error(found.T_target_source, truth)
    assert after[0] < 0.2 * before[0]
    assert after[1] < 0.2 * before[1]
    assert np.linalg.eigvalsh(found.information).min() > 1e3


def test_icp_does_not_slide_where_a_plane_leaves_it_free(rng):
    floor = room_cloud(rng, noise=0.002)[:2000]
    start = se3.exponential(np.array([0, 0, 0, 0.02, 0.01, 0.02]))
    found = _aligned(rng, floor, floor, start)
    moved = found.T_target_source[:3, 3]
    assert abs(moved[1]) < 0.003  # the floor holds the height
    assert np.allclose(moved[[0, 2]], (0.02, 0.02), atol=0.004)  # nothing holds the rest


def test_no_common_plane_is_said(rng):
    far = se3.exponential(np.array([0, 1.2, 0, 2.0, 0, 0]))
    assert _aligned(rng, room_cloud(rng)[:2000], room_cloud(rng)[2000:4000], far) is None


@pytest.mark.parametrize("points_per_plane", [30, 300])
def test_more_points_never_know_more_than_the_shared_error_allows(rng, points_per_plane):
    cloud = room_cloud(rng)
    planes = extract_planes(cloud, NOISE, PlaneSettings())
    settings = IcpSettings(points_per_plane=points_per_plane)
    found = align_planes(planes, planes, np.eye(4), PRIOR, NOISE, settings)
    sigma = np.sqrt(np.diag(np.linalg.inv(found.information)))
    assert sigma[3:].min() > 0.9 * settings.sigma_correlated_m
