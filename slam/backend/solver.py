"""A small interface to iSAM2 of gtsam: poses, priors and constraints in, optimal poses out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import gtsam
import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy.spatial.transform import Rotation

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.errors import SlamError

FloatArray = NDArray[np.float64]

PRIOR_SIGMA = 1e-6


class PoseGraphSettings(Settings):
    """Weights of constraints between keyframes, and rejection of bad ones."""

    kernel: Literal["huber", "cauchy", "none"] = Field(
        default="huber", description="robust kernel of every constraint"
    )
    kernel_width: float = Field(
        default=3.0, gt=0, le=100, description="width of the robust kernel, standard deviations"
    )
    sigma_rotation_rad: float = Field(
        default=0.001,
        gt=0,
        le=1,
        description="rotation error added to that estimated from a constraint's matches, radians",
    )
    sigma_translation_m: float = Field(
        default=0.002,
        gt=0,
        le=1,
        description="translation error added to that estimated from a constraint's matches, metres",
    )
    reject_width: float = Field(
        default=10.0,
        gt=0,
        le=1000,
        description="loops with a larger residual after optimisation are rejected, standard "
        "deviations",
    )
    iterations: int = Field(
        default=10,
        ge=1,
        le=100,
        description="maximum number of solver iterations after a loop closure",
    )
    converged_m: float = Field(
        default=1e-4,
        gt=0,
        le=0.1,
        description="the solver stops when no keyframe moves further than this, metres",
    )


@dataclass(frozen=True, slots=True)
class Constraint:
    """A measured motion between two keyframes.

    Attributes
    ----------
    first, second : int
        Keyframe ids.
    T_first_second : (4, 4) float64
        Maps points of the second camera to the first.
    information : (6, 6) float64
        In the second's frame: rotation, then translation.
    is_loop : bool
        Whether it closes a loop.
    by : str
        What it was measured by: ``features``, ``planes``, ``surface`` or ``depth``.
    """

    first: int
    second: int
    T_first_second: FloatArray
    information: FloatArray
    is_loop: bool
    by: Literal["features", "planes", "surface", "depth"] = "features"


def covariance_of(constraint: Constraint, settings: PoseGraphSettings) -> FloatArray:
    """Return a constraint's covariance (6, 6), floor included, in its second's frame."""
    floor = np.repeat([settings.sigma_rotation_rad, settings.sigma_translation_m], 3)
    covariance = np.linalg.inv(constraint.information + 1e-6 * np.eye(6)) + np.diag(floor**2)
    return np.asarray((covariance + covariance.T) / 2)


def factor_of(constraint: Constraint, settings: PoseGraphSettings, robust: bool) -> Any:
    """Return a constraint as gtsam's factor."""
    noise = gtsam.noiseModel.Gaussian.Covariance(covariance_of(constraint, settings))
    if robust and settings.kernel != "none":
        kernels = gtsam.noiseModel.mEstimator
        kernel = {"huber": kernels.Huber, "cauchy": kernels.Cauchy}[settings.kernel]
        noise = gtsam.noiseModel.Robust.Create(kernel.Create(settings.kernel_width), noise)
    return gtsam.BetweenFactorPose3(
        constraint.first, constraint.second, gtsam.Pose3(constraint.T_first_second), noise
    )


def deviations(
    constraints: Sequence[Constraint],
    T_world_first: FloatArray,
    T_world_second: FloatArray,
    settings: PoseGraphSettings,
) -> FloatArray:
    """Return how far poses (N, 4, 4) are from N constraints, in standard deviations."""
    measured = np.array([constraint.T_first_second for constraint in constraints])
    error = se3.inverse(measured) @ se3.inverse(T_world_first) @ T_world_second
    steps = np.concatenate(
        [Rotation.from_matrix(error[:, :3, :3]).as_rotvec(), error[:, :3, 3]], axis=1
    )
    covariances = np.array([covariance_of(constraint, settings) for constraint in constraints])
    weighted = np.linalg.solve(covariances, steps[:, :, None])[:, :, 0]
    return np.asarray(np.sqrt(np.einsum("nd,nd->n", steps, weighted)))


class Solver:
    """Optimises poses incrementally (iSAM2; Kaess et al., 2012).

    Additions and removals wait for the next `update`.
    """

    def __init__(self, settings: PoseGraphSettings) -> None:
        self.settings = settings
        parameters = gtsam.ISAM2Params()
        # Robust weights are those at the linearisation: it must follow the poses closely.
        parameters.setRelinearizeThreshold(0.01)
        self._isam = gtsam.ISAM2(parameters)
        self._factors = gtsam.NonlinearFactorGraph()
        self._values = gtsam.Values()
        self._waiting: list[int] = []
        self._removed: list[int] = []
        self._index: dict[int, int] = {}
        self._count = 0

    def add_pose(self, key: int, T: FloatArray) -> None:
        """Add an unknown pose with initial estimate `T` (4, 4)."""
        self._values.insert(key, gtsam.Pose3(T))

    def add_prior(self, key: int, T: FloatArray) -> int:
        """Add a prior at `T` (4, 4); return a number to remove it by."""
        noise = gtsam.noiseModel.Isotropic.Sigma(6, PRIOR_SIGMA)
        return self._add(gtsam.PriorFactorPose3(key, gtsam.Pose3(T), noise))

    def add_constraint(self, constraint: Constraint) -> int:
        """Add a measured motion; return a number to remove it by."""
        return self._add(factor_of(constraint, self.settings, robust=True))

    def remove(self, number: int) -> None:
        """Remove a factor of an earlier update."""
        self._removed.append(self._index.pop(number))

    def update(self, thoroughly: bool) -> None:
        """Update with all waiting factors.

        One step is enough where the new poses follow from the old; `thoroughly` iterates until
        the poses rest.

        Raises
        ------
        SlamError
            A pose is undetermined.
        """
        try:
            result = self._isam.update(self._factors, self._values, self._removed)
            if thoroughly:
                self._iterate()
        except RuntimeError as error:
            raise SlamError(
                "pose graph cannot be solved", expected="a constraint to every keyframe",
                got=str(error).splitlines()[0],
            ) from error  # fmt: skip
        self._index.update(zip(self._waiting, result.getNewFactorsIndices(), strict=True))
        self._factors, self._values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        self._waiting, self._removed = [], []

    def pose(self, key: int) -> FloatArray:
        """Return the estimate (4, 4) of one pose."""
        return np.asarray(self._isam.calculateEstimatePose3(key).matrix())

    def poses(self) -> FloatArray:
        """Return all estimates (N, 4, 4) in the order of their keys."""
        rows = np.asarray(gtsam.utilities.extractPose3(self._isam.calculateEstimate()))
        T = np.tile(np.eye(4), (len(rows), 1, 1))
        T[:, :3, :3] = rows[:, :9].reshape(-1, 3, 3)
        T[:, :3, 3] = rows[:, 9:]
        return T

    def _iterate(self) -> None:
        now = self.poses()
        for _ in range(self.settings.iterations):
            self._isam.update(force_relinearize=True)
            before, now = now, self.poses()
            if np.abs(now - before).max() < self.settings.converged_m:
                break

    def _add(self, factor: Any) -> int:
        self._factors.add(factor)
        self._waiting.append(self._count)
        self._count += 1
        return self._count - 1
