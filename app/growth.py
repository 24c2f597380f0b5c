"""How often something that grows is drawn."""

from __future__ import annotations


class GrowthGate:
    """Opens when something has grown enough since it last did.

    A step in proportion to the size makes all drawings together cost as much as a few of the last.

    Parameters
    ----------
    step : int
        The least growth, but for the very first.
    parts : int
        Growth by one part in so many, where that is more.
    """

    def __init__(self, step: int, parts: int) -> None:
        self._step, self._parts, self._size = step, parts, 0

    def opens(self, size: int) -> bool:
        """Tell whether it is time, and if so note the size."""
        due = self._size + max(self._step, self._size // self._parts) if self._size else 1
        if size < due:
            return False
        self._size = size
        return True
