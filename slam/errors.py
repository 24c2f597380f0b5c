"""Errors of SLAM."""

from __future__ import annotations

from roomgraph.datasets.errors import RoomgraphError


class SlamError(RoomgraphError):
    """A setting or a build that SLAM cannot work with."""
