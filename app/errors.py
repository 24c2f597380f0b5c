"""Errors of the application."""

from __future__ import annotations

from roomgraph.datasets.errors import RoomgraphError


class AppError(RoomgraphError):
    """A command, a setting or an output that cannot be used."""
