"""The camera's path and the pose graph in other formats."""

from __future__ import annotations

import csv
import io
import shutil
from itertools import groupby
from pathlib import Path

import numpy as np

from roomgraph.app.export.exporter import Notes, product
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3, trajectory
from roomgraph.datasets.files import replacing, write_text

_POSE_COLUMNS = ("tx", "ty", "tz", "qx", "qy", "qz", "qw")
# Stamps in frames.csv and trajectory.tum are rounded to microseconds alike.
_SAME_STAMP_S = 1e-6


def write_tum(folder: RunFolder, path: Path) -> Notes:
    """Copy the run's trajectory."""
    copy(product(folder.trajectory), path)
    return ()


def write_g2o(folder: RunFolder, path: Path) -> Notes:
    """Copy the run's pose graph."""
    copy(product(folder.pose_graph), path)
    return ()


def write_kitti(folder: RunFolder, path: Path) -> Notes:
    """Write a line for each frame with a pose and, beside it, which frame each line is.

    KITTI's files have neither stamps nor gaps, so readers take line i for frame i: where frames
    have no pose, the table beside says so, and so do the notes.
    """
    trajectory.write_kitti(path, folder.read_trajectory())
    frames = _frames(folder)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("frame", "timestamp", "line"))
    line = 0
    for index, (row, has_pose) in enumerate(frames):
        writer.writerow((index, row["timestamp"], line if has_pose else ""))
        line += has_pose
    (table,) = frames_beside(path)
    write_text(table, text.getvalue())
    without = [index for index, (_, has_pose) in enumerate(frames) if not has_pose]
    if not without:
        return ()
    return (
        f"{len(without)} of {len(frames)} frames have no pose and no line: {_ranges(without)}; "
        f"{table.name} gives the line of each frame",
    )


def frames_beside(path: Path) -> tuple[Path, ...]:
    """Return the table of frames that comes with KITTI poses."""
    return (path.with_name(f"{path.stem}_frames.csv"),)


def write_csv(folder: RunFolder, path: Path) -> Notes:
    """Write a row for every input frame; pose columns are empty where there is none."""
    track = folder.read_trajectory()
    rows = np.column_stack([track.positions, se3.to_quaternion(track.T_world_camera)])
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("timestamp", "state", *_POSE_COLUMNS, "label", "score"))
    following = iter(rows)
    for row, has_pose in _frames(folder):
        pose = [f"{v:.9f}" for v in next(following)] if has_pose else [""] * len(_POSE_COLUMNS)
        writer.writerow((row["timestamp"], row["state"], *pose, row["label"], row["score"]))
    write_text(path, text.getvalue())
    return ()


def copy(source: Path, path: Path) -> None:
    """Copy a file through a temporary name."""
    with replacing(path) as temporary:
        shutil.copyfile(source, temporary)


def _frames(folder: RunFolder) -> list[tuple[dict[str, str], bool]]:
    """Return the row of each input frame, and whether the trajectory has a pose for it."""
    stamps = folder.read_trajectory().stamps_s
    frames = []
    for row in folder.read_frames():
        stamp = float(row["timestamp"])
        nearest = min(int(np.searchsorted(stamps, stamp - _SAME_STAMP_S)), len(stamps) - 1)
        frames.append((row, bool(abs(stamps[nearest] - stamp) <= _SAME_STAMP_S)))
    return frames


def _ranges(numbers: list[int]) -> str:
    """Write rising numbers as ``3-7, 12``."""
    runs = [
        [number for _, number in group]
        for _, group in groupby(enumerate(numbers), key=lambda item: item[1] - item[0])
    ]
    return ", ".join(str(r[0]) if len(r) == 1 else f"{r[0]}-{r[-1]}" for r in runs)
