"""A sequence played forward and backward, again and again."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Camera
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.sequence import Selection, Sequence, frames_of
from roomgraph.datasets.trajectory import Trajectory

# A true pose this near in time is a frame's own (as where trajectories are compared).
MAX_DIFFERENCE_S = 0.01


class PingPongReplay:
    """A sequence followed by itself reversed, `laps` times: a long run that sees nothing new.

    Time goes on: the way back takes as long as the way there. True poses are repeated;
    true labels are left out. See `datasets.sequence.Sequence` for the attributes.

    Parameters
    ----------
    source : Sequence
        What is played.
    laps : int
        How often there and back; at least 1.
    """

    def __init__(self, source: Sequence, laps: int) -> None:
        self._source, self._laps = source, laps
        there = np.arange(len(source))
        lap = np.concatenate([there, there[-2:0:-1]])
        indices = np.tile(lap, laps)
        self._stamps_s = _running(source.stamps_s[indices])
        self._frames = Selection(
            source, tuple(int(i) for i in indices), name=source.name, root=source.root,
            camera=source.camera, ground_truth=None, places=None, notes=source.notes,
        )  # fmt: skip
        self.ground_truth = _repeated(source, indices, self._stamps_s)
        self.places = None
        self.name, self.root, self.camera = source.name, source.root, source.camera
        self.notes = source.notes

    @property
    def stamps_s(self) -> NDArray[np.float64]:
        """Time stamps of all frames (N,), seconds."""
        return self._stamps_s

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, index: int) -> Frame:
        return replace(self._frames[index], stamp_s=float(self._stamps_s[index]))

    def __iter__(self) -> Iterator[Frame]:
        return frames_of(self)

    def with_camera(self, camera: Camera) -> PingPongReplay:
        """Return the same laps, taken by another camera."""
        return PingPongReplay(self._source.with_camera(camera), self._laps)

    def with_notes(self, *notes: str) -> PingPongReplay:
        """Return the same laps, with more notes."""
        return PingPongReplay(self._source.with_notes(*notes), self._laps)


def _running(stamps_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn stamps (N,) that run back and forth into rising ones with the same steps."""
    steps = np.abs(np.diff(stamps_s))
    return np.asarray(stamps_s[0] + np.concatenate([[0.0], np.cumsum(steps)]))


def _repeated(
    source: Sequence, indices: NDArray[np.integer[Any]], stamps_s: NDArray[np.float64]
) -> Trajectory | None:
    """Return the true pose of each frame at its new time, where there is one near the old."""
    truth = source.ground_truth
    if truth is None:
        return None
    nearest = truth.nearest(source.stamps_s[indices], MAX_DIFFERENCE_S)
    known = nearest >= 0
    return Trajectory(stamps_s[known], truth.T_world_camera[nearest[known]])
