"""Up is found whatever the camera's pitch, the ceiling goes, and the scene is in sight."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from roomgraph.app.viewer.framing import Axes, below_ceiling, frame_scene, level_axes
from roomgraph.datasets.se3 import inverse, pose

UP = np.array([0.0, -1.0, 0.0])
LEVEL = Axes(np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), UP)


def walk(pitch_deg: float, yaws_deg: np.ndarray) -> np.ndarray:
    """Poses of a camera that nods down and looks around, in the frame of the first."""
    R = Rotation.from_euler("YX", [(yaw, -pitch_deg) for yaw in yaws_deg], degrees=True)
    T = np.array([pose(r, [0.1 * i, 0, 0]) for i, r in enumerate(R.as_matrix())])
    return inverse(T[0]) @ T


@settings(max_examples=30, deadline=None)
@given(st.floats(-60, 60), st.integers(0, 9))
def test_up_is_found_under_any_pitch(pitch_deg: float, seed: int) -> None:
    T = walk(pitch_deg, np.linspace(0, 200, 40) + seed)
    true_up = Rotation.from_euler("X", pitch_deg, degrees=True).apply(UP)
    axes = level_axes(T)
    assert axes.up @ true_up > np.cos(np.radians(2))
    frame = np.column_stack([axes.right, -axes.up, axes.forward])
    np.testing.assert_allclose(frame.T @ frame, np.eye(3), atol=1e-9)
    assert np.linalg.det(frame) == pytest.approx(1)


def test_a_camera_that_does_not_turn_takes_its_image_for_upright() -> None:
    np.testing.assert_allclose(level_axes(np.eye(4)[None]).up, UP, atol=1e-9)


def test_the_ceiling_is_told_from_the_rooms_on_two_floors() -> None:
    path = np.array([[0, 0, 0], [10, -3, 0.0]])
    points = np.array([[0, 1.5, 1], [0, -1, 1], [10, -3, 1], [10, -4, 1.0]])
    np.testing.assert_array_equal(below_ceiling(points, path, UP, 0.7), [True, False, True, False])
    assert below_ceiling(points, np.empty((0, 3)), UP, 0.7).all()


@pytest.mark.parametrize("size", [(1, 1, 1), (30, 2, 5), (5, 2, 30)])
def test_the_scene_is_in_sight_and_fills_it(size: tuple[float, float, float]) -> None:
    points = np.random.default_rng(0).uniform(-0.5, 0.5, (2000, 3)) * size
    path = np.array([[0, 0, 0.0]])
    framing = frame_scene(points, path, LEVEL)
    ahead = framing.target - framing.eye
    ahead /= np.linalg.norm(ahead)
    assert ahead @ UP < -0.5
    down = np.cross(ahead, LEVEL.right)
    low, high = np.percentile(points, [2, 98], axis=0)
    body = points[((points > low) & (points < high)).all(axis=1)] - framing.eye
    assert (body @ ahead > 0).all()
    tangents = np.abs(np.column_stack([body @ LEVEL.right, body @ down])) / (body @ ahead)[:, None]
    widest = tangents.max(axis=0)
    assert (widest <= [0.501, 0.431]).all()
    if max(size) > 1:
        assert (widest > [0.35, 0.3]).any()


def test_a_path_alone_is_seen_with_room_around_it() -> None:
    framing = frame_scene(np.empty((0, 3)), np.zeros((1, 3)), LEVEL)
    assert 3 < np.linalg.norm(framing.eye - framing.target) < 10


def test_the_floor_plan_is_seen_as_it_is_drawn() -> None:
    turn = Rotation.from_euler("xyz", [90, 0, 30], degrees=True).as_matrix()
    T_map_world = np.eye(4)
    T_map_world[:3, :3], T_map_world[:3, 3] = turn, [3.0, -2.0, 1.2]
    corners_map = np.array([[0.0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]])
    corners = (corners_map - T_map_world[:3, 3]) @ turn
    axes = Axes.of_map(T_map_world)
    seen = axes.on_floor(corners)
    np.testing.assert_allclose(seen - seen[0], corners_map[:, :2], atol=1e-12)
    framing = frame_scene(corners, corners, axes)
    ahead = turn @ (framing.target - framing.eye)
    np.testing.assert_allclose(ahead[0], 0.0, atol=1e-9)
    assert ahead[1] > 0 > ahead[2]
