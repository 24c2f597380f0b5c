"""The plot of an experiment."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import Any

import numpy as np

from roomgraph.datasets.files import replacing
from roomgraph.semantics.evaluation.accuracy import LabelAccuracy
from roomgraph.semantics.evaluation.calibration import rejection_curve, reliability
from roomgraph.semantics.evaluation.open_set import OpenSetEvaluation

# Letters on a line beside a bar.
_NAME_WIDTH = 24
# With fewer bars than this, bars are drawn as thick as with this many.
_FEWEST_BARS = 5
# The figure stands inside bars longer than this, percent.
_ROOM_FOR_FIGURE = 15


def draw(
    path: Path,
    content: dict[str, Any],
    confusion: LabelAccuracy,
    open_set: OpenSetEvaluation | None,
) -> None:
    """Plot the accuracies of an experiment, its confusion matrix, and its calibration.

    Parameters
    ----------
    path : Path
        The picture.
    content : dict
        What the report's JSON holds.
    confusion : LabelAccuracy
        True against found labels.
    open_set : OpenSetEvaluation or None
        Probabilities for buildings never seen.
    """
    from matplotlib.figure import Figure

    count = 2 if open_set is None else 4
    figure = Figure(figsize=(5.2 * min(count, 2), 4.6 * (count // 2)), layout="constrained")
    axes = np.ravel(figure.subplots(count // 2, 2))
    _draw_rows(axes[0], content)
    _draw_confusion(axes[1], confusion)
    if open_set is not None:
        _draw_reliability(axes[2], open_set, content)
        _draw_rejection(axes[3], open_set, content)
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=110)


def _draw_rows(axis: Any, content: dict[str, Any]) -> None:
    rows = content["rows"][::-1]
    bars = axis.barh(
        [textwrap.fill(row["name"], _NAME_WIDTH) for row in rows],
        [100 * row["accuracy_mean"] for row in rows],
        xerr=[100 * row["accuracy_std"] for row in rows],
        color="#4e79a7", ecolor="0.3", capsize=3,
    )  # fmt: skip
    for bar, row in zip(bars, rows, strict=True):
        share = 100 * row["accuracy_mean"]
        is_long = share > _ROOM_FOR_FIGURE
        axis.text(
            2 if is_long else share + 100 * row["accuracy_std"] + 2,
            bar.get_y() + bar.get_height() / 2, f"{row['accuracy_mean']:.1%}", va="center",
            color="white" if is_long else "0.2", fontsize=8,
        )  # fmt: skip
    middle, half = (len(rows) - 1) / 2, max(len(rows), _FEWEST_BARS) / 2
    axis.set(xlim=(0, 104), xlabel="accuracy (%)", ylim=(middle - half, middle + half))
    axis.set_title(f"{content['protocol']}, {content['recipe']}", loc="left")
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
    axis.set(xlabel="predicted", ylabel="true")
    axis.set_title("confusion (%)", loc="left")


def _draw_reliability(axis: Any, open_set: OpenSetEvaluation, content: dict[str, Any]) -> None:
    table = reliability(*open_set.confidence)
    table = table[table[:, 2] > 0]
    axis.plot([0, 1], [0, 1], color="0.7", lw=1)
    axis.plot(table[:, 0], table[:, 1], "o-", color="#e15759")
    for x, y, count in table:
        axis.annotate(f"{count:.0f}", (x, y), (4, -10), textcoords="offset points", fontsize=7)
    axis.set(xlim=(0, 1), ylim=(0, 1), xlabel="probability of the label", ylabel="accuracy")
    axis.set_title(f"unseen buildings: ECE {content['ece']:.3f}", loc="left")
    axis.spines[["top", "right"]].set_visible(False)


def _draw_rejection(axis: Any, open_set: OpenSetEvaluation, content: dict[str, Any]) -> None:
    for name, novel in open_set.novel.items():
        limits = np.quantile(open_set.known[name], np.linspace(0, 1, 101))
        kept = [(open_set.known[name] >= limit).mean() for limit in limits]
        refused = [(novel < limit).mean() for limit in limits]
        label = f"{name.replace('_', ' ')} {content['unknown_auroc'].get(name, float('nan')):.2f}"
        axis.plot(kept, refused, label=label)
    curve = rejection_curve(*open_set.confidence)
    axis.plot(
        curve[:, 0], curve[:, 1], color="black", ls="--", label="accuracy of known places kept"
    )
    axis.set(
        xlim=(0, 1), ylim=(0, 1.02), xlabel="known places kept", ylabel="unknown places rejected"
    )
    axis.legend(frameon=False, fontsize=7, loc="lower left", title="unknown, AUROC")
    axis.set_title("unknown", loc="left")
    axis.spines[["top", "right"]].set_visible(False)
