"""Tables of a run's results for the terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rich.table import Table

from roomgraph.semantics.graph.graph import UNLABELLED
from roomgraph.semantics.labels import UNKNOWN


def summary(metrics: Mapping[str, Any]) -> Table:
    """Return a table of a run's results and their accuracy."""
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="dim")
    table.add_column()
    frames = f"{metrics['frames_tracked']} of {metrics['frames']} tracked"
    if metrics["frames_lost"] or metrics["frames_skipped"]:
        frames += f", {metrics['frames_lost']} lost, {metrics['frames_skipped']} skipped"
    table.add_row("frames", frames)
    table.add_row(
        "speed", f"{metrics['fps']:.1f} frames/s, mapped in {metrics['seconds_total']:.1f} s"
    )
    table.add_row(
        "path", f"{metrics['path_length_m']:.1f} m, {metrics['keyframes']} keyframes, "
        f"{metrics['loop_closures']} loop closures",
    )  # fmt: skip
    table.add_row("map", f"{metrics['map_points']:,} points")
    table.add_row("graph", f"{metrics['graph_nodes']} nodes, {metrics['graph_edges']} edges")
    table.add_row("places", _places(metrics))
    for row in _truth_rows(metrics):
        table.add_row(*row)
    return table


def _places(metrics: Mapping[str, Any]) -> str:
    places, labels = metrics["places"], metrics.get("labels", ())
    why = "not labelled (no place model given: --model)"
    if labels:
        why = f"none recognised by the model, which knows {', '.join(labels)}"
    found = set(places) - {UNKNOWN}
    if not found:
        return why
    if all(place.removeprefix(UNLABELLED).isdigit() for place in found):
        return f"{len(found)}, {why}"
    return ", ".join(places)


def against_truth(metrics: Mapping[str, Any]) -> Table:
    """Return a table that compares a run with the ground truth."""
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    table.add_column(style="dim")
    table.add_column()
    for row in _truth_rows(metrics):
        table.add_row(*row)
    return table


def _truth_rows(metrics: Mapping[str, Any]) -> list[tuple[str, str]]:
    rows = []
    if "ate_rmse_m" in metrics:
        rows.append(("ATE", f"{metrics['ate_rmse_m'] * 100:.2f} cm (RMSE)"))
        rows.append((
            "RPE", f"{metrics['rpe_trans_rmse_m'] * 100:.2f} cm, "
            f"{metrics['rpe_rot_rmse_deg']:.3f}° per frame",
        ))  # fmt: skip
    if metrics.get("place_accuracy") is not None:
        rows.append((
            "correct labels", f"{metrics['place_accuracy']:.1%} of nodes, "
            f"{metrics['place_accuracy_per_frame']:.1%} of frames",
        ))  # fmt: skip
        for name, accuracy in metrics["place_accuracy_by_label"].items():
            if accuracy is not None:
                rows.append((f"  {name}", f"{accuracy:.1%} of frames"))
        rows.append((
            "separated rooms", f"{len(metrics['rooms_recovered'])} of {len(metrics['rooms'])} "
            f"({', '.join(metrics['rooms_recovered'])})",
        ))  # fmt: skip
    return rows
