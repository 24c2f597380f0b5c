"""Learning a place model from labelled images."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets.settings import Settings
from semantics.classifier import PlaceClassifier
from semantics.errors import SemanticsError
from semantics.examples import Example, thin_out
from semantics.extraction import extract_descriptors
from semantics.histogram import BagOfFeatures, Normalisation, normalise
from semantics.labels import UNKNOWN, LabelSpace
from semantics.model import PlaceModel
from semantics.neural_gas import NeuralGas
from slam.features import FeatureSettings

logger = logging.getLogger(__name__)

Progress = Callable[[int, int], None]


class TrainingSettings(Settings):
    """What is learned from how many images."""

    stride: int = Field(1, ge=1, description="every n-th image of each label is used")
    max_images_per_label: int = Field(200, ge=2, description="at most so many, evenly spread")
    n_words: int = Field(100, ge=2, le=10000, description="visual words (paper: 100)")
    n_epochs: int = Field(5, ge=1, le=1000, description="Neural Gas passes over the descriptors")
    max_descriptors: int = Field(
        200_000, ge=100, description="the words are learned from a sample of so many descriptors"
    )
    normalisation: Normalisation = Field(
        "hellinger", description="histograms the SVM sees: l1 (paper), l2 or hellinger"
    )
    C: float = Field(10.0, gt=0, description="penalty of the SVM (paper: 10)")
    min_features: int = Field(
        5, ge=1, description="an image with fewer features than this is of an unknown place"
    )
    threads: int = Field(2, ge=1, le=64, description="images read and described at once")


# As published. The defaults keep the words but take the root of the histograms, which tell rooms
# of buildings never seen better (79 % of frames against 75 %) and photographs as well; at their
# larger scale a penalty of 1 does what 10 does to the published ones.
PAPER = TrainingSettings(n_words=100, normalisation="l1", C=10.0)


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
        Share of images labelled rightly by machines trained without their visit.
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
    found = extract_descriptors(chosen, features, settings.threads, progress)
    usable = [
        (example, descriptors)
        for example, descriptors in zip(chosen, found, strict=True)
        if descriptors is not None and len(descriptors) >= settings.min_features
    ]
    labels = Counter(example.label for example, _ in usable)
    if len(labels) < 2:
        raise SemanticsError(
            "too few labels to tell apart", expected="readable images of two labels or more",
            got=", ".join(labels) or "none",
        )  # fmt: skip
    random = np.random.default_rng(seed)
    sample = _sample([descriptors for _, descriptors in usable], settings.max_descriptors, random)
    gas = NeuralGas(settings.n_words, settings.n_epochs, random_state=random).fit(sample)
    bag = BagOfFeatures(gas)
    counts = np.array([bag.counts(descriptors) for _, descriptors in usable])
    classifier = PlaceClassifier(settings.C, random_state=random).fit(
        normalise(counts, settings.normalisation),
        [example.label for example, _ in usable],
        [example.group for example, _ in usable],
    )
    unreadable = sum(descriptors is None for descriptors in found)
    summary = TrainingSummary(
        dict(sorted(labels.items())), unreadable, len(chosen) - len(usable) - unreadable,
        len(sample), gas.quantization_error_, classifier.cross_validated_accuracy_,
    )  # fmt: skip
    logger.info("trained on %d images: %s", len(usable), summary)
    return PlaceModel(
        LabelSpace.of(labels), bag, classifier, features,
        settings.normalisation, settings.min_features, asdict(summary),
    )  # fmt: skip


def _sample(
    descriptors: Sequence[NDArray[np.float32]], most: int, random: np.random.Generator
) -> NDArray[np.float32]:
    """Return at most `most` of the descriptors, drawn without replacement, in order."""
    ends = np.cumsum([len(part) for part in descriptors])
    if ends[-1] <= most:
        return np.vstack(descriptors)
    rows = np.sort(random.choice(int(ends[-1]), most, replace=False))
    parts = np.split(rows, np.searchsorted(rows, ends[:-1]))
    starts = ends - [len(part) for part in descriptors]
    return np.vstack(
        [part[r - start] for part, r, start in zip(descriptors, parts, starts, strict=True)]
    )
