"""Findings of the checks of a sequence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roomgraph.datasets.camera import Camera

Kind = Literal["depth scale", "intrinsics", "registration", "time offset"]


@dataclass(frozen=True, slots=True)
class CameraCorrection:
    """A camera that should solve the problem, and a description of the change."""

    camera: Camera
    words: str


@dataclass(frozen=True, slots=True)
class Finding:
    """A problem found in a sequence.

    Attributes
    ----------
    kind : str
        What is concerned.
    observed : str
        What was seen, with its figures.
    suggestion : str
        What to do about it.
    correction : CameraCorrection or None
        What would correct it, where the images show that.
    """

    kind: Kind
    observed: str
    suggestion: str
    correction: CameraCorrection | None = None

    def __str__(self) -> str:
        return f"{self.observed}; {self.suggestion}"
