"""The pose graph over keyframes, kept up to date by gtsam's iSAM2."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import gtsam
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets.files import replacing
from datasets.settings import Settings
from slam.errors import SlamError

FloatArray = NDArray[np.float64]


class PoseGraphSettings(Settings):
    """How links between keyframes are weighed."""

    kernel: Literal["huber", "cauchy", "none"] = Field(
        "huber", description="robust kernel on every link"
    )
    kernel_width: float = Field(3.0, gt=0, le=100, description="in standard deviations")
    sigma_rotation_rad: float = Field(
        0.001, gt=0, le=1, description="error of a link beyond what its matches say, radians"
    )
    sigma_translation_m: float = Field(
        0.002, gt=0, le=1, description="error of a link beyond what its matches say, metres"
    )


@dataclass(frozen=True, slots=True)
class Link:
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
    """

    first: int
    second: int
    T_first_second: FloatArray
    information: FloatArray
    is_loop: bool


class PoseGraph:
    """Keyframe poses that agree best with all links between them.

    The first keyframe is held at the pose it is added with. Keys are the plain keyframe ids.
    """

    def __init__(self, settings: PoseGraphSettings) -> None:
        self.settings = settings
        self.links: list[Link] = []
        self._poses: dict[int, FloatArray] = {}
        self._isam = gtsam.ISAM2(gtsam.ISAM2Params())
        self._new_factors = gtsam.NonlinearFactorGraph()
        self._new_values = gtsam.Values()

    def __len__(self) -> int:
        return len(self._poses)

    def __contains__(self, keyframe: int) -> bool:
        return keyframe in self._poses

    def __getitem__(self, keyframe: int) -> FloatArray:
        """Return T_world_keyframe (4, 4)."""
        return self._poses[keyframe]

    @property
    def poses(self) -> dict[int, FloatArray]:
        """All T_world_keyframe (4, 4) by keyframe id."""
        return dict(self._poses)

    def way_between(self, first: int, second: int) -> float:
        """Return the length of the way from one keyframe to the other, in order, metres."""
        keys = [key for key in sorted(self._poses) if first <= key <= second]
        centres = np.array([self._poses[key][:3, 3] for key in keys])
        return float(np.linalg.norm(np.diff(centres, axis=0), axis=1).sum())

    def add_keyframe(self, keyframe: int, T_world_keyframe: FloatArray) -> None:
        """Add a keyframe where it is believed to be; the first one stays there.

        Raises
        ------
        SlamError
            The keyframe is there already.
        """
        if keyframe in self._poses:
            raise SlamError("keyframe is in the graph already", where=f"keyframe {keyframe}")
        if not self._poses:
            prior = gtsam.noiseModel.Isotropic.Sigma(6, 1e-6)
            self._new_factors.add(
                gtsam.PriorFactorPose3(keyframe, gtsam.Pose3(T_world_keyframe), prior)
            )
        self._poses[keyframe] = T_world_keyframe
        self._new_values.insert(keyframe, gtsam.Pose3(T_world_keyframe))

    def add_link(self, link: Link) -> None:
        """Add a measurement between two keyframes of the graph.

        Raises
        ------
        SlamError
            One of the keyframes is not in the graph.
        """
        for keyframe in (link.first, link.second):
            if keyframe not in self._poses:
                raise SlamError("link to an unknown keyframe", where=f"keyframe {keyframe}")
        self.links.append(link)
        self._new_factors.add(self._factor(link, robust=True))

    def optimise(self) -> None:
        """Take the new keyframes and links in and update all poses.

        Raises
        ------
        SlamError
            A keyframe hangs on no link, so its pose is undetermined.
        """
        linked = {key for link in self.links for key in (link.first, link.second)}
        loose = sorted(set(list(self._poses)[1:]) - linked)
        if loose:
            raise SlamError(
                "pose graph cannot be solved", where=f"keyframe {loose[0]}",
                expected="a link to every keyframe",
            )  # fmt: skip
        try:
            self._isam.update(self._new_factors, self._new_values)
            if any(link.is_loop for link in self.links[-8:]):
                for _ in range(3):
                    self._isam.update()
            estimate = self._isam.calculateEstimate()
        except RuntimeError as error:
            raise SlamError(
                "pose graph cannot be solved", expected="a link to every keyframe",
                got=str(error).splitlines()[0],
            ) from error  # fmt: skip
        self._new_factors = gtsam.NonlinearFactorGraph()
        self._new_values = gtsam.Values()
        self._poses = {key: estimate.atPose3(key).matrix() for key in self._poses}

    def write_g2o(self, path: Path) -> None:
        """Write poses and links, without kernels, for other tools (``VERTEX_SE3:QUAT``)."""
        factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        for key, T in self._poses.items():
            values.insert(key, gtsam.Pose3(T))
        for link in self.links:
            factors.add(self._factor(link, robust=False))
        with replacing(path) as temporary:
            gtsam.writeG2o(factors, values, str(temporary))

    def _factor(self, link: Link, robust: bool) -> Any:
        floor = np.repeat([self.settings.sigma_rotation_rad, self.settings.sigma_translation_m], 3)
        covariance = np.linalg.inv(link.information + 1e-6 * np.eye(6)) + np.diag(floor**2)
        noise = gtsam.noiseModel.Gaussian.Covariance((covariance + covariance.T) / 2)
        if robust and self.settings.kernel != "none":
            kernels = gtsam.noiseModel.mEstimator
            kernel = {"huber": kernels.Huber, "cauchy": kernels.Cauchy}[self.settings.kernel]
            noise = gtsam.noiseModel.Robust.Create(kernel.Create(self.settings.kernel_width), noise)
        return gtsam.BetweenFactorPose3(
            link.first, link.second, gtsam.Pose3(link.T_first_second), noise
        )
