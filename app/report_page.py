"""``report.html``: what a run found, on one page that opens without a network."""

from __future__ import annotations

import base64
import tomllib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from app.charts import error_chart, label_chart
from app.config import AppSettings
from app.errors import AppError
from app.floorplan import draw_floor_plan, save_floor_plan
from app.occupancy_io import read_occupancy
from app.report_evidence import place_reasons
from app.run_folder import UNREAD, RunFolder
from app.thumbnails import read_thumbnails
from datasets.errors import RoomgraphError
from datasets.files import write_text
from datasets.places import PlaceTruth
from datasets.sequence import Sequence as FrameSequence
from datasets.trajectory import Trajectory
from semantics.graph import SemanticGraph
from semantics.graph_io import read_graph_json
from semantics.labels import UNKNOWN
from slam.errors import SlamError
from slam.evaluation import compare

# Of a place, pictures shown at most: a strip of them fills a wide page.
_PICTURES = 8
# What the stages of a run are called. The first two run in a thread, ahead of the others.
_STAGES = {
    "read": "reading images (beside)", "features": "features (beside)", "track": "tracking",
    "view": "showing and recording", "label": "labelling", "graph": "graph", "map": "final map",
    "survey": "floor and free space", "extents": "rooms and doorways", "write": "writing files",
    "close": "ending the recording",
}  # fmt: skip
_NONE = "\N{EN DASH}"


def write_report(folder: RunFolder, sequence: FrameSequence | None = None) -> None:
    """Write a finished run's floor plan and report from the files in its folder.

    Parameters
    ----------
    folder : RunFolder
        The run's.
    sequence : Sequence, optional
        What it was made from, for the truth; else it is opened as it was for the run.
    """
    graph, metrics = read_graph_json(folder.graph_json), folder.read_metrics()
    trajectory = folder.read_trajectory()
    if folder.occupancy.exists():
        figure = draw_floor_plan(graph, read_occupancy(folder.occupancy), trajectory.positions)
        save_floor_plan(figure, folder.floor_plan_png, folder.floor_plan_svg)
    sequence = sequence or _reopened(folder)
    content = {
        **_head(folder, graph, metrics),
        **_place_content(folder, graph),
        **_label_content(folder, graph, metrics, None if sequence is None else sequence.places),
        **_truth_content(
            metrics, trajectory, None if sequence is None else sequence.ground_truth
        ),
        "stages": _stages(metrics),
        "settings": (settings := folder.config.read_text(encoding="utf-8")),
        "changed": _changed(settings),
        "files": ", ".join(sorted(path.name for path in folder.root.iterdir())),
    }  # fmt: skip
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"), autoescape=True,
        undefined=StrictUndefined, trim_blocks=True,
    )  # fmt: skip
    write_text(folder.report, environment.get_template("report.html.j2").render(content))


def _reopened(folder: RunFolder) -> FrameSequence | None:
    """Open a run's sequence again; None where it is no longer to be had."""
    try:
        return folder.read_input().open()
    except RoomgraphError:
        return None


def _head(folder: RunFolder, graph: SemanticGraph, metrics: Mapping[str, Any]) -> dict[str, Any]:
    name = Path(metrics["sequence"]).name
    area = sum(extent.area_m2 for extent in graph.extents)
    share = metrics["frames_tracked"] / max(1, metrics["frames"])
    figures = [
        (str(len(graph.extents)), "places"),
        (f"{area:.0f} m²", "floor"),
        (f"{metrics['path_length_m']:.1f} m", "walked"),
        (f"{share:.0%}", f"of {metrics['frames']} frames tracked"),
        (str(metrics["loop_closures"]), "loops closed"),
        (f"{metrics['fps']:.1f}", "frames a second"),
    ]
    if "ate_rmse_m" in metrics:
        figures.append((f"{metrics['ate_rmse_m'] * 100:.1f} cm", "trajectory error (ATE)"))
    if metrics.get("place_accuracy") is not None:
        figures.append((f"{metrics['place_accuracy']:.0%}", "of nodes labelled rightly"))
    return {
        "name": name,
        "found": found_words(graph, metrics),
        "summary": f"{metrics['sequence']}: {metrics['frames']} frames, "
        f"{metrics['keyframes']} keyframes, {metrics['map_points']:,} map points, "
        f"{metrics['graph_nodes']} graph nodes; mapped in {metrics['seconds_total']:.0f} s.",
        "figures": figures,
        "warnings": _warnings(graph, metrics),
        "floor_plan": _data_url(folder.floor_plan_png, "image/png"),
        "plan_words": ", ".join(f"{e.name} {e.area_m2:.1f} m²" for e in graph.extents)
        or "no rooms found",
    }


