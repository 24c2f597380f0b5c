"""Relocalisation of an image in the keyframes of a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.local_map import covisible
from roomgraph.slam.frontend.tracker import Located, Tracker
from roomgraph.slam.relocalisation.keyframe_database import (
    KeyframeDatabase,
    StoredKeyframe,
    joined,
)
from roomgraph.slam.relocalisation.word_index import WordIndex, WordIndexSettings

FloatArray = NDArray[np.float64]


class RelocaliserSettings(Settings):
    """Selection and acceptance of keyframes."""

    candidates: int = Field(
        default=6,
        ge=1,
        le=100,
        description="maximum number of keyframes tried, the most similar first",
    )
    neighbours: int = Field(
        default=3, ge=0, le=50, description="number of neighbouring keyframes added to a candidate"
    )
    min_inliers: int = Field(
        default=30, ge=6, description="minimum number of inlier matches for a pose"
    )
    enough_inliers: int = Field(
        default=120,
        ge=6,
        description="number of inlier matches after which no other candidate is tried",
    )


@dataclass(frozen=True, slots=True)
class Resemblance:
    """Similarity of a keyframe (tf-idf), and the number of inliers of a pose from it.

    `T_world_camera` is that pose (4, 4), or None where no pose was tried or found.
    """

    keyframe: StoredKeyframe
    likeness: float
    inliers: int = 0
    T_world_camera: FloatArray | None = None


@dataclass(frozen=True, slots=True)
class Relocation:
    """The result for an image: candidate keyframes, the best first.

    If any has a pose, those with more agreeing matches come first; else the more alike.
    """

    resemblances: tuple[Resemblance, ...]

    @property
    def best(self) -> Resemblance | None:
        """The best candidate, if there is one."""
        return self.resemblances[0] if self.resemblances else None

    @property
    def T_world_camera(self) -> FloatArray | None:
        """The pose (4, 4) that most matches agree on; None if no pose was found."""
        return self.best.T_world_camera if self.best is not None else None


class Relocaliser:
    """Recognises keyframes by visual words, and estimates the pose from features.

    The words are made anew from the remembered descriptors, in the order of the keyframes: the
    same database gives the same answers. Depth helps where the image has it: without, the pose
    comes from the keyframes' points and the image's pixels alone (PnP).
    """

    def __init__(
        self,
        database: KeyframeDatabase,
        tracker: Tracker,
        settings: RelocaliserSettings,
        appearance: WordIndexSettings,
    ) -> None:
        self.database, self.tracker, self.settings = database, tracker, settings
        self._by_id = {keyframe.id: keyframe for keyframe in database.keyframes}
        self._index = WordIndex(appearance)
        for keyframe in database.keyframes:
            words = self._index.words_of(keyframe.features.descriptors)
            self._index.add(keyframe.id, words)

    def locate(self, view: View) -> Relocation:
        """Find the keyframes that a view resembles and, where enough features agree, its pose."""
        words = self._index.words_of(view.features.descriptors, grow=False)
        ranked = self._index.rank(words, before=max(self._by_id) + 1)
        found = []
        tried: set[int] = set()
        for keyframe_id, likeness in ranked[: self.settings.candidates]:
            keyframe = self._by_id[keyframe_id]
            if keyframe_id in tried:
                found.append(Resemblance(keyframe, likeness))
                continue
            around = self._around(keyframe)
            located = self.tracker.locate(view, joined(around))
            if located is not None and located.inliers < self.settings.min_inliers:
                located = None
            # What is joined to a candidate that fits need not be tried again.
            tried.update(k.id for k in around if located is not None)
            found.append(_measured(keyframe, likeness, located))
            if located is not None and located.inliers >= self.settings.enough_inliers:
                break
        found.sort(key=lambda r: (-r.inliers, -r.likeness, r.keyframe.id))
        return Relocation(tuple(found))

    def _around(self, keyframe: StoredKeyframe) -> list[StoredKeyframe]:
        """Return a keyframe and its nearest neighbours with a similar view direction."""
        T_world = {k.id: k.T_world_keyframe for k in self.database.keyframes}
        others = T_world.keys() - {keyframe.id}
        chosen = covisible(keyframe.id, others, T_world, self.settings.neighbours)
        return [self._by_id[k] for k in chosen]


def _measured(keyframe: StoredKeyframe, likeness: float, located: Located | None) -> Resemblance:
    if located is None:
        return Resemblance(keyframe, likeness)
    T = keyframe.T_world_keyframe @ se3.inverse(located.motion.T_camera_reference)
    return Resemblance(keyframe, likeness, located.inliers, np.asarray(T))
