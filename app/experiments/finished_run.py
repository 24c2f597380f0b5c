"""Results of a complete run along a route, with rooms and loop closures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from roomgraph.app.console import Terminal
from roomgraph.app.run.session import OutputOptions, map_sequence
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.run_folder import make_run_folder
from roomgraph.datasets.errors import RoomgraphError
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.semantics.evaluation.splits import SplitResult
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.semantics.recognition.model import PlaceModel

FINISHED, FINISHED_FRAMES = "nodes, finished run", "frames, finished run"


@dataclass(frozen=True, slots=True)
class FinishedRun:
    """Labels of a run's nodes and frames, its number of rooms, and of separated rooms."""

    nodes: SplitResult
    frames: SplitResult
    rooms: int
    told_apart: int


def finished_run(
    model: PlaceModel, root: Path, settings: AppSettings, terminal: Terminal
) -> FinishedRun:
    """Map and label a sequence like ``roomgraph run``, and compare it with the ground truth.

    Raises
    ------
    RoomgraphError
        The sequence cannot be mapped (no depth), or does not say which rooms it shows.
    """
    sequence = open_sequence(root)
    places = sequence.places
    if places is None:
        raise RoomgraphError("the sequence has no room labels", where=root)
    with TemporaryDirectory() as scratch:
        folder = make_run_folder(Path(scratch) / "run", sequence.name, overwrite=False)
        nothing = OutputOptions(live=False, save=False, report=False)
        metrics = map_sequence(
            sequence, settings, model=model, folder=folder, outputs=nothing, terminal=terminal
        )
        graph, rows = read_graph_json(folder.graph_json), folder.read_frames()
    nodes = [(places.at(node.stamp_s), node.label) for node in graph.nodes]
    frames = [(places.at(float(row["timestamp"])), row["label"]) for row in rows]
    return FinishedRun(
        _result(FINISHED, nodes), _result(FINISHED_FRAMES, frames),
        len(metrics["rooms"]), len(metrics["rooms_recovered"]),
    )  # fmt: skip


def _result(row: str, pairs: Sequence[tuple[tuple[str, str] | None, str]]) -> SplitResult:
    """Return the result for items in known rooms: true label and instance, predicted label."""
    known = [(truth[0], label) for truth, label in pairs if truth is not None]
    return SplitResult(
        row, np.array([truth for truth, _ in known]), np.array([x for _, x in known])
    )
