"""Labels of frames: from each image's prediction and those of neighbouring frames."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.recognition.model import PlaceModel, PlacePrediction
from roomgraph.semantics.temporal.look import FrameInput, Look
from roomgraph.semantics.temporal.odometer import Odometer
from roomgraph.semantics.temporal.settings import LabellerSettings


@dataclass(frozen=True, slots=True)
class FrameLabel:
    """The place that a frame shows.

    Attributes
    ----------
    index, stamp_s : int, float
        The frame's.
    label, label_id : str, int
        What the frames around speak for; ``unknown`` and 0 where none could tell.
    score : float
        Probability of the label, 0 to 1.
    raw_label : str
        What the frame alone looks like; ``unknown`` if it was not looked at.
    signature : (S,) float64
        What it is compared with other views by (see `PlacePrediction`), or that of the nearest
        frame looked at; empty without a model.
    probabilities : (n_labels,) float64
        By label id, given the frames around; empty where none could tell.
    voters : tuple of int
        The indices of the frames around that look like the label on their own.
    words : tuple of (int, float)
        The visual words that spoke most for it in the nearest of those, see `PlacePrediction`.
    """

    index: int
    stamp_s: float
    label: str = UNKNOWN
    label_id: int = 0
    score: float = 0.0
    raw_label: str = UNKNOWN
    signature: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    probabilities: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    voters: tuple[int, ...] = ()
    words: tuple[tuple[int, float], ...] = ()


class PlaceLabeller:
    """Labels frames with a temporal model of neighbouring frames (see `TEMPORAL_MODELS`).

    Not every frame need be looked at: those that come with nothing to look at take the label of
    the frames around them. Of the `window` frames around, those that were looked at decide; where
    they are fewer than `min_voters`, the nearest that were looked at do, so that the outcome does
    not depend on the frame rate where only keyframes are looked at.

    A frame's label is known ``window // 2`` frames later, or when half of `min_voters` have been
    seen after it, whichever comes last, and after `max_delay` frames at the latest. Frames that
    are `unknown` on their own abstain. Without a model everything is `unknown`, at once.

    Parameters
    ----------
    model : PlaceModel or None
        What predicts.
    settings : LabellerSettings
        Which frames decide, and how.
    """

    def __init__(self, model: PlaceModel | None, settings: LabellerSettings) -> None:
        self.model = model
        self.settings = settings
        if model is not None:
            self._temporal = settings.make_model(model.transitions)
        self._odometer = Odometer()
        self._looks: list[Look] = []
        self._waiting: deque[tuple[int, FrameInput]] = deque()
        self._taken = 0

    @property
    def uses_features(self) -> bool:
        """Whether frames need local features."""
        return self.model is not None and self.model.features is not None

    def process(self, frame: FrameInput) -> list[FrameLabel]:
        """Process the next frame; return the frames labelled by now."""
        if self.model is None:
            return [FrameLabel(frame.index, frame.stamp_s)]
        looks = self.model.can_look(frame.colour, frame.features)
        return self.take(frame, self.model.predict(frame.colour, frame.features) if looks else None)

    def take(self, frame: FrameInput, prediction: PlacePrediction | None) -> list[FrameLabel]:
        """Add the next frame with its own prediction, None if it was not classified."""
        if prediction is not None:
            way_m = self._odometer.step(frame.position_world, prediction.view)
            self._looks.append(Look(self._taken, frame.index, way_m, prediction))
        self._waiting.append((self._taken, FrameInput(frame.index, frame.stamp_s)))
        self._taken += 1
        return self._release()

    def finish(self) -> list[FrameLabel]:
        """Return the last frames, labelled with the evidence so far."""
        labels = [self._label(order, frame) for order, frame in self._waiting]
        self._waiting.clear()
        self._looks.clear()
        return labels

    def _release(self) -> list[FrameLabel]:
        """Return the waiting frames that can be labelled, and forget what is out of reach."""
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
        """Remove predictions that no later frame needs."""
        oldest = self._waiting[0][0] if self._waiting else self._taken
        before = sum(look.order < oldest - self.settings.window // 2 for look in self._looks)
        surplus = before - min(self.settings.min_voters, self.settings.window)
        if surplus > 0:
            for look in self._looks[:surplus]:
                self._temporal.advance(look)
            del self._looks[:surplus]

    def _around(self, order: int) -> list[Look]:
        """Return the looks that decide on a frame, the nearest first."""
        ranked = sorted(self._looks, key=lambda look: abs(look.order - order))
        half = self.settings.window // 2
        within = sum(abs(look.order - order) <= half for look in ranked)
        return ranked[: max(within, min(self.settings.min_voters, self.settings.window))]

    def _label(self, order: int, frame: FrameInput) -> FrameLabel:
        around = self._around(order)
        nearest = around[0] if around else None
        own = nearest if nearest is not None and nearest.order == order else None
        raw = own.prediction.label if own else UNKNOWN
        signature = nearest.prediction.signature if nearest else np.empty(0)
        voters = [look for look in around if look.prediction.label_id != 0]
        if self.model is None or not voters:
            return FrameLabel(frame.index, frame.stamp_s, raw_label=raw, signature=signature)
        belief = self._temporal.belief(order, self._looks, voters)
        winner = belief.label_id
        agreeing = [v for v in voters if v.prediction.label_id == winner]
        return FrameLabel(
            index=frame.index,
            stamp_s=frame.stamp_s,
            label=self.model.labels.names[winner],
            label_id=winner,
            score=float(belief.probabilities[winner]),
            raw_label=raw,
            signature=signature,
            probabilities=belief.probabilities,
            voters=tuple(sorted(look.frame for look in agreeing)),
            words=agreeing[0].prediction.words if agreeing else (),
        )
