"""Tables and pictures of an experiment."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from datasets.files import replacing, write_text
from semantics.calibration import (
    auroc,
    brier_score,
    expected_calibration_error,
    rejection_curve,
    reliability,
)
from semantics.evaluation import LabelAccuracy, compare_labels
from semantics.trials import Judgement, Trial, per_class

# Letters on a line beside a bar.
_NAME_WIDTH = 24


@dataclass(frozen=True, slots=True)
class ProtocolReport:
    """What an experiment found.

    Attributes
    ----------
    name, preset : str
        The experiment, and how places were learned.
    data : tuple of str
        What it was run on.
    trials : tuple of Trial
        All trainings and tests.
    notes : tuple of str
        What a reader has to know: what stands on both sides of a split, what was left out.
    headline : tuple of str
        Rows that the overall accuracy is the mean of; all if empty.
    judgement : Judgement or None
        Probabilities for buildings never seen.
    figures : mapping
        Further numbers by name.
    """

    name: str
    preset: str
    data: tuple[str, ...]
    trials: tuple[Trial, ...]
    notes: tuple[str, ...]
    headline: tuple[str, ...] = ()
    judgement: Judgement | None = None
    figures: dict[str, Any] = field(default_factory=dict)

    @property
    def counted(self) -> list[Trial]:
        """The trials of the headline rows."""
        return [t for t in self.trials if not self.headline or t.row in self.headline]

    @property
    def confusion(self) -> LabelAccuracy:
        """True against found labels of the headline rows."""
        return compare_labels(
            (str(a), str(b))
            for trial in self.counted
            for a, b in zip(trial.truth, trial.found, strict=True)
        )

    def content(self) -> dict[str, Any]:
        """Return the report as plain values."""
        accuracies = [trial.accuracy for trial in self.counted]
        content: dict[str, Any] = {
            "schema": "roomgraph/protocol/1",
            "protocol": self.name,
            "preset": self.preset,
            "data": list(self.data),
            "accuracy_mean": _rounded(np.mean(accuracies)),
            "accuracy_std": _rounded(np.std(accuracies)),
            "class_mean": _rounded(np.mean(list(per_class(self.counted).values()))),
            "per_class": {k: _rounded(v) for k, v in per_class(self.counted).items()},
            "rows": [_row(name, [t for t in self.trials if t.row == name]) for name in self.rows],
            "confusion": {
                "labels": list(self.confusion.names),
                "counts": self.confusion.confusion.tolist(),
            },
            "notes": list(self.notes),
        }
        if self.judgement is not None:
            content |= judged(self.judgement)
        return content | self.figures

    @property
    def rows(self) -> list[str]:
        """The table's rows, in order."""
        return list(dict.fromkeys(trial.row for trial in self.trials))


def judged(judgement: Judgement) -> dict[str, Any]:
    """Return the figures of the probabilities."""
    confidence, right = _confidence(judgement)
    index = np.array([judgement.classes.index(str(name)) for name in judgement.truth])
    areas = {k: auroc(judgement.usual[k], v) for k, v in judgement.strange.items() if len(v)}
    return {
        "ece": _rounded(expected_calibration_error(confidence, right)),
        "brier": _rounded(brier_score(judgement.probabilities, index)),
        "unknown_auroc_mean": _rounded(np.mean(list(areas.values()))),
        "unknown_auroc": {name: _rounded(value) for name, value in areas.items()},
    }


def write_report(directory: Path, report: ProtocolReport) -> dict[str, Any]:
    """Write NAME.json, NAME.md and NAME.png; return what the JSON holds."""
    directory.mkdir(parents=True, exist_ok=True)
    content = report.content()
    text = json.dumps(content, indent=1, allow_nan=False)
    write_text(directory / f"{report.name}.json", text + "\n")
    write_text(directory / f"{report.name}.md", markdown(content))
    _draw(directory / f"{report.name}.png", report, content)
    return content


def markdown(content: dict[str, Any]) -> str:
    """Return the report as Markdown."""
    lines = [
        f"# {content['protocol']}, preset {content['preset']}", "",
        f"On {', '.join(content['data'])}.", "",
        "| | accuracy | std | mean per class | trainings | images tested |",
        "| --- | ---: | ---: | ---: | ---: | ---: |",
    ]  # fmt: skip
    for row in content["rows"]:
        lines.append(
            f"| {row['name']} | {row['accuracy_mean']:.1%} | {row['accuracy_std']:.1%} | "
            f"{row['class_mean']:.1%} | {row['trials']} | {row['images']} |"
        )
    lines += ["", "| class | right |", "| --- | ---: |"]
    lines += [f"| {name} | {share:.1%} |" for name, share in content["per_class"].items()]
    if "ece" in content:
        lines += [
            "", f"Calibration error (ECE) {content['ece']:.3f}, "
            f"Brier score {content['brier']:.3f}; a kind of place never seen stands out with "
            f"AUROC {content['unknown_auroc_mean']:.2f}.",
        ]  # fmt: skip
    lines += ["", *(f"- {note}" for note in content["notes"])]
    return "\n".join(lines) + "\n"


