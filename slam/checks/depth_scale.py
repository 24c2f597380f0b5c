"""Check of the unit of the depth images."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings

# Raw units a metre that recordings come in, the usual ones first: millimetres, the TUM
# benchmark's, tenths of a millimetre, centimetres, metres.
USUAL_SCALES = (1000.0, 5000.0, 10000.0, 100.0, 1.0)


class DepthScaleSettings(Settings):
    """Distances that an indoor recording has.

    The scale of a single camera's depth cannot be found from its geometry: a room and its
    model in miniature look the same. What is known is what depth cameras can see. They are blind
    nearer than 0.25 to 0.5 m (Kinect, Azure Kinect, RealSense D4xx) and reach 4 to 10 m.
    """

    near_m: float = Field(
        default=0.25, gt=0, description="shortest distance that a sensor measures, metres"
    )
    far_m: float = Field(
        default=10.0, gt=0, description="longest distance that is measured indoors, metres"
    )
    typical_min_m: float = Field(
        default=0.5, gt=0, description="smallest typical median depth, metres"
    )
    typical_max_m: float = Field(
        default=6.0, gt=0, description="largest typical median depth, metres"
    )


@dataclass(frozen=True, slots=True)
class WrongScale:
    """Typical depth as it is read, and the depth scale under which it would be plausible."""

    median_m: float
    depth_scale: float | None


def find_wrong_scale(
    depths_m: NDArray[np.floating], depth_scale: float, settings: DepthScaleSettings
) -> WrongScale | None:
    """Judge readings `depths_m` (N,) from all over a sequence, none of them 0.

    Both the typical reading and the extreme ones have to lie where no depth camera's do: a
    close-up alone or a hall alone is no mistake.
    """
    if not len(depths_m):
        return None
    low, median, high = np.percentile(depths_m, [1, 50, 95])
    too_small = median < settings.typical_min_m and low < settings.near_m
    too_large = median > settings.typical_max_m and high > settings.far_m
    if not (too_small or too_large):
        return None
    raw = np.array([low, median, high]) * depth_scale
    fitting = [s for s in USUAL_SCALES if _plausible(raw / s, settings)]
    return WrongScale(float(median), fitting[0] if fitting else None)


def _plausible(depths_m: NDArray[np.floating], settings: DepthScaleSettings) -> bool:
    low, median, high = depths_m
    return bool(
        low >= settings.near_m
        and settings.typical_min_m <= median <= settings.typical_max_m
        and high <= settings.far_m
    )
