"""Stamped camera poses and their text files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.files import write_text


@dataclass(frozen=True, slots=True)
class Trajectory:
    """Camera poses over time.

    Attributes
    ----------
    stamps_s : (N,) float64
        Seconds, rising.
    T_world_camera : (N, 4, 4) float64
        Each maps camera points to the world.
    """

    stamps_s: NDArray[np.float64]
    T_world_camera: NDArray[np.float64]

    def __post_init__(self) -> None:
        if self.T_world_camera.shape != (len(self.stamps_s), 4, 4):
            raise ValueError(
                f"{len(self.stamps_s)} stamps but poses of shape {self.T_world_camera.shape}"
            )

    def __len__(self) -> int:
        return len(self.stamps_s)

    @property
    def positions(self) -> NDArray[np.float64]:
        """Camera centres (N, 3), metres."""
        return self.T_world_camera[:, :3, 3]

    @property
    def length_m(self) -> float:
        """Length of the path, metres."""
        return float(np.linalg.norm(np.diff(self.positions, axis=0), axis=1).sum())

    def nearest(self, stamps_s: NDArray[np.float64], max_difference_s: float) -> NDArray[np.int64]:
        """Return for each of `stamps_s` (M,) the index of the nearest pose in time, or -1."""
        if not len(self):
            return np.full(len(stamps_s), -1)
        after = np.clip(np.searchsorted(self.stamps_s, stamps_s), 1, max(1, len(self) - 1))
        before, after = after - 1, np.minimum(after, len(self) - 1)
        earlier = np.abs(stamps_s - self.stamps_s[before])
        later = np.abs(self.stamps_s[after] - stamps_s)
        index = np.where(earlier <= later, before, after)
        return np.where(np.minimum(earlier, later) < max_difference_s, index, -1).astype(np.int64)


def read_tum(path: Path) -> Trajectory:
    """Read ``timestamp tx ty tz qx qy qz qw`` lines (seconds, metres, xyzw).

    Raises
    ------
    DatasetError
        The file is missing or empty, or a line does not hold eight numbers.
    """
    values = _read_numbers(path, 8)
    order = np.argsort(values[:, 0], kind="stable")
    values = values[order]
    if np.any(np.linalg.norm(values[:, 4:], axis=1) < 0.5):
        raise DatasetError("a quaternion has norm 0", where=path, expected="qx qy qz qw of norm 1")
    return Trajectory(values[:, 0], se3.from_quaternion(values[:, 4:], values[:, 1:4]))


def write_tum(path: Path, trajectory: Trajectory) -> None:
    """Write ``timestamp tx ty tz qx qy qz qw`` lines, through a temporary file."""
    rows = np.column_stack(
        [trajectory.positions, se3.to_quaternion(trajectory.T_world_camera)]
    ) if len(trajectory) else np.empty((0, 7))  # fmt: skip
    lines = ["# timestamp tx ty tz qx qy qz qw"]
    for stamp, row in zip(trajectory.stamps_s, rows, strict=True):
        lines.append(f"{stamp:.6f} " + " ".join(f"{value:.9f}" for value in row))
    write_text(path, "\n".join(lines) + "\n")


def read_kitti(path: Path) -> Trajectory:
    """Read KITTI poses: twelve numbers a line, the rows of T_world_camera; stamps count up."""
    values = _read_numbers(path, 12)
    T = np.tile(np.eye(4), (len(values), 1, 1))
    T[:, :3, :] = values.reshape(-1, 3, 4)
    return Trajectory(np.arange(len(values), dtype=np.float64), T)


def write_kitti(path: Path, trajectory: Trajectory) -> None:
    """Write twelve numbers a line, the rows of T_world_camera (KITTI carries no stamps)."""
    rows = trajectory.T_world_camera[:, :3, :].reshape(-1, 12)
    write_text(path, "".join(" ".join(f"{v:.9e}" for v in row) + "\n" for row in rows))


def _read_numbers(path: Path, columns: int) -> NDArray[np.float64]:
    """Read a table of `columns` numbers a line; ``#`` begins a comment."""
    rows: list[list[float]] = []
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError("trajectory cannot be read", where=path, got=str(error)) from error
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#")[0].replace(",", " ").split()
        if not words:
            continue
        try:
            rows.append([float(word) for word in words])
        except ValueError:
            rows.append([])
        if len(rows[-1]) != columns or not np.all(np.isfinite(rows[-1])):
            raise DatasetError(
                "invalid trajectory line", where=f"{path}:{number}",
                expected=f"{columns} numbers", got=repr(line[:60]),
            )  # fmt: skip
    if not rows:
        raise DatasetError("trajectory holds no poses", where=path)
    return np.array(rows)
