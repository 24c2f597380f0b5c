"""The paper's experiments as plain computations on described images."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.folds import assign_folds
from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier

N_FOLDS = 10
# The row of images judged by the room that most of them shows, held out with it.
SHOWN = "fused, by what the image shows"
# An image hardly shows the room it was taken in if so little of it does.
HARDLY = 0.01
# The row of images that hardly show the next room: so far from a change of room.
AWAY, AWAY_M = "fused, 1 m or more from doorways", 1.0
# Rows of trials that learn from and test alternate stretches of a walk.
STRETCHES, STRETCHES_SAME_LIGHT = "other stretches, other light", "other stretches, same light"


@dataclass(frozen=True, slots=True)
class Bench:
    """Images as the classifier sees them, with what is known about each.

    Attributes
    ----------
    vectors : (N, D) float64
        What the classifier sees.
    labels, visits, rooms, buildings, lights : (N,) str
        The kind of place, the visit, the very room, the building and its light.
    C : float
        Penalty of the SVM.
    order, stretches : (N,) int
        Number of the image along its walk, and of the stretch of the walk that it is from, where
        the same walk was taken in every light; else empty.
    doorway_m : (N,) float64
        Way from the image to the nearest change of room on its walk; empty where nobody knows.
    shown, shown_rooms : (N,) str
        Kind and very room of what most of the image shows, where that is known; else empty.
    own_share : (N,) float64
        Share of the image that shows the room it was taken in, likewise.
    """

    vectors: NDArray[np.float64]
    labels: NDArray[np.str_]
    visits: NDArray[np.str_]
    rooms: NDArray[np.str_]
    buildings: NDArray[np.str_]
    lights: NDArray[np.str_]
    C: float
    order: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    stretches: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    doorway_m: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    shown: NDArray[np.str_] = field(default_factory=lambda: np.empty(0, dtype=str))
    shown_rooms: NDArray[np.str_] = field(default_factory=lambda: np.empty(0, dtype=str))
    own_share: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))

    @property
    def classes(self) -> list[str]:
        """The kinds of place, sorted."""
        return sorted({str(label) for label in self.labels})


@dataclass(frozen=True, slots=True)
class Trial:
    """One training and one test: the true and the found labels of the images tested.

    `row` is the line of the table that it counts for, `tested` the images' numbers in the bench.
    """

    row: str
    truth: NDArray[np.str_]
    found: NDArray[np.str_]
    tested: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))

    @property
    def accuracy(self) -> float:
        """Share of images labelled rightly."""
        return float(np.mean(self.truth == self.found))

    @property
    def mean_per_class(self) -> float:
        """Mean over the classes of the share labelled rightly."""
        return float(np.mean(list(per_class([self]).values())))


def per_class(trials: Sequence[Trial]) -> dict[str, float]:
    """Return the share of the images of each class that were labelled rightly, over all trials."""
    truth = np.concatenate([trial.truth for trial in trials])
    right = truth == np.concatenate([trial.found for trial in trials])
    return {str(name): float(right[truth == name].mean()) for name in np.unique(truth)}


def run_trial(bench: Bench, row: str, train: NDArray[np.bool_], test: NDArray[np.bool_]) -> Trial:
    """Learn from some images of the bench and label others."""
    classifier = PlaceClassifier(bench.C, n_folds=1).fit(bench.vectors[train], bench.labels[train])
    found = classifier.predict(bench.vectors[test]).astype(str)
    return Trial(row, bench.labels[test], found, np.flatnonzero(test))


def recognition(bench: Bench, seed: int) -> Iterator[Trial]:
    """Ten folds in each light and in all: visits held out whole, then frames drawn as they come.

    An image bears the label of the room it was taken in, as the paper's do. Where it is known what
    the images show, they are also learned and judged by that, with what is shown held out.
    """
    lights = sorted(set(bench.lights.tolist()))
    for light in lights:
        inside = bench.lights == light
        yield from _folds(bench, light, inside, bench.visits, seed)
    if len(lights) > 1:
        everything = np.ones(len(bench.labels), dtype=bool)
        for trial in _folds(bench, "fused", everything, bench.rooms, seed):
            yield trial
            yield from _away(bench, trial)
        if len(bench.shown):
            by_sight = replace(bench, labels=bench.shown)
            yield from _folds(by_sight, SHOWN, everything, bench.shown_rooms, seed)
    row = "frames of one visit on both sides (paper)"
    yield from _folds(bench, row, np.ones(len(bench.labels), dtype=bool), None, seed)


def light(bench: Bench) -> Iterator[Trial]:
    """Train in one light, test in another, in each building (paper, Table 2).

    Where the same walk was taken in every light, every other image of it is learned from, and
    those halfway between are tested. Then alternate stretches of the walk are learned from and
    tested, in another light and, to see what of the loss is the light's, in the same.
    """
    lights = sorted(set(bench.lights.tolist()))
    pairs = [(a, b) for a in lights for b in lights if a != b]
    if not len(bench.order):
        everything = np.ones(len(bench.labels), dtype=bool)
        yield from _across(bench, pairs, everything, everything, "{} to {}")
        return
    odd = bench.order % 2 == 1
    yield from _across(bench, pairs, ~odd, odd, "{} to {}")
    odd = bench.stretches % 2 == 1
    for train, test in ((odd, ~odd), (~odd, odd)):
        yield from _across(bench, pairs, train, test, STRETCHES)
    for train, test in ((odd, ~odd), (~odd, odd)):
        yield from _across(bench, [(a, a) for a in lights], train, test, STRETCHES_SAME_LIGHT)


def _across(
    bench: Bench,
    pairs: Sequence[tuple[str, str]],
    learned: NDArray[np.bool_],
    tested: NDArray[np.bool_],
    row: str,
) -> Iterator[Trial]:
    for a, b in pairs:
        for building in sorted(set(bench.buildings.tolist())):
            inside = bench.buildings == building
            train, test = inside & learned & (bench.lights == a), inside & (bench.lights == b)
            test &= tested
            if test.any() and len(np.unique(bench.labels[train])) > 1:
                yield run_trial(bench, row.format(a, b), train, test)


def building(bench: Bench, seed: int, permutations: int = 100) -> Iterator[Trial]:
    """Train on half of the buildings, test on the other half and back (paper, Fig. 15).

    Each permutation draws the halves, and half of the training images.
    """
    random = np.random.default_rng(seed)
    names = sorted(set(bench.buildings.tolist()))
    halves = list(combinations(names, len(names) // 2))
    for i in range(permutations):
        if i % 2 == 0:
            first = halves[int(random.integers(len(halves)))]
        inside = np.isin(bench.buildings, first) == (i % 2 == 0)
        train = inside & (random.random(len(inside)) < 0.5)
        yield run_trial(bench, "there" if i % 2 == 0 else "and back", train, ~inside)


def _folds(
    bench: Bench, row: str, inside: NDArray[np.bool_], groups: NDArray[np.str_] | None, seed: int
) -> Iterator[Trial]:
    members = np.flatnonzero(inside)
    own = None if groups is None else groups[members]
    folds = assign_folds(bench.labels[members], own, N_FOLDS, np.random.default_rng(seed))
    for fold in range(N_FOLDS):
        test = np.zeros(len(inside), dtype=bool)
        test[members[folds == fold]] = True
        train = inside & ~test
        if test.any() and len(np.unique(bench.labels[train])) > 1:
            yield run_trial(bench, row, train, test)


def _away(bench: Bench, trial: Trial) -> Iterator[Trial]:
    """Yield the part of a trial whose images were taken away from doorways, if it is known."""
    if len(bench.doorway_m):
        away = bench.doorway_m[trial.tested] >= AWAY_M
        if away.any():
            yield Trial(AWAY, trial.truth[away], trial.found[away], trial.tested[away])
