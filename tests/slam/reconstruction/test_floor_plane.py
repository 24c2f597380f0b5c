"""Up and the floor, found from planes that a tilted camera saw."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roomgraph.datasets import se3
from roomgraph.slam.reconstruction.floor_plane import find_floor_plane
from tests.slam.scene import around, box_room, camera, keyframes

ROOM = box_room(0, 0, 4, 3)


def tilt_of(floor_plane, T_world_map):
    """Angle between the up that was found and the true one, degrees."""
    up = floor_plane.T_map_world[:3, :3] @ T_world_map[:3, :3] @ [0, 0, 1]
    return np.degrees(np.arccos(np.clip(up[2], -1, 1)))


@settings(max_examples=8, deadline=None)
@given(st.floats(-20, 35), st.floats(0, 360), st.floats(0.7, 1.7))
def test_up_and_floor_whatever_way_the_first_camera_looks(pitch, heading, height):
    rng = np.random.default_rng(1)
    cameras = [camera(2, 1.5, heading, height, pitch), *around(2, 1.5, height, 25)]
    made, T_world = keyframes(ROOM, cameras, rng=rng)
    floor_plane = find_floor_plane(made, T_world)
    assert floor_plane.has_level and floor_plane.has_floor and floor_plane.has_walls
    assert tilt_of(floor_plane, se3.inverse(cameras[0])) < 0.5
    # The world's origin is the first camera.
    assert floor_plane.T_map_world[2, 3] == pytest.approx(height, abs=0.02)
    assert floor_plane.warnings == ()
    R = floor_plane.T_map_world[:3, :3]
    assert np.allclose(R @ R.T, np.eye(3), atol=1e-9) and np.linalg.det(R) > 0


def test_x_follows_the_walls(rng):
    made, T_world = keyframes(ROOM, around(2, 1.5), rng=rng)
    walls = find_floor_plane(made, T_world).T_map_world @ se3.inverse(around(2, 1.5)[0])
    angle = np.degrees(np.arctan2(walls[1, 0], walls[0, 0])) % 90
    assert min(angle, 90 - angle) < 1.0


def test_a_large_table_is_no_floor(rng):
    table = [(0.8, 0.8, 0.7, 3.2, 2.2, 0.75)]
    cameras = [*around(0.5, 0.5, 1.5, 25), *around(3.5, 2.5, 1.5, 25)]
    made, T_world = keyframes(ROOM + table, cameras, rng=rng)
    floor_plane = find_floor_plane(made, T_world)
    assert floor_plane.has_floor
    assert floor_plane.T_map_world[2, 3] == pytest.approx(1.5, abs=0.03)


def test_without_a_floor_in_view_it_says_so(rng):
    made, T_world = keyframes(ROOM, around(2, 1.5, 1.6, pitch_deg=-30), rng=rng)
    floor_plane = find_floor_plane(made, T_world)
    assert not floor_plane.has_floor
    assert any("no floor" in warning for warning in floor_plane.warnings)
    assert tilt_of(floor_plane, se3.inverse(around(2, 1.5, 1.6, pitch_deg=-30)[0])) < 1.0


def test_walls_alone_tell_which_way_is_up(rng):
    cameras = around(2, 1.5, 1.3, pitch_deg=0)
    made, T_world = keyframes(ROOM, cameras, rng=rng)
    walls = [[p for p in view.planes if abs(p.normal[1]) < 0.5] for view in made]
    made = [replace(view, planes=tuple(seen)) for view, seen in zip(made, walls, strict=True)]
    floor_plane = find_floor_plane(made, T_world)
    assert floor_plane.has_level
    assert tilt_of(floor_plane, se3.inverse(cameras[0])) < 1.0


def test_without_planes_up_is_the_cameras_own():
    made, T_world = keyframes(ROOM, around(2, 1.5, pitch_deg=0), with_planes=False)
    floor_plane = find_floor_plane(made, T_world)
    assert not floor_plane.has_level and not floor_plane.has_walls
    assert len(floor_plane.warnings) == 2
    assert tilt_of(floor_plane, se3.inverse(around(2, 1.5, pitch_deg=0)[0])) < 1.0


def test_nothing_at_all_still_gives_a_frame():
    floor_plane = find_floor_plane([], {})
    assert np.allclose(floor_plane.T_map_world[:3, :3] @ [0, -1, 0], [0, 0, 1])
