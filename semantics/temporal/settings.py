"""Settings of labelling frames in time."""

from __future__ import annotations

from pydantic import Field, field_validator

from roomgraph.datasets.plugins import known_name
from roomgraph.datasets.settings import Settings
from roomgraph.semantics.temporal.registry import TEMPORAL_MODELS


class LabellerSettings(Settings):
    """Which frames decide on a frame's label, and how."""

    method: str = Field(
        "filter",
        description="filter (a hidden Markov model) or vote (majority of the frames around, paper)",
    )
    window: int = Field(
        31, ge=1, le=999, description="frames around each that decide on its label (paper: w); odd"
    )
    min_voters: int = Field(
        5, ge=1, le=99,
        description="minimum number of frames that were looked at and decide, the nearest first",
    )  # fmt: skip
    max_delay: int = Field(
        90, ge=0, le=9999, description="frames after which a label is given with what there is"
    )
    change_m: float = Field(
        4.0, gt=0, description="metres walked in one kind of place, on average (filter)"
    )

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
