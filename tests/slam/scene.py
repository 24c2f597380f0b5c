"""Rooms made of boxes, seen by a depth camera: keyframes for what is built on their clouds."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.planes import PlaneSettings, extract_planes
from roomgraph.slam.geometry.range_image import RangeImage
from roomgraph.slam.keyframe import Keyframe

CAMERA = Intrinsics(120, 90, 98.0, 98.0, 59.5, 44.5)
# Optical axes (x right, y down, z forward) of a camera that looks along the map's x.
_LEVEL = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], dtype=float)
NOISE = SensorNoise()


def camera(x, y, heading_deg, height=1.2, pitch_deg=0.0):
    """Return T_map_camera (4, 4) of a camera over a floor; positive pitch looks down."""
    turn = Rotation.from_euler("z", heading_deg, degrees=True).as_matrix()
    tilt = Rotation.from_euler("x", -pitch_deg, degrees=True).as_matrix()
    return se3.pose(turn @ _LEVEL @ tilt, [x, y, height])


def around(x, y, height=1.2, pitch_deg=12.0, count=12):
    """Return cameras that look all round from one spot."""
    return [camera(x, y, 360 * i / count, height, pitch_deg) for i in range(count)]


def box_room(x0, y0, x1, y1, doors=(), height=2.5, thick=0.1, lintel=2.0):
    """Return boxes (N, 6), low corner and high corner: a room's floor, ceiling and walls.

    `doors` are (side, from, to) with side one of "w", "e", "s", "n" and a range along it.
    """
    boxes = [(x0, y0, -0.1, x1, y1, 0.0), (x0, y0, height, x1, y1, height + 0.1)]
    sides = {
        "w": (x0 - thick, x0, y0 - thick, y1 + thick),
        "e": (x1, x1 + thick, y0 - thick, y1 + thick),
        "s": (y0 - thick, y0, x0, x1),
        "n": (y1, y1 + thick, x0, x1),
    }
    for side, (a, b, start, end) in sides.items():
        gaps = sorted((g[1], g[2]) for g in doors if g[0] == side)
        edges = [start, *(value for gap in gaps for value in gap), end]
        pieces = [(low, high, 0.0) for low, high in zip(edges[::2], edges[1::2], strict=True)]
        pieces += [(low, high, lintel) for low, high in gaps]
        for low, high, foot in pieces:
            across, along = ((a, b), (low, high)) if side in "we" else ((low, high), (a, b))
            boxes.append((across[0], along[0], foot, across[1], along[1], height))
    return boxes


def look(boxes, T_map_camera, rng=None, max_depth_m=4.0):
    """Return the range image that a camera has of boxes, with noise if `rng` is given."""
    u, v = np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height))
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(float)
    rays = CAMERA.backproject(pixels, np.ones(len(pixels)))
    direction, origin = rays @ T_map_camera[:3, :3].T, T_map_camera[:3, 3]
    nearest = np.full(len(rays), np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        for box in np.asarray(boxes, dtype=float):
            t = (np.stack([box[:3], box[3:]])[:, None] - origin) / direction
            enter, leave = t.min(axis=0).max(axis=1), t.max(axis=0).min(axis=1)
            hit = (enter <= leave) & (enter > 0.05) & (enter < nearest)
            nearest[hit] = enter[hit]
    depth = np.where(nearest < max_depth_m, nearest, 0.0)
    if rng is not None:
        depth = depth + (depth > 0) * NOISE.depth_sigma(depth) * rng.normal(size=len(depth))
    depth_mm = np.rint(depth * 1000).astype(np.uint16).reshape(CAMERA.height, CAMERA.width)
    return RangeImage(depth_mm, np.zeros((*depth_mm.shape, 3), np.uint8), CAMERA)


def keyframes(boxes, cameras, T_world_map=None, rng=None, with_planes=True):
    """Return keyframes with planes, and their poses in a world that `T_world_map` leads to."""
    T_world_map = se3.inverse(cameras[0]) if T_world_map is None else T_world_map
    made, T_world = [], {}
    for i, T in enumerate(cameras):
        image = look(boxes, T, rng)
        planes = ()
        if with_planes and image.depth_mm.any():
            planes = extract_planes(image.points.astype(float), NOISE, PlaneSettings(), 0)
        words = np.empty(0, dtype=np.intp)
        made.append(
            Keyframe(
                id=i,
                frame_index=i,
                stamp_s=i / 30,
                features=Features.none(),
                points=np.empty((0, 3)),
                words=words,
                planes=planes,
                image=image,
                intrinsics=CAMERA,
            )
        )
        T_world[i] = T_world_map @ T
    return made, T_world
