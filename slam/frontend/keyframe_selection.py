"""Keyframe selection."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.settings import Settings
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.estimate import Estimate

FloatArray = NDArray[np.float64]


class KeyframeSettings(Settings):
    """When a view becomes a keyframe."""

    min_overlap: float = Field(
        default=0.75,
        gt=0,
        le=1,
        description="a keyframe is added when a smaller share of the reference's points is in view",
    )
    min_explained: float = Field(
        default=0.3,
        gt=0,
        le=1,
        description="with a smaller share of features found in the local map, min_change applies",
    )
    min_followed: float = Field(
        default=0.5,
        gt=0,
        le=1,
        description="a keyframe is added when a smaller share of the template's corners is tracked",
    )
    min_change: float = Field(
        default=0.25, ge=0, le=1,
        description="share of the usual change that makes a keyframe where few features are found"
        " in the local map",
    )  # fmt: skip
    max_baseline_share: float = Field(
        default=0.15,
        gt=0,
        le=2,
        description="maximum distance from the reference keyframe, as a share of the median depth",
    )
    max_angle_deg: float = Field(
        default=20.0,
        gt=0,
        le=180,
        description="maximum rotation from the reference keyframe, degrees",
    )
    same_m: float = Field(
        default=0.05,
        gt=0,
        le=1,
        description="an old keyframe is reused if both poses agree within this distance, metres",
    )
    same_deg: float = Field(
        default=2.0, gt=0, le=30, description="and within this rotation, degrees"
    )
    neighbours: int = Field(
        default=3,
        ge=0,
        le=50,
        description="number of keyframes tracked in addition to the reference",
    )


class KeyframeSelector:
    """Compares views with their reference keyframe.

    Parameters
    ----------
    settings : KeyframeSettings
        How much has to change.
    depth_way_m : float
        Way from one keyframe to the next where depth alone is to go by, metres.

    Attributes
    ----------
    outline : (N, 3) float64
        Points of the keyframe tracked against, in its camera, metres.
    """

    def __init__(self, settings: KeyframeSettings, depth_way_m: float) -> None:
        self.settings, self.depth_way_m = settings, depth_way_m
        self.outline: FloatArray = np.empty((0, 3))

    def wants(self, view: View, estimate: Estimate) -> bool:
        """Whether a view shows new space, or overlaps too little with its keyframe."""
        if not view.has_depth:
            return False
        settings, T = self.settings, estimate.T_camera_reference
        way = float(np.linalg.norm(T[:3, 3]))
        change = float(np.degrees(se3.rotation_angle(T))) / settings.max_angle_deg
        if estimate.method == "depth" or not len(self.outline):
            return max(change, way / self.depth_way_m) > 1
        gone = 1 - self._overlap(T, view.frame.intrinsics)
        change = max(
            change,
            way / (settings.max_baseline_share * self._depth),
            gone / max(1 - settings.min_overlap, 1e-6),
        )
        if estimate.method == "flow":
            return change > 1 or estimate.support < settings.min_followed
        # Features that are not found again without a change of place are blurred, or mere noise:
        # those of a new keyframe would be no better.
        poor = estimate.support < settings.min_explained
        return change > (settings.min_change if poor else 1)

    def nearest(self, T_world_camera: FloatArray, T_world_others: FloatArray) -> int | None:
        """Return the most similar view among keyframes (N, 4, 4), if one is near enough."""
        if not len(T_world_others) or not len(self.outline):
            return None
        T = se3.inverse(T_world_camera) @ T_world_others
        away = np.linalg.norm(T[:, :3, 3], axis=1) / (
            self.settings.max_baseline_share * self._depth
        )
        cosine = (np.trace(T[:, :3, :3], axis1=1, axis2=2) - 1) / 2
        turned = np.degrees(np.arccos(np.clip(cosine, -1, 1))) / self.settings.max_angle_deg
        nearest = int((away + turned).argmin())
        return nearest if away[nearest] + turned[nearest] < 1 else None

    def serves(self, known: Estimate, T_camera_other: FloatArray) -> bool:
        """Whether an older keyframe can be reused for a view tracked at `T_camera_other`."""
        settings = self.settings
        off = se3.inverse(T_camera_other) @ known.T_camera_reference
        return bool(
            np.linalg.norm(off[:3, 3]) < settings.same_m
            and np.degrees(se3.rotation_angle(off)) < settings.same_deg
            and known.support > settings.min_explained
        )

    @property
    def _depth(self) -> float:
        """Median depth of the outline, metres."""
        return float(np.median(self.outline[:, 2]))

    def _overlap(self, T_camera_reference: FloatArray, intrinsics: Intrinsics) -> float:
        """Return the share of the outline that a camera would see."""
        moved = se3.transform(T_camera_reference, self.outline)
        pixels = intrinsics.project(moved[moved[:, 2] > 0.1])
        inside = np.all((pixels >= 0) & (pixels < (intrinsics.width, intrinsics.height)), axis=1)
        return float(inside.sum() / len(self.outline))
