"""One RGB-D frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics


@dataclass(frozen=True, slots=True)
class Frame:
    """A colour image with the depth registered to it.

    Attributes
    ----------
    index : int
        Place in the sequence, from 0.
    stamp_s : float
        Time stamp, seconds.
    colour : (H, W, 3) uint8
        Red, green, blue.
    depth : (H, W) float32
        Metres along the optical axis; 0 where there is no reading.
    intrinsics : Intrinsics
        The (undistorted) camera that both images belong to.
    """

    index: int
    stamp_s: float
    colour: NDArray[np.uint8]
    depth: NDArray[np.float32]
    intrinsics: Intrinsics
