"""The interface of temporal models: from the looks around a frame to its label."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.temporal.look import Look


@dataclass(frozen=True, slots=True)
class Belief:
    """The label of a frame, and the probability (n_labels,) of each label by id."""

    label_id: int
    probabilities: NDArray[np.float64]


class TemporalModel(Protocol):
    """Labels a frame from the predictions of neighbouring frames.

    Parameters
    ----------
    transitions : (K, K) float64
        Chance of each kind of place (column) after leaving a kind (row).
    change_m : float
        Metres walked in one kind of place, on average.
    settings : Settings, optional
        An instance of the class's `settings_class`.

    Attributes
    ----------
    name : str
        What it is called in settings and on the command line.
    meaning : str
        What it does, in a few words.
    settings_class : type
        Its own settings; the default has none.
    """

    name: ClassVar[str]
    meaning: ClassVar[str]
    settings_class: ClassVar[type[Settings]] = Settings

    transitions: NDArray[np.float64]
    change_m: float
    settings: Any

    def __init__(
        self, transitions: NDArray[np.float64], change_m: float, settings: Settings | None = None
    ) -> None:
        self.transitions, self.change_m = transitions, change_m
        self.settings = self.settings_class() if settings is None else settings

    @abstractmethod
    def advance(self, look: Look) -> None:
        """Add a look to the past: `belief` will not get it again."""
        ...

    @abstractmethod
    def belief(self, order: int, looks: Sequence[Look], voters: Sequence[Look]) -> Belief:
        """Return the belief about a frame.

        Parameters
        ----------
        order : int
            The frame's.
        looks : sequence of Look
            All that were not taken for good yet, in time order.
        voters : sequence of Look
            Those around the frame that show a known place, the nearest first; at least one.
        """
        ...
