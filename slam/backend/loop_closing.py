"""Loop closing: candidates for a keyframe, and their verification."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.backend.alignment import KeyframeAligner, Measured
from roomgraph.slam.backend.loop_verification import LoopVerificationSettings, LoopVerifier
from roomgraph.slam.backend.pose_graph import PoseGraph
from roomgraph.slam.features.view import View
from roomgraph.slam.geometry.overlap import overlap
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.relocalisation.word_index import WordIndex, WordIndexSettings

FloatArray = NDArray[np.float64]


class LoopSettings(Settings):
    """Selection and acceptance of loop candidates."""

    enabled: bool = Field(default=True, description="search for loop closures")
    min_way_m: float = Field(
        default=0.0,
        ge=0,
        le=1000,
        description="minimum path length along constraints between two keyframes for a loop, "
        "metres",
    )
    candidates: int = Field(
        default=2, ge=0, description="maximum number of candidates by appearance, for each keyframe"
    )
    neighbours: int = Field(
        default=2, ge=0, description="maximum number of candidates by position, for each keyframe"
    )
    min_similarity: float = Field(
        default=0.3,
        ge=0,
        description="minimum similarity, as a share of that to the previous keyframe, for a "
        "keyframe to be tried",
    )
    max_distance_m: float = Field(
        default=2.0, gt=0, description="maximum distance of a candidate by position, metres"
    )
    max_angle_deg: float = Field(
        default=45.0,
        gt=0,
        le=180,
        description="maximum angle between optical axes for a candidate by position, degrees",
    )
    min_inliers: int = Field(default=30, ge=10, description="minimum number of inlier matches")
    min_agreement: float = Field(
        default=0.7,
        ge=0,
        le=1,
        description="minimum share of points in both views whose depth agrees",
    )
    min_correlation: float = Field(
        default=0.7,
        ge=-1,
        le=1,
        description="minimum correlation of grey levels on the surface that both views show",
    )
    verification: LoopVerificationSettings = LoopVerificationSettings()


class LoopCloser:
    """Proposes loop candidates by appearance and by position, and verifies them by geometry."""

    def __init__(
        self, settings: LoopSettings, appearance: WordIndexSettings, aligner: KeyframeAligner
    ) -> None:
        self.settings, self.aligner = settings, aligner
        self.index = WordIndex(appearance)
        self.verifier = LoopVerifier(settings.verification)

    def close(
        self,
        view: View,
        keyframe: Keyframe,
        keyframes: dict[int, Keyframe],
        graph: PoseGraph,
        known: set[int],
    ) -> list[Measured]:
        """Return the loop constraints to add for a new keyframe of the graph, and index it.

        A loop that others confirm later is returned with these, so not all need be the new
        keyframe's.

        Parameters
        ----------
        known : set of int
            Keyframes that it is linked to anyway; they close no loop.
        """
        taken: list[Measured] = []
        if self.settings.enabled:
            known = known | graph.around(keyframe.id, self.settings.min_way_m)
            tried = self._alike(keyframe, known)
            tried += [k for k in self._nearby(keyframe.id, graph, known) if k not in tried]
            for candidate in tried:
                measured = self.aligner.between(view, keyframe, keyframes[candidate])
                if measured is not None and self.is_sound(
                    measured.inliers, se3.inverse(measured.constraint.T_first_second), view,
                    keyframes[candidate],
                ):  # fmt: skip
                    taken = self.verifier.admit(measured, graph, keyframe.intrinsics.view_deg)
                    break
        self.index.add(keyframe.id, keyframe.words)
        return taken

    def alike(self, view: View, count: int) -> list[int]:
        """Return the keyframes most similar to a view, for relocalisation."""
        words = self.index.words_of(view.features.descriptors, grow=False)
        return [keyframe for keyframe, _ in self.index.rank(words, before=2**62)[:count]]

    def is_sound(self, inliers: int, T_view_other: FloatArray, view: View, other: Keyframe) -> bool:
        """Whether enough matches, depth and appearance support a motion between similar views."""
        if inliers < self.settings.min_inliers:
            return False
        common = overlap(other.thumbnail, view.thumbnail, T_view_other)
        return common.depth_agreement >= self.settings.min_agreement and common.looks_alike(
            self.settings.min_correlation
        )

    def _alike(self, keyframe: Keyframe, known: set[int]) -> list[int]:
        ranked = self.index.rank(keyframe.words, before=keyframe.id)
        likeness = dict(ranked)
        enough = self.settings.min_similarity * likeness.get(keyframe.id - 1, 0.0)
        return [
            other
            for other, score in ranked[: self.settings.candidates + len(known)]
            if score > enough and other not in known
        ][: self.settings.candidates]

    def _nearby(self, keyframe: int, graph: PoseGraph, known: set[int]) -> list[int]:
        """Return old keyframes whose poses suggest that they see the same, the nearest first."""
        others, T_world_other = graph.stacked()
        T = se3.inverse(graph[keyframe]) @ T_world_other
        distance = np.linalg.norm(T[:, :3, 3], axis=1)
        # How far apart the optical axes point.
        angle = np.degrees(np.arccos(np.clip(T[:, 2, 2], -1, 1)))
        near = (distance < self.settings.max_distance_m) & (angle < self.settings.max_angle_deg)
        order = np.argsort(distance + angle / 45.0, kind="stable")
        ordered = (int(others[i]) for i in order if near[i])
        return [k for k in ordered if k not in known and k < keyframe][: self.settings.neighbours]
