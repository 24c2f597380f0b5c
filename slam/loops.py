"""Finding loops: which keyframes to compare with, and which comparisons to believe."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets import poses
from datasets.settings import Settings
from slam.appearance import AppearanceIndex, AppearanceSettings
from slam.keyframe import Keyframe
from slam.linker import Linker, Measured
from slam.pose_graph import PoseGraph
from slam.view import View

FloatArray = NDArray[np.float64]


class LoopSettings(Settings):
    """When two keyframes are tried, and when they close a loop."""

    enabled: bool = Field(True, description="look for loops")
    min_gap: int = Field(10, ge=1, description="keyframes that must lie between, at least")
    candidates: int = Field(2, ge=0, description="tried by appearance, for each keyframe")
    neighbours: int = Field(2, ge=0, description="tried by position, for each keyframe")
    min_similarity: float = Field(
        0.3, ge=0, description="of the similarity to the keyframe before, the least to be tried"
    )
    max_distance_m: float = Field(2.0, gt=0, description="tried by position up to this far")
    max_angle_deg: float = Field(45.0, gt=0, le=180, description="and up to this turned")
    min_inliers: int = Field(30, ge=10, description="matches that must agree")


class LoopCloser:
    """Proposes loop candidates by appearance and by position, and verifies them by geometry."""

    def __init__(
        self, settings: LoopSettings, appearance: AppearanceSettings, linker: Linker
    ) -> None:
        self.settings, self.linker = settings, linker
        self.index = AppearanceIndex(appearance)

    def close(
        self,
        view: View,
        keyframe: Keyframe,
        keyframes: dict[int, Keyframe],
        graph: PoseGraph,
        known: set[int],
    ) -> list[Measured]:
        """Return the loop links of a new keyframe, already in the graph, and index it.

        Parameters
        ----------
        known : set of int
            Keyframes that it is linked to anyway; they close no loop.
        """
        words = self.index.words_of(keyframe.features.descriptors)
        measured = []
        if self.settings.enabled:
            tried = self._alike(words, keyframe.id, known)
            tried += [k for k in self._nearby(keyframe.id, graph, known) if k not in tried]
            for candidate in tried:
                link = self.linker.between(view, keyframe, keyframes[candidate])
                if link is not None and link.inliers >= self.settings.min_inliers:
                    measured.append(link)
        self.index.add(keyframe.id, words)
        return measured

    def alike(self, view: View, count: int) -> list[int]:
        """Return the keyframes that look most like a view, for relocalisation."""
        words = self.index.words_of(view.features.descriptors)
        return [keyframe for keyframe, _ in self.index.rank(words, before=2**62)[:count]]

    def _alike(self, words: NDArray[np.intp], keyframe: int, known: set[int]) -> list[int]:
        ranked = self.index.rank(words, before=keyframe)
        likeness = dict(ranked)
        enough = self.settings.min_similarity * likeness.get(keyframe - 1, 0.0)
        return [
            other
            for other, score in ranked
            if score > enough and keyframe - other > self.settings.min_gap and other not in known
        ][: self.settings.candidates]

    def _nearby(self, keyframe: int, graph: PoseGraph, known: set[int]) -> list[int]:
        T_keyframe_world = poses.inverse(graph[keyframe])
        found = []
        for other, T_world_other in graph.poses.items():
            if keyframe - other <= self.settings.min_gap or other in known:
                continue
            T = T_keyframe_world @ T_world_other
            distance, angle = np.linalg.norm(T[:3, 3]), np.degrees(poses.rotation_angle(T))
            if distance < self.settings.max_distance_m and angle < self.settings.max_angle_deg:
                found.append((float(distance) + float(angle) / 45.0, other))
        return [other for _, other in sorted(found)[: self.settings.neighbours]]
