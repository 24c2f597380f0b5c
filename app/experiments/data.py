"""The images of the experiments as input of the classifier."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
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
from roomgraph.app.settings import AppSettings
from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.descriptors.descriptor import vectors_of
from roomgraph.semantics.evaluation.splits import EvaluationSet
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.examples import Example
from roomgraph.semantics.recognition.model import PlaceModel, PlacePrediction
from roomgraph.semantics.recognition.preparation import Prepared, prepare_images
from roomgraph.semantics.recognition.training import learn, threshold, walks_of
from roomgraph.semantics.recognition.transitions import count_transitions

# Vectors of more images than this are left as they are: turning them would take longer.
TURNED = 2500


class Describer:
    """Turns images into vectors for a classifier; the descriptor is trained beforehand.

    Parameters
    ----------
    settings : AppSettings
        What descriptor and classifier are.
    examples : sequence of Example
        What the descriptor is learned from: images that are never tested.
    terminal : Terminal
        Shows progress.
    """

    def __init__(
        self, settings: AppSettings, examples: Sequence[Example], terminal: Terminal
    ) -> None:
        self.training = settings.semantics.training
        self.descriptor = self.training.make_descriptor(settings.slam.features)
        self.terminal = terminal
        images = self.prepare(examples, "Training the descriptor", to_fit=True)
        self.model = learn(images, self.descriptor, self.training, settings.seed)

    def prepare(
        self, examples: Sequence[Example], title: str, to_fit: bool = False
    ) -> list[Prepared]:
        """Return the readable images whose label is known, prepared."""
        known = [example for example in examples if example.label != UNKNOWN]
        with self.terminal.progress(title) as advance:
            found = prepare_images(
                known, self.descriptor, self.training.threads, to_fit,
                lambda done, total: advance(done, total, "images"),
            )  # fmt: skip
        return [image for image in found if image is not None]

    def vectors(self, images: Sequence[Prepared]) -> NDArray[Any]:
        """Return vectors (N, D) for a classifier; zeros for images with too few features."""
        found = vectors_of(
            self.descriptor, [image.content for image in images], self.training.threads
        )
        nothing = np.zeros(self.descriptor.length, dtype=np.float32)
        return np.array([nothing if vector is None else vector for vector in found])

    def relearned(
        self, images: Sequence[Prepared], vectors: NDArray[Any], groups: Sequence[str], seed: int
    ) -> PlaceModel:
        """Return a model with the same descriptor whose classifier learns from other images."""
        labels = [image.example.label for image in images]
        classifier = self.training.make_classifier().clone(random_state=seed)
        classifier.fit(vectors, labels, groups)
        space = LabelSpace.of(labels)
        return replace(
            self.model, labels=space, classifier=classifier, exemplars=None,
            reject_below=threshold(classifier, self.training.reject),
            transitions=count_transitions(walks_of(images), space.names[1:]),
        )  # fmt: skip

    def predictions(self, model: PlaceModel, images: Sequence[Prepared]) -> list[PlacePrediction]:
        """Return the prediction for each single image."""
        with ThreadPoolExecutor(self.training.threads) as pool:
            return list(pool.map(lambda image: self._prediction(model, image), images))

    def _prediction(self, model: PlaceModel, image: Prepared) -> PlacePrediction:
        if image.content is None:
            return model.prediction(None)
        return model.prediction(self.descriptor.describe(image.content))

    def collect(self, walks: Sequence[Walk], stride: int) -> Collection:
        """Return every `stride`-th image of the walks, described."""
        chosen = [(walk, e) for walk in walks for e in walk.examples[::stride]]
        images = self.prepare([e for _, e in chosen], "Describing images")
        of = {id(example): walk for walk, example in chosen}
        where = [of[id(image.example)] for image in images]
        return Collection(images, where, self.vectors(images), self.training.make_classifier())


@dataclass(frozen=True, slots=True)
class Collection:
    """Images, their walks, their vectors (N, D), and an unfitted classifier."""

    images: list[Prepared]
    walks: list[Walk]
    vectors: NDArray[Any]
    classifier: PlaceClassifier

    def evaluation_set(self) -> EvaluationSet:
        """Return the images as an evaluation set.

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
        order, stretches = self._along(visits)
        return EvaluationSet(
            vectors=turned(vectors.astype(np.float64)) if len(vectors) <= TURNED else vectors,
            labels=np.array([example.label for example in examples]),
            visits=visits,
            rooms=np.array(rooms),
            buildings=np.array(buildings),
            lights=np.array([walk.light for walk in self.walks]),
            classifier=self.classifier,
            order=order,
            stretches=stretches,
            doorway_m=doorway_distances(walks, examples),
            visible=np.array([room.label for room in seen]),
            visible_room_names=np.array(
                [f"{b}/{room.room}" for b, room in zip(buildings, seen, strict=False)]
            ),
            own_share=np.array([room.own_share for room in seen]),
        )

    def _along(self, visits: NDArray[np.str_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return order and stretches if every light has the same walk; else empty."""
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
