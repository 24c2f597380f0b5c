"""Benchmark results: a table, and a plot of time and memory over the run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from roomgraph.app.bench.worker import BenchRun
from roomgraph.datasets.files import replacing

Summary = Mapping[str, Any]


def _ate(summary: Summary) -> str:
    return f"{summary['ate_rmse_m'] * 100:.2f} cm" if "ate_rmse_m" in summary else "-"


def _rpe(summary: Summary) -> str:
    if "rpe_trans_rmse_m" not in summary:
        return "-"
    return f"{summary['rpe_trans_rmse_m'] * 100:.2f} cm, {summary['rpe_rot_rmse_deg']:.3f}°"


def _same(summary: Summary) -> str:
    known = {True: "yes", False: "no", None: "- (one repeat)"}
    return known[summary["deterministic"]]


def _times(summary: Summary, key: str) -> str:
    return f"{summary[key]['median']:.1f}, {summary[key]['p95']:.1f}"


def _growth(summary: Summary, key: str) -> str:
    figures = summary[key]
    first, last = figures["first_tenth"], figures["last_tenth"]
    return f"{first:.1f}, {last:.1f} (x {figures['growth']:.2f})"


ROWS: tuple[tuple[str, Callable[[Summary], str]], ...] = (
    ("frames", lambda s: f"{s['frames']}, {s['repeats']} x"),
    ("labelling", lambda s: "on" if s["model"] else "off"),
    ("frames/s", lambda s: f"{s['fps']:.1f}"),
    ("frame, ms (median, p95)", lambda s: _times(s, "frame_ms")),
    ("  first, last tenth", lambda s: _growth(s, "frame_ms")),
    ("  CPU time", lambda s: _times(s, "frame_cpu_ms")),
    ("  first, last tenth", lambda s: _growth(s, "frame_cpu_ms")),
    ("total CPU time", lambda s: f"{s['cpu_ms_per_frame']:.1f} ms per frame"),
    ("peak memory", lambda s: f"{s['peak_rss_mb']:.0f} MB"),
    ("  first, last tenth", lambda s: _growth(s, "memory_mb")),
    ("ATE", _ate),
    ("RPE per frame", _rpe),
    ("frames not tracked", lambda s: f"{s['share_lost']:.1%}"),
    ("identical trajectories", _same),
)

_LEGEND = (
    "frame: features and tracking; first, last tenth: medians over these parts of the sequence; "
    "stages run in parallel, so their times do not add up to the time of a frame"
)


def table(summaries: Sequence[Summary], cost: Mapping[str, float]) -> Table:
    """Return a table with a column for each sequence: its results and the times of its stages."""
    names = (str(s["sequence"]) for s in summaries)
    shown = Table("", *names, box=None, padding=(0, 2, 0, 0), caption=_LEGEND)
    shown.caption_justify = "left"
    for title, cell in ROWS:
        shown.add_row(title, *(cell(s) for s in summaries))
    if cost:
        costs = [f"{cost[s['sequence']]:+.1%}" if s["model"] else "" for s in summaries]
        shown.add_row("cost of labelling", *costs)
    shown.add_row()
    shown.add_row("stages, ms (median, p95)", style="dim")
    stages = dict.fromkeys(stage for s in summaries for stage in s["stage_ms"])
    for stage in stages:
        shown.add_row(f"  {stage}", *(_stage(s["stage_ms"].get(stage)) for s in summaries))
    return shown


def draw(path: Path, runs: Sequence[BenchRun]) -> None:
    """Plot frame time and memory over the frame number, a line for each repeat."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 6), layout="constrained")
    times, memory = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    for number, run in enumerate(runs, 1):
        frames = np.arange(len(run.frame_ms))
        label = f"repeat {number}" if len(runs) > 1 else None
        times.plot(frames, run.frame_ms, ".", ms=2, alpha=0.35, color=f"C{number - 1}")
        smooth = _running_median(np.array(run.frame_ms))
        times.plot(frames, smooth, color=f"C{number - 1}", label=label)
        memory.plot(run.memory_mb, color=f"C{number - 1}")
    # A few hiccups of the machine must not squeeze everything else.
    top = 1.3 * max(float(np.percentile(run.frame_ms, 99)) for run in runs)
    times.set(
        ylabel="features + tracking (ms)", ylim=(0, top),
        title=f"{runs[0].name}: time (with running median) and memory per frame",
    )  # fmt: skip
    memory.set(ylabel="resident memory (MB)", ylim=(0, None), xlabel="frame")
    if len(runs) > 1:
        times.legend(frameon=False)
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=120)


def _stage(figures: Mapping[str, float] | None) -> str:
    return f"{figures['median']:.1f}, {figures['p95']:.1f}" if figures is not None else "-"


def _running_median(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the running median of values, over a window of a fortieth of them."""
    from scipy.ndimage import median_filter

    return np.asarray(median_filter(values, max(3, len(values) // 40), mode="nearest"))
