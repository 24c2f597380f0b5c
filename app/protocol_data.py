"""The images of the experiments: rendered buildings from the cache, or the user's folders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.buildings import building_settings, cached
from app.console import Terminal
from app.training import labelled_examples
from datasets.building.settings import LIGHTS
from datasets.open import open_sequence
from semantics.classifier import PlaceClassifier
from semantics.examples import Example, sequence_examples
from semantics.extraction import Described, describe_images
from semantics.filter import count_transitions
from semantics.labels import UNKNOWN, LabelSpace
from semantics.model import PlaceModel, PlacePrediction
from semantics.training import Preset, learn, preset, threshold, vectors_of, walks_of
from semantics.trials import Bench

# Six buildings to experiment on, and one to learn the words from. The demonstration uses others.
SEEDS, WORD_SEED = (20, 21, 22, 23, 24, 25), 26
# Small images, wide steps: the experiments compare views, they do not track. One image in four of
# a walk is learned from or tested, so that hardly two are alike.
WALK = {"width": 320, "height": 240, "step_m": 0.16, "turn_deg": 8.0}
STRIDE = 4
# Across light, twice as many: those learned from, and those halfway between. So many of them in a
# row make a stretch: about 2.5 m, or a third of a turn.
LIGHT_STRIDE, STRETCH = 2, 8

# Vectors of more images than this are left as they are: turning them would take longer.
TURNED = 2500


@dataclass(frozen=True, slots=True)
class Walk:
    """Images of one building, or of one folder, in one light."""

    building: str
    light: str
    examples: list[Example]


def rendered_walks(seeds: Sequence[int], terminal: Terminal) -> list[Walk]:
    """Return the walks through rendered buildings in every light, rendering what is missing."""
    walks = []
    for seed in seeds:
        roots = cached(LIGHTS, building_settings(seed=seed, **WALK), terminal)
        for light, root in zip(LIGHTS, roots, strict=True):
            walks.append(Walk(f"building{seed}", light, sequence_examples(open_sequence(root))))
    return walks


def data_walks(roots: Sequence[Path]) -> list[Walk]:
    """Return the user's folders or sequences, each a building and a light of its own."""
    return [Walk(root.name, root.name, labelled_examples(root)) for root in roots]


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
            self.model, labels=labels, classifier=classifier, lessons=None,
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

    def bench(self) -> Bench:
        """Return the images as the experiments take them.

        The vectors of few images are turned onto the axes that they span, which changes no product
        of two and makes them shorter.
        """
        vectors = np.asarray(self.vectors)
        examples = [image.example for image in self.images]
        buildings = [walk.building for walk in self.walks]
        rooms = [f"{b}/{e.place or e.group}" for b, e in zip(buildings, examples, strict=True)]
        return Bench(
            turned(vectors.astype(np.float64)) if len(vectors) <= TURNED else vectors,
            np.array([example.label for example in examples]),
            np.array([example.group for example in examples]),
            np.array(rooms),
            np.array(buildings),
            np.array([walk.light for walk in self.walks]),
            self.C,
            *self._along(),
            self._to_doorways(),
        )

    def _to_doorways(self) -> NDArray[np.float64]:
        """Return the way (N,) from each image to the nearest change of room on its walk, metres."""
        walks = {id(walk): walk for walk in self.walks}
        ways = [_to_doorways(walk) for walk in walks.values()]
        if not all(ways):
            return np.empty(0)
        found = {key: way for part in ways for key, way in part.items()}
        return np.array([found[_key(image.example)] for image in self.images])

    def _along(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return the number of each image along its walk, and its stretch of it.

        Of a rendered building the same walk is taken in every light; nothing of the user's walks.
        A visit has two stretches at least.
        """
        order, stretches = np.zeros((2, len(self.images)), dtype=np.intp)
        if len({walk.building for walk in self.walks}) == len({id(walk) for walk in self.walks}):
            return order[:0], stretches[:0]
        walks = np.array([id(walk) for walk in self.walks])
        visits = np.array([image.example.group for image in self.images])
        for walk in dict.fromkeys(walks.tolist()):
            members = np.flatnonzero(walks == walk)
            order[members] = np.arange(len(members))
            first = 0
            for visit in dict.fromkeys(visits[members].tolist()):
                own = members[visits[members] == visit]
                count = max(2, round(len(own) / STRETCH))
                stretches[own] = first + np.arange(len(own)) * count // len(own)
                first += count
        return order, stretches


def route_positions(images: Sequence[Described]) -> NDArray[np.float64]:
    """Return where the images of one sequence were taken (N, 3); steps of 0.1 m if not known."""
    sequence = open_sequence(Path(images[0].example.session))
    truth = sequence.ground_truth
    stamps = np.array([image.example.stamp_s for image in images])
    if truth is None:
        return np.column_stack([0.1 * np.arange(len(stamps)), np.zeros((len(stamps), 2))])
    nearest = np.abs(truth.stamps_s[None] - stamps[:, None]).argmin(axis=1)
    return np.asarray(truth.positions[nearest])


def _to_doorways(walk: Walk) -> dict[tuple[str, float], float]:
    """Return the way from each image of a walk to a change of room; empty if it has no poses."""
    root = Path(walk.examples[0].session)
    truth = open_sequence(root).ground_truth if root.is_dir() else None
    if truth is None:
        return {}
    stamps = np.array([example.stamp_s for example in walk.examples])
    positions = truth.positions[np.abs(truth.stamps_s[None] - stamps[:, None]).argmin(axis=1)]
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    groups = np.array([example.group for example in walk.examples])
    changes = np.flatnonzero(groups[1:] != groups[:-1])
    borders = (along[changes] + along[changes + 1]) / 2
    ways = np.abs(along[:, None] - borders).min(axis=1, initial=np.inf)
    return {_key(e): float(way) for e, way in zip(walk.examples, ways, strict=True)}


def _key(example: Example) -> tuple[str, float]:
    return example.session, example.stamp_s


def turned(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors (N, D) on the at most N axes that they span; (N, D) if D is not more."""
    if vectors.shape[1] <= len(vectors):
        return vectors
    values, axes = np.linalg.eigh(vectors @ vectors.T)
    kept = values > values[-1] * 1e-10
    return np.asarray(axes[:, kept] * np.sqrt(values[kept]))
