"""Overlap of two views at a motion between them, and its agreement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.geometry.range_image import RangeImage

FloatArray = NDArray[np.float64]

# Fewer cells in common tell nothing.
FEWEST = 50
# Surfaces are the same within this many metres plus this share of their distance.
TOLERANCE_M, TOLERANCE_SHARE = 0.05, 0.03
# Blocks across a view within which greys are compared: light and dark halves are much the same
# everywhere.
BLOCKS = 4
# Standard deviation of grey levels, as a share of their mean and in levels, below which a surface
# is bare: noise and vignetting look so too.
BARE_SHARE, BARE_LEVELS = 0.04, 1.0
# Grey levels beyond which a cell may be clipped.
DARKEST, BRIGHTEST = 5.0, 250.0


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
    correlation : float or None
        Of the grey levels of the cells that lie on the same surface, each against the mean around
        it, -1 to 1: the same under any gain. None where there are few, or all are bare.
    """

    same: int
    seen_through: int
    correlation: float | None

    @property
    def depth_agreement(self) -> float:
        """The share of cells that the other does not see through; 0 where few can be compared."""
        total = self.same + self.seen_through
        return self.same / total if total >= FEWEST else 0.0

    def looks_alike(self, least: float) -> bool:
        """Whether the shared surface looks similar, if it has texture."""
        return self.correlation is None or self.correlation >= least


def overlap(image: RangeImage, other: RangeImage, T_other_image: FloatArray) -> Overlap:
    """Compare what a view saw with what another sees, at the motion (4, 4) between them.

    Matches of a pattern that repeats (wallpaper, a row of posters) agree with each other, and bare
    surface with any other; but what lies around the matches then looks different. Blur narrower
    than a few cells hardly matters; a motion wrong by some centimetres does.
    """
    points = se3.transform(T_other_image, image.points.astype(np.float64))
    ahead = np.flatnonzero(points[:, 2] > 0.1)
    pixels = np.rint(other.intrinsics.project(points[ahead])).astype(np.intp)
    height, width = other.depth_mm.shape
    inside = np.all((pixels >= 0) & (pixels < (width, height)), axis=1)
    ahead, (x, y) = ahead[inside], pixels[inside].T
    seen, z = other.depth[y, x], points[ahead, 2]
    tolerance = TOLERANCE_M + TOLERANCE_SHARE * seen
    same = (seen > 0) & (np.abs(z - seen) <= tolerance)
    seen_through = (seen > 0) & (z < seen - tolerance)
    greys = image.colours[ahead[same]].mean(axis=1), other.colour[y[same], x[same]].mean(axis=1)
    block = max(1, width // BLOCKS)
    blocks = (y[same] // block) * width + x[same] // block
    return Overlap(int(same.sum()), int(seen_through.sum()), _correlation(*greys, blocks))


def _correlation(one: FloatArray, other: FloatArray, blocks: NDArray[np.intp]) -> float | None:
    """Return the correlation of grey levels (N,), less the means of the blocks they lie in."""
    low, high = np.minimum(one, other), np.maximum(one, other)
    exposed = (low > DARKEST) & (high < BRIGHTEST)
    one, other, blocks = one[exposed], other[exposed], blocks[exposed]
    if len(one) < FEWEST:
        return None
    signals = [_against_mean(greys, blocks) for greys in (one, other)]
    bare = [
        signal.std() < max(BARE_LEVELS, BARE_SHARE * greys.mean())
        for signal, greys in zip(signals, (one, other), strict=True)
    ]
    power = float(np.sqrt((signals[0] @ signals[0]) * (signals[1] @ signals[1])))
    if all(bare):
        return None
    return float(signals[0] @ signals[1]) / power if power > 0 else 0.0


def _against_mean(greys: FloatArray, blocks: NDArray[np.intp]) -> FloatArray:
    """Return grey levels (N,) less the means of the blocks (N,) that they lie in."""
    count = np.maximum(np.bincount(blocks), 1)
    return np.asarray(greys - (np.bincount(blocks, greys) / count)[blocks])