def found_words(graph: SemanticGraph, metrics: Mapping[str, Any]) -> str:
    """Return in a sentence what a run found; nothing if that is no place."""
    kinds = Counter(e.label.replace("_", " ") for e in graph.extents if e.label != UNKNOWN)
    unnamed = len(graph.extents) - kinds.total()
    parts = [_counted(count, kind) for kind, count in kinds.most_common()]
    if unnamed:
        parts.append(f"{_counted(unnamed, 'room')} without a label")
    if not parts:
        return ""
    doors = len(graph.doorways)
    return f"A walk of {metrics['path_length_m']:.0f} m through {', '.join(parts)}" + (
        f", joined by {_counted(doors, 'doorway')}." if doors else "."
    )


def _counted(count: int, kind: str) -> str:
    if count > 1:
        return f"{count} {kind}s"
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _warnings(graph: SemanticGraph, metrics: Mapping[str, Any]) -> list[str]:
    found = [str(warning) for warning in metrics.get("warnings", ())]
    lost = metrics["frames_lost"] + metrics["frames_skipped"]
    if lost:
        found.append(
            f"{metrics['frames_lost']} frames were lost and {metrics['frames_skipped']} skipped: "
            "they have no pose"
        )
    if len(graph.labels) <= 1:
        found.append(
            "places are not labelled: no place model was given (`roomgraph train` makes one)"
        )
    elif graph.nodes and not any(node.label_id for node in graph.nodes):
        found.append(
            f"no place looks like what the model knows: {', '.join(graph.labels.names[1:])}"
        )
    return found


def _place_content(folder: RunFolder, graph: SemanticGraph) -> dict[str, Any]:
    """Return the table of places and their strips of pictures."""
    frames = folder.read_frames()
    start = float(frames[0]["timestamp"]) if frames else 0.0
    pictures = _pictures(graph, read_thumbnails(folder.thumbnails))
    rows = []
    for name in graph.places:
        nodes = [node for node in graph.nodes if node.place == name]
        extent = next((e for e in graph.extents if e.name == name), None)
        doors = {p for door in graph.doorways if name in door.places for p in door.places}
        rows.append({
            "name": name,
            "label": nodes[0].label.replace("_", " "),
            "colour": _hex(graph, nodes[0].label_id),
            "score": f"{extent.score:.0%}" if extent and extent.score else _NONE,
            "area": f"{extent.area_m2:.1f} m²" if extent else _NONE,
            "first": f"{nodes[0].stamp_s - start:.1f} s",
            "last": f"{nodes[-1].stamp_s - start:.1f} s",
            "nodes": len(nodes),
            "doors": ", ".join(p for p in graph.places if p in doors - {name}) or _NONE,
            "pictures": pictures.get(name, []),
        })  # fmt: skip
    return {
        "places": rows,
        "strips": any(row["pictures"] for row in rows),
        "reasons": place_reasons(graph),
    }


def _pictures(
    graph: SemanticGraph, thumbnails: Mapping[int, bytes]
) -> dict[str, list[dict[str, Any]]]:
    """Share the keyframes' pictures out to the places of the nodes next in time, evenly chosen."""
    if not graph.nodes:
        return {}
    at = np.array([node.frame for node in graph.nodes])
    by_place: dict[str, list[int]] = {}
    for frame in sorted(thumbnails):
        place = graph.nodes[int(np.abs(at - frame).argmin())].place
        by_place.setdefault(place, []).append(frame)
    chosen = {
        place: [
            frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, _PICTURES).astype(int))
        ]
        for place, frames in by_place.items()
    }
    return {
        place: [
            {"frame": frame, "source": _url(thumbnails[frame], "image/jpeg")} for frame in frames
        ]
        for place, frames in chosen.items()
    }


