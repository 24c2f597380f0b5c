"""The tables of objects and of boxes around them: ``objects.csv``, ``boxes.csv``."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from roomgraph.datasets.files import write_text
from roomgraph.datasets.synthetic.truth import Box, ObjectTruth


def write_objects(path: Path, objects: Iterable[ObjectTruth]) -> None:
    """Write an object a row: name, class, centre and size (metres, world axes), room, floor."""
    rows = [
        (
            item.name, item.kind, *(f"{value:.4f}" for value in (*item.centre, *item.size)),
            item.room, item.floor,
        )
        for item in objects
    ]  # fmt: skip
    columns = ("object", "class", "x", "y", "z", "size_x", "size_y", "size_z", "room", "floor")
    _write(path, columns, rows)


def write_boxes(
    path: Path, boxes: Iterable[tuple[str, Box]], objects: Sequence[ObjectTruth]
) -> None:
    """Write a box a row: stamp, object, class, left, top, right, bottom, pixels seen."""
    rows = [
        (
            stamp, objects[box.number].name, objects[box.number].kind, box.left, box.top,
            box.right, box.bottom, box.pixels,
        )
        for stamp, box in boxes
    ]  # fmt: skip
    columns = ("timestamp", "object", "class", "left", "top", "right", "bottom", "pixels")
    _write(path, columns, rows)


def _write(path: Path, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    write_text(path, text.getvalue())
