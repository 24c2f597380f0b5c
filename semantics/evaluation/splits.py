"""The paper's experiments as plain computations on described images."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.classifiers.folds import assign_folds

N_FOLDS = 10
# The row of images judged by the room that most of them shows, held out with it.
BY_VISIBLE_ROOM = "fused, by what the image shows"
# An image hardly shows the room it was taken in if so little of it does.
HARDLY = 0.01
# The row of images that hardly show the next room: so far from a change of room.
AWAY, AWAY_M = "fused, 1 m or more from doorways", 1.0
# Rows of results that learn from and test alternate stretches of a walk.
STRETCHES, STRETCHES_SAME_LIGHT = "other stretches, other light", "other stretches, same light"


@dataclass(frozen=True, slots=True)
class EvaluationSet:
    """Images as input of the classifier, with their metadata.

    Attributes
    ----------
    vectors : (N, D) float64
        What the classifier sees.
    labels, visits, rooms, buildings, lights : (N,) str
        The kind of place, the visit, the very room, the building and its light.
    classifier : PlaceClassifier
        What is trained, unfitted.
    order, stretches : (N,) int
        Number of the image along its walk, and of the stretch of the walk that it is from, where
        the same walk was taken in every light; else empty.
    doorway_m : (N,) float64
        Way from the image to the nearest change of room on its walk; empty where nobody knows.
    visible, visible_room_names : (N,) str
        Kind and very room of what most of the image shows, where that is known; else empty.
    own_share : (N,) float64
        Share of the image that shows the room it was taken in, where that is known.
    """

    vectors: NDArray[np.float64]
    labels: NDArray[np.str_]
    visits: NDArray[np.str_]
    rooms: NDArray[np.str_]
    buildings: NDArray[np.str_]
    lights: NDArray[np.str_]
    classifier: PlaceClassifier
    order: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    stretches: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    doorway_m: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    visible: NDArray[np.str_] = field(default_factory=lambda: np.empty(0, dtype=str))
    visible_room_names: NDArray[np.str_] = field(default_factory=lambda: np.empty(0, dtype=str))
    own_share: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))

    @property
    def classes(self) -> list[str]:
        """The kinds of place, sorted."""
        return sorted({str(label) for label in self.labels})


@dataclass(frozen=True, slots=True)
class SplitResult:
    """One training and one test: the true and the found labels of the images tested.

    `row` is the line of the table that it counts for, `tested` the images' numbers in the
    evaluation set.
    """

    row: str
    truth: NDArray[np.str_]
    found: NDArray[np.str_]
    tested: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))

    @property
    def accuracy(self) -> float:
        """Share of images labelled correctly."""
        return float(np.mean(self.truth == self.found))


def per_class(results: Sequence[SplitResult]) -> dict[str, float]:
    """Return the share of correctly labelled images of each class, over all splits."""
    truth = np.concatenate([result.truth for result in results])
    right = truth == np.concatenate([result.found for result in results])
    return {str(name): float(right[truth == name].mean()) for name in np.unique(truth)}


def run_split(
    evaluation_set: EvaluationSet, row: str, train: NDArray[np.bool_], test: NDArray[np.bool_]
) -> SplitResult:
    """Learn from some images of the evaluation set and label others."""
    classifier = evaluation_set.classifier.clone(n_folds=1).fit(
        evaluation_set.vectors[train], evaluation_set.labels[train]
    )
    found = classifier.predict(evaluation_set.vectors[test]).astype(str)
    return SplitResult(row, evaluation_set.labels[test], found, np.flatnonzero(test))


def recognition(evaluation_set: EvaluationSet, seed: int) -> Iterator[SplitResult]:
    """Ten folds in each light and in all: whole visits held out, then random frames.

    An image has the label of the room it was taken in, as the paper's do. Where it is known what
    the images show, they are also learned and judged by that, with what is shown held out.
    """
    lights = sorted(set(evaluation_set.lights.tolist()))
    for light in lights:
        inside = evaluation_set.lights == light
        yield from _folds(evaluation_set, light, inside, evaluation_set.visits, seed)
    if len(lights) > 1:
        everything = np.ones(len(evaluation_set.labels), dtype=bool)
        for result in _folds(evaluation_set, "fused", everything, evaluation_set.rooms, seed):
            yield result
            yield from _away(evaluation_set, result)
        if len(evaluation_set.visible):
            by_visible_room = replace(evaluation_set, labels=evaluation_set.visible)
            yield from _folds(
                by_visible_room,
                BY_VISIBLE_ROOM,
                everything,
                evaluation_set.visible_room_names,
                seed,
            )
    row = "frames of one visit on both sides (paper)"
    yield from _folds(
        evaluation_set, row, np.ones(len(evaluation_set.labels), dtype=bool), None, seed
    )


def light(evaluation_set: EvaluationSet) -> Iterator[SplitResult]:
    """Train in one light, test in another, in each building (paper, Table 2).

    Where the same walk was taken in every light, every other image of it is learned from, and
    those halfway between are tested. Then alternate stretches of the walk are learned from and
    tested, in another light and, to see what of the loss is the light's, in the same.
    """
    lights = sorted(set(evaluation_set.lights.tolist()))
    pairs = [(a, b) for a in lights for b in lights if a != b]
    if not len(evaluation_set.order):
        everything = np.ones(len(evaluation_set.labels), dtype=bool)
        yield from _across(evaluation_set, pairs, everything, everything, "{} to {}")
        return
    odd = evaluation_set.order % 2 == 1
    yield from _across(evaluation_set, pairs, ~odd, odd, "{} to {}")
    odd = evaluation_set.stretches % 2 == 1
    for train, test in ((odd, ~odd), (~odd, odd)):
        yield from _across(evaluation_set, pairs, train, test, STRETCHES)
    for train, test in ((odd, ~odd), (~odd, odd)):
        yield from _across(
            evaluation_set, [(a, a) for a in lights], train, test, STRETCHES_SAME_LIGHT
        )


def _across(
    evaluation_set: EvaluationSet,
    pairs: Sequence[tuple[str, str]],
    learned: NDArray[np.bool_],
    tested: NDArray[np.bool_],
    row: str,
) -> Iterator[SplitResult]:
    for a, b in pairs:
        for building in sorted(set(evaluation_set.buildings.tolist())):
            inside = evaluation_set.buildings == building
            train, test = (
                inside & learned & (evaluation_set.lights == a),
                inside & (evaluation_set.lights == b),
            )
            test &= tested
            if test.any() and len(np.unique(evaluation_set.labels[train])) > 1:
                yield run_split(evaluation_set, row.format(a, b), train, test)


def building(
    evaluation_set: EvaluationSet, seed: int, permutations: int = 100
) -> Iterator[SplitResult]:
    """Train on half of the buildings, test on the other half and back (paper, Fig. 15).

    Each permutation draws the halves, and half of the training images.
    """
    random = np.random.default_rng(seed)
    names = sorted(set(evaluation_set.buildings.tolist()))
    halves = list(combinations(names, len(names) // 2))
    for i in range(permutations):
        if i % 2 == 0:
            first = halves[int(random.integers(len(halves)))]
        inside = np.isin(evaluation_set.buildings, first) == (i % 2 == 0)
        train = inside & (random.random(len(inside)) < 0.5)
        yield run_split(evaluation_set, "there" if i % 2 == 0 else "and back", train, ~inside)


def _folds(
    evaluation_set: EvaluationSet,
    row: str,
    inside: NDArray[np.bool_],
    groups: NDArray[np.str_] | None,
    seed: int,
) -> Iterator[SplitResult]:
    members = np.flatnonzero(inside)
    own = None if groups is None else groups[members]
    folds = assign_folds(evaluation_set.labels[members], own, N_FOLDS, np.random.default_rng(seed))
    for fold in range(N_FOLDS):
        test = np.zeros(len(inside), dtype=bool)
        test[members[folds == fold]] = True
        train = inside & ~test
        if test.any() and len(np.unique(evaluation_set.labels[train])) > 1:
            yield run_split(evaluation_set, row, train, test)


def _away(evaluation_set: EvaluationSet, result: SplitResult) -> Iterator[SplitResult]:
    """Yield the part of a result whose images were taken away from doorways, if it is known."""
    if len(evaluation_set.doorway_m):
        away = evaluation_set.doorway_m[result.tested] >= AWAY_M
        if away.any():
            yield SplitResult(AWAY, result.truth[away], result.found[away], result.tested[away])
