"""Labels for frames: each image's prediction, then a vote among its neighbours in time."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.recognition.model import PlaceModel, PlacePrediction
from roomgraph.semantics.temporal.filter import PlaceFilter
from roomgraph.semantics.temporal.odometer import Odometer
from roomgraph.slam.tracking import Tracking


class LabellerSettings(Settings):
    """How many frames vote."""

    method: Literal["vote", "filter"] = Field(
        "filter", description="a hidden Markov model, or the majority of the frames around (paper)"
    )
    window: int = Field(
        31, ge=1, le=999, description="frames around each that vote on its label (paper: w); odd"
    )
    min_voters: int = Field(
        5, ge=1, le=99,
        description="where fewer of those were looked at, so many of the nearest that were",
    )  # fmt: skip
    max_delay: int = Field(
        90, ge=0, le=9999, description="frames after which a label is given with what there is"
    )
    change_m: float = Field(
        4.0, gt=0, description="metres walked in one kind of place, on average (filter)"
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
        SLAM's account of the same frame (it holds the features: do not keep it).
    label, label_id : str, int
        What the frames around speak for; ``unknown`` and 0 where none could tell.
    score : float
        Probability of the label, 0 to 1.
    raw_label : str
        What the frame alone looks like; ``unknown`` if it was not looked at.
    histogram : (Q,) float64
        Its appearance, of unit length, or that of the nearest frame looked at; empty without a
        model.
    probabilities : (n_labels,) float64
        By label id, given the frames around, or their mean (vote); empty where none could tell.
    voters : tuple of int
        The indices of the frames around that look like the label on their own.
    words : tuple of (int, float)
        The visual words that spoke most for it in the nearest of those, see `PlacePrediction`.
    """

    tracking: Tracking
    label: str
    label_id: int
    score: float
    raw_label: str
    histogram: NDArray[np.float64]
    probabilities: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    voters: tuple[int, ...] = ()
    words: tuple[tuple[int, float], ...] = ()


@dataclass(frozen=True, slots=True)
class _Look:
    """What a frame alone looks like.

    `order` counts the frames taken, looked at or not; `way_m` leads here from the last look.
    """

    order: int
    frame: int
    way_m: float
    prediction: PlacePrediction


