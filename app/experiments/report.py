"""The results of an experiment, and its tables."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from roomgraph.app.experiments.pictures import draw
from roomgraph.app.rounding import rounded
from roomgraph.datasets.files import write_text
from roomgraph.semantics.evaluation.accuracy import LabelAccuracy, compare_labels
from roomgraph.semantics.evaluation.calibration import (
    auroc,
    brier_score,
    expected_calibration_error,
)
from roomgraph.semantics.evaluation.open_set import OpenSetEvaluation
from roomgraph.semantics.evaluation.splits import SplitResult, per_class
from roomgraph.semantics.recognition.settings import TrainingSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class ProtocolReport:
    """The results of an experiment.

    Attributes
    ----------
    data : tuple of str
        What it was run on.
    results : tuple of SplitResult
        All trainings and tests.
    notes : tuple of str
        What a reader has to know: what stands on both sides of a split, what was left out.
    headline : tuple of str
        Rows that the overall accuracy is the mean of; all if empty.
    open_set : OpenSetEvaluation or None
        Probabilities for buildings never seen.
    figures : mapping
        Further numbers by name.
    name : str
        The experiment.
    training : TrainingSettings
        What the place models were made of.
    """

    data: tuple[str, ...]
    results: tuple[SplitResult, ...]
    notes: tuple[str, ...]
    headline: tuple[str, ...] = ()
    open_set: OpenSetEvaluation | None = None
    figures: dict[str, Any] = field(default_factory=dict)
    name: str = ""
    training: TrainingSettings = field(default_factory=TrainingSettings)

    @property
    def counted(self) -> list[SplitResult]:
        """The results of the headline rows."""
        return [t for t in self.results if not self.headline or t.row in self.headline]

    @property
    def confusion(self) -> LabelAccuracy:
        """Confusion of true and predicted labels in the headline rows."""
        return compare_labels(
            (str(a), str(b))
            for result in self.counted
            for a, b in zip(result.truth, result.found, strict=True)
        )

    def content(self) -> dict[str, Any]:
        """Return the report as plain values."""
        accuracies = [result.accuracy for result in self.counted]
        content: dict[str, Any] = {
            "schema": "roomgraph/protocol/1",
            "protocol": self.name,
            "recipe": f"{self.training.descriptor}, {self.training.classifier}",
            "training": self.training.model_dump(mode="json"),
            "data": list(self.data),
            "accuracy_mean": rounded(np.mean(accuracies)),
            "accuracy_std": rounded(np.std(accuracies)),
            "class_mean": rounded(np.mean(list(per_class(self.counted).values()))),
            "per_class": {k: rounded(v) for k, v in per_class(self.counted).items()},
            "rows": [_row(name, [t for t in self.results if t.row == name]) for name in self.rows],
            "confusion": {
                "labels": list(self.confusion.names),
                "counts": self.confusion.confusion.tolist(),
            },
            "notes": list(self.notes),
        }
        if self.open_set is not None:
            content |= open_set_figures(self.open_set)
        return content | self.figures

    @property
    def rows(self) -> list[str]:
        """The table's rows, in order."""
        return list(dict.fromkeys(result.row for result in self.results))


def open_set_figures(open_set: OpenSetEvaluation) -> dict[str, Any]:
    """Return the metrics of the probabilities."""
    confidence, right = open_set.confidence
    index = np.array([open_set.classes.index(str(name)) for name in open_set.truth])
    areas = {k: auroc(open_set.known[k], v) for k, v in open_set.novel.items() if len(v)}
    return {
        "ece": rounded(expected_calibration_error(confidence, right)),
        "brier": rounded(brier_score(open_set.probabilities, index)),
        "unknown_auroc_mean": rounded(np.mean(list(areas.values()))),
        "unknown_auroc": {name: rounded(value) for name, value in areas.items()},
    }


def write_report(directory: Path, report: ProtocolReport) -> dict[str, Any]:
    """Write NAME.json, NAME.md and NAME.png; return what the JSON holds."""
    directory.mkdir(parents=True, exist_ok=True)
    content = report.content()
    text = json.dumps(content, indent=1, allow_nan=False)
    write_text(directory / f"{report.name}.json", text + "\n")
    write_text(directory / f"{report.name}.md", markdown(content))
    draw(directory / f"{report.name}.png", content, report.confusion, report.open_set)
    return content


def markdown(content: dict[str, Any]) -> str:
    """Return the report as Markdown."""
    lines = [
        f"# {content['protocol']}, {content['recipe']}", "",
        f"Data: {', '.join(content['data'])}.", "",
        "| | accuracy | std | mean per class | trainings | test images |",
        "| --- | ---: | ---: | ---: | ---: | ---: |",
    ]  # fmt: skip
    for row in content["rows"]:
        lines.append(
            f"| {row['name']} | {row['accuracy_mean']:.1%} | {row['accuracy_std']:.1%} | "
            f"{row['class_mean']:.1%} | {row['results']} | {row['images']} |"
        )
    lines += ["", "| class | accuracy |", "| --- | ---: |"]
    lines += [f"| {name} | {share:.1%} |" for name, share in content["per_class"].items()]
    if "ece" in content:
        lines += [
            "", f"Calibration error (ECE) {content['ece']:.3f}, "
            f"Brier score {content['brier']:.3f}; AUROC of the detection of unknown kinds of place "
            f"{content['unknown_auroc_mean']:.2f}.",
        ]  # fmt: skip
    lines += ["", *(f"- {note}" for note in content["notes"])]
    return "\n".join(lines) + "\n"


def _row(name: str, results: Sequence[SplitResult]) -> dict[str, Any]:
    accuracies = [result.accuracy for result in results]
    return {
        "name": name,
        "accuracy_mean": rounded(np.mean(accuracies)),
        "accuracy_std": rounded(np.std(accuracies)),
        "class_mean": rounded(np.mean(list(per_class(results).values()))),
        "results": len(results),
        "images": sum(len(result.truth) for result in results),
    }
