"""A sequence kept as one colour and one depth file for each frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Camera, read_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.places import PlaceTruth, read_places
from roomgraph.datasets.readers.images import check_size, read_colour, read_depth
from roomgraph.datasets.readers.registration import rectify
from roomgraph.datasets.sequence import frames_of
from roomgraph.datasets.trajectory import Trajectory, read_tum


@dataclass(frozen=True)
class RecordedSequence:
    """Files on disk, read frame by frame; what all readers of this folder return.

    See `datasets.sequence.Sequence` for the attributes.
    """

    name: str
    root: Path
    camera: Camera
    stamps: NDArray[np.float64]
    colour_files: tuple[Path, ...]
    depth_files: tuple[Path, ...]
    ground_truth: Trajectory | None = None
    places: PlaceTruth | None = None
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not len(self.stamps):
            raise DatasetError(
                "no frames", where=self.root, expected="colour images with depth images",
                hint="check the folder, or give its layout with --dataset",
            )  # fmt: skip

    @property
    def stamps_s(self) -> NDArray[np.float64]:
        """Time stamps of all frames (N,), seconds."""
        return self.stamps

    def __len__(self) -> int:
        return len(self.stamps)

    def __getitem__(self, index: int) -> Frame:
        colour = read_colour(self.colour_files[index])
        depth = read_depth(self.depth_files[index], self.camera.depth_scale)
        check_size(colour, self.camera.intrinsics, self.colour_files[index])
        colour, depth, pinhole = rectify(colour, depth, self.camera, self.depth_files[index])
        return Frame(index, float(self.stamps[index]), colour, depth, pinhole)

    def __iter__(self) -> Iterator[Frame]:
        return frames_of(self)

    def with_camera(self, camera: Camera) -> RecordedSequence:
        """Return the same files, taken by another camera."""
        return replace(self, camera=camera)

    def with_notes(self, *notes: str) -> RecordedSequence:
        """Return the same files, with more notes."""
        return replace(self, notes=(*self.notes, *notes))


def camera_beside(root: Path, names: tuple[str, ...] = ("camera.json",)) -> Camera | None:
    """Read the first of these camera files that the folder has."""
    for name in names:
        if (root / name).exists():
            return read_camera(root / name)
    return None


def truth_beside(root: Path) -> Trajectory | None:
    """Read ``groundtruth.txt`` where the folder has one."""
    path = root / "groundtruth.txt"
    return read_tum(path) if path.exists() else None


def unpaired_notes(colour: int, depth: int) -> list[str]:
    """Return a note on how many images of each kind have no partner; none where all have one."""
    if not colour and not depth:
        return []
    return [f"dropped {colour} colour and {depth} depth images without a partner"]


def places_beside(root: Path) -> PlaceTruth | None:
    """Read ``places.csv`` where the folder has one."""
    path = root / "places.csv"
    return read_places(path) if path.exists() else None
