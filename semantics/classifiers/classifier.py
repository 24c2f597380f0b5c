"""The interface of place classifiers: from a vector to the probabilities of places."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any, ClassVar, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roomgraph.datasets.settings import Settings

FloatArray = NDArray[np.float64]


class PlaceClassifier(Protocol):
    """A scikit-learn classifier with calibrated probabilities, saved as named arrays.

    `CalibratedClassifier` implements all but the machine itself.

    Attributes
    ----------
    name : str
        What it is called in settings, in files and on the command line.
    settings_class : type
        Its settings; their names are arguments of its constructor, beside ``n_folds`` (folds of
        the cross-validation that the probabilities are fitted on; below 2 there is none) and
        ``random_state``.
    classes_ : (K,) array
        The classes, sorted.
    n_features_in_ : int
        Numbers D of a vector.
    familiarity_ : (N,) float64
        `familiarity` of each training sample when its fold was left out; NaN where it never was.
    cross_validated_accuracy_ : float
        Share of samples that were right when their fold was left out; NaN where none was.
    """

    name: ClassVar[str]
    settings_class: ClassVar[type[Settings]]
    classes_: NDArray[Any]
    n_features_in_: int
    familiarity_: FloatArray
    cross_validated_accuracy_: float

    def fit(self, X: ArrayLike, y: ArrayLike, groups: Sequence[Hashable] | None = None) -> Self:
        """Learn from vectors `X` (N, D) and classes `y` (N,); a group is held out as a whole."""
        ...

    def predict(self, X: ArrayLike) -> NDArray[Any]:
        """Return the class (N,) of each vector."""
        ...

    def decisions(self, X: ArrayLike) -> FloatArray:
        """Return the decision values (N, K) of the classes; the largest wins."""
        ...

    def probabilities(self, decisions: FloatArray) -> FloatArray:
        """Return the probability (N, K) of each class from decisions (N, K)."""
        ...

    def familiarity(self, decisions: FloatArray) -> FloatArray:
        """Return how well the best class fits (N,), 0 to 1: low where none does."""
        ...

    def contributions(self, vector: NDArray[Any], winner: int) -> FloatArray | None:
        """Return the contribution of each number of a vector (D,) to a class against the mean.

        None where the decision is no sum over the vector's numbers.
        """
        ...

    def clone(self, **changes: Any) -> Self:
        """Return an unfitted classifier with the same parameters, but for some."""
        ...

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return what was learned, as named arrays, but for the classes."""
        ...

    def with_arrays(self, classes: Sequence[str], arrays: Mapping[str, NDArray[Any]]) -> Self:
        """Restore what `arrays` returned; return self.

        Raises
        ------
        KeyError, ValueError
            An array is missing, or is not of the right shape.
        """
        ...
