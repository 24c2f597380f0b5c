"""A learned place model: from features to the kind of place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semantics.classifier import PlaceClassifier
from semantics.errors import SemanticsError
from semantics.histogram import BagOfFeatures, Normalisation, normalise
from semantics.labels import UNKNOWN, LabelSpace
from slam.features import Features, FeatureSettings


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
    """

    label: str
    label_id: int
    score: float
    probabilities: NDArray[np.float64]
    histogram: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PlaceModel:
    """Visual words, machines and label space, with the features they were learned on.

    Attributes
    ----------
    labels : LabelSpace
        The labels it tells apart, and `unknown`.
    bag : BagOfFeatures
        The visual words.
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
    """

    labels: LabelSpace
    bag: BagOfFeatures
    classifier: PlaceClassifier
    features: FeatureSettings
    normalisation: Normalisation = "l1"
    min_features: int = 5
    training: Mapping[str, Any] = field(default_factory=dict)

    def predict(self, features: Features | NDArray[Any]) -> PlacePrediction:
        """Return the place that the features, or descriptors (N, D), of an image speak of.

        Raises
        ------
        SemanticsError
            The descriptors are of another kind than those the model has learned.
        """
        descriptors = features.descriptors if isinstance(features, Features) else features
        probabilities = np.zeros(len(self.labels))
        if len(descriptors) < self.min_features:
            probabilities[0] = 1.0
            return PlacePrediction(UNKNOWN, 0, 0.0, probabilities, np.zeros(self.bag.n_words))
        try:
            counts = self.bag.counts(descriptors)
        except ValueError as error:
            raise SemanticsError(
                "descriptors do not fit the place model",
                expected=f"those of {self.features.detector}", got=str(error),
                hint="run with the feature settings that the model was trained with",
            ) from error  # fmt: skip
        x = normalise(counts, self.normalisation)
        margins = self.classifier.coef_ @ x + self.classifier.intercept_
        ids = self._ids_of_classes()
        probabilities[ids] = self.classifier.probabilities(margins[None])[0]
        label_id = ids[int(margins.argmax())]
        return PlacePrediction(
            self.labels.names[label_id], label_id, float(probabilities[label_id]),
            probabilities, normalise(counts, "l2"),
        )  # fmt: skip

    def _ids_of_classes(self) -> list[int]:
        return [self.labels.id_of(str(name)) for name in self.classifier.classes_]
