"""Training images kept in a place model, and training on further labels with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.recognition.model import Exemplars, PlaceModel


def choose_exemplars(
    vectors: NDArray[Any], labels: Sequence[str], groups: Sequence[str], maximum: int
) -> Exemplars | None:
    """Return up to `maximum` vectors of each label, evenly spread; None for a maximum of 0.

    Parameters
    ----------
    vectors : (N, D) float
        What a classifier saw.
    labels, groups : sequence of str
        The class of each, and what it was seen together with.
    maximum : int
        Of each label.
    """
    if not maximum:
        return None
    names = np.array(labels)
    rows = [np.flatnonzero(names == name) for name in np.unique(names)]
    kept = np.sort(
        np.concatenate(
            [own[np.linspace(0, len(own) - 1, min(maximum, len(own))).astype(int)] for own in rows]
        )
    )
    return Exemplars(vectors[kept].astype(np.float16), names[kept], np.array(groups)[kept])


def learn_more(
    model: PlaceModel, vectors: Sequence[NDArray[Any]], label: str, group: str, seed: int = 0
) -> PlaceModel:
    """Return a model trained on further images of a label, which may be new.

    The descriptor stays as it is; the classifier is learned again from the exemplars that the
    model keeps and the new ones.

    Parameters
    ----------
    model : PlaceModel
        With exemplars.
    vectors : sequence of (D,) arrays
        What its classifier sees of the new images, see `PlaceModel.vector`.
    label, group : str
        What they show, and what they were seen together with.
    seed : int
        Of the folds.

    Raises
    ------
    SemanticsError
        The model has no exemplars, or there are no new images.
    """
    if model.exemplars is None:
        raise SemanticsError(
            "the model keeps no exemplars", expected="a model trained with exemplars above 0",
            hint="train it again",
        )  # fmt: skip
    if not len(vectors):
        raise SemanticsError("no image to learn from", expected="an image of the place")
    known, count = model.exemplars, len(vectors)
    exemplars = Exemplars(
        np.vstack([known.vectors, np.asarray(vectors, dtype=np.float16)]),
        np.concatenate([known.labels, np.repeat(label, count)]),
        np.concatenate([known.groups, np.repeat(group, count)]),
    )
    classifier = model.classifier.clone(random_state=seed).fit(
        exemplars.vectors, exemplars.labels, exemplars.groups.tolist()
    )
    labels = model.labels.with_label(label)
    return replace(
        model, labels=labels, classifier=classifier, exemplars=exemplars,
        transitions=_extended(model.transitions, len(labels) - 1),
    )  # fmt: skip


def _extended(transitions: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Return transitions extended by a new kind, if there is one, with uniform probabilities."""
    if len(transitions) == count:
        return transitions
    table = np.full((count, count), 1.0 / max(1, count - 1))
    table[-1, -1] = 0.0
    table[:-1, :-1] = transitions * (count - 2) / max(1, count - 1)
    return table