def _label_content(
    folder: RunFolder, graph: SemanticGraph, metrics: Mapping[str, Any], truth: PlaceTruth | None
) -> dict[str, Any]:
    rows = [row for row in folder.read_frames() if row["method"] != UNREAD]
    if len(graph.labels) <= 1 or not rows:
        return {"label_chart": None, "label_words": "", "legend": []}
    stamps = np.array([float(row["timestamp"]) for row in rows])
    labels = [row["label"] for row in rows]
    true = None
    if truth is not None:
        found = [truth.at(float(stamp)) for stamp in stamps]
        true = ["" if place is None else place[0] for place in found]
    chart = label_chart(
        stamps, labels, np.array([float(row["score"]) for row in rows]), true, graph.labels
    )
    words = ""
    if metrics.get("place_accuracy_per_frame") is not None:
        words = (
            f"{metrics['place_accuracy_per_frame']:.1%} of frames right on the way, "
            f"{metrics['place_accuracy']:.1%} of nodes once the rooms were known; "
            f"{len(metrics['rooms_recovered'])} of {len(metrics['rooms'])} rooms told apart."
        )
    names = [name for name in graph.labels.names if name in {*labels, *(true or ())}]
    legend = [
        {"name": name.replace("_", " "), "colour": _hex(graph, graph.labels.id_of(name))}
        for name in names
    ]
    return {"label_chart": Markup(chart), "label_words": words, "legend": legend}


def _truth_content(
    metrics: Mapping[str, Any], trajectory: Trajectory, truth: Trajectory | None
) -> dict[str, Any]:
    rows = []
    for key, words in (
        ("place_precision", "places that are rooms"), ("place_recall", "rooms found"),
        ("doorway_precision", "doorways that are there"), ("doorway_recall", "doorways found"),
    ):  # fmt: skip
        if metrics.get(key) is not None:
            rows.append((words, f"{metrics[key]:.0%}"))
    for room, error in metrics.get("area_error", {}).items():
        if error is not None:
            rows.append((f"area of {room} off by", f"{error:+.1%}"))
    content: dict[str, Any] = {"truth_rows": rows, "error_chart": None, "error_words": ""}
    if truth is None:
        return content
    try:
        error = compare(trajectory, truth)
    except SlamError:
        return content
    words = (
        f"ATE {error.ate_rmse_m * 100:.2f} cm (root mean square), {error.ate_max_m * 100:.1f} cm "
        f"at most; RPE {error.rpe_trans_rmse_m * 100:.2f} cm and {error.rpe_rot_rmse_deg:.2f}° "
        "a frame."
    )
    chart = error_chart(error.stamps_s, error.errors_m)
    return content | {"error_chart": Markup(chart), "error_words": words}


def _stages(metrics: Mapping[str, Any]) -> list[dict[str, str]]:
    seconds = max(float(metrics["seconds_total"]), 1e-3)
    return [
        {
            "name": _STAGES.get(name, name),
            "median": f"{stage['median']:.1f}", "p95": f"{stage['p95']:.1f}",
            "total": f"{stage['total'] / 1000:.1f}",
            "percent": f"{min(100.0, stage['total'] / 10 / seconds):.1f}",
        }
        for name, stage in metrics["stage_ms"].items()
    ]  # fmt: skip


def _changed(text: str) -> list[tuple[str, str]]:
    """Return dotted names and values of the settings in TOML that are not as by default."""
    usual = _flat(AppSettings().model_dump(mode="json", exclude_none=True))
    return [
        (name, str(value))
        for name, value in _flat(tomllib.loads(text)).items()
        if usual.get(name) != value
    ]


def _flat(values: Mapping[str, Any], table: str = "") -> dict[str, Any]:
    """Return nested settings under their dotted names."""
    flat: dict[str, Any] = {}
    for name, value in values.items():
        if isinstance(value, Mapping):
            flat |= _flat(value, f"{table}{name}.")
        else:
            flat[f"{table}{name}"] = value
    return flat


def _hex(graph: SemanticGraph, label_id: int) -> str:
    red, green, blue = graph.labels.colours[label_id]
    return f"#{red:02x}{green:02x}{blue:02x}"


def _data_url(path: Path, kind: str) -> str | None:
    try:
        return _url(path.read_bytes(), kind) if path.exists() else None
    except OSError as error:
        raise AppError("picture cannot be read", where=path, got=str(error)) from error


def _url(data: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"
