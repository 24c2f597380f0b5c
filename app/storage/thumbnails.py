"""Small pictures of a run's keyframes, in a ZIP file that anything opens."""

from __future__ import annotations

import zipfile
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.app.errors import AppError

WIDTH = 192
_QUALITY = 75
# A ZIP entry bears a date; the same run shall give the same file.
_DATE = (1980, 1, 1, 0, 0, 0)


class ThumbnailWriter:
    """Adds a JPEG for each frame it is given; the file is there from the first one on."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file: zipfile.ZipFile | None = None

    def add(self, frame: int, colour: NDArray[np.uint8]) -> None:
        """Add frame number `frame`, an image (H, W, 3) in red, green, blue."""
        if self._file is None:
            self._file = zipfile.ZipFile(self.path, "w", zipfile.ZIP_STORED)
        self._file.writestr(zipfile.ZipInfo(_name(frame), _DATE), encode_thumbnail(colour))

    def close(self) -> None:
        """Write the file's directory."""
        if self._file is not None:
            self._file.close()


def encode_thumbnail(colour: NDArray[np.uint8]) -> bytes:
    """Return an image (H, W, 3) in red, green, blue as a small JPEG, `WIDTH` pixels wide."""
    height = max(1, round(colour.shape[0] * WIDTH / colour.shape[1]))
    small = cv2.resize(colour, (WIDTH, height), interpolation=cv2.INTER_AREA)
    bgr = cv2.cvtColor(small, cv2.COLOR_RGB2BGR)
    return bytes(cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, _QUALITY])[1])


def read_thumbnails(path: Path) -> dict[int, bytes]:
    """Return the JPEGs by frame number; none where there is no such file.

    Raises
    ------
    AppError
        The file is not whole.
    """
    if not path.exists():
        return {}
    try:
        with zipfile.ZipFile(path) as file:
            return {int(Path(name).stem.split("_")[1]): file.read(name) for name in file.namelist()}
    except (OSError, zipfile.BadZipFile, ValueError, IndexError) as error:
        raise AppError(
            "thumbnails cannot be read", where=path, expected="frame_NNNNNN.jpg in a ZIP file",
            got=str(error),
        ) from error  # fmt: skip


def _name(frame: int) -> str:
    return f"frame_{frame:06d}.jpg"
