"""The interface of readers of sequence layouts."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

from roomgraph.datasets.camera import Camera
from roomgraph.datasets.sequence import Sequence


class Reader(Protocol):
    """How the sequences of a layout are recognised and opened."""

    @property
    def name(self) -> str:
        """What the layout is called after ``--dataset``."""
        ...

    @property
    def files(self) -> str:
        """What tells the layout from others, in a few words: ``rgb.txt + depth.txt``."""
        ...

    def recognises(self, root: Path) -> bool:
        """Whether `root`, a folder or a file, is a sequence of this layout."""
        ...

    def open(self, root: Path, camera: Camera | None = None) -> Sequence:
        """Open a sequence, taken by `camera` if that is given, else by the sequence's own.

        Raises
        ------
        DatasetError
            The sequence cannot be read, or its camera is unknown.
        """
        ...
