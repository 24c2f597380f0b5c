"""What two views have in common at a motion between them, and whether it agrees."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from datasets import poses
from slam.range_image import RangeImage

FloatArray = NDArray[np.float64]

# Fewer cells in common tell nothing.
FEWEST = 50
# Surfaces are the same within so many metres, and so much of their distance.
TOLERANCE_M, TOLERANCE_SHARE = 0.05, 0.03
# Cells a side of the blocks within which greys are compared: light and dark halves of a view are
# much the same everywhere.
BLOCK = 20
# Grey levels (standard deviation) below which a surface is bare: noise and vignetting look so too.
BARE = 5.0


@dataclass(frozen=True, slots=True)
class Overlap:
    """How the surface that one view saw agrees with what another sees in the same place.

    Surface hidden behind what the other sees counts for nothing.

    Attributes
    ----------
    same : int
        Cells that lie on the surface the other sees.
    seen_through : int
        Cells where the other sees something farther off.
    likeness : float or None
        Correlation of the grey levels of the cells that lie on the same surface, each against
        the mean around it, -1 to 1: the same under any exposure. None where either view shows it
        bare.
    """

    same: int
    seen_through: int
    likeness: float | None

    @property
    def depth_agreement(self) -> float:
        """The share of cells that the other does not see through; 0 where few can be compared."""
        total = self.same + self.seen_through
        return self.same / total if total >= FEWEST else 0.0

    def looks_alike(self, least: float) -> bool:
        """Whether the same surface looks the same, as far as it looks like anything."""
        return self.same >= FEWEST and (self.likeness is None or self.likeness >= least)


def overlap(image: RangeImage, other: RangeImage, T_other_image: FloatArray) -> Overlap:
    """Compare what a view saw with what another sees, at the motion (4, 4) between them.

    Matches of a pattern that repeats (wallpaper, a row of posters) agree with each other, and bare
    surface with any other; but what lies around the matches then looks different. The cells are
    wide enough for blur, and for the errors of a motion, not to matter.
    """
    points = poses.transform(T_other_image, image.points.astype(np.float64))
    ahead = np.flatnonzero(points[:, 2] > 0.1)
    pixels = np.rint(other.intrinsics.project(points[ahead])).astype(np.intp)
    height, width = other.depth_mm.shape
    inside = np.all((pixels >= 0) & (pixels < (width, height)), axis=1)
    ahead, (x, y) = ahead[inside], pixels[inside].T
    seen, z = other.depth[y, x], points[ahead, 2]
    tolerance = TOLERANCE_M + TOLERANCE_SHARE * seen
    same = (seen > 0) & (np.abs(z - seen) <= tolerance)
    seen_through = (seen > 0) & (z < seen - tolerance)
    ahead, x, y = ahead[same], x[same], y[same]
    blocks = (y // BLOCK) * width + x // BLOCK
    shown = (
        _against_mean(greys.mean(axis=1), blocks)
        for greys in (image.colours[ahead], other.colour[y, x])
    )
    return Overlap(len(ahead), int(seen_through.sum()), _likeness(*shown))


def _against_mean(greys: FloatArray, blocks: NDArray[np.intp]) -> FloatArray:
    """Return grey levels (N,) less the means of the blocks (N,) that they lie in."""
    count = np.maximum(np.bincount(blocks), 1)
    return np.asarray(greys - (np.bincount(blocks, greys) / count)[blocks])


def _likeness(one: FloatArray, other: FloatArray) -> float | None:
    """Return the correlation of two signals (N,) without mean, None where either is weak."""
    if len(one) < FEWEST or min(one.std(), other.std()) < BARE:
        return None
    return float(one @ other / np.sqrt((one @ one) * (other @ other)))
