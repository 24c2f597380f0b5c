"""Motion model: predicted pose of the camera, and its uncertainty."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.chi_square import CHI2_95_6DOF

FloatArray = NDArray[np.float64]

# Steps in time that are alike: stamps jitter.
ALIKE = 0.1


class PredictionSettings(Settings):
    """Assumptions on the motion of a handheld or robot-mounted camera."""

    enabled: bool = Field(
        default=True,
        description="use a constant-velocity model in directions that a view does not constrain",
    )
    acceleration_m_s2: float = Field(
        default=5.0, gt=0, le=1000, description="typical acceleration of the camera, m/s²"
    )
    acceleration_rad_s2: float = Field(
        default=30.0,
        gt=0,
        le=10000,
        description="typical angular acceleration of the camera, rad/s²",
    )
    memory: float = Field(
        default=0.9,
        ge=0,
        lt=1,
        description="weight of the past prediction errors when a new one is averaged in",
    )
    caution: float = Field(
        default=3.0, ge=1, le=100, description="factor on the past prediction errors"
    )
    longest: float = Field(
        default=5.0,
        ge=1,
        le=100,
        description="maximum extrapolation, as a multiple of the last time step",
    )


class MotionModel:
    """Constant velocity, weighted by its past prediction errors.

    What a view shows decides where it was taken; only directions that it leaves open (a few
    features in a corner, a bare wall) are held by the prediction. Its covariance is that of a
    random acceleration, or of its own errors if these are larger (adaptive, after Mehra, 1970):
    of frames far apart next to nothing is predicted.
    """

    def __init__(self, settings: PredictionSettings) -> None:
        self.settings = settings
        self._T_now_last: FloatArray = np.eye(4)
        self._step_s = 0.0
        self._squares: FloatArray | None = None

    def moved(self, T_now_last: FloatArray, seconds: float) -> None:
        """Update with the latest motion (4, 4) and its duration.

        It feeds the next one: left alone, rounding errors would double with each frame.
        """
        self._T_now_last, self._step_s = se3.orthonormal(T_now_last), seconds

    def stand_still(self) -> None:
        """Predict no motion, since the last motion is unknown."""
        self._T_now_last, self._step_s = np.eye(4), 0.0

    def step(self, seconds: float) -> FloatArray:
        """Return the predicted T_next_now (4, 4) after `seconds` at constant velocity."""
        times = self._times(seconds)
        if abs(times - 1.0) < ALIKE:
            return self._T_now_last
        rotation = cv2.Rodrigues(self._T_now_last[:3, :3])[0][:, 0]
        return se3.exponential(times * np.r_[rotation, self._T_now_last[:3, 3]])

    def hold(
        self, T: FloatArray, information: FloatArray, T_predicted: FloatArray, seconds: float
    ) -> FloatArray:
        """Return a measured pose, with unconstrained directions taken from the prediction.

        The product of two Gaussians, the prediction weighed down by Cauchy's kernel where it
        contradicts the measurement.

        Parameters
        ----------
        T, T_predicted : (4, 4) float64
            Of the camera, in front of the same reference.
        information : (6, 6) float64
            Of the measurement, in the camera's frame.
        seconds : float
            From the last frame to this one.
        """
        off = se3.logarithm(T_predicted @ se3.inverse(T))
        known, self._squares = self._squares, self._learnt(off, information)
        if known is None or not self.settings.enabled:
            return T
        prior = np.diag(1.0 / self._variances(known, seconds))
        both = information + prior
        # Mahalanobis, from the information of either: (P^-1 + H^-1)^-1 = P (P + H)^-1 H.
        error = float(off @ prior @ np.linalg.solve(both, information @ off))
        prior = prior / (1.0 + error / CHI2_95_6DOF)
        pull: FloatArray = np.asarray(np.linalg.solve(information + prior, prior @ off))
        return se3.exponential(pull) @ T

    def _times(self, seconds: float) -> float:
        """Return a time as a multiple of the last step; 1 if time stamps are unusable."""
        if self._step_s <= 0 or seconds <= 0:
            return 1.0
        return min(seconds / self._step_s, self.settings.longest)

    def _variances(self, known: FloatArray, seconds: float) -> FloatArray:
        s = self.settings
        usual = np.array([s.acceleration_rad_s2, s.acceleration_m_s2]) * seconds**2
        return np.asarray(np.repeat(usual**2 + s.caution**2 * known, 3))

    def _learnt(self, off: FloatArray, information: FloatArray) -> FloatArray:
        """Return the mean square prediction errors (2,) of rotation and translation, per axis.

        An error that the measurement itself may have caused is no error of the prediction.
        """
        own = np.diag(np.linalg.inv(information + 1e-6 * np.eye(6)))
        square: FloatArray = np.maximum(off**2 - own, 0.0).reshape(2, 3).mean(axis=1)
        if self._squares is None:
            return square
        memory = self.settings.memory
        return np.asarray(memory * self._squares + (1 - memory) * square)
