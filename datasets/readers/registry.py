"""From a path to a sequence: the layout is guessed from the folder."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from roomgraph.datasets.camera import Camera, read_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.readers.folder import is_folder, open_folder
from roomgraph.datasets.readers.recorded import RecordedSequence
from roomgraph.datasets.readers.seven_scenes import is_seven_scenes, open_seven_scenes
from roomgraph.datasets.readers.tum import is_tum, open_tum

Layout = Literal["tum", "7scenes", "folder"]


@dataclass(frozen=True, slots=True)
class Reader:
    """How a layout is recognised and opened."""

    recognises: Callable[[Path], bool]
    open: Callable[[Path, Camera | None], RecordedSequence]


READERS: dict[Layout, Reader] = {
    "tum": Reader(is_tum, open_tum),
    "7scenes": Reader(is_seven_scenes, open_seven_scenes),
    "folder": Reader(is_folder, open_folder),
}


def open_sequence(
    root: Path,
    layout: Layout | None = None,
    camera: Path | None = None,
    depth_scale: float | None = None,
) -> RecordedSequence:
    """Open a folder of RGB-D frames.

    Parameters
    ----------
    root : Path
        The sequence's folder.
    layout : str, optional
        One of `READERS`; guessed from the folder's files if not given.
    camera : Path, optional
        A camera file that takes the place of the sequence's own.
    depth_scale : float, optional
        Raw depth units per metre, in place of the sequence's own.

    Raises
    ------
    DatasetError
        The folder is missing, empty or of no known layout, or the reader refuses it.
    """
    if not root.is_dir():
        raise DatasetError(
            "no such folder", where=root, expected="a folder with an RGB-D sequence",
            got="a file" if root.exists() else "nothing there",
        )  # fmt: skip
    reader = READERS[layout or guess_layout(root)]
    sequence = reader.open(root, read_camera(camera) if camera else None)
    depth = sequence.camera.depth
    if depth is not None:
        beside_mm = 1000 * np.linalg.norm(depth.T_colour_depth[:3, 3])
        note = (
            f"depth comes from a camera of its own, {depth.intrinsics.width}x"
            f"{depth.intrinsics.height}, fx {depth.intrinsics.fx:g}, {beside_mm:.0f} mm beside "
            "the colour camera; it is registered to that"
        )
        sequence = replace(sequence, notes=(*sequence.notes, note))
    if depth_scale is not None:
        sequence = replace(sequence, camera=replace(sequence.camera, depth_scale=depth_scale))
    return sequence


def guess_layout(root: Path) -> Layout:
    """Return the layout that the folder's files speak of.

    Raises
    ------
    DatasetError
        No reader recognises the folder.
    """
    for name, reader in READERS.items():
        if reader.recognises(root):
            return name
    found = sorted(path.name for path in root.iterdir())[:4]
    raise DatasetError(
        "not an RGB-D sequence of a known layout", where=root,
        expected="rgb.txt + depth.txt (tum), frame-*.color.* (7scenes), color/ + depth/ (folder)",
        got=", ".join(found) if found else "an empty folder",
        hint=f"force a layout with --dataset {'|'.join(get_args(Layout))}",
    )  # fmt: skip
