"""The head of a run's report: its results in figures and a sentence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roomgraph.app.errors import AppError
from roomgraph.app.report.places import data_url
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.floor_plan import FILE_NAME
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import UNKNOWN


def summary_content(
    folder: RunFolder, graph: SemanticGraph, metrics: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the page's title, figures, warnings and floor plan."""
    name = Path(metrics["sequence"]).name
    area = sum(room.area_m2 for room in graph.rooms)
    share = metrics["frames_tracked"] / max(1, metrics["frames"])
    figures = [
        (str(len(graph.rooms)), "place" if len(graph.rooms) == 1 else "places"),
        (f"{area:.0f} m²", "floor"),
        (f"{metrics['path_length_m']:.1f} m", "walked"),
        (f"{share:.0%}", f"of {metrics['frames']} frames tracked"),
        (str(metrics["loop_closures"]), "loop closures"),
        (f"{metrics['fps']:.1f}", "frames per second"),
    ]
    if "ate_rmse_m" in metrics:
        figures.append((f"{metrics['ate_rmse_m'] * 100:.1f} cm", "trajectory error (ATE)"))
    if metrics.get("place_accuracy") is not None:
        figures.append((f"{metrics['place_accuracy']:.0%}", "of nodes labelled correctly"))
    return {
        "name": name,
        "found": found_words(graph, metrics),
        "summary": f"{metrics['sequence']}: {metrics['frames']} frames, "
        f"{metrics['keyframes']} keyframes, {metrics['map_points']:,} map points, "
        f"{metrics['graph_nodes']} graph nodes; mapped in {metrics['seconds_total']:.0f} s.",
        "truth": _truth_words(metrics),
        "figures": figures,
        "warnings": _warnings(graph, metrics),
        "labelled": len(graph.labels) > 1,
        "floor_plan": _picture(folder.floor_plan_png, "image/png"),
        "plan_words": ", ".join(f"{e.name} {e.area_m2:.1f} m²" for e in graph.rooms)
        or "no rooms found",
    }


def found_words(graph: SemanticGraph, metrics: Mapping[str, Any]) -> str:
    """Return a sentence about the places found; empty if there are none."""
    kinds = Counter(e.label.replace("_", " ") for e in graph.rooms if e.label != UNKNOWN)
    unnamed = len(graph.rooms) - kinds.total()
    parts = [_counted(count, kind) for kind, count in kinds.most_common()]
    if unnamed:
        parts.append(f"{_counted(unnamed, 'room')} without a label")
    if not parts:
        return ""
    doors = len(graph.doorways)
    return f"A walk of {metrics['path_length_m']:.0f} m through {', '.join(parts)}" + (
        f", joined by {_counted(doors, 'doorway')}." if doors else "."
    )


def _truth_words(metrics: Mapping[str, Any]) -> str:
    """Return what the errors are measured against; empty if there is no ground truth."""
    if "ate_rmse_m" not in metrics:
        return ""
    if (Path(metrics["sequence"]) / FILE_NAME).is_file():
        return (
            "A rendered building: errors are measured against its true path and rooms. "
            "Errors of a real camera are larger."
        )
    return "Errors are measured against the ground-truth path of the sequence."


def _counted(count: int, kind: str) -> str:
    if count > 1:
        return f"{count} {kind}s"
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _warnings(graph: SemanticGraph, metrics: Mapping[str, Any]) -> list[str]:
    found = [str(warning) for warning in metrics.get("warnings", ())]
    lost = metrics["frames_lost"] + metrics["frames_skipped"]
    if lost:
        found.append(
            f"{metrics['frames_lost']} frames were lost and {metrics['frames_skipped']} skipped; "
            "these have no pose"
        )
    if len(graph.labels) <= 1:
        found.append(
            "places are not labelled: no place model was given (train one with `roomgraph train`)"
        )
    elif graph.nodes and not any(node.label_id for node in graph.nodes):
        found.append(
            f"no place was recognised by the model, which knows {', '.join(graph.labels.names[1:])}"
        )
    return found


def _picture(path: Path, kind: str) -> str | None:
    try:
        return data_url(path.read_bytes(), kind) if path.exists() else None
    except OSError as error:
        raise AppError("picture cannot be read", where=path, got=str(error)) from error
