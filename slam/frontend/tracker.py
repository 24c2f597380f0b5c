"""Pose of a view from matches with a local map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.slam.features.matching import Matches, match, match_near
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.local_map import LocalMap
from roomgraph.slam.geometry.motion import Correspondences, MotionSettings, estimate_motion
from roomgraph.slam.geometry.noise import SensorNoise
from roomgraph.slam.geometry.refinement import RefinedMotion, refine_motion

FloatArray = NDArray[np.float64]


class TrackerSettings(Settings):
    """How views are matched to a local map."""

    ratio: float = Field(
        default=0.8,
        gt=0,
        lt=1,
        description="maximum ratio of the nearest to the second nearest descriptor distance "
        "(ratio test)",
    )
    search_share: float = Field(
        default=0.06,
        gt=0,
        le=1,
        description="search radius around predicted positions, as a share of the image's width",
    )
    guided_inliers: int = Field(
        default=40,
        ge=6,
        description="with fewer inliers from guided matching, all features are matched again",
    )
    guided_share: float = Field(
        default=0.5,
        gt=0,
        le=1,
        description="minimum share of inliers among guided matches; below it, RANSAC estimates "
        "the pose",
    )
    min_inliers: int = Field(
        default=15, ge=6, description="minimum number of inlier matches for a pose"
    )
    min_share: float = Field(
        default=0.15,
        ge=0,
        le=1,
        description="minimum share of inliers among the matches for a pose",
    )


@dataclass(frozen=True, slots=True)
class Located:
    """A view's pose, measured against a local map.

    Attributes
    ----------
    local_map : LocalMap
        What it was measured against.
    motion : RefinedMotion
        The pose, ``T_camera_reference``, and its information.
    matches : (N, 2) int
        Points of the local map and features of the view that agree.
    agreement : float
        Their share of all pairs that were found.
    """

    local_map: LocalMap
    motion: RefinedMotion
    matches: Matches
    agreement: float

    @property
    def inliers(self) -> int:
        """Number of inliers."""
        return len(self.matches)

    def matches_by_owner(self) -> dict[int, int]:
        """Return the number of inlier matches by keyframe id."""
        ids, count = np.unique(self.local_map.owners[self.matches[:, 0]], return_counts=True)
        return dict(zip(ids.tolist(), count.tolist(), strict=True))


class Tracker:
    """Finds a view's pose from feature matches with a local map."""

    def __init__(
        self, settings: TrackerSettings, motion: MotionSettings, noise: SensorNoise, seed: int = 0
    ) -> None:
        self.settings, self.motion, self.noise, self.seed = settings, motion, noise, seed

    def track(
        self, view: View, around: LocalMap, T_camera_reference: FloatArray | None
    ) -> Located | None:
        """Return the view's pose, or None if too few features agree on one.

        Points are first looked for where `T_camera_reference`, the prediction, puts them. Where
        few agree, or less than half of what is found, the prediction may be off by a period of
        what is seen (tiles, slats), and they are looked for everywhere as well.
        """
        settings, guided = self.settings, None
        if T_camera_reference is not None:
            guided = self.guided(view, around, T_camera_reference)
            if guided is not None and guided.inliers >= settings.guided_inliers:
                if guided.agreement >= settings.guided_share:
                    return guided
            else:
                guided = None
        found = self.locate(view, around)
        if guided is None or (found is not None and found.inliers > guided.inliers):
            return found
        return guided

    def locate(self, view: View, around: LocalMap) -> Located | None:
        """Return the view's pose by matching all features, the reference keyframe's first."""
        own = np.flatnonzero(around.owners == around.reference)
        for rows in (own, np.arange(len(around.points))):
            pairs = match(around.descriptors[rows], view.features.descriptors, self.settings.ratio)
            pairs[:, 0] = rows[pairs[:, 0]]
            coarse = self._solve(view, around, pairs)
            if coarse is not None:
                finer = self.guided(view, around, coarse.motion.T_camera_reference, scale=0.25)
                better = finer is not None and finer.inliers > coarse.inliers
                return finer if better else coarse
            if len(own) == len(around.points):
                break
        return None

    def guided(
        self, view: View, around: LocalMap, T_camera_reference: FloatArray, scale: float = 1.0
    ) -> Located | None:
        """Return the view's pose from points searched only near their predicted positions.

        `scale` narrows the search radius.
        """
        intrinsics = view.frame.intrinsics
        radius = self.settings.search_share * scale * intrinsics.width
        rows, predicted = around.visible(T_camera_reference, intrinsics, radius)
        pairs = match_near(
            around.descriptors[rows], view.features.descriptors, predicted, view.features.pixels,
            radius, self.settings.ratio,
        )  # fmt: skip
        pairs[:, 0] = rows[pairs[:, 0]]
        pairs = one_a_position(pairs, view.features.pixels)
        if len(pairs) < self.settings.min_inliers:
            return None
        # The prediction is near and wrong matches are few: no need of RANSAC.
        found = correspondences(around.points, view, pairs)
        fine = refine_motion(T_camera_reference, found, intrinsics, self.noise, width=0.25 * radius)
        if fine.count >= max(self.settings.min_inliers, self.settings.guided_share * len(pairs)):
            return _located(around, fine, pairs)
        return self._solve(view, around, pairs)

    def _solve(self, view: View, around: LocalMap, pairs: Matches) -> Located | None:
        """Find the pose that most pairs agree with: RANSAC, then refinement on all of them."""
        pairs = one_a_position(pairs, view.features.pixels)
        found = correspondences(around.points, view, pairs)
        coarse = estimate_motion(found, view.frame.intrinsics, self.noise, self.motion, self.seed)
        if coarse is None:
            return None
        fine = refine_motion(coarse.T_camera_reference, found, view.frame.intrinsics, self.noise)
        enough = max(self.settings.min_inliers, self.settings.min_share * len(pairs))
        return _located(around, fine, pairs) if fine.count >= enough else None


def _located(around: LocalMap, motion: RefinedMotion, pairs: Matches) -> Located:
    return Located(around, motion, pairs[motion.inliers], motion.count / len(pairs))


def correspondences(points: FloatArray, view: View, pairs: Matches) -> Correspondences:
    """Return points paired with their measurements in a view."""
    columns = pairs[:, 1]
    return Correspondences(
        points[pairs[:, 0]], view.features.pixels[columns], view.points_camera[columns, 2]
    )


def one_a_position(pairs: Matches, pixels: FloatArray) -> Matches:
    """Keep one pair per feature position, as SIFT describes a point once per orientation."""
    _, first = np.unique(np.rint(pixels[pairs[:, 1]]), axis=0, return_index=True)
    return pairs[np.sort(first)]
