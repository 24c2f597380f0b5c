"""The base of every module's settings."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Settings(BaseModel):
    """Immutable settings that refuse unknown names, on every level they are nested in."""

    model_config = ConfigDict(extra="forbid", frozen=True)
