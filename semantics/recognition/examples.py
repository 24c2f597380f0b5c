"""Labelled images, for training and testing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import sequence as sequences
from roomgraph.datasets.readers.images import IMAGE_SUFFIXES, read_colour
from roomgraph.semantics.errors import SemanticsError


@dataclass(frozen=True, slots=True)
class Example:
    """An image on disk with the label of its place.

    Attributes
    ----------
    name : str
        The file, or the sequence and time stamp, for people to read.
    label : str
        The kind of place.
    group : str
        What it was seen together with: the visit to the room; unique for a lone photo.
    session : str
        The sequence it is from; the file itself for a lone photo.
    place : str
        The very room (``office2``), empty if not known.
    stamp_s : float
        Its time in the sequence, seconds.
    read : callable
        Returns the image, (H, W, 3) uint8 RGB.
    """

    name: str
    label: str
    group: str
    read: Callable[[], NDArray[np.uint8]]
    session: str = ""
    place: str = ""
    stamp_s: float = 0.0


def folder_examples(root: Path) -> list[Example]:
    """Return the images of ``root/<label>/...``, sorted by name.

    Raises
    ------
    SemanticsError
        There is no folder with an image in it.
    """
    folders = [f for f in (root.iterdir() if root.is_dir() else ()) if f.is_dir()]
    for folder in sorted(folders):
        _refuse_level_above(folder)
    examples = [
        Example(
            name=str(path),
            label=folder.name,
            group=str(path),
            read=partial(read_colour, path),
            session=str(path),
        )
        for folder in sorted(root.iterdir() if root.is_dir() else ())
        if folder.is_dir() and not folder.name.startswith(".")
        for path in sorted(folder.rglob("*"))
        if path.suffix.lower() in IMAGE_SUFFIXES
    ]
    if not examples:
        raise SemanticsError(
            "no training images", where=root, expected="a folder for each label, with images in it",
            hint="or give a sequence with places.csv",
        )  # fmt: skip
    return examples


def _refuse_level_above(folder: Path) -> None:
    """Raise if the folder of a class has no images, but several folders of images."""
    inside = list(folder.iterdir())
    if any(path.suffix.lower() in IMAGE_SUFFIXES for path in inside):
        return
    if sum(path.is_dir() for path in inside) > 1:
        raise SemanticsError(
            "no images directly in a class's folder", where=folder,
            expected="DATA/class/image", got="folders only", hint=f"did you mean {folder}?",
        )  # fmt: skip


def sequence_examples(sequence: sequences.Sequence) -> list[Example]:
    """Return the frames of a sequence whose place is known, in time order.

    A group is one visit: consecutive frames in the same room.

    Raises
    ------
    SemanticsError
        The sequence has no places, or none near its frames' stamps.
    """
    examples = list(_visits(sequence)) if sequence.places is not None else []
    if not examples:
        raise SemanticsError(
            "the sequence has no room labels", where=sequence.root,
            expected="a places.csv with timestamp,label[,instance] near the frames' stamps",
        )  # fmt: skip
    return examples


def thin_out(
    examples: Sequence[Example], stride: int = 1, max_per_label: int | None = None
) -> list[Example]:
    """Return every `stride`-th example of each label, at most `max_per_label`, evenly spread."""
    chosen: list[int] = []
    for label in sorted({example.label for example in examples}):
        indices = [i for i, example in enumerate(examples) if example.label == label][::stride]
        if max_per_label is not None and len(indices) > max_per_label:
            steps = np.linspace(0, len(indices) - 1, max_per_label).round().astype(int)
            indices = [indices[i] for i in steps]
        chosen.extend(indices)
    return [examples[i] for i in sorted(chosen)]


def _visits(sequence: sequences.Sequence) -> Iterator[Example]:
    places = sequence.places
    visit, last = 0, None
    for index, stamp in enumerate(sequence.stamps_s):
        truth = places.at(float(stamp)) if places is not None else None
        if truth is None:
            continue
        if truth != last:
            visit, last = visit + 1, truth
        yield Example(
            name=f"{sequence.name}@{stamp:.3f}", label=truth[0], group=f"{sequence.root}#{visit}",
            read=partial(_colour, sequence, index), session=str(sequence.root), place=truth[1],
            stamp_s=float(stamp),
        )  # fmt: skip


def _colour(sequence: sequences.Sequence, index: int) -> NDArray[np.uint8]:
    return sequence[index].colour