def _row(name: str, trials: Sequence[Trial]) -> dict[str, Any]:
    accuracies = [trial.accuracy for trial in trials]
    return {
        "name": name,
        "accuracy_mean": _rounded(np.mean(accuracies)),
        "accuracy_std": _rounded(np.std(accuracies)),
        "class_mean": _rounded(np.mean(list(per_class(trials).values()))),
        "trials": len(trials),
        "images": sum(len(trial.truth) for trial in trials),
    }


def _confidence(judgement: Judgement) -> tuple[np.ndarray, np.ndarray]:
    best = judgement.probabilities.argmax(axis=1)
    right = np.array(judgement.classes)[best] == judgement.truth
    return judgement.probabilities.max(axis=1), right


def _draw(path: Path, report: ProtocolReport, content: dict[str, Any]) -> None:
    from matplotlib.figure import Figure

    count = 2 if report.judgement is None else 4
    figure = Figure(figsize=(5.2 * min(count, 2), 4.6 * (count // 2)), layout="constrained")
    axes = np.ravel(figure.subplots(count // 2, 2))
    _draw_rows(axes[0], report, content)
    _draw_confusion(axes[1], report.confusion)
    if report.judgement is not None:
        _draw_reliability(axes[2], report.judgement, content)
        _draw_rejection(axes[3], report.judgement, content)
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=110)


def _draw_rows(axis: Any, report: ProtocolReport, content: dict[str, Any]) -> None:
    rows = content["rows"][::-1]
    axis.barh(
        [textwrap.fill(row["name"], _NAME_WIDTH) for row in rows],
        [100 * row["accuracy_mean"] for row in rows],
        xerr=[100 * row["accuracy_std"] for row in rows],
        color="#4e79a7", ecolor="0.3", capsize=3,
    )  # fmt: skip
    axis.set(xlim=(0, 104), xlabel="images right (%)")
    axis.set_title(f"{report.name}, preset {report.preset}", loc="left")
    axis.spines[["top", "right"]].set_visible(False)


def _draw_confusion(axis: Any, accuracy: LabelAccuracy) -> None:
    share = accuracy.confusion / np.maximum(accuracy.confusion.sum(axis=1, keepdims=True), 1)
    axis.imshow(share, cmap="Blues", vmin=0, vmax=1)
    names = [name.replace("_", " ") for name in accuracy.names]
    axis.set_xticks(range(len(names)), names, rotation=45, ha="right", fontsize=8)
    axis.set_yticks(range(len(names)), names, fontsize=8)
    for (i, j), value in np.ndenumerate(share):
        if value >= 0.005:
            colour = "white" if value > 0.5 else "black"
            axis.text(
                j, i, f"{100 * value:.0f}", ha="center", va="center", color=colour, fontsize=8
            )
    axis.set(xlabel="found", ylabel="true")
    axis.set_title("confusion (%)", loc="left")


def _draw_reliability(axis: Any, judgement: Judgement, content: dict[str, Any]) -> None:
    table = reliability(*_confidence(judgement))
    table = table[table[:, 2] > 0]
    axis.plot([0, 1], [0, 1], color="0.7", lw=1)
    axis.plot(table[:, 0], table[:, 1], "o-", color="#e15759")
    for x, y, count in table:
        axis.annotate(f"{count:.0f}", (x, y), (4, -10), textcoords="offset points", fontsize=7)
    axis.set(xlim=(0, 1), ylim=(0, 1), xlabel="probability of the label", ylabel="share right")
    axis.set_title(f"buildings never seen: ECE {content['ece']:.3f}", loc="left")
    axis.spines[["top", "right"]].set_visible(False)


def _draw_rejection(axis: Any, judgement: Judgement, content: dict[str, Any]) -> None:
    for name, strange in judgement.strange.items():
        limits = np.quantile(judgement.usual[name], np.linspace(0, 1, 101))
        kept = [(judgement.usual[name] >= limit).mean() for limit in limits]
        refused = [(strange < limit).mean() for limit in limits]
        label = f"{name.replace('_', ' ')} {content['unknown_auroc'].get(name, float('nan')):.2f}"
        axis.plot(kept, refused, label=label)
    curve = rejection_curve(*_confidence(judgement))
    axis.plot(curve[:, 0], curve[:, 1], color="black", ls="--", label="known: share right")
    axis.set(
        xlim=(0, 1), ylim=(0, 1.02), xlabel="known places kept", ylabel="places never seen refused"
    )
    axis.legend(frameon=False, fontsize=7, loc="lower left", title="never seen, AUROC")
    axis.set_title("unknown", loc="left")
    axis.spines[["top", "right"]].set_visible(False)


def _rounded(value: Any) -> float:
    return round(float(value), 4)
