"""A made-up scene: points on walls, seen from any pose, with a Kinect's noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.slam.geometry.motion import Correspondences
from roomgraph.slam.geometry.noise import SensorNoise

CAMERA = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
NOISE = SensorNoise()


def small_motion(rng, metres=0.15, radians=0.1):
    return se3.exponential(np.r_[rng.normal(0, radians, 3), rng.normal(0, metres, 3)])


def correspondences(rng, count=200, noise=1.0, outliers=0.0, T=None):
    """Return correspondences, the motion T_camera_reference, and which are right."""
    T = small_motion(rng) if T is None else T
    pixels = rng.uniform((40, 40), (600, 440), (4 * count, 2))
    depth = rng.uniform(0.8, 4.0, 4 * count)
    points = CAMERA.backproject(pixels, depth)
    moved = se3.transform(T, points)
    seen = CAMERA.project(moved)
    inside = np.all((seen > 0) & (seen < (640, 480)), axis=1) & (moved[:, 2] > 0.3)
    points, moved, seen = points[inside][:count], moved[inside][:count], seen[inside][:count]
    measured = moved[:, 2] + noise * NOISE.depth_sigma(moved[:, 2]) * rng.normal(size=len(moved))
    ray = points / points[:, 2:]
    points = (
        points
        + ray * (noise * NOISE.depth_sigma(points[:, 2]) * rng.normal(size=len(points)))[:, None]
    )
    seen = seen + 0.7 * noise * rng.normal(size=seen.shape)
    right = rng.random(len(points)) >= outliers
    seen[~right] = rng.uniform((0, 0), (640, 480), ((~right).sum(), 2))
    return Correspondences(points, seen, measured), T, right


def room_cloud(rng, T_camera_world=None, count=6000, noise=0.0):
    """Return points on a floor and two walls of a room, in the camera's frame (N, 3)."""
    n = count // 3
    u, v = rng.uniform(0, 3, (2, n))
    floor = np.column_stack([u - 1.5, np.full(n, 0.8), v + 0.8])
    left = np.column_stack([np.full(n, -1.5), u - 2.2, v + 0.8])
    back = np.column_stack([u - 1.5, v - 2.2, np.full(n, 3.8)])
    points = np.concatenate([floor, left, back])
    if T_camera_world is not None:
        points = se3.transform(T_camera_world, points)
    return points + noise * rng.normal(size=points.shape)


def dark(frame):
    """Return a frame that shows nothing and reads no depth."""
    return replace(frame, colour=np.zeros_like(frame.colour), depth=np.zeros_like(frame.depth))


def way_of(slam, trackings):
    """Return the trajectory of the frames that have a pose."""
    posed = [t for t in trackings if t.anchor is not None]
    return Trajectory(
        np.array([t.stamp_s for t in posed]), np.array([slam.pose_of(t.anchor) for t in posed])
    )


def motion_error(T, truth):
    """Return translation (metres) and rotation (radians) between two motions."""
    difference = se3.inverse(T) @ truth
    return float(np.linalg.norm(difference[:3, 3])), se3.rotation_angle(difference)
