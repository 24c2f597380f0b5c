"""The folder of a run: all its file names are defined here."""

from __future__ import annotations

import csv
import json
import shutil
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from roomgraph.app.errors import AppError
from roomgraph.app.storage.input import InputOptions, read_input
from roomgraph.datasets.camera import Camera
from roomgraph.datasets.files import is_working_folder
from roomgraph.datasets.trajectory import Trajectory, read_tum

# Only a folder that holds all of these is a run, and may be overwritten; they are written first.
RUN_MARKS = ("config.toml", "input.toml")
# Metrics that had another name in version 0.1.0.
_RENAMED_METRICS = {"place_accuracy_per_frame_on_the_way": "place_accuracy_per_frame_online"}


@dataclass(frozen=True, slots=True)
class RunFolder:
    """Paths of the files of a run."""

    root: Path

    @property
    def trajectory(self) -> Path:
        """A pose for each tracked frame."""
        return self.root / "trajectory.tum"

    def submap(self, number: int) -> Path:
        """Return the file of the poses of a sub-map that never joined the map, in its own frame."""
        return self.root / f"submap_{number}.tum"

    @property
    def frames(self) -> Path:
        """A row for every input frame."""
        return self.root / "frames.csv"

    @property
    def keyframes(self) -> Path:
        """Optimised keyframe poses."""
        return self.root / "keyframes.tum"

    @property
    def pose_graph(self) -> Path:
        """The optimised pose graph."""
        return self.root / "pose_graph.g2o"

    @property
    def keyframe_database(self) -> Path:
        """The keyframe database, for relocalisation."""
        return self.root / "keyframes.npz"

    @property
    def map(self) -> Path:
        """The labelled, coloured cloud."""
        return self.root / "map.ply"

    @property
    def occupancy(self) -> Path:
        """The occupancy grid for ROS and Nav2, with its picture ``map.pgm`` beside it."""
        return self.root / "map.yaml"

    @property
    def labels(self) -> Path:
        """The label space."""
        return self.root / "labels.json"

    @property
    def graph_json(self) -> Path:
        """The topological graph as node-link JSON."""
        return self.root / "graph.json"

    @property
    def graphml(self) -> Path:
        """The topological graph as GraphML."""
        return self.root / "graph.graphml"

    @property
    def metrics(self) -> Path:
        """Metrics of the run."""
        return self.root / "metrics.json"

    @property
    def thumbnails(self) -> Path:
        """Small pictures of the keyframes."""
        return self.root / "thumbnails.zip"

    @property
    def floor_plan_png(self) -> Path:
        """The floor plan as a picture."""
        return self.root / "floorplan.png"

    @property
    def floor_plan_svg(self) -> Path:
        """The floor plan as a drawing."""
        return self.root / "floorplan.svg"

    @property
    def report(self) -> Path:
        """The report page of the run."""
        return self.root / "report.html"

    @property
    def config(self) -> Path:
        """Resolved settings."""
        return self.root / "config.toml"

    @property
    def input(self) -> Path:
        """The input of the run: the sequence and how it was opened."""
        return self.root / "input.toml"

    @property
    def camera(self) -> Path:
        """The corrected camera; only where a correction was needed."""
        return self.root / "camera.json"

    @property
    def log(self) -> Path:
        """The log file."""
        return self.root / "run.log"

    @property
    def recording(self) -> Path:
        """The Rerun recording."""
        return self.root / "recording.rrd"

    @property
    def model(self) -> Path:
        """The place model that the demonstration trained."""
        return self.root / "model"

    def read_metrics(self) -> dict[str, Any]:
        """Return the run's metrics."""
        try:
            values: dict[str, Any] = json.loads(self.existing(self.metrics).read_text("utf-8"))
        except ValueError as error:
            raise AppError(
                "metrics of the run cannot be read", where=self.metrics, got=str(error)
            ) from error
        if not str(values.get("schema", "")).startswith("roomgraph/metrics/"):
            raise AppError(
                "metrics file of another kind",
                where=self.metrics,
                expected="schema roomgraph/metrics/1",
            )
        return {_RENAMED_METRICS.get(name, name): value for name, value in values.items()}

    def read_input(self) -> InputOptions:
        """Return how the run's sequence was opened."""
        return read_input(self.existing(self.input))

    def read_camera(self) -> Camera | None:
        """Return the camera of the run's sequence, as opened; None if the sequence is gone."""
        source = self.read_input()
        return source.open().camera if source.sequence.is_dir() else None

    def read_trajectory(self) -> Trajectory:
        """Return the poses of the tracked frames."""
        return read_tum(self.existing(self.trajectory))

    def read_frames(self) -> list[dict[str, str]]:
        """Return the rows of frames.csv."""
        with self.existing(self.frames).open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def existing(self, path: Path) -> Path:
        """Return the path of an output.

        Raises
        ------
        AppError
            It is not there.
        """
        if not path.exists():
            raise AppError(
                "not the folder of a finished run", where=self.root,
                expected=path.name, got="no such file",
                hint="create one with: roomgraph run SEQUENCE -o DIR",
            )  # fmt: skip
        return path


def make_run_folder(output: Path | None, name: str, overwrite: bool) -> RunFolder:
    """Make an empty run folder: `output`, or a new one below ``results/<name>/``.

    Raises
    ------
    AppError
        `output` is there already and `overwrite` is not given, or holds something else than a run.
    """
    if output is None:
        parent = Path("results") / name
        root = parent / datetime.now().strftime("%Y-%m-%d_%H-%M-%S-%f")
        root.mkdir(parents=True)
        latest = parent / "latest"
        latest.unlink(missing_ok=True)
        latest.symlink_to(root.name)
        return RunFolder(root)
    clear_output(output, overwrite, RUN_MARKS)
    output.mkdir(parents=True)
    return RunFolder(output)


def clear_output(output: Path, overwrite: bool, marks: tuple[str, ...]) -> None:
    """Clear an output folder; only a folder with all files in `marks` is ever removed.

    Raises
    ------
    AppError
        The folder is there already and `overwrite` is not given, it holds something else, or it is
        the working folder.
    """
    if is_working_folder(output):
        raise AppError(
            "the working folder cannot be replaced", where=output, expected="a folder of its own",
            hint="choose another with -o",
        )  # fmt: skip
    if not output.exists() or (output.is_dir() and not any(output.iterdir())):
        if output.exists():
            output.rmdir()
        return
    if not overwrite:
        raise AppError(
            "output exists already", where=output, expected="a new folder",
            hint="choose another with -o, or give --overwrite",
        )  # fmt: skip
    if output.is_symlink() or not all((output / mark).exists() for mark in marks):
        raise AppError(
            "refusing to overwrite what is not roomgraph output", where=output,
            expected=f"a folder with {' and '.join(marks)}",
            got="other content", hint="choose another with -o",
        )  # fmt: skip
    shutil.rmtree(output)


def refuse_existing(output: Path, overwrite: bool) -> None:
    """Raise if an output file already exists, or its folder does not."""
    if not output.resolve().parent.is_dir():
        raise AppError("no such folder", where=output.parent, expected="an existing folder")
    if output.exists() and not overwrite:
        raise AppError(
            "output exists already", where=output, expected="a new file",
            hint="choose another with -o, or give --overwrite",
        )  # fmt: skip
