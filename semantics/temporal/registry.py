"""All temporal models by name: a new one is a file beside this one and a line here."""

from __future__ import annotations

from roomgraph.datasets.plugins import classes_by_name
from roomgraph.semantics.temporal.temporal_model import TemporalModel

TEMPORAL_MODELS: dict[str, type[TemporalModel]] = classes_by_name(
    "roomgraph.semantics.temporal",
    "vote.Vote",
    "filter.PlaceFilter",
)
