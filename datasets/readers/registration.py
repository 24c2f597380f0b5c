"""Undistortion of images, and registration of depth to colour."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Camera, DepthCamera, Intrinsics
from roomgraph.datasets.readers.images import check_size, undistort_colour, undistort_depth

# Neighbours whose depths differ by more than this share of them lie on different surfaces.
EDGE_SHARE = 0.05


def rectify(
    colour: NDArray[np.uint8], depth: NDArray[np.float32], camera: Camera, depth_path: Path
) -> tuple[NDArray[np.uint8], NDArray[np.float32], Intrinsics]:
    """Undistort colour, and register the depth to it if from a separate camera.

    Parameters
    ----------
    colour : (H, W, 3) uint8
        Of the size that the camera says.
    depth : (H, W) or (h, w) float32
        Metres; of the depth camera's size, if there is one.
    camera : Camera
        That took both.
    depth_path : Path
        Where the depth comes from, for what is said if its size is wrong.

    Returns
    -------
    colour, depth, intrinsics : (H, W, 3) uint8, (H, W) float32, Intrinsics

    Raises
    ------
    DatasetError
        The depth image has not the size of the camera that took it.
    """
    pinhole = replace(camera.intrinsics, distortion=())
    hint = 'for a separate depth camera, describe it in the camera file: "depth": {...}'
    taken_by = camera.intrinsics if camera.depth is None else camera.depth.intrinsics
    check_size(depth, taken_by, depth_path, hint)
    depth = undistort_depth(depth, taken_by)
    if camera.depth is not None:
        depth = register(depth, camera.depth, pinhole)
    return undistort_colour(colour, camera.intrinsics), depth, pinhole


def register(
    depth: NDArray[np.float32], camera: DepthCamera, colour: Intrinsics
) -> NDArray[np.float32]:
    """Return undistorted depth (h, w) as the colour camera would measure it (H, W), metres.

    Each reading is moved to the pixel that it is seen at, the nearest surface winning. An image of
    fewer pixels is first made denser, within surfaces only, so that no gaps are left.
    """
    own = camera.intrinsics
    # Above a pixel's distance in the colour image, readings would leave pixels out between them.
    factor = int(np.ceil(max(colour.fx / own.fx, colour.fy / own.fy) - 0.02))
    if factor > 1:
        depth = _denser(depth, factor)
    seen = np.flatnonzero(depth)
    z = depth.ravel()[seen]
    points = _rays(camera, factor)[:, seen] * z
    points += camera.T_colour_depth[:3, 3:].astype(np.float32)
    points = points[:, points[2] > 0]
    x = np.rint(points[0] / points[2] * np.float32(colour.fx) + np.float32(colour.cx))
    y = np.rint(points[1] / points[2] * np.float32(colour.fy) + np.float32(colour.cy))
    inside = (x >= 0) & (x < colour.width) & (y >= 0) & (y < colour.height)
    pixel = y[inside].astype(np.intp) * colour.width + x[inside].astype(np.intp)
    laid = np.full(colour.height * colour.width, np.inf, np.float32)
    np.minimum.at(laid, pixel, points[2, inside])
    laid[np.isinf(laid)] = 0
    return laid.reshape(colour.height, colour.width)


@lru_cache(maxsize=4)
def _rays(camera: DepthCamera, factor: int) -> NDArray[np.float32]:
    """Return what a depth camera's pixels see at a depth of 1 (3, N), along the colour's axes."""
    own = replace(camera.intrinsics, distortion=())
    own = own.resized(own.width * factor, own.height * factor)
    row, column = np.divmod(np.arange(own.width * own.height), own.width)
    rays = own.backproject(np.stack([column, row], axis=1), np.ones(len(row)))
    return np.ascontiguousarray((rays @ camera.T_colour_depth[:3, :3].T).T, dtype=np.float32)


def _denser(depth: NDArray[np.float32], factor: int) -> NDArray[np.float32]:
    """Return depth with a multiple of its rows and columns; surfaces are never mixed."""
    kernel = np.ones((3, 3), np.uint8)
    far = cv2.dilate(depth, kernel)
    near = cv2.erode(depth, kernel)  # 0 beside holes
    is_smooth = (far - near < EDGE_SHARE * near).astype(np.uint8)
    size = depth.shape[1] * factor, depth.shape[0] * factor
    nearest, is_smooth = (
        cv2.resize(image, size, interpolation=cv2.INTER_NEAREST) for image in (depth, is_smooth)
    )
    between = cv2.resize(depth, size, interpolation=cv2.INTER_LINEAR)
    return np.asarray(np.where(is_smooth > 0, between, nearest), dtype=np.float32)
