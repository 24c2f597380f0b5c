"""Measurement noise of a depth camera."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings


class SensorNoise(Settings):
    """Standard deviations of a structured-light or time-of-flight depth camera.

    The depth error grows with the square of the depth (Khoshelham & Elberink, 2012); the
    defaults are of the size that Nguyen et al. (2012) measured for the Kinect.
    """

    pixel: float = Field(
        default=1.0, gt=0, le=10, description="error of a feature's position, pixels"
    )
    depth_floor_m: float = Field(
        default=0.003, gt=0, le=0.1, description="depth error at short range, metres"
    )
    depth_quadratic: float = Field(
        default=0.0025,
        ge=0,
        le=0.1,
        description="depth error in metres added per square metre of depth (it grows with the "
        "depth squared)",
    )

    @property
    def coefficients(self) -> NDArray[np.float64]:
        """The two coefficients (2,) of `depth_sigma`, for compiled loops."""
        return np.array([self.depth_floor_m, self.depth_quadratic])

    def depth_sigma(self, depth_m: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the standard deviation (N,) of readings `depth_m` (N,), metres.

        The same formula is in the compiled loops of `surface`, `space` and `fusion`.
        """
        return np.asarray(self.depth_floor_m + self.depth_quadratic * depth_m**2, dtype=np.float64)
