"""The compiled normal equations against derivatives by differences and against NumPy."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.geometry.motion import Correspondences
from roomgraph.slam.geometry.normal_equations import HOLD, _invert, motion_equations
from roomgraph.slam.geometry.refinement import inverse_variances, refine_motion
from tests.slam.helpers import CAMERA, NOISE, correspondences, motion_error, small_motion


def cost(T, found):
    """Half the squared errors of all correspondences, by plain NumPy."""
    local = se3.transform(T, found.points)
    predicted = np.column_stack([CAMERA.project(local), 1 / local[:, 2]])
    measured = np.column_stack([found.pixels, 1 / found.depths])
    known = np.isfinite(measured)
    residual = np.where(known, predicted - np.where(known, measured, 0), 0)
    return 0.5 * (inverse_variances(found.depths, NOISE) * residual**2).sum()


@pytest.fixture
def problem(rng):
    found, T, _ = correspondences(rng, count=40)
    found.depths[::5] = np.nan
    return found, small_motion(rng, 0.02, 0.02) @ T


def equations_of(T, found, spread=None, bound=np.inf):
    spread = np.zeros_like(found.points) if spread is None else spread
    return motion_equations(
        T, found.points, spread, found.pixels, found.depths,
        inverse_variances(found.depths, NOISE), CAMERA.parameters, bound, 1,
    )  # fmt: skip


def test_the_gradient_is_that_of_the_cost(problem):
    found, T = problem
    error, H, g = equations_of(T, found)
    assert 0.5 * error.sum() == pytest.approx(cost(T, found), rel=1e-9)
    size = 1e-6
    for k, step in enumerate(size * np.eye(6)):
        ahead, behind = (cost(se3.exponential(s) @ T, found) for s in (step, -step))
        assert g[k] == pytest.approx(
            (ahead - behind) / (2 * size), rel=1e-4, abs=1e-3 * abs(g).max()
        )
    assert np.array_equal(H, H.T)
    assert np.linalg.eigvalsh(H).min() > 0


def test_uncertain_reference_depths_count_for_less(problem):
    found, T = problem
    sure, H_sure, _ = equations_of(T, found)
    unsure, H_unsure, _ = equations_of(T, found, spread=0.02 * found.points)
    assert (unsure <= sure + 1e-9).all()
    assert np.trace(H_unsure) < np.trace(H_sure)


@pytest.mark.parametrize("depth", [-1.0, 0.0, 1e-12, 1e-8, np.nan])
def test_points_that_no_camera_sees_change_nothing(rng, depth):
    found, T, _ = correspondences(rng, count=60)
    points = found.points.copy()
    points[0] = se3.transform(se3.inverse(T), np.array([[0.0, 0.0, depth]]))
    fine = refine_motion(T, Correspondences(points, found.pixels, found.depths), CAMERA, NOISE)
    without = refine_motion(T, found.take(np.arange(1, 60)), CAMERA, NOISE)
    assert not fine.inliers[0]
    assert fine.T_camera_reference == pytest.approx(without.T_camera_reference, abs=1e-5)


def test_a_start_far_off_is_followed_to_the_end(rng):
    # What is far away and seen at a small angle draws slowly.
    T = se3.exponential(np.array([0.0, 0.02, 0.0, 0.05, 0.0, 0.2]))
    pixels = rng.uniform((200, 150), (440, 330), (200, 2))
    points = CAMERA.backproject(pixels, rng.uniform(2.5, 4.5, 200))
    moved = se3.transform(T, points)
    wrong = rng.random(200) < 0.4
    seen = CAMERA.project(moved) + rng.normal(0, 0.3, (200, 2))
    seen[wrong] += rng.uniform(-40, 40, (wrong.sum(), 2))
    found = Correspondences(points, seen, np.full(200, np.nan))
    fine = refine_motion(np.eye(4), found, CAMERA, NOISE, width=9.6)
    best = refine_motion(T, found, CAMERA, NOISE)
    assert motion_error(fine.T_camera_reference, best.T_camera_reference)[0] < 0.002


@pytest.mark.parametrize("size", [1.0, 1e4, 1e6])
def test_small_matrices_are_inverted_even_where_one_direction_is_open(rng, size):
    for _ in range(20):
        J = rng.normal(size=(2, 3))
        A, inverse = size * J.T @ J, np.empty((3, 3))
        _invert(A, inverse)
        exact = np.linalg.inv((A + HOLD * np.eye(3)).astype(np.longdouble).astype(float))
        # As well as the numbers allow: the condition is size / HOLD.
        assert inverse == pytest.approx(exact, rel=1e-2, abs=1e-2 * np.abs(exact).max())
        assert np.array_equal(inverse, inverse.T)
