"""Small models, frames and graphs for the tests of this folder."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roomgraph.datasets.se3 import pose
from roomgraph.semantics.classifiers.linear_svm import LinearSvm
from roomgraph.semantics.descriptors.words import WordsDescriptor, WordsSettings
from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.semantics.temporal.labeller import FrameLabel
from roomgraph.semantics.temporal.look import FrameInput
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.tracking import Anchor

KINDS = ("bathroom", "corridor", "kitchen")
# Rooms are only reached through the corridor.
MOVES = count_transitions([["bathroom", "corridor", "kitchen", "corridor"] * 40], KINDS)


def features(descriptors: np.ndarray) -> Features:
    n = len(descriptors)
    return Features(np.zeros((n, 2)), descriptors, np.ones(n, np.float32))


def descriptors_of(word: int, n: int = 20, n_words: int = 4) -> np.ndarray:
    """`n` descriptors of 8 numbers; most lie on `word`, some on the last word."""
    words = np.where(np.arange(n) % 4 == 3, n_words - 1, word)
    return (10.0 * np.eye(8)[words]).astype(np.float32)


def tiny_model() -> PlaceModel:
    """A model of three labels, each with a word of its own; the fourth word is everywhere."""
    settings = WordsSettings(n_words=4, normalisation="l1")
    descriptor = WordsDescriptor(settings).with_arrays(
        {"prototypes": (10 * np.eye(8)[:4]).astype(np.float32)}
    )
    names = ["corridor", "kitchen", "office"]
    images = [descriptors_of(k, n) for k in range(3) for n in range(12, 32)]
    vectors = np.array([descriptor.describe(image).vector for image in images])
    classifier = LinearSvm(random_state=0).fit(vectors, np.repeat(names, 20))
    return PlaceModel(labels=LabelSpace.of(names), descriptor=descriptor, classifier=classifier)


def frame(index: int, word: int = 0, x: float | None = None, n: int = 20) -> FrameInput:
    """A frame with `n` features, most of one word; at (x, 0, 0) if that is given."""
    position = None if x is None else np.array([x, 0.0, 0.0])
    return FrameInput(
        index, index / 30, features=features(descriptors_of(word, n)), position_world=position
    )


def anchor(x: float, y: float = 0.0, keyframe: int = 0) -> Anchor:
    """A pose at (x, y, 0) in front of a keyframe."""
    return Anchor(keyframe, pose(t=[x, y, 0.0]))


def frame_label(
    index: int, label: str = "office", signature: np.ndarray | None = None
) -> FrameLabel:
    labels = label_space()
    return FrameLabel(
        index, index / 30, label, labels.id_of(label), 0.9, label,
        view(0) if signature is None else signature,
    )  # fmt: skip


def looks(kinds: Sequence[int], sure: float = 0.6) -> np.ndarray:
    """Probabilities (N, 3) of looks that each show a kind, the others alike."""
    other = (1 - sure) / 2
    return np.array([[sure if k == i else other for i in range(3)] for k in kinds])


def label_space() -> LabelSpace:
    return LabelSpace.of(["corridor", "kitchen", "office"])


def view(k: int, n_words: int = 16) -> np.ndarray:
    """Unit signatures; two different ones are sqrt(2) apart."""
    return np.eye(n_words)[k]
