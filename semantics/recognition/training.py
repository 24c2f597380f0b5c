"""Learning a place model from labelled images."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier
from roomgraph.semantics.descriptors.histogram import BagOfFeatures
from roomgraph.semantics.descriptors.neural_gas import NeuralGas
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.description import Described, describe_images
from roomgraph.semantics.recognition.encoding import learn_encoder, sample_of, vectors_of
from roomgraph.semantics.recognition.examples import Example, thin_out
from roomgraph.semantics.recognition.model import Exemplars, PlaceModel
from roomgraph.semantics.recognition.presets import TrainingSettings
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.slam.features.extraction import FeatureSettings

logger = logging.getLogger(__name__)

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class TrainingSummary:
    """What the training saw and how well it fits.

    Attributes
    ----------
    images : dict of str to int
        Images used, by label.
    unreadable, featureless : int
        Images left out: not readable, or with too few features.
    descriptors : int
        Descriptors that the words were learned from.
    quantization_error : float
        Mean squared distance of those to their words, in the descriptors' units.
    cross_validated_accuracy : float
        Share of images labelled rightly by machines trained without their group: their visit, or
        their whole sequence where several show the same kinds of place.
    """

    images: dict[str, int]
    unreadable: int
    featureless: int
    descriptors: int
    quantization_error: float
    cross_validated_accuracy: float


def train(
    examples: Sequence[Example],
    features: FeatureSettings,
    settings: TrainingSettings,
    seed: int = 0,
    progress: Progress | None = None,
) -> PlaceModel:
    """Learn words, then machines, from labelled images (paper, section 3.2).

    Parameters
    ----------
    examples : sequence of Example
        From `folder_examples`, `sequence_examples`, or both.
    features : FeatureSettings
        How images are described; runs with the model have to use the same.
    settings : TrainingSettings
        What is learned.
    seed : int
        Same examples and seed, same model.
    progress : callable, optional
        Called with (images described, images).

    Returns
    -------
    PlaceModel
        With its `TrainingSummary` in ``model.training``.

    Raises
    ------
    SemanticsError
        Fewer than two labels are left to tell apart.
    """
    chosen = thin_out(
        [e for e in examples if e.label != UNKNOWN], settings.stride, settings.max_images_per_label
    )
    dense = settings.fisher.dense if settings.encoding == "fisher" else None
    found = describe_images(chosen, features, dense, settings.threads, progress)
    return learn(found, features, settings, seed)


def learn(
    found: Sequence[Described | None],
    features: FeatureSettings,
    settings: TrainingSettings,
    seed: int = 0,
) -> PlaceModel:
    """Learn a place model from described images, None for those that could not be read.

    Raises
    ------
    SemanticsError
        Fewer than two labels are left to tell apart.
    """
    usable = [d for d in found if d is not None and is_usable(d, settings)]
    images = Counter(d.example.label for d in usable)
    _check_labels(images)
    random = np.random.default_rng(seed)
    sample = sample_of([d.descriptors for d in usable], settings.max_descriptors, random)
    gas = NeuralGas(settings.n_words, settings.n_epochs, random_state=random).fit(sample)
    bag, encoder = BagOfFeatures(gas), learn_encoder(usable, settings, random)
    vectors, groups = vectors_of(usable, bag, encoder, settings), _groups(usable)
    truth = [d.example.label for d in usable]
    classifier = PlaceClassifier(settings.C, random_state=random).fit(vectors, truth, groups)
    unreadable = sum(described is None for described in found)
    summary = TrainingSummary(
        dict(sorted(images.items())), unreadable, len(found) - len(usable) - unreadable,
        len(sample), gas.quantization_error_, classifier.cross_validated_accuracy_,
    )  # fmt: skip
    logger.info("trained on %d images: %s", len(usable), summary)
    labels = LabelSpace.of(images)
    return PlaceModel(
        labels, bag, classifier, features, settings.normalisation, settings.min_features,
        asdict(summary), encoder, threshold(classifier, settings.reject),
        count_transitions(walks_of(usable), labels.names[1:]),
        _exemplars(vectors, truth, groups, settings.exemplars),
    )  # fmt: skip


def is_usable(image: Described, settings: TrainingSettings) -> bool:
    """Whether there is enough in an image to learn from it."""
    return len(image.descriptors) >= settings.min_features


def _exemplars(
    vectors: NDArray[Any], truth: Sequence[str], groups: Sequence[str], most: int
) -> Exemplars | None:
    """Return at most so many of each label, evenly spread."""
    if not most:
        return None
    labels = np.array(truth)
    rows = [np.flatnonzero(labels == name) for name in np.unique(labels)]
    kept = np.sort(
        np.concatenate(
            [own[np.linspace(0, len(own) - 1, min(most, len(own))).astype(int)] for own in rows]
        )
    )
    return Exemplars(vectors[kept].astype(np.float16), labels[kept], np.array(groups)[kept])


def _check_labels(images: Counter[str]) -> None:
    if len(images) < 2:
        raise SemanticsError(
            "too few labels to tell apart", expected="readable images of two labels or more",
            got=", ".join(images) or "none",
        )  # fmt: skip


def _groups(images: Sequence[Described]) -> list[str]:
    """Return what is held out together: whole sequences if every label is in two or more.

    Day and night of one building, or two laps, show the same rooms: a visit held out alone would
    be judged by machines that know the room from the other sequence.
    """
    sessions = {(d.example.label, d.example.session) for d in images}
    count = Counter(label for label, _ in sessions)
    if min(count.values()) >= 2 and len({session for _, session in sessions}) < len(images) // 2:
        return [d.example.session for d in images]
    return [d.example.group for d in images]


def walks_of(images: Sequence[Described]) -> list[list[str]]:
    """Return the labels along each sequence that the images are from, in time order."""
    by_session = groupby(images, key=lambda d: d.example.session)
    return [[d.example.label for d in walk] for _, walk in by_session]


def threshold(classifier: PlaceClassifier, share: float) -> float:
    """Return the familiarity below which `share` of the held-out images lie."""
    known = classifier.familiarity_[np.isfinite(classifier.familiarity_)]
    return float(np.quantile(known, share)) if len(known) and share else 0.0
