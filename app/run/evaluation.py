"""Comparison of a finished run with the ground truth."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roomgraph.app.errors import AppError
from roomgraph.app.run.metrics import place_metrics, topology_metrics, trajectory_metrics
from roomgraph.app.storage.frames import UNREAD
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.files import replacing
from roomgraph.datasets.floor_plan import FILE_NAME, read_floor_plan
from roomgraph.datasets.places import PlaceTruth, read_places
from roomgraph.datasets.trajectory import Trajectory, read_tum
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.slam.evaluation import compare


@dataclass(frozen=True, slots=True)
class RunEvaluation:
    """A run's trajectory, the true one if known, and the metrics."""

    estimate: Trajectory
    truth: Trajectory | None
    metrics: dict[str, Any]


def evaluate_run(
    folder: RunFolder, groundtruth: Path | None = None, places: Path | None = None
) -> RunEvaluation:
    """Compare a run with ground-truth files, or with the ground truth of its sequence.

    Raises
    ------
    AppError
        The folder is no run's, or no truth is to be found.
    """
    estimate = folder.read_trajectory()
    truth, rooms = _truth(folder, groundtruth, places)
    found: dict[str, Any] = {}
    if truth is not None:
        found |= trajectory_metrics(estimate, truth)
    graph = read_graph_json(folder.graph_json)
    if rooms is not None and len(graph.labels) > 1:
        rows = [row for row in folder.read_frames() if row["method"] != UNREAD]
        frames = [(float(row["timestamp"]), row["label"]) for row in rows]
        found |= place_metrics(graph, frames, rooms)
        plan = folder.read_input().sequence / FILE_NAME
        if places is None and plan.is_file():
            found |= topology_metrics(graph, read_floor_plan(plan), found["rooms_matched"])
    if not found:
        raise AppError(
            "no ground truth to compare with", where=folder.root,
            expected="ground-truth poses or labels at the run's time stamps",
            hint="give them with --groundtruth FILE or --places FILE",
        )  # fmt: skip
    return RunEvaluation(estimate, truth, found)


def draw(path: Path, found: RunEvaluation) -> None:
    """Plot both paths, seen from above the first camera, and the error over time."""
    from matplotlib.figure import Figure

    if found.truth is None:
        raise AppError("nothing to plot", where=path, expected="ground-truth poses")
    if path.suffix not in (".png", ".pdf", ".svg"):
        raise AppError("unknown image format", where=path, expected=".png, .pdf or .svg")
    error = compare(found.estimate, found.truth)
    figure = Figure(figsize=(10, 4.5), layout="constrained")
    paths, times = figure.subplots(1, 2)
    true_positions = found.truth.positions
    aligned = se3.transform(error.T_truth_estimate, found.estimate.positions)
    # The two directions in which the camera moved most.
    across = sorted(range(3), key=lambda axis: -float(true_positions[:, axis].std()))[:2]
    x, y = sorted(across)
    paths.plot(*true_positions[:, [x, y]].T, color="0.6", lw=3, label="truth")
    paths.plot(*aligned[:, [x, y]].T, color="tab:blue", label="estimate")
    paths.set(aspect="equal", xlabel=f"{'xyz'[x]} (m)", ylabel=f"{'xyz'[y]} (m)")
    paths.legend(frameon=False)
    times.plot(error.stamps_s - error.stamps_s[0], error.errors_m * 100, color="tab:red")
    times.set(
        xlabel="time (s)", ylabel="position error (cm)", ylim=(0, None),
        title=f"ATE {error.ate_rmse_m * 100:.2f} cm",
    )  # fmt: skip
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=120)


def _truth(
    folder: RunFolder, groundtruth: Path | None, places: Path | None
) -> tuple[Trajectory | None, PlaceTruth | None]:
    trajectory = read_tum(groundtruth) if groundtruth else None
    rooms = read_places(places) if places else None
    if trajectory is None and rooms is None:
        source = folder.read_input()
        if source.sequence.is_dir():
            sequence = source.open()
            return sequence.ground_truth, sequence.places
    return trajectory, rooms
