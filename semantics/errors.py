"""Errors of the semantic layer."""

from __future__ import annotations

from roomgraph.datasets.errors import RoomgraphError


class SemanticsError(RoomgraphError):
    """A model, a label, a graph or a set of training images that cannot be used."""
