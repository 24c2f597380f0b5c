"""Motion from depth alone, for views without texture: KISS-ICP, a guess, and planes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy.spatial import cKDTree

from datasets import poses
from datasets.frame import Frame
from datasets.settings import Settings
from slam.icp import IcpSettings, align_planes
from slam.noise import SensorNoise
from slam.planes import Plane, PlaneSettings, extract_planes
from slam.view import without_edges

FloatArray = NDArray[np.float64]


class TexturelessSettings(Settings):
    """When and how depth alone carries the camera."""

    enabled: bool = Field(True, description="fall back on depth alone where features fail")
    voxel_m: float = Field(0.10, gt=0, le=2, description="KISS-ICP's voxel size")
    stride: int = Field(6, ge=1, le=64, description="every n-th pixel takes part")
    min_overlap: float = Field(
        0.7, gt=0, le=1, description="share of points that must fall onto the cloud before"
    )
    fit_m: float = Field(0.08, gt=0, le=1, description="a point this near falls onto the cloud")
    clearly_better: float = Field(
        0.9, gt=0, le=1, description="KISS-ICP's misfit, as a share of the guess's, to be taken"
    )
    max_step_m: float = Field(0.5, gt=0, le=5, description="a longer step is not believed")
    sigma_rotation_rad: float = Field(
        0.02, gt=0, le=1, description="error of a step where no plane holds it, radians"
    )
    sigma_translation_m: float = Field(
        0.03, gt=0, le=1, description="error of a step where no plane holds it, metres"
    )


@dataclass(frozen=True, slots=True)
class Surface:
    """What depth alone knows of a frame: a thinned cloud (N, 3) in metres, and its planes."""

    cloud: FloatArray
    planes: tuple[Plane, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """A motion from the last frame's camera to this one's, with its information (6, 6)."""

    T_camera_last: FloatArray
    information: FloatArray


class DepthOdometry:
    """Registers depth images one after the other.

    KISS-ICP (Vizzo et al., 2023) is point to point and slides along planes, so it only proposes:
    its motion and the guess are both refined on common planes, and the guess is taken unless the
    clouds lie clearly closer together after KISS-ICP's.
    """

    def __init__(
        self,
        settings: TexturelessSettings,
        planes: PlaneSettings,
        icp: IcpSettings,
        noise: SensorNoise,
    ) -> None:
        self.settings, self.planes, self.icp, self.noise = settings, planes, icp, noise
        self._kiss: Any = None
        self._last: Surface | None = None

    @property
    def is_tracking(self) -> bool:
        """Whether depth carries the camera at present."""
        return self._last is not None

    def forget(self) -> None:
        """Stop: features carry the camera again."""
        self._kiss, self._last = None, None

    def remember(self, frame: Frame) -> None:
        """Start from the last frame with a pose: the next one is registered to it."""
        self._kiss, self._last = None, self._surface_of(frame)

    def register(self, frame: Frame, T_camera_last: FloatArray) -> Step | None:
        """Return the step from the last frame to this one, which becomes the last; or None.

        Parameters
        ----------
        frame : Frame
            The new frame.
        T_camera_last : (4, 4) float64
            A guess.
        """
        surface = self._surface_of(frame)
        if self._last is None or min(len(surface.cloud), len(self._last.cloud)) < 200:
            return None
        proposed = self._propose(surface.cloud, T_camera_last)
        tree = cKDTree(self._last.cloud)
        steps = [self._on_planes(surface, T) for T in (T_camera_last, proposed)]
        distances = [self._distances(tree, surface.cloud, step) for step in steps]
        misfit = [float(distance.mean()) for distance in distances]
        # Sliding along a wall hardly changes the misfit: KISS-ICP has to be clearly better.
        best = int(misfit[1] < self.settings.clearly_better * misfit[0])
        overlap = float((distances[best] < self.settings.fit_m).mean())
        step = steps[best]
        far = np.linalg.norm(step.T_camera_last[:3, 3]) > self.settings.max_step_m
        if far or overlap < self.settings.min_overlap:
            self.forget()
            return None
        if best == 0:
            self._kiss = None
        self._last = surface
        return step

    def _propose(self, cloud: FloatArray, T_camera_last: FloatArray) -> FloatArray:
        """Return KISS-ICP's motion, started at the guess."""
        if self._kiss is None:
            self._kiss = self._start()
        start = np.array(self._kiss.last_pose)
        self._kiss.last_delta = poses.inverse(T_camera_last)
        self._kiss.register_frame(cloud, np.array([]))
        return np.asarray(poses.inverse(np.array(self._kiss.last_pose)) @ start)

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

    def _on_planes(self, surface: Surface, T_camera_last: FloatArray) -> Step:
        """Refine a motion on common planes; where they leave it free, it is held weakly."""
        assert self._last is not None
        settings = self.settings
        sigma = np.repeat([settings.sigma_rotation_rad, settings.sigma_translation_m], 3)
        weak = np.diag(sigma**-2.0)
        aligned = align_planes(
            self._last.planes, surface.planes, T_camera_last, weak, self.noise, self.icp
        )
        if aligned is None or not aligned.improves:
            return Step(T_camera_last, weak)
        return Step(aligned.T_target_source, weak + aligned.information)

    def _distances(self, tree: Any, cloud: FloatArray, step: Step) -> FloatArray:
        """Return how far each point is from the last cloud, at most twice the fitting distance."""
        moved = poses.transform(poses.inverse(step.T_camera_last), cloud)
        distance, _ = tree.query(moved, distance_upper_bound=2 * self.settings.fit_m)
        return np.asarray(np.minimum(distance, 2 * self.settings.fit_m))

    def _surface_of(self, frame: Frame) -> Surface:
        stride = self.settings.stride
        depth = without_edges(frame.depth)[::stride, ::stride]
        rows, columns = np.nonzero(depth > 0)
        pixels = np.column_stack([columns, rows]) * float(stride)
        cloud = frame.intrinsics.backproject(pixels, depth[rows, columns])
        planes = extract_planes(cloud, self.noise, self.planes) if self.planes.enabled else ()
        return Surface(cloud, planes)
