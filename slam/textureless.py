"""Motion from depth alone, for views without texture: KISS-ICP with a guess."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy.spatial import cKDTree

from datasets import poses
from datasets.frame import Frame
from datasets.settings import Settings
from slam.view import without_edges

FloatArray = NDArray[np.float64]


class TexturelessSettings(Settings):
    """When and how depth alone carries the camera."""

    enabled: bool = Field(True, description="fall back on KISS-ICP where features fail")
    voxel_m: float = Field(0.10, gt=0, le=2, description="KISS-ICP's voxel size")
    stride: int = Field(6, ge=1, le=64, description="every n-th pixel takes part")
    min_overlap: float = Field(
        0.7, gt=0, le=1, description="share of points that must fall onto the cloud before"
    )
    fit_m: float = Field(0.08, gt=0, le=1, description="a point this near falls onto the cloud")
    max_step_m: float = Field(0.5, gt=0, le=5, description="a longer step is not believed")


class DepthOdometry:
    """Registers depth images one after the other with KISS-ICP (Vizzo et al., 2023).

    KISS-ICP is point to point and slides along planes, so it only stands in; the caller hands in
    a guess and refines the result.
    """

    def __init__(self, settings: TexturelessSettings) -> None:
        self.settings = settings
        self._kiss: Any = None
        self._cloud: FloatArray = np.empty((0, 3))

    @property
    def is_tracking(self) -> bool:
        """Whether depth carries the camera at present."""
        return self._kiss is not None

    def forget(self) -> None:
        """Drop the local map: features carry the camera again."""
        self._kiss = None

    def remember(self, frame: Frame) -> None:
        """Keep the cloud of the last frame with a pose: the next one is registered to it."""
        self._cloud = self._cloud_of(frame)
        self.forget()

    def register(self, frame: Frame, T_last_camera: FloatArray) -> FloatArray | None:
        """Return the motion T_last_camera (4, 4) from this frame to the last, or None.

        Parameters
        ----------
        frame : Frame
            The new frame; it becomes the last one if it fits.
        T_last_camera : (4, 4) float64
            A guess.
        """
        cloud = self._cloud_of(frame)
        if len(cloud) < 200 or len(self._cloud) < 200:
            return None
        if self._kiss is None:
            self._kiss = self._start()
        start = np.array(self._kiss.last_pose)
        self._kiss.last_delta = T_last_camera
        self._kiss.register_frame(cloud, np.array([]))
        motion: FloatArray = poses.inverse(start) @ np.array(self._kiss.last_pose)
        if not self._fits(cloud, motion):
            self.forget()
            return None
        self._cloud = cloud
        return motion

    def _start(self) -> Any:
        from kiss_icp.config import load_config
        from kiss_icp.kiss_icp import KissICP

        config = load_config(None)
        config.data.max_range, config.data.min_range, config.data.deskew = 10.0, 0.2, False
        config.mapping.voxel_size = self.settings.voxel_m
        config.adaptive_threshold.initial_threshold = 0.2
        config.adaptive_threshold.min_motion_th = 0.01
        config.registration.max_num_threads = 1
        kiss = KissICP(config)
        kiss.register_frame(self._cloud, np.array([]))
        return kiss

    def _fits(self, cloud: FloatArray, T_last_camera: FloatArray) -> bool:
        if np.linalg.norm(T_last_camera[:3, 3]) > self.settings.max_step_m:
            return False
        distance, _ = cKDTree(self._cloud).query(
            poses.transform(T_last_camera, cloud), distance_upper_bound=self.settings.fit_m
        )
        return bool(np.isfinite(distance).mean() >= self.settings.min_overlap)

    def _cloud_of(self, frame: Frame) -> FloatArray:
        stride = self.settings.stride
        depth = without_edges(frame.depth)[::stride, ::stride]
        rows, columns = np.nonzero(depth > 0)
        pixels = np.column_stack([columns, rows]) * float(stride)
        return frame.intrinsics.backproject(pixels, depth[rows, columns])
