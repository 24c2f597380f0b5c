"""Whether depth and colour were taken at the same time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets.settings import Settings
from slam.checks.edges import Outlines
from slam.checks.registration import Alignment, score
from slam.checks.statistics import paired_t


class DelaySettings(Settings):
    """How far apart in time the two images are looked for."""

    frames: int = Field(5, ge=1, le=30, description="delays searched, frames")
    min_outline: int = Field(100, ge=10, description="smaller outlines, in pixels, don't count")
    min_windows: int = Field(5, ge=3, description="fewer stretches of frames decide nothing")
    min_pairs: int = Field(2, ge=1, description="image pairs that a window needs for each delay")
    min_score: float = Field(
        0.3, gt=0, description="strength of colour edges that outlines have to lie on"
    )
    min_t: float = Field(3.5, ge=2, description="paired t value against no delay")


@dataclass(frozen=True, slots=True)
class Delay:
    """By how many frames the depth images come late (early, if negative), and the fit then."""

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
    rows = np.array([_scores(window, settings, alignment) for window in windows])
    known = np.isfinite(rows)
    none = settings.frames
    comparable = known & known[:, [none]]
    means = np.array([
        rows[use, slot].mean() if use.sum() >= settings.min_windows else -np.inf
        for slot, use in enumerate(comparable.T)
    ])  # fmt: skip
    best = int(means.argmax())
    if best == none or means[best] < settings.min_score:
        return None
    both = rows[comparable[:, best]]
    if paired_t(list(both[:, best]), list(both[:, none])) < settings.min_t:
        return None
    return Delay(best - none, float(means[best]))


def _scores(
    window: Sequence[Outlines], settings: DelaySettings, alignment: Alignment | None
) -> NDArray[np.float64]:
    """Return the fit (2 n + 1,) of a window for each delay; NaN where too little is to be seen."""
    delays = range(-settings.frames, settings.frames + 1)
    scores = np.full(len(delays), np.nan)
    for slot, delay in enumerate(delays):
        pairs = [
            score(replace(colour, pixels=window[i + delay].pixels), alignment)
            for i, colour in enumerate(window)
            if 0 <= i + delay < len(window)
            and len(window[i + delay].pixels) >= settings.min_outline
        ]
        if len(pairs) >= settings.min_pairs:
            scores[slot] = np.mean(pairs)
    return scores
