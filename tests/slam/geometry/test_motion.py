import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roomgraph.datasets import se3
from roomgraph.slam.geometry.motion import (
    Correspondences,
    MotionSettings,
    estimate_motion,
    procrustes,
)
from roomgraph.slam.geometry.refinement import refine_motion
from tests.slam.helpers import CAMERA, NOISE, correspondences, motion_error, small_motion


@given(seed=st.integers(0, 10_000), count=st.integers(3, 40))
@settings(max_examples=40, deadline=None)
def test_procrustes_finds_any_exact_motion(seed, count):
    rng = np.random.default_rng(seed)
    T = se3.exponential(rng.normal(size=6))
    source = rng.normal(size=(count, 3))
    assert np.allclose(procrustes(source, se3.transform(T, source)), T, atol=1e-6)


def test_procrustes_never_mirrors(rng):
    flat = np.column_stack([rng.normal(size=(5, 2)), np.zeros(5)])
    mirrored = flat * (1, -1, 1) + 0.1 * rng.normal(size=(5, 3))
    assert np.isclose(np.linalg.det(procrustes(flat, mirrored)[:3, :3]), 1)


def test_procrustes_solves_many_at_once(rng, random_poses):
    source = rng.normal(size=(20, 6, 3))
    target = np.array([se3.transform(T, p) for T, p in zip(random_poses, source, strict=True)])
    assert np.allclose(procrustes(source, target), random_poses)


@pytest.mark.parametrize("method", ["pnp", "procrustes"])
@pytest.mark.parametrize("outliers", [0.0, 0.5])
def test_ransac_finds_the_motion_among_wrong_matches(rng, method, outliers):
    found, T, right = correspondences(rng, outliers=outliers)
    motion = estimate_motion(found, CAMERA, NOISE, MotionSettings(method=method))
    metres, radians = motion_error(motion.T_camera_reference, T)
    assert metres < 0.03
    assert radians < 0.02
    assert (motion.inliers & ~right).sum() <= 0.02 * len(right)
    assert motion.inliers[right].mean() > 0.7


@pytest.mark.parametrize("method", ["pnp", "procrustes"])
def test_no_motion_is_said(rng, method):
    few, _, _ = correspondences(rng, count=8)
    wrong, _, _ = correspondences(rng, outliers=1.0)
    settings = MotionSettings(method=method)
    assert estimate_motion(few, CAMERA, NOISE, settings) is None
    assert estimate_motion(wrong, CAMERA, NOISE, settings) is None


def test_same_seed_same_motion(rng):
    found, _, _ = correspondences(rng, outliers=0.4)
    first, second = (
        estimate_motion(found, CAMERA, NOISE, MotionSettings(), seed=4) for _ in range(2)
    )
    assert np.array_equal(first.T_camera_reference, second.T_camera_reference)


def test_refinement_is_exact_without_noise(rng):
    found, T, _ = correspondences(rng, noise=0.0)
    start = small_motion(rng, 0.03, 0.02) @ T
    refined = refine_motion(start, found, CAMERA, NOISE, iterations=20)
    assert motion_error(refined.T_camera_reference, T) < (1e-5, 1e-5)
    assert refined.inliers.all()


def test_refinement_beats_the_coarse_motion_and_knows_how_well(rng):
    coarse_errors, fine_errors, chi2 = [], [], []
    for _ in range(40):
        found, T, _ = correspondences(rng, count=120, outliers=0.2)
        coarse = estimate_motion(found, CAMERA, NOISE, MotionSettings())
        fine = refine_motion(coarse.T_camera_reference, found, CAMERA, NOISE)
        coarse_errors.append(motion_error(coarse.T_camera_reference, T)[0])
        fine_errors.append(motion_error(fine.T_camera_reference, T)[0])
        step = se3.logarithm(fine.T_camera_reference @ se3.inverse(T))
        chi2.append(step @ fine.information @ step)
    assert np.median(fine_errors) < 0.9 * np.median(coarse_errors)
    # Six degrees of freedom: the information must be of the right size.
    assert 2 < np.median(chi2) < 12


def test_refinement_works_without_any_second_depth(rng):
    found, T, _ = correspondences(rng, noise=0.0)
    blind = type(found)(found.points, found.pixels, np.full(len(found), np.nan))
    refined = refine_motion(small_motion(rng, 0.02, 0.01) @ T, blind, CAMERA, NOISE, 20)
    assert motion_error(refined.T_camera_reference, T) < (1e-4, 1e-4)


def test_a_pattern_mistaken_by_one_period_hardly_pulls(rng):
    T = se3.exponential(np.array([0.0, 0.03, 0.0, 0.1, 0.0, 0.05]))
    alone, pulled = [], []
    for _ in range(20):
        # A wall far off in a narrow view: turning and stepping aside look alike.
        pixels = rng.uniform((150, 100), (490, 380), (240, 2))
        points = CAMERA.backproject(pixels, 3.0 + 0.2 * rng.random(240))
        moved = se3.transform(T, points)
        seen = CAMERA.project(moved) + rng.normal(0, 0.5, (240, 2))
        seen[140:, 0] += 9.0
        depths = moved[:, 2] + NOISE.depth_sigma(moved[:, 2]) * rng.normal(size=240)
        found = Correspondences(points, seen, depths)
        both = refine_motion(T, found, CAMERA, NOISE)
        assert both.inliers[:140].mean() > 0.9
        assert not both.inliers[140:].any()
        right = refine_motion(T, found.take(np.arange(140)), CAMERA, NOISE)
        pulled.append(motion_error(both.T_camera_reference, T)[0])
        alone.append(motion_error(right.T_camera_reference, T)[0])
    assert np.mean(pulled) < 1.2 * np.mean(alone)
