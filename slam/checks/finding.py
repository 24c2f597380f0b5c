"""What the data says against itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Kind = Literal["depth scale", "intrinsics", "registration", "time offset"]


@dataclass(frozen=True, slots=True)
class Finding:
    """Something about a sequence that cannot be right.

    Attributes
    ----------
    kind : str
        What is concerned.
    observed : str
        What was seen, with its figures.
    suggestion : str
        What to do about it.
    """

    kind: Kind
    observed: str
    suggestion: str

    def __str__(self) -> str:
        return f"{self.observed}; {self.suggestion}"
