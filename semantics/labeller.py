"""Labels for frames: each image's prediction, then a vote among its neighbours in time."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from datasets.settings import Settings
from semantics.labels import UNKNOWN
from semantics.model import PlaceModel, PlacePrediction
from slam.tracking import Tracking


class LabellerSettings(Settings):
    """How many frames vote."""

    window: int = Field(
        31, ge=1, le=999, description="frames around each that vote on its label (paper: w); odd"
    )

    @field_validator("window")
    @classmethod
    def _is_odd(cls, window: int) -> int:
        if window % 2 == 0:
            raise ValueError("the window must be odd, so that the frame is in its middle")
        return window


@dataclass(frozen=True, slots=True)
class FrameLabel:
    """The place that a frame shows.

    Attributes
    ----------
    tracking : Tracking
        The low layer's account of the same frame (it holds the features: do not keep it).
    label, label_id : str, int
        What the frames around voted for; ``unknown`` and 0 where none could tell.
    score : float
        Mean probability of the label over the frames that voted, 0 to 1.
    raw_label : str
        What the frame alone looks like.
    histogram : (Q,) float64
        Its appearance, of unit length; empty without a model.
    """

    tracking: Tracking
    label: str
    label_id: int
    score: float
    raw_label: str
    histogram: NDArray[np.float64]


class PlaceLabeller:
    """Labels frames by majority vote of the `window` frames around each (paper, section 3.3).

    A frame's label is known `window // 2` frames later. Frames that are `unknown` on their own
    abstain; a tie goes to the label with the larger summed probability. Without a model
    everything is `unknown`, at once.

    Parameters
    ----------
    model : PlaceModel or None
        What predicts.
    settings : LabellerSettings
        The vote.
    """

    def __init__(self, model: PlaceModel | None, settings: LabellerSettings) -> None:
        self.model = model
        self.settings = settings
        self._recent: deque[tuple[Tracking, PlacePrediction]] = deque(maxlen=settings.window)
        self._waiting = 0

    def process(self, tracking: Tracking) -> list[FrameLabel]:
        """Take the next frame; return those whose vote is complete with it."""
        if self.model is None:
            return [FrameLabel(tracking, UNKNOWN, 0, 0.0, UNKNOWN, np.empty(0))]
        self._recent.append((tracking, self.model.predict(tracking.features)))
        self._waiting += 1
        return self._release(self.settings.window // 2)

    def finish(self) -> list[FrameLabel]:
        """Return the last frames, voted on by those there are."""
        labels = self._release(0)
        self._recent.clear()
        return labels

    def _release(self, delay: int) -> list[FrameLabel]:
        """Return the waiting frames but the last `delay`."""
        labels = []
        while self._waiting > delay:
            labels.append(self._vote(len(self._recent) - self._waiting))
            self._waiting -= 1
        return labels

    def _vote(self, centre: int) -> FrameLabel:
        half = self.settings.window // 2
        predictions = [prediction for _, prediction in self._recent]
        voters = [
            p for p in predictions[max(0, centre - half) : centre + half + 1] if p.label_id != 0
        ]
        (tracking, own) = self._recent[centre]
        if not voters:
            return FrameLabel(tracking, UNKNOWN, 0, 0.0, own.label, own.histogram)
        mean = np.mean([p.probabilities for p in voters], axis=0)
        votes = np.bincount([p.label_id for p in voters], minlength=len(mean))
        winner = int(np.lexsort((mean, votes))[-1])
        name = next(p.label for p in voters if p.label_id == winner)
        return FrameLabel(
            tracking, name, winner, float(mean[winner]), own.label, own.histogram
        )  # fmt: skip
