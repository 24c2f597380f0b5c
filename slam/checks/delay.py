"""Whether depth and colour were taken at the same time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.slam.checks.edges import Outlines
from roomgraph.slam.checks.registration import Alignment, score
from roomgraph.slam.checks.statistics import gain_error


class DelaySettings(Settings):
    """How a delay between depth and colour images is found."""

    frames: int = Field(default=5, ge=1, le=30, description="longest delay searched, frames")
    min_outline: int = Field(
        default=100, ge=10, description="minimum number of outline pixels for an image to count"
    )
    min_windows: int = Field(
        default=5, ge=3, description="minimum number of windows of frames for a report"
    )
    min_pairs: int = Field(
        default=2, ge=1, description="minimum number of image pairs in a window for each delay"
    )
    min_score: float = Field(
        default=0.3, gt=0, description="minimum mean strength of colour edges at depth outlines"
    )
    min_gain: float = Field(
        default=4.0, ge=2, description="minimum gain in fit over no delay, standard errors"
    )


@dataclass(frozen=True, slots=True)
class Delay:
    """Delay of the depth images in frames (negative: early), and the fit with it."""

    frames: int
    score: float


def find_delay(
    windows: Sequence[Sequence[Outlines]],
    settings: DelaySettings,
    alignment: Alignment | None = None,
) -> Delay | None:
    """Return the delay at which depth outlines fit the colour edges, or None if it is 0.

    In each window of successive frames, every colour image is compared with the depth images
    before and after it, moved by `alignment` (working pixels). With the camera in motion only
    the one taken at the same time fits.
    """
    if len(windows) < settings.min_windows:
        return None
    found = [_scores(window, settings, alignment) for window in windows]
    rows, pairs = (np.array(side) for side in zip(*found, strict=True))
    none = settings.frames
    known = pairs >= settings.min_pairs
    comparable = known & known[:, [none]]
    enough = comparable.sum(axis=0) >= settings.min_windows
    sums = np.where(comparable, rows, 0).sum(axis=0)
    means = np.where(enough, sums / np.maximum(comparable.sum(axis=0), 1), -np.inf)
    best = int(means.argmax())
    if best == none or means[best] < settings.min_score:
        return None
    used = comparable[:, best]
    # Half a motion off fits half, so the delays beside the best don't count as wrong. A mean over
    # few pairs varies more by chance: as one over a single pair would, divided.
    wrong = np.abs(np.arange(rows.shape[1]) - best) > 1
    singly = np.where(known, rows * np.sqrt(pairs), np.nan)[used][:, wrong]
    error = gain_error(singly, pairs[used][:, [best, none]])
    if np.mean(rows[used, best] - rows[used, none]) < settings.min_gain * error:
        return None
    return Delay(best - none, float(means[best]))


def _scores(
    window: Sequence[Outlines], settings: DelaySettings, alignment: Alignment | None
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the fit (2 n + 1,) of a window for each delay, and of how many pairs it is a mean."""
    delays = range(-settings.frames, settings.frames + 1)
    scores, pairs = np.zeros(len(delays)), np.zeros(len(delays), dtype=np.int64)
    for slot, delay in enumerate(delays):
        found = [
            score(replace(colour, pixels=window[i + delay].pixels), alignment)
            for i, colour in enumerate(window)
            if 0 <= i + delay < len(window)
            and len(window[i + delay].pixels) >= settings.min_outline
        ]
        if found:
            scores[slot], pairs[slot] = np.mean(found), len(found)
    return scores, pairs
