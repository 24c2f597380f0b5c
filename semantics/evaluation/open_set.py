"""What probabilities are worth: for buildings never seen, and for kinds of place never seen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.linear_svm import PlaceClassifier
from roomgraph.semantics.evaluation.trials import Bench

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class Judgement:
    """Probabilities (N, K) of images of buildings never seen, their truth (N,), familiarity (N,).

    `strange` is the familiarity of images of a kind of place never seen.
    """

    classes: list[str]
    probabilities: NDArray[np.float64]
    truth: NDArray[np.str_]
    familiarity: NDArray[np.float64]
    strange: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    usual: dict[str, NDArray[np.float64]] = field(default_factory=dict)

    @property
    def confidence(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """The largest probability of each image (N,), and whether its class is the true one."""
        best = self.probabilities.argmax(axis=1)
        right = np.array(self.classes)[best] == self.truth
        return self.probabilities.max(axis=1), right


def judge(bench: Bench, progress: Progress) -> Judgement:
    """Return probabilities for buildings left out, and familiarity for kinds left out as well."""
    names, classes = sorted(set(bench.buildings.tolist())), bench.classes
    shape = (len(bench.labels), len(classes))
    probabilities, familiarity = np.zeros(shape), np.zeros(shape[0])
    strange, usual = {}, {}
    total = len(names) + len(classes)
    for done, name in enumerate(names, 1):
        test = bench.buildings == name
        fitted = _calibrated(bench, ~test)
        decisions = _decisions(fitted, bench.vectors[test])
        columns = [classes.index(str(c)) for c in fitted.classes_]
        found = np.zeros((int(test.sum()), len(classes)))
        found[:, columns] = fitted.probabilities(decisions)
        probabilities[test], familiarity[test] = found, fitted.familiarity(decisions)
        progress(done, total)
    for i, kind in enumerate(classes):
        test = bench.buildings == names[i % len(names)]
        fitted = _calibrated(bench, ~test & (bench.labels != kind))
        found = fitted.familiarity(_decisions(fitted, bench.vectors[test]))
        is_strange = bench.labels[test] == kind
        strange[kind], usual[kind] = found[is_strange], found[~is_strange]
        progress(len(names) + i + 1, total)
    return Judgement(classes, probabilities, bench.labels, familiarity, strange, usual)


def _calibrated(bench: Bench, train: NDArray[np.bool_]) -> PlaceClassifier:
    buildings = bench.buildings[train].tolist()
    return PlaceClassifier(bench.C, random_state=0).fit(
        bench.vectors[train], bench.labels[train], buildings
    )


def _decisions(fitted: PlaceClassifier, X: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(X @ fitted.coef_.T + fitted.intercept_)
