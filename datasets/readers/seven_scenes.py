"""Sequences in the layout of Microsoft's 7-Scenes."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from roomgraph.datasets.camera import Camera, Intrinsics
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.images import read_colour
from roomgraph.datasets.readers.recorded import RecordedSequence, camera_beside, places_beside
from roomgraph.datasets.trajectory import Trajectory

FRAME_RATE_HZ = 30.0
DEPTH_SCALE = 1000.0
# The calibration that the benchmark gives for both of its images.
PUBLISHED = (585.0, 585.0, 320.0, 240.0)


class SevenScenesReader:
    """The layout of Microsoft's 7-Scenes."""

    name = "7scenes"
    files = "frame-*.color.*"

    def recognises(self, root: Path) -> bool:
        """Whether the folder looks like a 7-Scenes sequence."""
        return any(root.glob("frame-*.color.*"))

    def open(self, root: Path, camera: Camera | None = None) -> RecordedSequence:
        """Open ``frame-XXXXXX.color.*``, ``.depth.png`` (millimetres) and ``.pose.txt``.

        Stamps are made up at 30 Hz from the frames' numbers. Frames without depth are dropped and
        counted in the notes.

        Raises
        ------
        DatasetError
            No frame is complete, or a pose or the camera cannot be read.
        """
        names = (path.name.split(".")[0] for path in root.glob("frame-*.color.*"))
        stems = sorted((n for n in names if re.fullmatch(r"frame-\d+", n)), key=_number)
        whole = [stem for stem in stems if (root / f"{stem}.depth.png").exists()]
        colour = [next(root.glob(f"{stem}.color.*")) for stem in whole]
        if not whole:
            raise DatasetError(
                "no complete frame", where=root,
                expected="frame-XXXXXX.color.png|jpg with frame-XXXXXX.depth.png",
                got=f"{len(stems)} colour images, none with depth",
            )  # fmt: skip
        camera = camera or camera_beside(root) or _camera_of(root, colour[0])
        stamps = np.array([_number(stem) for stem in whole]) / FRAME_RATE_HZ
        notes = [
            f"camera fx {camera.intrinsics.fx:g}, depth {camera.depth_scale:g} units per metre, "
            f"from {camera.origin}"
        ]
        if len(stems) > len(whole):
            notes.append(f"dropped {len(stems) - len(whole)} colour images without depth")
        return RecordedSequence(
            name=root.resolve().name, root=root, camera=camera, stamps=stamps,
            colour_files=tuple(colour),
            depth_files=tuple(root / f"{stem}.depth.png" for stem in whole),
            ground_truth=_read_poses(root, whole, stamps), places=places_beside(root),
            notes=tuple(notes),
        )  # fmt: skip


def _number(stem: str) -> int:
    return int(stem.split("-")[1])


def _read_poses(root: Path, stems: list[str], stamps: np.ndarray) -> Trajectory | None:
    """Read the (4, 4) camera-to-world poses of the frames that have one."""
    kept, poses = [], []
    for stamp, stem in zip(stamps, stems, strict=True):
        path = root / f"{stem}.pose.txt"
        if not path.exists():
            continue
        try:
            T = np.loadtxt(path)
        except ValueError as error:
            raise DatasetError("invalid pose", where=path, got=str(error)) from error
        if T.shape != (4, 4):
            raise DatasetError("invalid pose", where=path, expected="4 x 4 numbers")
        if np.all(np.isfinite(T)):
            kept.append(stamp)
            poses.append(T)
    return Trajectory(np.array(kept), np.array(poses)) if kept else None


def _camera_of(root: Path, first_colour: Path) -> Camera:
    height, width = read_colour(first_colour).shape[:2]
    path = root / "camera-intrinsics.txt"
    if not path.exists() and (width, height) != (640, 480):
        raise DatasetError(
            "camera unknown", where=root, expected=f"{path.name}, or 640x480 images",
            got=f"{width}x{height}", hint="give the camera with --camera FILE.json",
        )  # fmt: skip
    if not path.exists():
        values, origin = PUBLISHED, "7-Scenes' published calibration"
    else:
        try:
            K = np.loadtxt(path).reshape(3, 3)
        except ValueError as error:
            raise DatasetError(
                "invalid camera file", where=path, expected="a 3 x 3 matrix", got=str(error)
            ) from error
        values, origin = (K[0, 0], K[1, 1], K[0, 2], K[1, 2]), path.name
    fx, fy, cx, cy = (float(value) for value in values)
    return Camera(Intrinsics(width, height, fx, fy, cx, cy), DEPTH_SCALE, origin)
