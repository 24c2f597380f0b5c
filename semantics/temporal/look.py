"""Predictions of single frames, before temporal models."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.recognition.model import PlacePrediction
from roomgraph.slam.features.extraction import Features


@dataclass(frozen=True, slots=True)
class FrameInput:
    """A frame to be labelled.

    Attributes
    ----------
    index : int
        Its number in the sequence.
    stamp_s : float
        Its time, seconds.
    colour : (H, W, 3) uint8 or None
        Its image; may be left out for frames that need no look of their own.
    features : Features or None
        Its local features, where they are known already.
    position_world : (3,) float64 or None
        Where it was taken, metres, if known.
    """

    index: int
    stamp_s: float
    colour: NDArray[np.uint8] | None = None
    features: Features | None = None
    position_world: NDArray[np.float64] | None = None


@dataclass(frozen=True, slots=True)
class Look:
    """The prediction for a single frame.

    Attributes
    ----------
    order : int
        Number of the frame among all frames taken, looked at or not.
    frame : int
        Its index in the sequence.
    way_m : float
        Metres that lead here from the last look.
    prediction : PlacePrediction
        What it looks like.
    """

    order: int
    frame: int
    way_m: float
    prediction: PlacePrediction
