"""The images of the experiments as the classifier sees them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.console import Terminal
from roomgraph.app.experiments.visible_rooms import (
    doorway_distances,
    stretches_along,
    visible_rooms,
)
from roomgraph.app.experiments.walks import Walk
from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier
from roomgraph.semantics.evaluation.splits import EvaluationSet
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.description import Described, describe_images
from roomgraph.semantics.recognition.encoding import vectors_of
from roomgraph.semantics.recognition.examples import Example
from roomgraph.semantics.recognition.model import PlaceModel, PlacePrediction
from roomgraph.semantics.recognition.presets import Preset, preset
from roomgraph.semantics.recognition.training import learn, threshold, walks_of
from roomgraph.semantics.recognition.transitions import count_transitions

# Vectors of more images than this are left as they are: turning them would take longer.
TURNED = 2500


class Describer:
    """Turns images into what the classifier of a preset sees; the words are learned beforehand.

    Parameters
    ----------
    name : str
        The preset.
    examples : sequence of Example
        What the words are learned from: images that are never tested.
    seed : int
        Of the words.
    terminal : Terminal
        Shows progress.
    """

    def __init__(
        self, name: Preset, examples: Sequence[Example], seed: int, terminal: Terminal
    ) -> None:
        self.settings, self.features = preset(name)
        self.terminal = terminal
        self.model = learn(
            self.describe(examples, "Learning words", True), self.features, self.settings, seed
        )

    def describe(
        self, examples: Sequence[Example], title: str, to_learn_words: bool = False
    ) -> list[Described]:
        """Return the readable images, described by what the classifier sees, or for words."""
        features = self.features if to_learn_words or self.settings.encoding == "words" else None
        dense = self.settings.fisher.dense if self.settings.encoding == "fisher" else None
        known = [example for example in examples if example.label != UNKNOWN]
        with self.terminal.progress(title) as advance:
            found = describe_images(
                known, features, dense, self.settings.threads,
                lambda done, total: advance(done, total, "images"),
            )  # fmt: skip
        return [described for described in found if described is not None]

    def vectors(self, images: Sequence[Described]) -> NDArray[Any]:
        """Return what the classifier sees (N, D)."""
        return vectors_of(images, self.model.bag, self.model.encoder, self.settings)

    def relearned(
        self, images: Sequence[Described], vectors: NDArray[Any], groups: Sequence[str], seed: int
    ) -> PlaceModel:
        """Return a model with the same words whose machines are learned from other images."""
        classifier = PlaceClassifier(self.settings.C, random_state=seed).fit(
            vectors, [image.example.label for image in images], groups
        )
        labels = LabelSpace.of(image.example.label for image in images)
        return replace(
            self.model, labels=labels, classifier=classifier, exemplars=None,
            reject_below=threshold(classifier, self.settings.reject),
            transitions=count_transitions(walks_of(images), labels.names[1:]),
        )  # fmt: skip

    def predictions(self, model: PlaceModel, images: Sequence[Described]) -> list[PlacePrediction]:
        """Return what each image alone looks like."""
        none = np.zeros(model.bag.n_words)
        return [model.prediction(vector, none) for vector in self.vectors(images)]

    def collect(self, walks: Sequence[Walk], stride: int) -> Collection:
        """Return every `stride`-th image of the walks, described."""
        chosen = [(walk, e) for walk in walks for e in walk.examples[::stride]]
        images = self.describe([e for _, e in chosen], "Describing images")
        of = {id(example): walk for walk, example in chosen}
        where = [of[id(image.example)] for image in images]
        return Collection(images, where, self.vectors(images), self.settings.C)


@dataclass(frozen=True, slots=True)
class Collection:
    """Described images, the walk of each, and what the classifier sees of them (N, D)."""

    images: list[Described]
    walks: list[Walk]
    vectors: NDArray[Any]
    C: float

    def evaluation_set(self) -> EvaluationSet:
        """Return the images as the experiments take them.

        The vectors of few images are turned onto the axes that they span, which changes no product
        of two and makes them shorter.
        """
        vectors = np.asarray(self.vectors)
        examples = [image.example for image in self.images]
        buildings = [walk.building for walk in self.walks]
        rooms = [f"{b}/{e.place or e.group}" for b, e in zip(buildings, examples, strict=True)]
        visits = np.array([example.group for example in examples])
        walks = list({id(walk): walk for walk in self.walks}.values())
        seen = visible_rooms(walks, examples)
        return EvaluationSet(
            turned(vectors.astype(np.float64)) if len(vectors) <= TURNED else vectors,
            np.array([example.label for example in examples]),
            visits,
            np.array(rooms),
            np.array(buildings),
            np.array([walk.light for walk in self.walks]),
            self.C,
            *self._along(visits),
            doorway_distances(walks, examples),
            np.array([visible_room.label for visible_room in seen]),
            np.array(
                [
                    f"{b}/{visible_room.room}"
                    for b, visible_room in zip(buildings, seen, strict=False)
                ]
            ),
            np.array([visible_room.own_share for visible_room in seen]),
        )

    def _along(self, visits: NDArray[np.str_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return order and stretches where the same walk was taken in every light, else nothing."""
        walks = np.array([id(walk) for walk in self.walks])
        if len({walk.building for walk in self.walks}) == len(np.unique(walks)):
            return np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
        return stretches_along(walks, visits)


def turned(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors (N, D) on the at most N axes that they span; (N, D) if D is not more."""
    if vectors.shape[1] <= len(vectors):
        return vectors
    values, axes = np.linalg.eigh(vectors @ vectors.T)
    kept = values > values[-1] * 1e-10
    return np.asarray(axes[:, kept] * np.sqrt(values[kept]))