class PlaceLabeller:
    """Labels frames by the frames around each: a hidden Markov model, or the paper's vote.

    The vote is that of section 3.3. The model knows how places follow each other and how far the
    camera went between two looks, see `PlaceFilter` and, for frames without poses, `Odometer`; it
    is right more often, and its score is a probability that holds.

    Not every frame need be looked at: those that come without features (nor an image, for a model
    that describes images itself) take the label that the frames around them vote for. Of the
    `window` frames around, those that were looked at vote; where they are fewer than `min_voters`,
    the nearest that were looked at do, so that the vote does not depend on the frame rate where
    only keyframes are looked at.

    A frame's label is known ``window // 2`` frames later, or when half of `min_voters` have been
    seen after it, whichever comes last, and after `max_delay` frames at the latest. Frames that
    are `unknown` on their own abstain; a tie goes to the label with the larger summed probability.
    Without a model everything is `unknown`, at once.

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
        self._filter = None if model is None else PlaceFilter(model.transitions, settings.change_m)
        self._odometer = None if self._filter is None else Odometer(self._filter.independent_m)
        self._looks: list[_Look] = []
        self._waiting: deque[tuple[int, Tracking]] = deque()
        self._taken = 0

    def process(
        self, tracking: Tracking, colour: NDArray[np.uint8] | None = None
    ) -> list[FrameLabel]:
        """Take the next frame; return those whose vote is complete with it.

        Parameters
        ----------
        tracking : Tracking
            The frame; with features, it is looked at.
        colour : (H, W, 3) uint8, optional
            Its image. A model that describes images itself looks at the frame if it is given; it
            may be left out for frames that need no look of their own.
        """
        if self.model is None:
            return [FrameLabel(tracking, UNKNOWN, 0, 0.0, UNKNOWN, np.empty(0))]
        looks = self.model.can_look(tracking.features, colour)
        return self.take(tracking, self.model.predict(tracking.features, colour) if looks else None)

    def take(self, tracking: Tracking, prediction: PlacePrediction | None) -> list[FrameLabel]:
        """Take the next frame with what it alone looks like, None if it was not looked at."""
        if prediction is not None and self._odometer is not None:
            T = tracking.T_world_camera
            way_m = self._odometer.step(None if T is None else T[:3, 3], prediction.view)
            self._looks.append(_Look(self._taken, tracking.index, way_m, prediction))
        self._waiting.append((self._taken, tracking))
        self._taken += 1
        return self._release()

    def finish(self) -> list[FrameLabel]:
        """Return the last frames, voted on by those there are."""
        labels = [self._label(order, tracking) for order, tracking in self._waiting]
        self._waiting.clear()
        self._looks.clear()
        return labels

    def _release(self) -> list[FrameLabel]:
        """Return the waiting frames whose vote is complete, and forget what is out of reach."""
        labels = []
        while self._waiting and self._is_complete(self._waiting[0][0]):
            labels.append(self._label(*self._waiting.popleft()))
        self._forget()
        return labels

    def _is_complete(self, order: int) -> bool:
        age = self._taken - 1 - order
        if age < self.settings.window // 2:
            return False
        needed = min(self.settings.min_voters, self.settings.window) // 2
        after = sum(look.order > order for look in self._looks[-needed:]) if needed else 0
        return after >= needed or age >= self.settings.max_delay

    def _forget(self) -> None:
        """Drop looks that no frame to come will ask: too old, and enough younger ones."""
        oldest = self._waiting[0][0] if self._waiting else self._taken
        before = sum(look.order < oldest - self.settings.window // 2 for look in self._looks)
        surplus = before - min(self.settings.min_voters, self.settings.window)
        if surplus > 0:
            if self._filter is not None:
                for look in self._looks[:surplus]:
                    self._filter.advance(look.way_m, look.prediction.probabilities[1:])
            del self._looks[:surplus]

    def _around(self, order: int) -> list[_Look]:
        """Return the looks that vote on a frame, the nearest first."""
        ranked = sorted(self._looks, key=lambda look: abs(look.order - order))
        half = self.settings.window // 2
        within = sum(abs(look.order - order) <= half for look in ranked)
        return ranked[: max(within, min(self.settings.min_voters, self.settings.window))]

    def _label(self, order: int, tracking: Tracking) -> FrameLabel:
        around = self._around(order)
        nearest = around[0] if around else None
        own = nearest if nearest is not None and nearest.order == order else None
        raw = own.prediction.label if own else UNKNOWN
        histogram = nearest.prediction.histogram if nearest else np.empty(0)
        voters = [look for look in around if look.prediction.label_id != 0]
        if not voters:
            return FrameLabel(tracking, UNKNOWN, 0, 0.0, raw, histogram)
        if self.settings.method == "filter":
            mean = self._filtered(order)
            winner = int(mean.argmax())
        else:
            mean = np.mean([look.prediction.probabilities for look in voters], axis=0)
            votes = np.bincount([v.prediction.label_id for v in voters], minlength=len(mean))
            winner = int(np.lexsort((mean, votes))[-1])
        assert self.model is not None
        own_voters = [v for v in voters if v.prediction.label_id == winner]
        return FrameLabel(
            tracking, self.model.labels.names[winner], winner, float(mean[winner]), raw, histogram,
            mean, tuple(sorted(v.frame for v in own_voters)),
            own_voters[0].prediction.words if own_voters else (),
        )  # fmt: skip

    def _filtered(self, order: int) -> NDArray[np.float64]:
        """Return the labels' probabilities at a frame, given all looks so far."""
        assert self._filter is not None
        beliefs = self._filter.smoothed(
            [look.way_m for look in self._looks],
            np.array([look.prediction.probabilities[1:] for look in self._looks]),
        )
        nearest = min(range(len(beliefs)), key=lambda i: abs(self._looks[i].order - order))
        return np.concatenate([[0.0], beliefs[nearest]])
