"""Opening of sequences; the layout is detected from the folder."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from roomgraph.datasets.camera import DepthCamera, read_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.plugins import classes_by_name
from roomgraph.datasets.readers.reader import Reader
from roomgraph.datasets.sequence import Sequence

# A layout is a line here; where several recognise a folder, the first one opens it.
_CLASSES: dict[str, type[Reader]] = classes_by_name(
    "roomgraph.datasets.readers",
    "tum.TumReader",
    "seven_scenes.SevenScenesReader",
    "folder.FolderReader",
)
READERS: dict[str, Reader] = {name: made() for name, made in _CLASSES.items()}


def open_sequence(
    root: str | Path,
    layout: str | None = None,
    camera: Path | None = None,
    depth_scale: float | None = None,
) -> Sequence:
    """Open a recording of RGB-D frames.

    Parameters
    ----------
    root : str or Path
        The sequence's folder, or its file if the layout is a single file.
    layout : str, optional
        One of `READERS`; guessed from the folder's files if not given.
    camera : Path, optional
        A camera file that takes the place of the sequence's own.
    depth_scale : float, optional
        Raw depth units per metre, in place of the sequence's own.

    Raises
    ------
    DatasetError
        The folder is missing, empty or of no known layout, there is no such layout, or the reader
        refuses it.
    """
    root = Path(root)
    if not root.exists():
        raise DatasetError(
            "no such folder", where=root, expected="a folder with an RGB-D sequence",
            got="nothing there",
        )  # fmt: skip
    reader = reader_named(layout or guess_layout(root))
    sequence = reader.open(root, read_camera(camera) if camera else None)
    if sequence.camera.depth is not None:
        sequence = sequence.with_notes(_registered(sequence.camera.depth))
    if depth_scale is not None:
        sequence = sequence.with_camera(replace(sequence.camera, depth_scale=depth_scale))
    return sequence


def guess_layout(root: Path) -> str:
    """Return the name of the layout that matches the folder's files.

    Raises
    ------
    DatasetError
        No reader recognises the folder.
    """
    for name, reader in READERS.items():
        if reader.recognises(root):
            return name
    found = sorted(path.name for path in root.iterdir())[:4] if root.is_dir() else ["a file"]
    raise DatasetError(
        "not an RGB-D sequence of a known layout", where=root, expected=", ".join(described()),
        got=", ".join(found) if found else "an empty folder",
        hint=f"force a layout with --dataset {'|'.join(READERS)}",
    )  # fmt: skip


def reader_named(layout: str) -> Reader:
    """Return the reader of a layout.

    Raises
    ------
    DatasetError
        There is no such layout.
    """
    if layout not in READERS:
        raise DatasetError(
            "no such layout", where=f"--dataset {layout}", expected=" or ".join(described())
        )
    return READERS[layout]


def described() -> list[str]:
    """Return each layout as ``its files (its name)``, for a person to read."""
    return [f"{reader.files} ({name})" for name, reader in READERS.items()]


def _registered(depth: DepthCamera) -> str:
    """Return a note for the user about a separate depth camera."""
    beside_mm = 1000 * np.linalg.norm(depth.T_colour_depth[:3, 3])
    return (
        f"depth images are from a separate camera, {depth.intrinsics.width}x"
        f"{depth.intrinsics.height}, fx {depth.intrinsics.fx:g}, {beside_mm:.0f} mm beside "
        "the colour camera; it is registered to the colour images"
    )
