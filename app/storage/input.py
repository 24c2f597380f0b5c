"""Opening the user's sequence, and storing how it was opened."""

from __future__ import annotations

import tomllib
from pathlib import Path

import tomli_w
from pydantic import Field, ValidationError

from roomgraph.app.errors import AppError
from roomgraph.datasets.files import write_text
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.sequence import Sequence, select
from roomgraph.datasets.settings import Settings


class InputOptions(Settings):
    """A sequence and how to open it, as given by the flags of `roomgraph run`."""

    sequence: Path = Field(description="folder of the sequence")
    dataset: str | None = Field(
        default=None, description="layout of the dataset; detected if left out"
    )
    camera: Path | None = Field(
        default=None, description="camera file that replaces the sequence's own"
    )
    depth_scale: float | None = Field(default=None, gt=0, description="raw depth units per metre")
    start: int = Field(default=0, ge=0, description="number of the first frame")
    frames: int | None = Field(default=None, ge=1, description="maximum number of frames")
    stride: int = Field(default=1, ge=1, description="every n-th frame is used")

    def open(self) -> Sequence:
        """Open the sequence.

        Raises
        ------
        DatasetError
            `dataset` names no layout, the sequence cannot be opened, or no frame is left of it.
        """
        whole = open_sequence(self.sequence, self.dataset, self.camera, self.depth_scale)
        return select(whole, self.start, self.frames, self.stride)


def write_input(path: Path, options: InputOptions) -> None:
    """Write options as TOML, paths in full, so that the sequence is found from anywhere.

    What lies beside `path` is only named, so that the folder may be moved.
    """
    values = options.model_dump(mode="json", exclude_none=True)
    for name in ("sequence", "camera"):
        if name in values:
            place = Path(values[name]).resolve()
            values[name] = place.name if place.parent == path.resolve().parent else str(place)
    write_text(path, tomli_w.dumps(values))


def read_input(path: Path) -> InputOptions:
    """Read what `write_input` wrote.

    Raises
    ------
    AppError
        The file cannot be read or does not hold such options.
    """
    try:
        options = InputOptions.model_validate(tomllib.loads(path.read_text(encoding="utf-8")))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError, ValidationError) as error:
        raise AppError(
            "input options cannot be read", where=path,
            expected="a file written by `roomgraph run`", got=str(error).splitlines()[0],
        ) from error  # fmt: skip
    beside = {"sequence": path.parent / options.sequence}
    if options.camera is not None:
        beside["camera"] = path.parent / options.camera
    return options.model_copy(update=beside)
