"""Labelling images and sequences that are not being mapped."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.table import Table

from roomgraph.app.console import Advance
from roomgraph.app.learning.training import labelled_examples
from roomgraph.app.prefetch import prefetch
from roomgraph.app.storage.input import InputOptions
from roomgraph.datasets import sequence as sequences
from roomgraph.datasets.errors import DatasetError, RoomgraphError
from roomgraph.datasets.files import write_text
from roomgraph.datasets.readers.images import IMAGE_SUFFIXES, read_colour
from roomgraph.datasets.readers.registry import guess_layout
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.evaluation.accuracy import compare_labels
from roomgraph.semantics.recognition.examples import Example
from roomgraph.semantics.recognition.model import PlaceModel, PlacePrediction
from roomgraph.semantics.temporal.labeller import PlaceLabeller
from roomgraph.semantics.temporal.look import FrameInput
from roomgraph.semantics.temporal.settings import LabellerSettings


@dataclass(frozen=True, slots=True)
class LabelledItem:
    """An image with its predicted label and its true label (empty if unknown)."""

    name: str
    label: str
    score: float
    truth: str


def label_items(
    model: PlaceModel,
    data: Path,
    advance: Advance,
    settings: LabellerSettings | None = None,
    dataset: str | None = None,
    camera: Path | None = None,
) -> list[LabelledItem]:
    """Label an image, a folder of images (class/image, or flat), or a sequence.

    Parameters
    ----------
    model : PlaceModel
        What predicts.
    data : Path
        What to label.
    advance : callable
        Called with items done, items in all and the last label.
    settings : LabellerSettings, optional
        The vote among the frames of a sequence.
    dataset, camera : str and Path, optional
        Layout and camera file of a sequence, where they cannot be guessed.

    Raises
    ------
    RoomgraphError
        There is nothing to label, or an image cannot be read.
    """
    if dataset is not None or camera is not None or _is_sequence(data):
        sequence = InputOptions(sequence=data, dataset=dataset, camera=camera).open()
        return list(_label_sequence(model, sequence, settings or LabellerSettings(), advance))
    examples = _images(data) if data.is_dir() else [_unlabelled(data)]
    return list(_label_images(model, examples, advance))


def _is_sequence(data: Path) -> bool:
    try:
        return data.is_dir() and bool(guess_layout(data))
    except DatasetError:
        return False


def write_labels_csv(path: Path, items: Sequence[LabelledItem]) -> None:
    """Write ``item,label,score,truth`` rows."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("item", "label", "score", "truth"))
    writer.writerows((i.name, i.label, f"{i.score:.4f}", i.truth) for i in items)
    write_text(path, text.getvalue())


def accuracy_table(items: Sequence[LabelledItem]) -> Table | None:
    """Return the accuracy by class and overall, or None without ground truth."""
    accuracy = compare_labels((i.truth, i.label) for i in items if i.truth)
    if not accuracy.count:
        return None
    table = Table("class", "right", box=None, padding=(0, 2, 0, 0))
    for name, share in accuracy.per_label.items():
        if np.isfinite(share):
            table.add_row(name, f"{share:.1%}")
    table.add_row("all", f"{accuracy.overall:.1%} of {accuracy.count}", style="bold")
    return table


def _images(root: Path) -> list[Example]:
    try:
        return labelled_examples(root)
    except RoomgraphError:
        flat = sorted(p for p in root.iterdir() if p.suffix.lower() in IMAGE_SUFFIXES)
        if not flat:
            raise SemanticsError(
                "nothing to label", where=root, expected="images, class/image, or a sequence"
            ) from None
        return [_unlabelled(path) for path in flat]


def _unlabelled(path: Path) -> Example:
    return Example(str(path), "", str(path), lambda: read_colour(path))


def _label_images(
    model: PlaceModel, examples: list[Example], advance: Advance
) -> Iterator[LabelledItem]:
    def predict(example: Example) -> PlacePrediction:
        return model.predict(example.read())

    for done, (example, prediction) in enumerate(
        zip(examples, prefetch(predict, examples), strict=True), 1
    ):
        advance(done, len(examples), prediction.label)
        yield LabelledItem(example.name, prediction.label, prediction.score, example.label)


def _label_sequence(
    model: PlaceModel, sequence: sequences.Sequence, settings: LabellerSettings, advance: Advance
) -> Iterator[LabelledItem]:
    labeller = PlaceLabeller(model, settings)

    def predict(index: int) -> tuple[FrameInput, PlacePrediction]:
        frame = sequence[index]
        return FrameInput(index, frame.stamp_s), model.predict(frame.colour)

    for frame, prediction in prefetch(predict, range(len(sequence))):
        labels = labeller.take(frame, prediction)
        if frame.index + 1 == len(sequence):
            labels += labeller.finish()
        for label in labels:
            place = sequence.places.at(label.stamp_s) if sequence.places else None
            advance(label.index + 1, len(sequence), label.label)
            yield LabelledItem(
                f"{label.stamp_s:.6f}", label.label, label.score, place[0] if place else ""
            )
