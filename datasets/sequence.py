"""The interface of sequences: RGB-D frames with camera and ground truth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.places import PlaceTruth
from roomgraph.datasets.trajectory import Trajectory


@runtime_checkable
class Sequence(Protocol):
    """RGB-D frames in time order, read when asked for."""

    @property
    def name(self) -> str:
        """Short name, usually the folder's."""
        ...

    @property
    def root(self) -> Path:
        """Path on disk."""
        ...

    @property
    def camera(self) -> Camera:
        """Intrinsics, raw depth units per metre, and where both come from."""
        ...

    @property
    def ground_truth(self) -> Trajectory | None:
        """True poses, where there are any."""
        ...

    @property
    def places(self) -> PlaceTruth | None:
        """True room labels, where there are any."""
        ...

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes for the user: frames dropped, the calibration chosen ..."""
        ...

    @property
    def stamps_s(self) -> NDArray[np.float64]:
        """Time stamps of all frames (N,), seconds."""
        ...

    def __len__(self) -> int: ...

    def __getitem__(self, index: int) -> Frame:
        """Read frame `index`; raises DatasetError if one of its images cannot be read.

        Several threads may read at once.
        """
        ...

    def __iter__(self) -> Iterator[Frame]:
        """Read all frames, in order."""
        ...

    def with_camera(self, camera: Camera) -> Sequence:
        """Return the same images as another camera would have taken them."""
        ...

    def with_notes(self, *notes: str) -> Sequence:
        """Return the same frames, with these notes after those that there are."""
        ...


@dataclass(frozen=True, slots=True)
class Selection:
    """A part of a sequence: `indices` of its frames, in order. A sequence like any other."""

    source: Sequence
    indices: tuple[int, ...]
    name: str
    root: Path
    camera: Camera
    ground_truth: Trajectory | None
    places: PlaceTruth | None
    notes: tuple[str, ...]

    @property
    def stamps_s(self) -> NDArray[np.float64]:
        """Time stamps of the chosen frames (N,), seconds."""
        return self.source.stamps_s[list(self.indices)]

    def __len__(self) -> int:
        return len(self.indices)

    def __getitem__(self, index: int) -> Frame:
        frame = self.source[self.indices[index]]
        return Frame(index, frame.stamp_s, frame.colour, frame.depth, frame.intrinsics)

    def __iter__(self) -> Iterator[Frame]:
        return frames_of(self)

    def with_camera(self, camera: Camera) -> Selection:
        """Return the same part, taken by another camera."""
        return replace(self, source=self.source.with_camera(camera), camera=camera)

    def with_notes(self, *notes: str) -> Selection:
        """Return the same part, with more notes."""
        return replace(self, notes=(*self.notes, *notes))


def select(
    sequence: Sequence, start: int = 0, frames: int | None = None, stride: int = 1
) -> Sequence:
    """Return every `stride`-th frame from `start`, `frames` of them at most.

    Raises
    ------
    DatasetError
        Nothing is left.
    """
    if (start, frames, stride) == (0, None, 1):
        return sequence
    indices = tuple(range(start, len(sequence), stride))[:frames]
    if not indices:
        raise DatasetError(
            "no frame is left to read", where=sequence.root, expected=f"start < {len(sequence)}",
            got=f"start {start}, frames {frames}", hint="lower --start or raise --frames",
        )  # fmt: skip
    return Selection(
        sequence, indices, name=sequence.name, root=sequence.root, camera=sequence.camera,
        ground_truth=sequence.ground_truth, places=sequence.places, notes=sequence.notes,
    )  # fmt: skip


def frames_of(sequence: Sequence) -> Iterator[Frame]:
    """Yield all frames in order: what a sequence's ``__iter__`` returns."""
    return (sequence[index] for index in range(len(sequence)))
