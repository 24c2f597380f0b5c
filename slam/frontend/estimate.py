"""Pose estimates of views, from any tracking method."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets import se3
from roomgraph.slam.tracking import Anchor

FloatArray = NDArray[np.float64]
Method = Literal["flow", "features", "depth"]

# Information that every direction has at least, for matrices to be inverted.
WEAKEST = 1e-6


@dataclass(frozen=True, slots=True)
class Estimate:
    """A view's pose, relative to a keyframe.

    Attributes
    ----------
    reference : int
        The keyframe's id.
    T_camera_reference : (4, 4) float64
        Maps the keyframe's points to the camera.
    information : (6, 6) float64
        Inverse covariance in the camera's frame: rotation, then translation.
    inliers : int
        Corners or features that agree; 0 if it comes from depth alone.
    support : float
        How many agree, as a share of those that could: how well the keyframe still explains the
        view.
    method : str
        ``flow``, ``features`` or ``depth``.
    pixels : (N, 2) float64
        Where the view shows what agrees.
    """

    reference: int
    T_camera_reference: FloatArray
    information: FloatArray
    inliers: int
    support: float
    method: Method
    pixels: FloatArray

    @property
    def anchor(self) -> Anchor:
        """The pose as an anchor."""
        return Anchor(self.reference, se3.inverse(self.T_camera_reference))

    @property
    def covariance(self) -> FloatArray:
        """Covariance (6, 6) in the camera's frame."""
        return inverted(self.information)


def inverted(information: FloatArray) -> FloatArray:
    """Return the covariance (6, 6) of an information matrix.

    Directions of which nothing is known make it singular: they get a standard deviation of a
    thousand metres or radians.
    """
    return np.asarray(np.linalg.inv(information + WEAKEST * np.eye(6)))
