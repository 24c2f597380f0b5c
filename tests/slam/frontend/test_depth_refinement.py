"""Poses on few features, improved on the surfaces around."""

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.frontend.depth_odometry import DepthOdometry
from roomgraph.slam.frontend.depth_refinement import DepthRefinementSettings, DepthRefiner
from roomgraph.slam.frontend.estimate import Estimate
from roomgraph.slam.settings import SlamSettings
from tests.slam.helpers import NOISE, motion_error


@pytest.fixture
def views(rendered_sequence):
    first, second = rendered_sequence[0], rendered_sequence[2]
    truth = rendered_sequence.ground_truth.T_world_camera
    return first, second, se3.inverse(truth[2]) @ truth[0]


def _estimate(T, inliers=30, sigma=0.02):
    information = np.diag(np.repeat([sigma / 2, sigma], 3) ** -2.0)
    return Estimate(
        reference=7,
        T_camera_reference=T,
        information=information,
        inliers=inliers,
        support=0.5,
        method="features",
        pixels=np.empty((0, 2)),
    )


def _refiner(first, **settings):
    refiner = DepthRefiner(DepthRefinementSettings(**settings), NOISE)
    refiner.rest_on(7, first)
    return refiner


def test_walls_and_floor_put_a_weak_pose_right(views):
    first, second, truth = views
    off = se3.exponential(np.array([0.01, -0.01, 0.005, 0.02, 0.015, -0.02])) @ truth
    refined = _refiner(first).refine(second, _estimate(off))
    before, after = motion_error(off, truth), motion_error(refined.T_camera_reference, truth)
    assert after[0] < 0.5 * before[0]
    assert after[1] < 0.5 * before[1]
    gained = refined.information - _estimate(off).information
    assert np.linalg.eigvalsh(gained)[0] > -1e-6
    assert np.linalg.eigvalsh(gained)[-1] > 1e4


def test_what_stands_alone_stays(views):
    first, second, truth = views
    sure = _estimate(truth, inliers=DepthRefinementSettings().inliers)
    assert _refiner(first).refine(second, sure) is sure
    weak = _estimate(truth)
    assert _refiner(first, enabled=False).refine(second, weak) is weak
    elsewhere = replace(weak, reference=8)
    assert _refiner(first).refine(second, elsewhere) is elsewhere


def test_surfaces_that_contradict_the_features_are_not_believed(views):
    first, second, truth = views
    off = se3.exponential(np.array([0.0, 0, 0, 0.04, 0.03, -0.04])) @ truth
    sure = _estimate(off, sigma=0.001)
    refined = _refiner(first).refine(second, sure)
    assert motion_error(refined.T_camera_reference, off)[0] < 0.004


def test_nothing_is_made_of_views_without_depth(views):
    first, second, truth = views
    weak = _estimate(truth)
    blind = replace(second, depth=np.zeros_like(second.depth))
    assert _refiner(first).refine(blind, weak) is weak
    assert _refiner(replace(first, depth=np.zeros_like(first.depth))).refine(second, weak) is weak


def test_a_guess_bent_by_rounding_does_not_end_the_process(views, rng):
    first, second, truth = views
    settings = SlamSettings()
    odometry = DepthOdometry(settings.depth_odometry, settings.planes, settings.icp, settings.noise)
    odometry.remember(first)
    bent = truth.copy()
    bent[:3, :3] += 1e-8 * rng.normal(size=(3, 3))
    step = odometry.register(second, bent)
    assert step is not None
    assert motion_error(step.T_camera_last, truth)[0] < 0.03
