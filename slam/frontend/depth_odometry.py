"""Odometry from depth alone, for views without texture: KISS-ICP, prediction and planes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.settings import Settings
from roomgraph.slam.geometry.depth_alignment import Surface, align_surface, surface_of
from roomgraph.slam.geometry.icp import IcpSettings, align_planes
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.planes import Plane, PlaneSettings, extract_planes

FloatArray = NDArray[np.float64]


class DepthOdometrySettings(Settings):
    """When and how the camera is tracked by depth alone."""

    enabled: bool = Field(
        default=True, description="track the camera by depth alone where features fail"
    )
    voxel_m: float = Field(default=0.10, gt=0, le=2, description="KISS-ICP's voxel size")
    stride: int = Field(default=6, ge=1, le=64, description="every n-th pixel is used")
    min_overlap: float = Field(
        default=0.5,
        gt=0,
        le=1,
        description="minimum share of points that lie on the previous surface",
    )
    texture: int = Field(
        default=100, ge=1, description="number of features with depth that makes a view textured"
    )
    min_overlap_textured: float = Field(
        default=0.7,
        gt=0,
        le=1,
        description="minimum overlap for a textured view of which no feature is recognised",
    )
    fit_m: float = Field(
        default=0.08,
        gt=0,
        le=1,
        description="maximum distance of a point from the surface it lies on, metres",
    )
    max_step_m: float = Field(
        default=0.5,
        gt=0,
        le=5,
        description="maximum motion between two frames; a longer one is rejected, metres",
    )
    keyframe_m: float = Field(
        default=0.3,
        gt=0,
        le=5,
        description="distance between keyframes when tracking by depth alone, metres",
    )
    sigma_rotation_rad: float = Field(
        default=0.02,
        gt=0,
        le=1,
        description="rotation error of a step where no surface constrains it, radians",
    )
    sigma_translation_m: float = Field(
        default=0.03,
        gt=0,
        le=1,
        description="translation error of a step where no surface constrains it, metres",
    )


@dataclass(frozen=True, slots=True)
class Step:
    """A motion from the last frame's camera to this one's, with its information (6, 6).

    `is_held` says whether the surfaces leave no direction in which to slide.
    """

    T_camera_last: FloatArray
    information: FloatArray
    is_held: bool = True


class DepthOdometry:
    """Registers depth images one after the other.

    KISS-ICP (Vizzo et al., 2023) is point to point and slides along planes, so it only proposes:
    its motion and the guess are both refined on common planes, then on the whole surface, and the
    one that fits the last depth image better is taken.
    """

    def __init__(
        self,
        settings: DepthOdometrySettings,
        planes: PlaneSettings,
        icp: IcpSettings,
        noise: SensorNoise,
        seed: int = 0,
    ) -> None:
        self.settings, self.planes, self.icp = settings, planes, icp
        self.noise, self.seed = noise, seed
        self._kiss: Any = None
        self._last: Surface | None = None
        self._last_planes: tuple[Plane, ...] = ()

    @property
    def is_tracking(self) -> bool:
        """Whether the camera is tracked by depth at present."""
        return self._last is not None

    def forget(self) -> None:
        """Stop: the camera is tracked by features again."""
        self._kiss, self._last = None, None

    def remember(self, frame: Frame) -> None:
        """Start from the last frame with a pose: the next one is registered to it."""
        self._kiss, self._last = None, surface_of(frame, self.settings.stride)
        self._last_planes = self._planes_of(self._last.cloud)

    def register(
        self, frame: Frame, T_camera_last: FloatArray, is_textured: bool = False
    ) -> Step | None:
        """Return the motion from the last frame to this one, which becomes the last; or None.

        Parameters
        ----------
        frame : Frame
            The new frame.
        T_camera_last : (4, 4) float64
            A guess.
        is_textured : bool
            Whether features were seen, but not recognised: then depth must fit better.
        """
        surface = surface_of(frame, self.settings.stride)
        cloud = surface.cloud
        if self._last is None or min(len(cloud), len(self._last.cloud)) < 200:
            return None
        planes = self._planes_of(cloud)
        steps = [
            self._refine(cloud, planes, T)
            for T in (T_camera_last, self._propose(cloud, T_camera_last))
        ]
        gaps = [self._gaps(cloud, step) for step in steps]
        misfit = [float(gap.mean()) if len(gap) else np.inf for gap in gaps]
        best = int(np.argmin(misfit))
        overlap = float((gaps[best] < self.settings.fit_m).sum()) / len(cloud)
        step = steps[best]
        far = np.linalg.norm(step.T_camera_last[:3, 3]) > self.settings.max_step_m
        needed = self.settings.min_overlap_textured if is_textured else self.settings.min_overlap
        if far or overlap < needed or (is_textured and not step.is_held):
            self.forget()
            return None
        if best == 0:
            self._kiss = None
        self._last, self._last_planes = surface, planes
        return step

    def _propose(self, cloud: FloatArray, T_camera_last: FloatArray) -> FloatArray:
        """Return the motion of KISS-ICP, with the guess as initial estimate."""
        if self._kiss is None:
            self._kiss = self._start()
        start = np.array(self._kiss.last_pose)
        # Sophus ends the whole process over a rotation that rounding has bent.
        self._kiss.last_delta = se3.orthonormal(se3.inverse(T_camera_last))
        self._kiss.register_frame(cloud, np.array([]))
        return np.asarray(se3.inverse(np.array(self._kiss.last_pose)) @ start)

    def _start(self) -> Any:
        from kiss_icp.config import load_config
        from kiss_icp.kiss_icp import KissICP

        assert self._last is not None
        config = load_config(None)
        config.data.max_range, config.data.min_range, config.data.deskew = 10.0, 0.2, False
        config.mapping.voxel_size = self.settings.voxel_m
        config.adaptive_threshold.initial_threshold = 0.2
        config.adaptive_threshold.min_motion_th = 0.01
        config.registration.max_num_threads = 1
        kiss = KissICP(config)
        kiss.register_frame(self._last.cloud, np.array([]))
        return kiss

    def _refine(
        self, cloud: FloatArray, planes: tuple[Plane, ...], T_camera_last: FloatArray
    ) -> Step:
        """Refine a motion on common planes, then on all surfaces; unconstrained directions stay."""
        assert self._last is not None
        sigma = [self.settings.sigma_rotation_rad, self.settings.sigma_translation_m]
        weak = np.diag(np.repeat(sigma, 3) ** -2.0)
        T_last_camera, held = se3.inverse(T_camera_last), weak
        aligned = align_planes(
            planes,
            self._last_planes,
            T_target_source=T_last_camera,
            prior_information=weak,
            noise=self.noise,
            settings=self.icp,
        )
        if aligned is not None and aligned.improves:
            T_last_camera, held = aligned.T_target_source, weak + aligned.information
        T_last_camera, information = align_surface(
            cloud,
            self._last,
            T_target_cloud=T_last_camera,
            prior_information=held,
            noise=self.noise,
            max_distance_m=self.settings.fit_m,
        )
        # From the last camera's frame to this one's, where constraints are weighed.
        T_camera_last = se3.inverse(T_last_camera)
        A = se3.adjoint(T_last_camera)
        # In units of the guess's own errors: how well the direction is held that is held least.
        units = np.repeat(sigma, 3)
        least = float(np.linalg.eigvalsh(information * np.outer(units, units))[0])
        return Step(T_camera_last, A.T @ (held + information) @ A, least > 1.0)

    def _gaps(self, cloud: FloatArray, step: Step) -> FloatArray:
        """Return the depth difference (N,) of points to the last depth image.

        At most twice the fitting distance, metres. Unlike distances to the nearest point, these
        do not favour standing still: the pixels' pattern moves along with the camera.
        """
        assert self._last is not None
        moved = se3.transform(se3.inverse(step.T_camera_last), cloud)
        which, found = self._last.at(moved)
        gap = np.abs(moved[which, 2] - found[:, 2])
        return np.asarray(np.minimum(gap, 2 * self.settings.fit_m))

    def _planes_of(self, cloud: FloatArray) -> tuple[Plane, ...]:
        return (
            extract_planes(cloud, self.noise, self.planes, self.seed) if self.planes.enabled else ()
        )
