"""Small models, frames and graphs for the tests of this folder."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from roomgraph.datasets.se3 import pose
from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier
from roomgraph.semantics.descriptors.histogram import BagOfFeatures, normalise
from roomgraph.semantics.descriptors.neural_gas import NeuralGas
from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.temporal.labeller import FrameLabel
from roomgraph.slam.features.extraction import Features, FeatureSettings
from roomgraph.slam.tracking import Anchor, Tracking, TrackingState


def features(descriptors: np.ndarray) -> Features:
    n = len(descriptors)
    return Features(np.zeros((n, 2)), descriptors, np.ones(n, np.float32))


def descriptors_of(word: int, n: int = 20, n_words: int = 4) -> np.ndarray:
    """`n` descriptors of 8 numbers; most lie on `word`, some on the last word."""
    words = np.where(np.arange(n) % 4 == 3, n_words - 1, word)
    return (10.0 * np.eye(8)[words]).astype(np.float32)


def tiny_model() -> PlaceModel:
    """A model of three labels, each with a word of its own; the fourth word is everywhere."""
    bag = BagOfFeatures(NeuralGas.from_prototypes((10 * np.eye(8)[:4]).astype(np.float32)))
    names = ["corridor", "kitchen", "office"]
    counts = np.array([bag.counts(descriptors_of(k, n)) for k in range(3) for n in range(12, 32)])
    classifier = PlaceClassifier(random_state=0).fit(normalise(counts, "l1"), np.repeat(names, 20))
    return PlaceModel(LabelSpace.of(names), bag, classifier, FeatureSettings())


def seen(found: Features) -> SimpleNamespace:
    """What of a view the semantic layer looks at."""
    return SimpleNamespace(features=found)


def tracking(
    index: int, x: float = 0.0, y: float = 0.0, word: int = 0, keyframe: int = 0, lost: bool = False
) -> Tracking:
    """A frame at (x, y, 0) relative to a keyframe, or a lost one."""
    anchor = None if lost else Anchor(keyframe, pose(t=[x, y, 0.0]))
    state = TrackingState.LOST if lost else TrackingState.OK
    return Tracking(
        index, index / 30, state, 50, "features", anchor, None, False, (),
        np.empty((0, 2)), seen(features(descriptors_of(word))),
    )  # fmt: skip


def frame_label(
    index: int,
    x: float,
    y: float = 0.0,
    label: str = "office",
    histogram: np.ndarray | None = None,
    keyframe: int = 0,
    lost: bool = False,
) -> FrameLabel:
    labels = label_space()
    return FrameLabel(
        tracking(index, x, y, keyframe=keyframe, lost=lost), label, labels.id_of(label), 0.9,
        label, view(0) if histogram is None else histogram,
    )  # fmt: skip


def label_space() -> LabelSpace:
    return LabelSpace.of(["corridor", "kitchen", "office"])


def view(k: int, n_words: int = 16) -> np.ndarray:
    """Unit histograms; two different ones are sqrt(2) apart."""
    return np.eye(n_words)[k]
