"""The places of a run's report: their table, their pictures, the labels over time."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

import numpy as np
from markupsafe import Markup

from roomgraph.app.answers.explanations import place_reasons
from roomgraph.app.report.charts import label_chart
from roomgraph.app.storage.frames import UNREAD
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.app.storage.thumbnails import read_thumbnails
from roomgraph.datasets.places import PlaceTruth
from roomgraph.semantics.graph.graph import SemanticGraph

# Maximum number of pictures per place: a strip of them fills a wide page.
_PICTURES = 8
_NONE = "\N{EN DASH}"


def place_content(folder: RunFolder, graph: SemanticGraph) -> dict[str, Any]:
    """Return the table of places and their strips of pictures."""
    frames = folder.read_frames()
    start = float(frames[0]["timestamp"]) if frames else 0.0
    pictures = _pictures(graph, read_thumbnails(folder.thumbnails))
    rows = []
    for name in graph.places:
        nodes = [node for node in graph.nodes if node.place == name]
        room = next((e for e in graph.rooms if e.name == name), None)
        doors = {p for door in graph.doorways if name in door.places for p in door.places}
        rows.append({
            "name": name,
            "label": nodes[0].label.replace("_", " ") if nodes[0].label_id else _NONE,
            "colour": _hex(graph, nodes[0].label_id),
            "score": f"{room.score:.0%}" if room and room.score else _NONE,
            "area": f"{room.area_m2:.1f} m²" if room else _NONE,
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
    """Assign keyframe pictures to the place of the node nearest in time; choose some evenly."""
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
            {"frame": frame, "source": data_url(thumbnails[frame], "image/jpeg")}
            for frame in frames
        ]
        for place, frames in chosen.items()
    }


def label_content(
    folder: RunFolder, graph: SemanticGraph, metrics: Mapping[str, Any], truth: PlaceTruth | None
) -> dict[str, Any]:
    """Return the chart of labels over time, a sentence about it, and its legend."""
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
    if metrics.get("place_accuracy_per_frame_online") is not None:
        words = (
            f"{metrics['place_accuracy_per_frame_online']:.1%} of frames correct online, "
            f"{metrics['place_accuracy_per_frame']:.1%} of frames and "
            f"{metrics['place_accuracy']:.1%} of nodes correct at the end; "
            f"{len(metrics['rooms_recovered'])} of {len(metrics['rooms'])} rooms separated."
        )
    names = [name for name in graph.labels.names if name in {*labels, *(true or ())}]
    legend = [
        {"name": name.replace("_", " "), "colour": _hex(graph, graph.labels.id_of(name))}
        for name in names
    ]
    return {"label_chart": Markup(chart), "label_words": words, "legend": legend}


def _hex(graph: SemanticGraph, label_id: int) -> str:
    red, green, blue = graph.labels.colours[label_id]
    return f"#{red:02x}{green:02x}{blue:02x}"


def data_url(data: bytes, kind: str) -> str:
    """Return a file's content as a data URL."""
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"
