"""Errors of the low layer."""

from __future__ import annotations

from roomgraph.datasets.errors import RoomgraphError


class SlamError(RoomgraphError):
    """A setting or a build that the low layer cannot work with."""
