"""Folds for cross-validation that keep groups of images together."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import NDArray


def assign_folds(
    labels: Sequence[Hashable] | NDArray[np.generic],
    groups: Sequence[Hashable] | NDArray[np.generic] | None,
    n_folds: int,
    random: np.random.Generator,
) -> NDArray[np.int64]:
    """Return the fold (N,) of each sample, with each label spread over the folds.

    Frames of one visit to a room look alike: with some of them in training, the others say little
    about an unseen visit. A group therefore stays in one fold, the largest being dealt first. A
    label with a single group has to be split to be tested at all: into blocks of consecutive
    samples, of which only the borders look alike.

    Parameters
    ----------
    labels : (N,) sequence
        The class of each sample.
    groups : (N,) sequence or None
        The group (visit) of each sample, in time order; None if the samples are independent.
    n_folds : int
        Number of folds, 2 or more.
    random : Generator
        Deals independent samples.
    """
    labels = np.asarray(labels)
    folds = np.zeros(len(labels), dtype=np.int64)
    filled = np.zeros(n_folds, dtype=np.int64)
    for label in np.unique(labels):
        members = np.flatnonzero(labels == label)
        if groups is None:
            folds[random.permutation(members)] = np.arange(len(members)) % n_folds
            continue
        parts = _groups_of(members, np.asarray(groups)[members])
        if len(parts) == 1:
            parts = [block for block in np.array_split(members, n_folds) if len(block)]
        used = np.zeros(n_folds, dtype=np.int64)
        for part in sorted(parts, key=len, reverse=True):
            fold = int(np.lexsort((filled, used))[0])
            folds[part] = fold
            used[fold] += len(part)
            filled[fold] += len(part)
    return folds


def _groups_of(members: NDArray[np.int64], groups: NDArray[np.generic]) -> list[NDArray[np.int64]]:
    return [members[groups == group] for group in np.unique(groups)]
