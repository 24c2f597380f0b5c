"""Tracking by optical flow from a template frame, which tracks most frames."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.features.view import View, depth_at
from roomgraph.slam.geometry.motion import Correspondences
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.refinement import RefinedMotion, refine_motion
from roomgraph.slam.tracking import Anchor

FloatArray = NDArray[np.float64]


class FlowSettings(Settings):
    """How corners are chosen and tracked."""

    enabled: bool = Field(
        default=True, description="track corners by optical flow between keyframes"
    )
    corners: int = Field(
        default=400, ge=20, le=5000, description="maximum number of corners tracked"
    )
    quality: float = Field(
        default=0.005,
        gt=0,
        lt=1,
        description="minimum corner strength, as a share of the strongest",
    )
    spacing_share: float = Field(
        default=0.015,
        gt=0,
        lt=1,
        description="minimum distance between corners, as a share of the image's width",
    )
    window: int = Field(
        default=15, ge=5, le=101, description="side of the patch that is tracked, pixels"
    )
    levels: int = Field(
        default=3, ge=0, le=6, description="number of times the image is halved for the pyramid"
    )
    min_inliers: int = Field(
        default=40, ge=6, description="with fewer inliers, features are matched instead"
    )
    min_share: float = Field(
        default=0.5, gt=0, le=1, description="minimum share of inliers among the corners in view"
    )


@dataclass(frozen=True, slots=True)
class Template:
    """A frame whose corners are tracked in later frames.

    Attributes
    ----------
    anchor : Anchor
        Where it was taken.
    grey : (H, W) uint8
        The image.
    pixels : (N, 2) float64
        Its corners.
    points : (N, 3) float64
        Where they lie in its camera, metres.
    """

    anchor: Anchor
    grey: NDArray[np.uint8]
    pixels: FloatArray
    points: FloatArray


class FlowTracker:
    """Finds a view's pose from corners followed from a template (Lucas & Kanade; Bouguet, 2000).

    The corners are looked for where a predicted motion puts them, in the template's own image, so
    errors do not add up from frame to frame.
    """

    def __init__(self, settings: FlowSettings, noise: SensorNoise) -> None:
        self.settings, self.noise = settings, noise

    def template(self, view: View, anchor: Anchor) -> Template:
        """Choose the corners of a view (Shi & Tomasi, 1994) that have depth."""
        grey, settings = view.grey, self.settings
        small = cv2.resize(grey, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
        spacing = settings.spacing_share * small.shape[1]
        found = cv2.goodFeaturesToTrack(small, 3 * settings.corners, settings.quality, spacing)
        pixels = np.empty((0, 2)) if found is None else found[:, 0].astype(np.float64)
        pixels = (pixels + 0.5) * 2 - 0.5
        depth = depth_at(view.frame.depth, pixels)
        kept = np.flatnonzero(depth > 0)[: settings.corners]
        points = view.frame.intrinsics.backproject(pixels[kept], depth[kept])
        return Template(anchor, grey, pixels[kept], points)

    def track(
        self, view: View, template: Template, T_camera_template: FloatArray
    ) -> tuple[RefinedMotion, FloatArray] | None:
        """Return the motion from the template to a view, and where it shows the corners (N, 2).

        None if too few agree.

        Parameters
        ----------
        T_camera_template : (4, 4) float64
            The prediction.
        """
        settings, intrinsics = self.settings, view.frame.intrinsics
        if view.grey.shape != template.grey.shape:
            return None
        moved = se3.transform(T_camera_template, template.points)
        ahead = np.flatnonzero(moved[:, 2] > 0.1)
        predicted = intrinsics.project(moved[ahead])
        inside = np.all((predicted >= 0) & (predicted < (intrinsics.width, intrinsics.height)), 1)
        rows, predicted = ahead[inside], predicted[inside]
        if len(rows) < settings.min_inliers:
            return None
        pixels, status, _ = cv2.calcOpticalFlowPyrLK(
            template.grey, view.grey,
            np.float32(template.pixels[rows]),
            np.ascontiguousarray(predicted, dtype=np.float32),
            winSize=(settings.window, settings.window), maxLevel=settings.levels,
            criteria=(cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 20, 0.03),
            flags=cv2.OPTFLOW_USE_INITIAL_FLOW,
        )  # fmt: skip
        pixels = pixels.reshape(-1, 2).astype(np.float64)
        followed = (status[:, 0] > 0) & np.all(
            (pixels >= 0) & (pixels < (intrinsics.width, intrinsics.height)), axis=1
        )
        seen = pixels[followed]
        if len(seen) < settings.min_inliers:
            return None
        depth = depth_at(view.frame.depth, seen)
        depth[depth <= 0] = np.nan
        found = Correspondences(template.points[rows[followed]], seen, depth)
        motion = refine_motion(T_camera_template, found, intrinsics, self.noise, width=8.0)
        enough = max(settings.min_inliers, settings.min_share * len(rows))
        return (motion, seen[motion.inliers]) if motion.count >= enough else None
