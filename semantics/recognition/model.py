"""A learned place model: from features to the kind of place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier
from roomgraph.semantics.descriptors.dense import describe_densely
from roomgraph.semantics.descriptors.fisher import FisherEncoder
from roomgraph.semantics.descriptors.histogram import BagOfFeatures, Normalisation, normalise
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.slam.features.extraction import Features, FeatureSettings

# Words named as having spoken for a label.
_WORDS = 5


@dataclass(frozen=True, slots=True)
class Exemplars:
    """What a model was learned from, as its classifier sees it, to learn more beside it later.

    Attributes
    ----------
    vectors : (N, L) float16
        What the classifier saw.
    labels, groups : (N,) str
        The class of each, and what it was seen together with.
    """

    vectors: NDArray[np.float16]
    labels: NDArray[np.str_]
    groups: NDArray[np.str_]


@dataclass(frozen=True, slots=True)
class PlacePrediction:
    """What one image looks like.

    Attributes
    ----------
    label, label_id : str, int
        The kind of place; ``unknown`` and 0 where there are too few features to say.
    score : float
        Probability of the label, 0 to 1; 0 for ``unknown``.
    probabilities : (n_labels,) float64
        Of each label, by id.
    histogram : (Q,) float64
        The appearance-based histogram, of unit length (the visual memory of section 3.3).
    familiarity : float
        Largest probability that any single machine gives, 0 to 1: low where nothing fits.
    words : tuple of (int, float)
        The visual words that spoke most for the label, and by how much of the margin over the
        mean of the other classes; the strongest first.
    view : (L,) float or None
        The whole image as one vector of unit length, to compare images by; None if there is
        nothing in it.
    """

    label: str
    label_id: int
    score: float
    probabilities: NDArray[np.float64]
    histogram: NDArray[np.float64]
    familiarity: float = 0.0
    words: tuple[tuple[int, float], ...] = ()
    view: NDArray[Any] | None = None


@dataclass(frozen=True, slots=True)
class PlaceModel:
    """Visual words, machines and label space, with the features they were learned on.

    Attributes
    ----------
    labels : LabelSpace
        The labels it tells apart, and `unknown`.
    bag : BagOfFeatures
        The visual words; their histogram is the visual memory, and what the classifier sees if
        there is no `encoder`.
    classifier : PlaceClassifier
        Its classes are names of `labels`.
    features : FeatureSettings
        How images have to be described.
    normalisation : str
        Of the histograms that the classifier sees.
    min_features : int
        With fewer, an image is of an unknown place.
    training : mapping
        What `semantics.training` reported, for people to read.
    encoder : FisherEncoder or None
        Describes the image itself, densely; the classifier then sees its vectors.
    reject_below : float
        An image that no class's machine gives this probability is of an unknown place.
    transitions : (K, K) float64
        Chance of each class (column) after leaving a class (row), in the order of the labels
        without ``unknown``; even where the training data were no walks.
    exemplars : Exemplars or None
        A part of the training data, so that another class can be taken in.
    """

    labels: LabelSpace
    bag: BagOfFeatures
    classifier: PlaceClassifier
    features: FeatureSettings
    normalisation: Normalisation = "l1"
    min_features: int = 5
    training: Mapping[str, Any] = field(default_factory=dict)
    encoder: FisherEncoder | None = None
    reject_below: float = 0.0
    transitions: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)))
    exemplars: Exemplars | None = None

    def __post_init__(self) -> None:
        if not self.transitions.size:
            even = count_transitions((), self.labels.names[1:])
            object.__setattr__(self, "transitions", even)

    def can_look(
        self, features: Features | NDArray[Any], colour: NDArray[np.uint8] | None = None
    ) -> bool:
        """Whether there is anything in a frame for this model to look at."""
        return len(features) > 0 if self.encoder is None else colour is not None

    def predict(
        self, features: Features | NDArray[Any], colour: NDArray[np.uint8] | None = None
    ) -> PlacePrediction:
        """Return the place that an image speaks of.

        Parameters
        ----------
        features : Features or (N, D) array
            The features of the image, or their descriptors.
        colour : (H, W, 3) uint8, optional
            The image; a model with an encoder needs it.

        Raises
        ------
        SemanticsError
            The descriptors are of another kind than those the model has learned, or the image is
            missing.
        """
        descriptors = features.descriptors if isinstance(features, Features) else features
        counts = self._counts(descriptors)
        memory = normalise(counts, "l2")
        return self.prediction(self._vector(counts, colour), memory)

    def prediction(
        self, vector: NDArray[Any] | None, memory: NDArray[np.float64]
    ) -> PlacePrediction:
        """Return what the machines say of what the classifier sees, None if there is nothing.

        `memory` (Q,) is the histogram that is handed on.
        """
        probabilities = np.zeros(len(self.labels))
        if vector is None:
            probabilities[0] = 1.0
            return PlacePrediction(UNKNOWN, 0, 0.0, probabilities, memory)
        view = memory if self.encoder is None else vector
        margins = self.classifier.coef_ @ vector + self.classifier.intercept_
        ids = self._ids_of_classes()
        probabilities[ids] = self.classifier.probabilities(margins[None])[0]
        familiarity = float(self.classifier.familiarity(margins[None])[0])
        if familiarity < self.reject_below:
            return PlacePrediction(UNKNOWN, 0, 0.0, probabilities, memory, familiarity, view=view)
        label_id = ids[int(margins.argmax())]
        return PlacePrediction(
            self.labels.names[label_id], label_id, float(probabilities[label_id]),
            probabilities, memory, familiarity, self._words(vector, int(margins.argmax())), view,
        )  # fmt: skip

    def _words(self, vector: NDArray[Any], winner: int) -> tuple[tuple[int, float], ...]:
        """Return the words that spoke most for a class against the mean of the others."""
        coef = self.classifier.coef_
        others = (coef.sum(axis=0) - coef[winner]) / (len(coef) - 1)
        share = (coef[winner] - others) * vector
        if self.encoder is not None:
            # Mean and width of each word, each of several numbers.
            share = share.reshape(2, self.encoder.n_words, -1).sum(axis=(0, 2))
        top = np.argsort(-share)[:_WORDS]
        return tuple((int(word), float(share[word])) for word in top if share[word] > 0)

    def _counts(self, descriptors: NDArray[Any]) -> NDArray[np.float64]:
        if len(descriptors) < self.min_features:
            return np.zeros(self.bag.n_words)
        try:
            return self.bag.counts(descriptors)
        except ValueError as error:
            raise SemanticsError(
                "descriptors do not fit the place model",
                expected=f"those of {self.features.detector}", got=str(error),
                hint="run with the feature settings that the model was trained with",
            ) from error  # fmt: skip

    def vector(
        self, features: Features | NDArray[Any], colour: NDArray[np.uint8] | None = None
    ) -> NDArray[Any] | None:
        """Return what the classifier sees of an image (see `predict`), None if too little."""
        descriptors = features.descriptors if isinstance(features, Features) else features
        return self._vector(self._counts(descriptors), colour)

    def _vector(
        self, counts: NDArray[np.float64], colour: NDArray[np.uint8] | None
    ) -> NDArray[Any] | None:
        """Return what the classifier sees of an image, None where there is too little."""
        if self.encoder is None:
            return normalise(counts, self.normalisation) if counts.any() else None
        if colour is None:
            raise SemanticsError(
                "the place model describes images itself", expected="the image", got="features only"
            )
        vector = self.encoder.encode(describe_densely(colour, self.encoder.settings))
        return vector if vector.any() else None

    def _ids_of_classes(self) -> list[int]:
        return [self.labels.id_of(str(name)) for name in self.classifier.classes_]
