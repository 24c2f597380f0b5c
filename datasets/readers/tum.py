"""Sequences in the layout of the TUM RGB-D benchmark."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Camera, tum_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.association import MAX_DIFFERENCE_S, associate, typical_offset
from roomgraph.datasets.readers.images import read_colour
from roomgraph.datasets.readers.recorded import (
    RecordedSequence,
    camera_beside,
    places_beside,
    truth_beside,
    unpaired_notes,
)


class TumReader:
    """The layout of the TUM RGB-D benchmark."""

    name = "tum"
    files = "rgb.txt + depth.txt"

    def recognises(self, root: Path) -> bool:
        """Whether the folder looks like a TUM sequence."""
        return any((root / name).exists() for name in ("rgb.txt", "associations.txt"))

    def open(self, root: Path, camera: Camera | None = None) -> RecordedSequence:
        """Open a TUM sequence: ``associations.txt`` if there, else ``rgb.txt`` and ``depth.txt``.

        Raises
        ------
        DatasetError
            A list is missing or not understood, or no colour image has a depth image within 0.02 s.
        """
        if (root / "associations.txt").exists():
            stamps, colour, depth = _read_associations(root / "associations.txt")
            notes = [f"{len(stamps)} pairs from associations.txt"]
        else:
            stamps, colour, depth, notes = _associate(root)
        camera = camera or camera_beside(root) or _published_camera(root, colour[0])
        intrinsics = camera.intrinsics
        notes.append(
            f"camera {intrinsics.width}x{intrinsics.height}, fx {intrinsics.fx:g}, "
            f"depth {camera.depth_scale:g} units per metre, from {camera.origin}"
        )
        return RecordedSequence(
            name=root.resolve().name, root=root, camera=camera, stamps=stamps,
            colour_files=tuple(colour), depth_files=tuple(depth),
            ground_truth=truth_beside(root),
            places=places_beside(root), notes=tuple(notes),
        )  # fmt: skip


def _associate(root: Path) -> tuple[NDArray[np.float64], list[Path], list[Path], list[str]]:
    colour_s, colour = _read_list(root / "rgb.txt")
    depth_s, depth = _read_list(root / "depth.txt")
    pairs = associate(colour_s, depth_s)
    if not len(pairs):
        raise DatasetError(
            "no colour image has a depth image at its time", where=root,
            expected=f"time stamps in rgb.txt and depth.txt within {MAX_DIFFERENCE_S} s",
            got=f"{len(colour)} colour and {len(depth)} depth images, none within that time",
            hint=f"the depth's stamps are {typical_offset(colour_s, depth_s):+.4g} s off: "
            "take that from those in depth.txt",
        )  # fmt: skip
    notes = [f"{len(pairs)} colour images with depth within {MAX_DIFFERENCE_S} s"]
    notes += unpaired_notes(len(colour) - len(pairs), len(depth) - len(pairs))
    return (
        colour_s[pairs[:, 0]],
        [colour[i] for i in pairs[:, 0]],
        [depth[j] for j in pairs[:, 1]],
        notes,
    )


def _read_list(path: Path) -> tuple[NDArray[np.float64], list[Path]]:
    """Read ``timestamp file`` lines, sorted by time."""
    rows = sorted((float(words[0]), words[1]) for words in _rows(path, 2))
    return np.array([stamp for stamp, _ in rows]), [path.parent / name for _, name in rows]


def _read_associations(path: Path) -> tuple[NDArray[np.float64], list[Path], list[Path]]:
    """Read ``timestamp rgb timestamp depth`` lines, in whichever order the two kinds stand."""
    rows = sorted((float(w[0]), w[1], float(w[2]), w[3]) for w in _rows(path, 4))
    first, second = [path.parent / r[1] for r in rows], [path.parent / r[3] for r in rows]
    if "depth" in rows[0][1] and "depth" not in rows[0][3]:
        return np.array([r[2] for r in rows]), second, first
    return np.array([r[0] for r in rows]), first, second


def _rows(path: Path, columns: int) -> list[list[str]]:
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError(
            "list of images cannot be read", where=path,
            expected="rgb.txt and depth.txt, or associations.txt", got=str(error).split(":")[0],
            hint="a folder without lists is read with --dataset folder",
        ) from error  # fmt: skip
    rows = []
    for number, line in enumerate(lines, 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        if len(words) != columns or not all(_is_number(w) for w in words[::2]):
            raise DatasetError(
                "invalid line", where=f"{path}:{number}",
                expected=" ".join(["timestamp file"] * (columns // 2)), got=repr(line[:60]),
            )  # fmt: skip
        rows.append(words)
    if not rows:
        raise DatasetError("list of images is empty", where=path, expected="a line for each image")
    return rows


def _is_number(word: str) -> bool:
    try:
        return bool(np.isfinite(float(word)))
    except ValueError:
        return False


def _published_camera(root: Path, first_colour: Path) -> Camera:
    """Return the camera that the benchmark gives, if the images have its size."""
    camera = tum_camera(root.resolve().name)
    height, width = read_colour(first_colour).shape[:2]
    if (width, height) != (camera.intrinsics.width, camera.intrinsics.height):
        raise DatasetError(
            "camera unknown", where=root,
            expected="camera.json, or 640x480 images of a TUM Kinect", got=f"{width}x{height}",
            hint="give the camera with --camera FILE.json",
        )  # fmt: skip
    return camera
