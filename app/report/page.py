"""``report.html``: the results of a run on one page that works offline."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from roomgraph.app.report.charts import error_chart
from roomgraph.app.report.floor_plan import draw_floor_plan, save_floor_plan
from roomgraph.app.report.places import label_content, place_content
from roomgraph.app.report.summary import summary_content
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.occupancy import read_occupancy
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.errors import RoomgraphError
from roomgraph.datasets.files import write_text
from roomgraph.datasets.sequence import Sequence as FrameSequence
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.slam.errors import SlamError
from roomgraph.slam.evaluation import compare

# Displayed names of the stages of a run. Some run in parallel threads.
_STAGES = {
    "read": "reading (in parallel)", "features": "features (in parallel)", "track": "tracking",
    "view": "viewer", "sketch": "online map (in parallel)", "label": "labelling",
    "graph": "graph", "map": "point map (in parallel)",
    "floor": "free space", "rooms": "rooms", "write": "writing poses",
    "write graph": "writing graph", "write map": "writing point map",
    "close": "closing the recording",
}  # fmt: skip


def write_report(folder: RunFolder, sequence: FrameSequence | None = None) -> None:
    """Write a finished run's floor plan and report from the files in its folder.

    Parameters
    ----------
    folder : RunFolder
        The run's.
    sequence : Sequence, optional
        The sequence of the run, for its ground truth. Default: it is opened again.
    """
    graph, metrics = read_graph_json(folder.graph_json), folder.read_metrics()
    trajectory = folder.read_trajectory()
    if folder.occupancy.exists():
        figure = draw_floor_plan(graph, read_occupancy(folder.occupancy), trajectory.positions)
        save_floor_plan(figure, folder.floor_plan_png, folder.floor_plan_svg)
    sequence = sequence or _reopened(folder)
    content = {
        **summary_content(folder, graph, metrics),
        **place_content(folder, graph),
        **label_content(folder, graph, metrics, None if sequence is None else sequence.places),
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
    """Open a run's sequence again; None if it is no longer available."""
    try:
        return folder.read_input().open()
    except RoomgraphError:
        return None


def _truth_content(
    metrics: Mapping[str, Any], trajectory: Trajectory, truth: Trajectory | None
) -> dict[str, Any]:
    rows = [
        (words, f"{metrics[key] if is_good else 1 - metrics[key]:.0%}")
        for key, words, is_good in (
            ("place_recall", "rooms found", True),
            ("place_precision", "places that match no room", False),
            ("doorway_recall", "doorways found", True),
            ("doorway_precision", "false doorways", False),
        )
        if metrics.get(key) is not None
    ]
    for room, error in metrics.get("area_error", {}).items():
        if error is not None:
            rows.append((f"area error of {room}", f"{error:+.1%}"))
    content: dict[str, Any] = {"truth_rows": rows, "error_chart": None, "error_words": ""}
    if truth is None:
        return content
    try:
        error = compare(trajectory, truth)
    except SlamError:
        return content
    words = (
        f"Position error (ATE): {error.ate_rmse_m * 100:.2f} cm RMSE, "
        f"maximum {error.ate_max_m * 100:.1f} cm. Error between successive frames (RPE): "
        f"{error.rpe_trans_rmse_m * 100:.2f} cm and {error.rpe_rot_rmse_deg:.2f}°."
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
    """Return dotted names and values of the settings in TOML that differ from their defaults."""
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
