"""Bag-of-words index: an inverted index over visual words learned online."""

from __future__ import annotations

from array import array
from collections import defaultdict
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.slam.features.matching import squared_distances


class WordIndexSettings(Settings):
    """How visual words are built from descriptors."""

    max_words: int = Field(default=4096, ge=16, description="maximum number of visual words")
    radius: float = Field(
        default=0.55,
        gt=0,
        le=2,
        description="a descriptor further than this from all words becomes a new word, as a share"
        " of its norm",
    )
    features: int = Field(default=300, ge=20, description="number of features indexed per keyframe")


class WordIndex:
    """Ranks past keyframes by shared visual words, weighted by tf-idf.

    The vocabulary needs no training: a descriptor far from every word becomes a word itself
    (leader clustering), until there are enough. After Sivic & Zisserman (2003), and Angeli et
    al. (2008) for the vocabulary that grows online.

    One thread may make words while another adds keyframes and ranks them.
    """

    def __init__(self, settings: WordIndexSettings) -> None:
        self.settings = settings
        self._words: NDArray[Any] = np.empty((0, 0))
        # By word: the keyframes that hold it, and its weight in each.
        self._holders: defaultdict[int, tuple[array[int], array[float]]] = defaultdict(
            lambda: (array("q"), array("d"))
        )
        self._keyframes = 0

    def words_of(self, descriptors: NDArray[Any], grow: bool = True) -> NDArray[np.intp]:
        """Return the word (n,) of each of the descriptors (N, D), new ones made where needed.

        Without `grow` no new ones are made: descriptors far from every word are left out.
        """
        descriptors = descriptors[: self.settings.features]
        if not len(descriptors) or not (grow or len(self._words)):
            return np.empty(0, dtype=np.intp)
        limit = self._limit(descriptors)
        if not len(self._words):
            self._words = descriptors[:1].copy()
        nearest, distance = _nearest(descriptors, self._words)
        is_far = distance > limit
        if not grow:
            return nearest[~is_far]
        leaders = self._leaders(descriptors[is_far], limit)
        if len(leaders):
            among, other = _nearest(descriptors, leaders)
            nearest = np.where(other < distance, len(self._words) + among, nearest)
            self._words = np.vstack([self._words, leaders])
        return nearest

    def _leaders(self, descriptors: NDArray[Any], limit: float) -> NDArray[Any]:
        """Return those of the descriptors that lie far from each one chosen before them."""
        room = self.settings.max_words - len(self._words)
        if not len(descriptors) or room <= 0:
            return descriptors[:0]
        between = squared_distances(descriptors, descriptors)
        leaders = [0]
        for i in range(1, len(between)):
            if len(leaders) < room and between[i, leaders].min() > limit:
                leaders.append(i)
        return descriptors[leaders]

    def add(self, keyframe: int, words: NDArray[np.intp]) -> None:
        """Index a keyframe by its words."""
        found, count = np.unique(words, return_counts=True)
        length = float(np.sqrt((count**2).sum())) or 1.0
        for word, n in zip(found.tolist(), count.tolist(), strict=True):
            keyframes, weights = self._holders[word]
            keyframes.append(keyframe)
            weights.append(n / length)
        self._keyframes += 1

    def rank(self, words: NDArray[np.intp], before: int) -> list[tuple[int, float]]:
        """Return the keyframes with ids below `before` and their scores, the most similar first."""
        found, count = np.unique(words, return_counts=True)
        length = float(np.sqrt((count**2).sum())) or 1.0
        keyframes, scores = [np.empty(0, dtype=np.int64)], [np.empty(0)]
        for word, n in zip(found.tolist(), count.tolist(), strict=True):
            if word in self._holders:
                holders, weights = (np.array(column) for column in self._holders[word])
                rarity = np.log((1 + self._keyframes) / (1 + len(holders)))
                keyframes.append(holders)
                scores.append(rarity * n / length * weights)
        total = np.bincount(np.concatenate(keyframes), np.concatenate(scores))[:before]
        order = np.argsort(-total, kind="stable")[: np.count_nonzero(total)]
        return list(zip(order.tolist(), total[order].tolist(), strict=True))

    def _limit(self, descriptors: NDArray[Any]) -> float:
        """Return the squared radius in the descriptors' own unit."""
        if descriptors.dtype == np.uint8:
            return float(self.settings.radius * descriptors.shape[1] * 8 / 2) ** 2
        norm = float(np.sqrt((descriptors[0] ** 2).sum()))
        return (self.settings.radius * norm) ** 2


def _nearest(
    descriptors: NDArray[Any], words: NDArray[Any]
) -> tuple[NDArray[np.intp], NDArray[np.float32]]:
    """Return the nearest word (N,) of each descriptor, and its squared distance (N,)."""
    distance = squared_distances(descriptors, words)
    nearest = distance.argmin(axis=1)
    return nearest, distance[np.arange(len(nearest)), nearest]
