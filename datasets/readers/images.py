"""Reading colour and depth images, undistorted, with errors that name the file."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.errors import DatasetError

IMAGE_SUFFIXES = (".png", ".jpg", ".jpeg", ".bmp", ".webp", ".pgm", ".ppm", ".tif", ".tiff")


def read_colour(path: Path) -> NDArray[np.uint8]:
    """Read an image as (H, W, 3) uint8, red, green, blue.

    Raises
    ------
    DatasetError
        The file is missing, cut short or not an image.
    """
    image = _decode(path, cv2.IMREAD_COLOR)
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), dtype=np.uint8)


def read_depth(
    path: Path, depth_scale: float, invalid: tuple[int, ...] = (0, 65535)
) -> NDArray[np.float32]:
    """Read a 16-bit depth image as (H, W) float32 metres.

    Parameters
    ----------
    path : Path
        A single-channel 16-bit image.
    depth_scale : float
        Raw units per metre.
    invalid : tuple of int
        Raw values that mean "no reading"; they become 0.

    Raises
    ------
    DatasetError
        The file is missing, cut short, or not a single channel of 16 bits.
    """
    raw = _decode(path, cv2.IMREAD_UNCHANGED)
    if raw.ndim != 2 or raw.dtype not in (np.uint16, np.float32):
        raise DatasetError(
            "not a depth image", where=path,
            expected="one channel of 16 bits",
            got=f"{raw.shape[2] if raw.ndim > 2 else 1} channel(s) of {raw.dtype}",
        )  # fmt: skip
    depth = raw.astype(np.float32)
    for value in invalid:
        if value:
            depth[raw == value] = 0
    depth[~np.isfinite(depth)] = 0
    depth *= np.float32(1.0 / depth_scale)
    return depth


def undistort_colour(colour: NDArray[np.uint8], camera: Intrinsics) -> NDArray[np.uint8]:
    """Return an image (H, W, 3) as a camera without distortion sees it."""
    if not camera.is_distorted:
        return colour
    x, y = _undistortion_maps(camera)
    return np.asarray(cv2.remap(colour, x, y, cv2.INTER_LINEAR), dtype=np.uint8)


def undistort_depth(depth: NDArray[np.float32], camera: Intrinsics) -> NDArray[np.float32]:
    """Return depth (H, W) as a camera without distortion sees it; holes stay holes."""
    if not camera.is_distorted:
        return depth
    x, y = _undistortion_maps(camera)
    return np.asarray(cv2.remap(depth, x, y, cv2.INTER_NEAREST), dtype=np.float32)


def check_size(
    image: NDArray[np.generic],
    intrinsics: Intrinsics,
    path: Path,
    hint: str = "give the right camera with --camera FILE.json",
) -> None:
    """Raise DatasetError where an image's size is not the camera's."""
    height, width = image.shape[:2]
    if (width, height) != (intrinsics.width, intrinsics.height):
        raise DatasetError(
            "image size differs from the camera's", where=path,
            expected=f"{intrinsics.width}x{intrinsics.height}", got=f"{width}x{height}",
            hint=hint,
        )  # fmt: skip


@lru_cache(maxsize=4)
def _undistortion_maps(intrinsics: Intrinsics) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    size = (intrinsics.width, intrinsics.height)
    coefficients = np.array(intrinsics.distortion)
    x, y = cv2.initUndistortRectifyMap(
        intrinsics.K, coefficients, np.eye(3), intrinsics.K, size, cv2.CV_32FC1
    )
    return np.asarray(x, dtype=np.float32), np.asarray(y, dtype=np.float32)


def _decode(path: Path, flags: int) -> NDArray[np.generic]:
    try:
        data = np.fromfile(path, dtype=np.uint8)
    except OSError as error:
        raise DatasetError(
            "image cannot be opened", where=path, got=error.strerror or str(error)
        ) from error
    if not _is_whole(data):
        raise DatasetError(
            "image is cut short", where=path, got=f"{data.size} bytes without the end mark",
            hint="copy or record the file again",
        )  # fmt: skip
    image = cv2.imdecode(data, flags) if data.size else None
    if image is None:
        raise DatasetError(
            "image cannot be decoded", where=path, expected="a PNG or JPEG file",
            got=f"{data.size} bytes that are not one",
        )  # fmt: skip
    return np.asarray(image)


def _is_whole(data: NDArray[np.uint8]) -> bool:
    """Whether a PNG has its IEND chunk and a JPEG its end marker: decoders pad what is missing."""
    head, tail = data[:4].tobytes(), data[-64:].tobytes()
    if head == b"\x89PNG":
        return b"IEND" in tail
    if head[:2] == b"\xff\xd8":
        return b"\xff\xd9" in data[-4096:].tobytes()
    return True
