"""Plain folders: colour images, depth images and a camera file."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from roomgraph.datasets.camera import Camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.images import IMAGE_SUFFIXES
from roomgraph.datasets.readers.recorded import (
    RecordedSequence,
    camera_beside,
    places_beside,
    truth_beside,
    unpaired_notes,
)

COLOUR_NAMES = ("color", "colour", "rgb", "image", "images")
DEPTH_NAMES = ("depth",)
CAMERA_NAMES = ("camera.json", "camera_intrinsic.json", "intrinsic.json", "intrinsics.json")
FRAME_RATE_HZ = 30.0


class FolderReader:
    """Folders of colour and depth images with a camera file."""

    name = "folder"
    files = "color/ + depth/"

    def recognises(self, root: Path) -> bool:
        """Whether the folder holds a colour and a depth folder."""
        return (
            _subfolder(root, COLOUR_NAMES) is not None and _subfolder(root, DEPTH_NAMES) is not None
        )

    def open(self, root: Path, camera: Camera | None = None) -> RecordedSequence:
        """Open ``color/``, ``depth/`` (or their usual other names) and ``camera.json``.

        Images are paired by file name where the names agree, else by order. Stamps come from the
        names where these are numbers with a decimal point, else from the count at 30 Hz.

        Raises
        ------
        DatasetError
            A folder or the camera is missing, or nothing pairs up.
        """
        colour_root = _needed(root, COLOUR_NAMES, "colour images")
        depth_root = _needed(root, DEPTH_NAMES, "depth images")
        colour = {path.stem: path for path in _images(colour_root)}
        depth = {path.stem: path for path in _images(depth_root)}
        shared = [stem for stem in colour if stem in depth]
        if shared:
            pairs = [(stem, colour[stem], depth[stem]) for stem in shared]
        elif len(colour) == len(depth):
            pairs = [(c, colour[c], depth[d]) for c, d in zip(colour, depth, strict=True)]
        else:
            raise DatasetError(
                "colour and depth images do not pair up", where=root,
                expected="equal file names, or equal numbers of images",
                got=f"{len(colour)} colour and {len(depth)} depth images",
            )  # fmt: skip
        camera = camera or _camera_of(root)
        stamps = _stamps([stem for stem, _, _ in pairs])
        notes = [f"camera from {camera.origin}, depth {camera.depth_scale:g} units per metre"]
        notes += unpaired_notes(len(colour) - len(pairs), len(depth) - len(pairs))
        return RecordedSequence(
            name=root.resolve().name, root=root, camera=camera, stamps=stamps,
            colour_files=tuple(c for _, c, _ in pairs), depth_files=tuple(d for _, _, d in pairs),
            ground_truth=truth_beside(root), places=places_beside(root), notes=tuple(notes),
        )  # fmt: skip


def _subfolder(root: Path, names: tuple[str, ...]) -> Path | None:
    return next((root / name for name in names if (root / name).is_dir()), None)


def _needed(root: Path, names: tuple[str, ...], what: str) -> Path:
    found = _subfolder(root, names)
    if found is None:
        raise DatasetError(
            f"no folder of {what}", where=root, expected=" or ".join(f"{n}/" for n in names)
        )
    return found


def _images(root: Path) -> list[Path]:
    """Return the images of a folder, numbers in their names sorted as numbers."""
    files = [path for path in root.iterdir() if path.suffix.lower() in IMAGE_SUFFIXES]
    return sorted(files, key=lambda path: [
        (0, float(word), "") if word[0].isdigit() else (1, 0.0, word)
        for word in re.findall(r"\d+(?:\.\d+)?|\D+", path.stem)
    ])  # fmt: skip


def _stamps(stems: list[str]) -> np.ndarray:
    if all(re.fullmatch(r"\d+\.\d+", stem) for stem in stems):
        return np.array([float(stem) for stem in stems])
    return np.arange(len(stems)) / FRAME_RATE_HZ


def _camera_of(root: Path) -> Camera:
    camera = camera_beside(root, CAMERA_NAMES)
    if camera is None:
        raise DatasetError(
            "camera unknown", where=root, expected=f"{CAMERA_NAMES[0]} beside the images",
            hint="give one with --camera FILE.json (width, height, fx, fy, cx, cy, depth_scale)",
        )  # fmt: skip
    return camera
