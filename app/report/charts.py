"""The report's charts, as SVG that is legible on light and dark backgrounds."""

from __future__ import annotations

import io
from collections.abc import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roomgraph.semantics.labels import UNKNOWN, LabelSpace

# Grey that stands out from white and from black alike.
_GREY, _LINE, _TRUTH = "#808489", "#3d8bd4", "#d07a2d"
_WIDTH_INCHES = 4.8


def label_chart(
    stamps_s: NDArray[np.float64],
    labels: Sequence[str],
    scores: NDArray[np.float64],
    truth: Sequence[str] | None,
    space: LabelSpace,
) -> str:
    """Draw the labels of the frames over time, above them the true ones if known, and the scores.

    Parameters
    ----------
    stamps_s : (N,) float64
        Of the frames, seconds.
    labels, scores : sequence of str, (N,) float64
        Label of each frame and its probability.
    truth : sequence of str or None
        True label of each frame; empty where unknown.
    space : LabelSpace
        Names and colours.
    """
    rows = [("found", labels)] if truth is None else [("true", truth), ("found", labels)]
    figure = Figure(figsize=(_WIDTH_INCHES, 1.5 + 0.3 * len(rows)), layout="constrained")
    strips, lines = figure.subplots(
        2, 1, sharex=True, gridspec_kw={"height_ratios": [0.5 * len(rows), 1.6]}
    )
    known = {name: colour for name, colour in zip(space.names, space.colours, strict=True)}
    image = np.array(
        [[known.get(label, known[UNKNOWN]) for label in row] for _, row in rows], dtype=np.uint8
    ).reshape(len(rows), len(labels), 3)
    time = stamps_s - stamps_s[0]
    end = max(float(time[-1]), 1e-3)
    strips.imshow(
        image, aspect="auto", extent=(0, end, len(rows) - 0.5, -0.5), interpolation="nearest"
    )
    strips.set_yticks(range(len(rows)), [name for name, _ in rows])
    lines.plot(time, scores, color=_LINE, lw=1.0)
    lines.set(ylim=(0, 1.02), xlim=(0, end), xlabel="time (s)", ylabel="probability")
    return _svg(figure, (strips, lines))


def error_chart(stamps_s: NDArray[np.float64], errors_m: NDArray[np.float64]) -> str:
    """Draw the position error (N,) in centimetres over time (N,)."""
    figure = Figure(figsize=(_WIDTH_INCHES, 2.0), layout="constrained")
    axes = figure.subplots()
    time = stamps_s - stamps_s[0]
    axes.fill_between(time, errors_m * 100, color=_TRUTH, alpha=0.25, lw=0)
    axes.plot(time, errors_m * 100, color=_TRUTH, lw=1.0)
    axes.set(xlabel="time (s)", ylabel="position error (cm)", ylim=(0, None))
    axes.margins(x=0)
    return _svg(figure, (axes,))


def _svg(figure: Figure, all_axes: Sequence[Axes]) -> str:
    """Return a figure as an ``<svg>`` element with a transparent background."""
    figure.patch.set_alpha(0)
    for axes in all_axes:
        axes.patch.set_alpha(0)
        axes.tick_params(colors=_GREY, labelsize=8)
        axes.xaxis.label.set(color=_GREY, size=9)
        axes.yaxis.label.set(color=_GREY, size=9)
        for side, spine in axes.spines.items():
            spine.set(color=_GREY, visible=side in ("left", "bottom"), lw=0.8)
    text = io.StringIO()
    with rc_context({"svg.hashsalt": "roomgraph", "svg.fonttype": "none"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()[text.getvalue().index("<svg") :]
