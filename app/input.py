"""Opening what the user points at."""

from __future__ import annotations

from pathlib import Path
from typing import cast, get_args

from app.errors import AppError
from datasets.open import Layout, open_sequence
from datasets.sequence import Sequence, select


def open_input(
    root: Path,
    dataset: str | None = None,
    camera: Path | None = None,
    depth_scale: float | None = None,
    start: int = 0,
    frames: int | None = None,
    stride: int = 1,
) -> Sequence:
    """Open a sequence as the flags say.

    Raises
    ------
    AppError
        `dataset` names no layout.
    DatasetError
        The sequence cannot be opened, or no frame is left of it.
    """
    if dataset is not None and dataset not in get_args(Layout):
        raise AppError(
            "no such layout", where="--dataset", expected=" or ".join(get_args(Layout)), got=dataset
        )
    sequence = open_sequence(root, cast(Layout | None, dataset), camera, depth_scale)
    return select(sequence, start, frames, stride)
