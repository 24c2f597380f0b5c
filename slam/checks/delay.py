"""Whether depth and colour were taken at the same time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets.settings import Settings
from slam.checks.edges import Outlines
from slam.checks.registration import under
from slam.checks.statistics import paired_t


class DelaySettings(Settings):
    """How far apart in time the two images are looked for."""

    frames: int = Field(5, ge=1, le=30, description="delays searched, frames")
    min_outline: int = Field(100, ge=10, description="smaller outlines, in pixels, don't count")
    min_windows: int = Field(4, ge=3, description="fewer stretches of frames decide nothing")
    min_gain: float = Field(
        0.2, ge=0, description="least gain of the fit, as a share of that without delay"
    )
    min_t: float = Field(5.0, ge=2, description="paired t value against no delay")


@dataclass(frozen=True, slots=True)
class Delay:
    """By how many frames the depth images come late (early, if negative), and the fit then."""

    frames: int
    score: float


def find_delay(windows: Sequence[Sequence[Outlines]], settings: DelaySettings) -> Delay | None:
    """Return the delay at which depth outlines fit the colour edges, or None if it is 0.

    In each window of successive frames, every colour image is compared with the depth images
    before and after it. With the camera in motion only the one taken at the same time fits.
    """
    rows = np.array([_scores(window, settings) for window in windows])
    rows = rows[np.isfinite(rows).all(axis=1)] if len(rows) else rows
    if len(rows) < settings.min_windows:
        return None
    mean, none = rows.mean(axis=0), settings.frames
    best = int(mean.argmax())
    if best == none or mean[best] - mean[none] <= settings.min_gain * abs(mean[none]):
        return None
    if paired_t(list(rows[:, best]), list(rows[:, none])) < settings.min_t:
        return None
    return Delay(best - none, float(mean[best]))


def _scores(window: Sequence[Outlines], settings: DelaySettings) -> NDArray[np.float64]:
    """Return the fit (2 n + 1,) of a window for each delay; NaN where nothing can be said."""
    delays = range(-settings.frames, settings.frames + 1)
    scores = np.full(len(delays), np.nan)
    for slot, delay in enumerate(delays):
        pairs = [
            under(window[i + delay].pixels, colour.edges)
            for i, colour in enumerate(window)
            if 0 <= i + delay < len(window)
            and len(window[i + delay].pixels) >= settings.min_outline
        ]
        if pairs:
            scores[slot] = np.mean(pairs)
    return scores
