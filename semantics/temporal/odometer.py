"""Distance travelled between two looks, with or without known poses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# At half of what two independent views differ by, the next views are compared with this one.
_RENEW = 0.5
# Looks this far apart say independent things, metres.
INDEPENDENT_M = 0.5


class Odometer:
    """Measures the distance between looks: from poses, or else from the change of the view.

    Views are unit vectors (Fisher vectors, histograms); two that have nothing in common, by their
    cosine, count as `INDEPENDENT_M` apart. The views that follow one are compared with that one
    until they are half as different, and what counts is by how much the difference grows: so the
    images' noise does not add up while the camera stands still, at whatever frame rate.
    """

    def __init__(self) -> None:
        self._position: NDArray[np.float64] | None = None
        self._reference: NDArray[np.floating] | None = None
        self._change = 0.0
        self._is_first = True

    def step(
        self, position: NDArray[np.float64] | None, view: NDArray[np.floating] | None
    ) -> float:
        """Return the distance to the next look, metres; the first is independent of all before.

        Parameters
        ----------
        position : (3,) float64 or None
            Where it was taken, metres, if known.
        view : (L,) float or None
            What it shows, of unit length; None if there is nothing to see.
        """
        changed = self._changed(view)
        last, self._position = self._position, position
        if self._is_first:
            self._is_first = False
            return INDEPENDENT_M
        if last is not None and position is not None:
            return float(np.linalg.norm(position - last))
        return INDEPENDENT_M * changed

    def _changed(self, view: NDArray[np.floating] | None) -> float:
        """Return by how much more than the last a view differs from the reference, 0 to 1."""
        if view is None or not view.size:
            return 0.0
        if self._reference is None or self._reference.shape != view.shape:
            self._reference, self._change = view, 0.0
            return 0.0
        change = float(np.clip(1.0 - self._reference @ view, 0.0, 1.0))
        grown = max(0.0, change - self._change)
        self._change = max(self._change, change)
        if change >= _RENEW:
            self._reference, self._change = view, 0.0
        return grown
