"""Settings of labelling frames in time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from roomgraph.datasets.plugins import known_name, settings_by_name
from roomgraph.datasets.settings import Settings
from roomgraph.semantics.temporal.registry import TEMPORAL_MODELS
from roomgraph.semantics.temporal.temporal_model import TemporalModel

if TYPE_CHECKING:
    TemporalSettings = Settings
else:
    TemporalSettings = settings_by_name("TemporalSettings", __name__, TEMPORAL_MODELS)


class LabellerSettings(Settings):
    """How neighbouring frames determine a frame's label."""

    method: str = Field(
        default="filter",
        description=" or ".join(f"{m.name} ({m.meaning})" for m in TEMPORAL_MODELS.values()),
    )
    window: int = Field(
        default=31,
        ge=1,
        le=999,
        description="number of frames that vote on the one in the middle (paper: w); odd",
    )
    min_voters: int = Field(
        default=5, ge=1, le=99,
        description="minimum number of observed frames that vote, the nearest first",
    )  # fmt: skip
    max_delay: int = Field(
        default=90,
        ge=0,
        le=9999,
        description="maximum number of frames before a label is given with the evidence so far",
    )
    change_m: float = Field(
        default=4.0, gt=0, description="mean distance walked in one kind of place, metres"
    )

    methods: TemporalSettings = TemporalSettings()

    @field_validator("method")
    @classmethod
    def _is_known(cls, method: str) -> str:
        return known_name(method, TEMPORAL_MODELS)

    @field_validator("window")
    @classmethod
    def _is_odd(cls, window: int) -> int:
        if window % 2 == 0:
            raise ValueError("the window must be odd, so that the frame is in its middle")
        return window

    def make_model(self, transitions: NDArray[np.float64]) -> TemporalModel:
        """Return the chosen temporal model, for kinds of place that follow each other so.

        Parameters
        ----------
        transitions : (K, K) float64
            Chance of each kind of place (column) after leaving a kind (row).
        """
        settings: Settings = getattr(self.methods, self.method)
        return TEMPORAL_MODELS[self.method](transitions, self.change_m, settings)
