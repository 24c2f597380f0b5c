"""True room labels of a sequence: ``places.csv``."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.files import write_text


@dataclass(frozen=True, slots=True)
class PlaceTruth:
    """The room that the camera truly is in, over time.

    Attributes
    ----------
    stamps_s : (N,) float64
        Seconds, rising.
    labels : tuple of str
        The kind of place at each stamp (``office``).
    instances : tuple of str
        The very room at each stamp (``office2``); empty strings where the file does not say.
    floors : tuple of int
        The floor of the building at each stamp, 0 at the bottom; empty if the file does not say.
    transitions : tuple of str
        ``door``, ``jamb``, ``stairs`` or ``elevator`` at each stamp where the camera is in one,
        else an empty string; empty if the file does not say.
    """

    stamps_s: NDArray[np.float64]
    labels: tuple[str, ...]
    instances: tuple[str, ...]
    floors: tuple[int, ...] = ()
    transitions: tuple[str, ...] = ()

    def at(self, stamp_s: float, max_difference_s: float = 0.05) -> tuple[str, str] | None:
        """Return label and instance nearest to `stamp_s`, or None if none is that near."""
        index = int(np.abs(self.stamps_s - stamp_s).argmin())
        if abs(self.stamps_s[index] - stamp_s) > max_difference_s:
            return None
        return self.labels[index], self.instances[index]


def read_places(path: Path) -> PlaceTruth:
    """Read ``timestamp,label[,instance][,floor,transition]`` rows under a header line.

    Raises
    ------
    DatasetError
        A column is missing, or a time stamp or a floor is not a number.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError("place labels cannot be read", where=path, got=str(error)) from error
    with io.StringIO(text, newline="") as file:
        reader = csv.DictReader(file)
        if not {"timestamp", "label"} <= set(reader.fieldnames or ()):
            raise DatasetError(
                "invalid place labels", where=f"{path}:1",
                expected="a header timestamp,label[,instance]", got=str(reader.fieldnames),
            )  # fmt: skip
        rows = list(reader)
    try:
        stamps = np.array([float(row["timestamp"]) for row in rows])
    except (TypeError, ValueError) as error:
        raise DatasetError("a time stamp is not a number", where=path, got=str(error)) from error
    if not len(stamps):
        raise DatasetError("no place labels", where=path, expected="a row for each frame")
    order = np.argsort(stamps, kind="stable")
    floors: tuple[int, ...] = ()
    transitions: tuple[str, ...] = ()
    if "floor" in rows[0]:
        floors = tuple(_floor(rows[i]["floor"], path, int(i) + 2) for i in order)
    if "transition" in rows[0]:
        transitions = tuple((rows[i]["transition"] or "").strip() for i in order)
    return PlaceTruth(
        stamps[order],
        tuple((rows[i]["label"] or "unknown").strip() for i in order),
        tuple((rows[i].get("instance") or "").strip() for i in order),
        floors,
        transitions,
    )


def _floor(text: str | None, path: Path, line: int) -> int:
    try:
        return int(text or "")
    except ValueError as error:
        raise DatasetError(
            "a floor is not a whole number", where=f"{path}:{line}", got=repr(text)
        ) from error


def write_places(path: Path, places: PlaceTruth) -> None:
    """Write ``timestamp,label,instance`` rows, with ``floor`` and ``transition`` if known."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    columns: list[tuple[str, Sequence[object]]] = [
        ("timestamp", [f"{stamp:.6f}" for stamp in places.stamps_s]),
        ("label", places.labels),
        ("instance", places.instances),
    ]
    if places.floors:
        columns.append(("floor", places.floors))
    if places.transitions:
        columns.append(("transition", places.transitions))
    writer.writerow([name for name, _ in columns])
    writer.writerows(zip(*(values for _, values in columns), strict=True))
    write_text(path, text.getvalue())
