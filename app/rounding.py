"""Figures as they are written to JSON."""

from __future__ import annotations

import math
from typing import SupportsFloat


def rounded(value: SupportsFloat, digits: int = 4) -> float | None:
    """Return a figure rounded to a number of decimals, None for one that is not finite.

    JSON has no NaN.
    """
    figure = float(value)
    return round(figure, digits) if math.isfinite(figure) else None
