"""How often something that changes or grows is drawn."""

from __future__ import annotations

import math


class GrowthGate:
    """Opens when something has grown enough since it last did.

    A step in proportion to the size makes all drawings together cost as much as a few of the last.

    Parameters
    ----------
    step : int
        The least growth, but for the very first.
    parts : int
        Reciprocal of the growth that is needed, where that is more.
    """

    def __init__(self, step: int, parts: int) -> None:
        self._step, self._parts, self._size = step, parts, 0

    def opens(self, size: int) -> bool:
        """Return whether it opens, and if so store the size."""
        due = self._size + max(self._step, self._size // self._parts) if self._size else 1
        if size < due:
            return False
        self._size = size
        return True


class TimeGate:
    """Opens at a mean interval in seconds of sequence time.

    Parameters
    ----------
    every_s : float
        Seconds; a sequence whose frames lie further apart is shown whole.
    """

    def __init__(self, every_s: float) -> None:
        self._every_s, self._due_s, self._last_s = every_s, -math.inf, -math.inf

    def opens(self, now_s: float, anyway: bool = False) -> bool:
        """Return whether it opens: when due, when forced, or when time runs backwards."""
        in_turn = self._due_s <= now_s
        if not (anyway or in_turn or now_s < self._last_s):
            return False
        # A frame that came late does not make the next ones late.
        next_s = self._due_s + self._every_s
        self._due_s = next_s if in_turn and next_s > now_s else now_s + self._every_s
        self._last_s = now_s
        return True
