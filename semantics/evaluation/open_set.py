"""Open-set evaluation: probabilities in unseen buildings and for unseen kinds of place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.classifiers.classifier import PlaceClassifier
from roomgraph.semantics.evaluation.splits import EvaluationSet

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class OpenSetEvaluation:
    """Probabilities (N, K), truth (N,) and familiarity (N,) of images of unseen buildings.

    `novel` is the familiarity of images of a kind of place never seen.
    """

    classes: list[str]
    probabilities: NDArray[np.float64]
    truth: NDArray[np.str_]
    familiarity: NDArray[np.float64]
    novel: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    known: dict[str, NDArray[np.float64]] = field(default_factory=dict)

    @property
    def confidence(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """The largest probability of each image (N,), and whether its class is the true one."""
        best = self.probabilities.argmax(axis=1)
        right = np.array(self.classes)[best] == self.truth
        return self.probabilities.max(axis=1), right


def evaluate_open_set(evaluation_set: EvaluationSet, progress: Progress) -> OpenSetEvaluation:
    """Return probabilities for buildings left out, and familiarity for kinds left out as well."""
    names, classes = sorted(set(evaluation_set.buildings.tolist())), evaluation_set.classes
    shape = (len(evaluation_set.labels), len(classes))
    probabilities, familiarity = np.zeros(shape), np.zeros(shape[0])
    novel, known = {}, {}
    total = len(names) + len(classes)
    for done, name in enumerate(names, 1):
        test = evaluation_set.buildings == name
        fitted = _calibrated(evaluation_set, ~test)
        decisions = fitted.decisions(evaluation_set.vectors[test])
        columns = [classes.index(str(c)) for c in fitted.classes_]
        found = np.zeros((int(test.sum()), len(classes)))
        found[:, columns] = fitted.probabilities(decisions)
        probabilities[test], familiarity[test] = found, fitted.familiarity(decisions)
        progress(done, total)
    for i, kind in enumerate(classes):
        test = evaluation_set.buildings == names[i % len(names)]
        fitted = _calibrated(evaluation_set, ~test & (evaluation_set.labels != kind))
        found = fitted.familiarity(fitted.decisions(evaluation_set.vectors[test]))
        is_novel = evaluation_set.labels[test] == kind
        novel[kind], known[kind] = found[is_novel], found[~is_novel]
        progress(len(names) + i + 1, total)
    return OpenSetEvaluation(
        classes=classes,
        probabilities=probabilities,
        truth=evaluation_set.labels,
        familiarity=familiarity,
        novel=novel,
        known=known,
    )


def _calibrated(evaluation_set: EvaluationSet, train: NDArray[np.bool_]) -> PlaceClassifier:
    buildings = evaluation_set.buildings[train].tolist()
    return evaluation_set.classifier.clone(random_state=0).fit(
        evaluation_set.vectors[train], evaluation_set.labels[train], buildings
    )
