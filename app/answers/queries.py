"""The images to be located."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.errors import AppError
from roomgraph.app.storage.input import InputOptions
from roomgraph.datasets.camera import Camera, read_camera
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.readers.images import IMAGE_SUFFIXES, read_colour, read_depth
from roomgraph.datasets.readers.registration import rectify
from roomgraph.datasets.readers.registry import READERS

# Of images without time stamps.
_FRAME_RATE_HZ = 30.0


@dataclass(frozen=True, slots=True)
class Query:
    """An image to be located: its name and the frame."""

    name: str
    frame: Frame


def queries(source: InputOptions, depth: Path | None, camera: Camera) -> Iterator[Query]:
    """Yield the frames of a sequence, the images of a folder by name, or one image.

    Parameters
    ----------
    source : InputOptions
        What to look at; `sequence` may be an image, a folder of images or a sequence.
    depth : Path or None
        The depth image of a single image.
    camera : Camera
        That took the images, if they are no sequence, and `source` names no other.

    Raises
    ------
    RoomgraphError
        There is no image, one cannot be read, or its shape is not the camera's.
    """
    if is_sequence(source.sequence):
        sequence = source.open()
        for index in range(len(sequence)):
            frame = sequence[index]
            yield Query(f"{frame.stamp_s:.6f}", frame)
        return
    if source.camera is not None:
        camera = read_camera(source.camera)
    if source.depth_scale is not None:
        camera = replace(camera, depth_scale=source.depth_scale)
    files = _files(source.sequence)[source.start :: source.stride][: source.frames]
    if not files or (depth is not None and source.sequence.is_dir()):
        raise AppError(
            "nothing to locate", where=source.sequence,
            expected="an image, with or without its depth; a folder of images; or a sequence",
        )  # fmt: skip
    yield from _image_queries(files, depth, camera)


def is_sequence(data: Path) -> bool:
    """Whether a path is a folder of a known layout."""
    return data.is_dir() and any(reader.recognises(data) for reader in READERS.values())


def _files(data: Path) -> list[Path]:
    if data.is_dir():
        return sorted(p for p in data.iterdir() if p.suffix.lower() in IMAGE_SUFFIXES)
    return [data]


def _image_queries(files: list[Path], depth: Path | None, camera: Camera) -> Iterator[Query]:
    """Yield images with time stamps as if taken at 30 per second."""
    for index, path in enumerate(files):
        colour = read_colour(path)
        fitted = fitted_camera(camera, colour, path)
        if depth is not None:
            readings = read_depth(depth, camera.depth_scale)
        else:
            fitted = replace(fitted, depth=None)
            readings = np.zeros(colour.shape[:2], dtype=np.float32)
        colour, readings, pinhole = rectify(colour, readings, fitted, depth or path)
        yield Query(str(path), Frame(index, index / _FRAME_RATE_HZ, colour, readings, pinhole))


def fitted_camera(camera: Camera, colour: NDArray[np.uint8], where: str | Path) -> Camera:
    """Return a camera for an image (H, W, 3) of another size but the same aspect ratio.

    Raises
    ------
    AppError
        The image has another aspect ratio, or is no colour image.
    """
    if colour.ndim != 3 or colour.shape[2] != 3:
        raise AppError(
            "not a colour image", where=where, expected="(H, W, 3) RGB", got=str(colour.shape)
        )
    height, width = colour.shape[:2]
    known = camera.intrinsics
    scale = width / known.width
    if abs(known.height * scale - height) > 1:
        raise AppError(
            "aspect ratio of the image differs from the camera's", where=where,
            expected=f"{known.width}x{known.height} or a multiple of it", got=f"{width}x{height}",
            hint="give the camera that took it: --camera FILE.json",
        )  # fmt: skip
    return replace(camera, intrinsics=known.resized(width, height))
