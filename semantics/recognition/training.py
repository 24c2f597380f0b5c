"""Training of a place model on labelled images."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from typing import Any

import numpy as np

from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.descriptors.descriptor import ImageDescriptor, vectors_of
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.examples import Example, thin_out
from roomgraph.semantics.recognition.exemplars import choose_exemplars
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.recognition.preparation import Prepared, Progress, prepare_images
from roomgraph.semantics.recognition.settings import TrainingSettings
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.slam.features.extraction import FeatureSettings

logger = logging.getLogger(__name__)


def train(
    examples: Sequence[Example],
    features: FeatureSettings,
    settings: TrainingSettings,
    seed: int = 0,
    progress: Progress | None = None,
) -> PlaceModel:
    """Learn a descriptor, then a classifier, from labelled images (paper, section 3.2).

    Parameters
    ----------
    examples : sequence of Example
        From `folder_examples`, `sequence_examples`, or both.
    features : FeatureSettings
        How local features are extracted, where the descriptor looks at any.
    settings : TrainingSettings
        What is learned.
    seed : int
        Same examples and seed, same model.
    progress : callable, optional
        Called with (images prepared, images).

    Returns
    -------
    PlaceModel
        With a summary in ``model.training``: ``images`` by label, ``unreadable`` and
        ``featureless`` images left out, ``cross_validated_accuracy`` (share of images labelled
        rightly by classifiers trained without their group: their visit, or their whole sequence
        where several show the same kinds of place), and what the descriptor says of itself.

    Raises
    ------
    SemanticsError
        Fewer than two labels are left to tell apart.
    """
    chosen = thin_out(
        [e for e in examples if e.label != UNKNOWN], settings.stride, settings.max_images_per_label
    )
    descriptor = settings.make_descriptor(features)
    found = prepare_images(chosen, descriptor, settings.threads, to_fit=True, progress=progress)
    return learn(found, descriptor, settings, seed)


def learn(
    found: Sequence[Prepared | None],
    descriptor: ImageDescriptor,
    settings: TrainingSettings,
    seed: int = 0,
) -> PlaceModel:
    """Learn a place model from prepared images, None for those that could not be read.

    Raises
    ------
    SemanticsError
        Fewer than two labels are left to tell apart.
    """
    usable = [image for image in found if image is not None and image.content is not None]
    _check_labels(usable)
    random = np.random.default_rng(seed)
    descriptor.fit([image.content for image in usable], random)
    vectors = vectors_of(descriptor, [image.content for image in usable], settings.threads)
    seen = [i for i, vector in enumerate(vectors) if vector is not None]
    images = [usable[i] for i in seen]
    counts = _check_labels(images)
    matrix = np.array([vectors[i] for i in seen])
    truth, groups = [image.example.label for image in images], groups_of(images)
    classifier = settings.make_classifier().clone(random_state=random).fit(matrix, truth, groups)
    unreadable = sum(image is None for image in found)
    summary: dict[str, Any] = {
        "images": dict(sorted(counts.items())),
        "unreadable": unreadable,
        "featureless": len(found) - len(images) - unreadable,
        **descriptor.summary(),
        "cross_validated_accuracy": classifier.cross_validated_accuracy_,
    }
    logger.info("trained on %d images: %s", len(images), summary)
    labels = LabelSpace.of(counts)
    return PlaceModel(
        labels=labels,
        descriptor=descriptor,
        classifier=classifier,
        training=summary,
        reject_below=threshold(classifier, settings.reject),
        transitions=count_transitions(walks_of(images), labels.names[1:]),
        exemplars=choose_exemplars(matrix, truth, groups, settings.exemplars),
    )


def _check_labels(images: Sequence[Prepared]) -> Counter[str]:
    """Return the number of images by label, of which there must be two."""
    counts = Counter(image.example.label for image in images)
    if len(counts) < 2:
        raise SemanticsError(
            "too few labels to train on", expected="readable images of at least two labels",
            got=", ".join(counts) or "none",
        )  # fmt: skip
    return counts


def groups_of(images: Sequence[Prepared]) -> list[str]:
    """Return the groups to hold out: whole sequences if every label is in two or more.

    Day and night of one building, or two laps, show the same rooms: a visit held out alone would
    be judged by a classifier that knows the room from the other sequence.
    """
    sessions = {(image.example.label, image.example.session) for image in images}
    count = Counter(label for label, _ in sessions)
    if min(count.values()) >= 2 and len({session for _, session in sessions}) < len(images) // 2:
        return [image.example.session for image in images]
    return [image.example.group for image in images]


def walks_of(images: Sequence[Prepared]) -> list[list[str]]:
    """Return the labels along each sequence that the images are from, in time order."""
    by_session = groupby(images, key=lambda image: image.example.session)
    return [[image.example.label for image in walk] for _, walk in by_session]


def threshold(classifier: PlaceClassifier, share: float) -> float:
    """Return the familiarity below which `share` of the held-out images lie."""
    known = classifier.familiarity_[np.isfinite(classifier.familiarity_)]
    return float(np.quantile(known, share)) if len(known) and share else 0.0
