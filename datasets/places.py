"""True room labels of a sequence: ``places.csv``."""

from __future__ import annotations

import csv
import io
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
    """

    stamps_s: NDArray[np.float64]
    labels: tuple[str, ...]
    instances: tuple[str, ...]

    def at(self, stamp_s: float, max_difference_s: float = 0.05) -> tuple[str, str] | None:
        """Return label and instance nearest to `stamp_s`, or None if none is that near."""
        index = int(np.abs(self.stamps_s - stamp_s).argmin())
        if abs(self.stamps_s[index] - stamp_s) > max_difference_s:
            return None
        return self.labels[index], self.instances[index]


def read_places(path: Path) -> PlaceTruth:
    """Read ``timestamp,label[,instance]`` rows under a header line.

    Raises
    ------
    DatasetError
        A column is missing or a time stamp is not a number.
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
    return PlaceTruth(
        stamps[order],
        tuple((rows[i]["label"] or "unknown").strip() for i in order),
        tuple((rows[i].get("instance") or "").strip() for i in order),
    )


def write_places(path: Path, places: PlaceTruth) -> None:
    """Write ``timestamp,label,instance`` rows."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("timestamp", "label", "instance"))
    for stamp, label, instance in zip(
        places.stamps_s, places.labels, places.instances, strict=True
    ):
        writer.writerow((f"{stamp:.6f}", label, instance))
    write_text(path, text.getvalue())
