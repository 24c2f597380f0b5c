"""A trained place model: from an image to the kind of place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.descriptors.descriptor import Description, Image, ImageDescriptor
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.slam.features.extraction import Features, FeatureSettings

# Words named as having spoken for a label.
_WORDS = 5


@dataclass(frozen=True, slots=True)
class Exemplars:
    """Vectors of training images, for later training on further labels.

    Attributes
    ----------
    vectors : (N, D) float16
        What the classifier saw.
    labels, groups : (N,) str
        The class of each, and what it was seen together with.
    """

    vectors: NDArray[np.float16]
    labels: NDArray[np.str_]
    groups: NDArray[np.str_]


@dataclass(frozen=True, slots=True)
class PlacePrediction:
    """The prediction for one image.

    Attributes
    ----------
    label, label_id : str, int
        The kind of place; ``unknown`` and 0 where there is too little to see, or nothing fits.
    score : float
        Probability of the label, 0 to 1; 0 for ``unknown``.
    probabilities : (n_labels,) float64
        Of each label, by id.
    signature : (S,) float64
        What two views of a place are compared by, of unit length (the visual memory of section
        3.3); zeros where there is too little to compare.
    familiarity : float
        How well the best class fits, 0 to 1: low where nothing does.
    words : tuple of (int, float)
        The visual words that spoke most for the label, and by how much of the margin over the
        mean of the other classes; the strongest first. Empty where the descriptor has no words.
    view : (D,) float64 or None
        The whole image as one vector of unit length, to measure change by; None if there is
        nothing in it.
    """

    label: str
    label_id: int
    score: float
    probabilities: NDArray[np.float64]
    signature: NDArray[np.float64]
    familiarity: float = 0.0
    words: tuple[tuple[int, float], ...] = ()
    view: NDArray[np.float64] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaceModel:
    """A descriptor, a classifier and their labels.

    Attributes
    ----------
    labels : LabelSpace
        The labels it distinguishes, and `unknown`.
    descriptor : ImageDescriptor
        Makes vectors of images.
    classifier : PlaceClassifier
        Its classes are names of `labels`.
    training : mapping
        What training reported, for people to read.
    reject_below : float
        An image that fits no class this well is of an unknown place.
    transitions : (K, K) float64
        Chance of each class (column) after leaving a class (row), in the order of the labels
        without ``unknown``; even where the training data were no walks.
    exemplars : Exemplars or None
        A part of the training data, so that another class can be learned.
    """

    labels: LabelSpace
    descriptor: ImageDescriptor
    classifier: PlaceClassifier
    training: Mapping[str, Any] = field(default_factory=dict)
    reject_below: float = 0.0
    transitions: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)))
    exemplars: Exemplars | None = None

    def __post_init__(self) -> None:
        if not self.transitions.size:
            even = count_transitions((), self.labels.names[1:])
            object.__setattr__(self, "transitions", even)

    @property
    def features(self) -> FeatureSettings | None:
        """Settings of the local features; None if the model uses none."""
        return self.descriptor.features

    def can_look(self, colour: Image | None, features: Features | None = None) -> bool:
        """Whether an image has what this model needs."""
        return self.descriptor.can_describe(colour, features)

    def predict(self, colour: Image | None, features: Features | None = None) -> PlacePrediction:
        """Return the place that an image shows.

        Parameters
        ----------
        colour : (H, W, 3) uint8 or None
            The image, RGB.
        features : Features, optional
            Its local features, where they are known already.

        Raises
        ------
        SemanticsError
            The features are of another kind than those the model has learned.
        """
        return self.prediction(self._description(colour, features))

    def vector(self, colour: Image | None, features: Features | None = None) -> NDArray[Any] | None:
        """Return the vector of an image (see `predict`), None for too few features."""
        description = self._description(colour, features)
        return None if description is None else description.vector

    def prediction(self, description: Description | None) -> PlacePrediction:
        """Return the prediction for a description, None without a description."""
        probabilities = np.zeros(len(self.labels))
        if description is None:
            probabilities[0] = 1.0
            nothing = np.zeros(self.descriptor.signature_length)
            return PlacePrediction(UNKNOWN, 0, 0.0, probabilities, nothing)
        decisions = self.classifier.decisions(description.vector[None])
        ids = [self.labels.id_of(str(name)) for name in self.classifier.classes_]
        probabilities[ids] = self.classifier.probabilities(decisions)[0]
        familiarity = float(self.classifier.familiarity(decisions)[0])
        winner = int(decisions[0].argmax())
        is_known = familiarity >= self.reject_below
        label_id = ids[winner] if is_known else 0
        return PlacePrediction(
            label=self.labels.names[label_id],
            label_id=label_id,
            score=float(probabilities[label_id]),
            probabilities=probabilities,
            signature=description.signature,
            familiarity=familiarity,
            words=self._words(description.vector, winner) if is_known else (),
            view=self.descriptor.view(description),
        )

    def _description(self, colour: Image | None, features: Features | None) -> Description | None:
        prepared = self.descriptor.prepare(colour, features)
        return None if prepared is None else self.descriptor.describe(prepared)

    def _words(self, vector: NDArray[Any], winner: int) -> tuple[tuple[int, float], ...]:
        """Return the words that contributed most to a class against the mean of the others."""
        shares = self.classifier.contributions(vector, winner)
        by_word = None if shares is None else self.descriptor.words(shares)
        if by_word is None:
            return ()
        top = np.argsort(-by_word)[:_WORDS]
        return tuple((int(word), float(by_word[word])) for word in top if by_word[word] > 0)
