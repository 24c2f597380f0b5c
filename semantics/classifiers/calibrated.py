"""Calibration of any classifier's probabilities on samples held out of training."""

from __future__ import annotations

import warnings
from abc import ABC, abstractmethod
from collections.abc import Hashable, Mapping, Sequence
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.classifiers.folds import assign_folds
from roomgraph.semantics.classifiers.platt import fit_sigmoid, fit_softmax, sigmoid, softmax
from roomgraph.semantics.estimator import Estimator

FloatArray = NDArray[np.float64]
# What a machine has learned, by name.
Machine = dict[str, FloatArray]


class CalibratedClassifier(Estimator, ABC):
    """A machine that decides, and the probabilities of its decisions (see `PlaceClassifier`).

    A subclass says how the machine is learned (`_learn`), how it decides (`_decide`), and the
    shapes of its arrays (`_shapes`, `_width`). Its constructor takes its own parameters,
    ``n_folds`` and ``random_state``.

    Attributes
    ----------
    classes_ : (K,) array
        The classes, sorted.
    machine_ : dict of str to array
        What the machine has learned.
    sigmoid_ : (K, 2) float64
        Slope and offset of each class's sigmoid (Platt, 1999): does it fit this class at all?
    scaling_ : (K + 1,) float64
        Slope of all decisions and offset of each class, under the softmax that makes them
        probabilities: which class fits best?
    familiarity_ : (N,) float64
        `familiarity` of each sample when its fold was left out; NaN where it never was.
    cross_validated_accuracy_ : float
        Share of samples that were right when their fold was left out; NaN if a class has a single
        sample.
    """

    name: ClassVar[str]
    settings_class: ClassVar[type[Settings]]
    n_folds: int
    random_state: int | np.random.Generator | None

    @abstractmethod
    def _learn(self, X: FloatArray, index: NDArray[np.int64]) -> Machine:
        """Return the machine that tells classes (N,), 0 to K - 1, apart by samples (N, D)."""

    @abstractmethod
    def _decide(self, machine: Machine, X: FloatArray) -> FloatArray:
        """Return the decisions (N, K) of a machine."""

    @abstractmethod
    def _shapes(self, n_classes: int, n_features: int) -> dict[str, tuple[int, ...]]:
        """Return the shapes of a machine's arrays; -1 for a length that may be any."""

    @abstractmethod
    def _width(self, machine: Machine) -> int:
        """Return the number D of features that a machine takes."""

    def _axes(self, X: FloatArray) -> FloatArray | None:
        """Return axes (D, R) that make training faster with the same result, or None."""
        return None

    def _lifted(self, machine: Machine, axes: FloatArray) -> Machine:
        """Return a machine learned on axes as one for the features themselves."""
        return machine

    def contributions(self, vector: FloatArray, winner: int) -> FloatArray | None:
        """Return the contribution of each number of a vector (D,) to a class against the mean.

        None, as by default, where the decision is no sum over the vector's numbers.
        """
        return None

    def fit(self, X: ArrayLike, y: ArrayLike, groups: Sequence[Hashable] | None = None) -> Self:
        """Learn from vectors `X` (N, D) and their classes `y` (N,).

        Samples of the same group (a visit to a room) are never on both sides of the
        cross-validation, see `assign_folds`.

        Raises
        ------
        ValueError
            `X` or `y` is not such an array, or there are fewer than two classes.
        """
        matrix = self._check_X(X, reset=True)
        target = _check_y(y, len(matrix), type(self).__name__)
        self.classes_, index = np.unique(target, return_inverse=True)
        if len(self.classes_) < 2:
            raise ValueError(f"expected two classes or more, got one class: {self.classes_[0]!r}")
        n_folds = min(self.n_folds, int(np.bincount(index).min()))
        self.sigmoid_ = np.tile([1.0, 0.0], (len(self.classes_), 1))
        self.scaling_ = np.concatenate([[1.0], np.zeros(len(self.classes_))])
        self.cross_validated_accuracy_ = float("nan")
        self.familiarity_ = np.full(len(matrix), np.nan)
        axes = self._axes(matrix)
        matrix = matrix if axes is None else matrix @ axes
        if n_folds >= 2:
            folds = assign_folds(index, groups, n_folds, np.random.default_rng(self.random_state))
            self._calibrate(matrix, index, folds)
        machine = self._learn(matrix, index)
        self.machine_ = machine if axes is None else self._lifted(machine, axes)
        return self

    def decisions(self, X: ArrayLike) -> FloatArray:
        """Return the decision values (N, K) of the classes; the largest wins."""
        self._check_fitted()
        return self._decide(self.machine_, self._check_X(X))

    def decision_function(self, X: ArrayLike) -> FloatArray:
        """Return the decisions (N, K); of two classes only the second's (N,), as elsewhere."""
        decisions = self.decisions(X)
        return decisions[:, 1] if len(self.classes_) == 2 else decisions

    def predict(self, X: ArrayLike) -> NDArray[Any]:
        """Return the class (N,) that most speaks for."""
        decisions = self.decisions(X)
        return np.asarray(self.classes_[decisions.argmax(axis=1)])

    def predict_proba(self, X: ArrayLike) -> FloatArray:
        """Return the probability (N, K) of each class."""
        return self.probabilities(self.decisions(X))

    def probabilities(self, decisions: FloatArray) -> FloatArray:
        """Return probabilities (N, K) from decisions (N, K)."""
        return softmax(decisions * self.scaling_[0] + self.scaling_[1:])

    def familiarity(self, decisions: FloatArray) -> FloatArray:
        """Return the largest probability (N,) that a class alone has, from decisions (N, K).

        It is low where nothing speaks for any: the image may be of none of the classes.
        """
        alone = sigmoid(decisions * self.sigmoid_[:, 0] + self.sigmoid_[:, 1])
        return np.asarray(alone.max(axis=1))

    def score(self, X: ArrayLike, y: ArrayLike) -> float:
        """Return the share of `X` (N, D) that is predicted as `y` (N,)."""
        return float(np.mean(self.predict(X) == np.asarray(y)))

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the machine's arrays, ``sigmoid`` and ``scaling``."""
        return {**self.machine_, "sigmoid": self.sigmoid_, "scaling": self.scaling_}

    def with_arrays(self, classes: Sequence[str], arrays: Mapping[str, NDArray[Any]]) -> Self:
        """Restore what `arrays` returned; return self.

        Raises
        ------
        KeyError, ValueError
            An array is missing, or is not of the right shape.
        """
        own = {"sigmoid": (len(classes), 2), "scaling": (len(classes) + 1,)}
        names = self._shapes(len(classes), 0)
        machine = {name: np.asarray(arrays[name], dtype=np.float64) for name in names}
        width = self._width(machine)
        for name, shape in (own | self._shapes(len(classes), width)).items():
            _check_shape(name, arrays[name], shape)
        self.classes_, self.machine_, self.n_features_in_ = np.array(classes), machine, width
        self.sigmoid_, self.scaling_ = arrays["sigmoid"], arrays["scaling"]
        return self

    def __sklearn_tags__(self) -> Any:
        from sklearn.utils import ClassifierTags, InputTags, Tags, TargetTags

        return Tags(
            estimator_type="classifier",
            target_tags=TargetTags(required=True),
            classifier_tags=ClassifierTags(),
            input_tags=InputTags(),
        )

    def _calibrate(self, X: FloatArray, index: NDArray[np.int64], folds: NDArray[np.int64]) -> None:
        """Fit the sigmoids on the decisions about samples that were left out of training."""
        decisions = np.full((len(X), len(self.classes_)), np.nan)
        for fold in np.unique(folds):
            test = folds == fold
            if len(np.unique(index[~test])) == len(self.classes_):
                machine = self._learn(X[~test], index[~test])
                decisions[test] = self._decide(machine, X[test])
        known = ~np.isnan(decisions[:, 0])
        if not known.any():
            return
        decisions, index = decisions[known], index[known]
        self.scaling_ = fit_softmax(decisions, index)
        self.cross_validated_accuracy_ = float(np.mean(decisions.argmax(axis=1) == index))
        self.sigmoid_ = np.array(
            [fit_sigmoid(decisions[:, k], index == k) for k in range(len(self.classes_))]
        )
        self.familiarity_[known] = self.familiarity(decisions)


def _check_shape(name: str, array: NDArray[Any], shape: tuple[int, ...]) -> None:
    fits = array.ndim == len(shape) and all(
        wanted in (-1, found) for wanted, found in zip(shape, array.shape, strict=True)
    )
    if not fits:
        raise ValueError(f"{name} of shape {array.shape}, expected {shape}")


def _check_y(y: ArrayLike, n_samples: int, owner: str) -> NDArray[Any]:
    if y is None:
        raise ValueError(f"{owner} requires y to be passed, but the target y is None")
    target = np.asarray(y)
    if target.ndim == 2 and target.shape[1] == 1:
        from sklearn.exceptions import DataConversionWarning

        message = "A column-vector y was passed when a 1d array was expected"
        warnings.warn(message, DataConversionWarning, stacklevel=3)
        target = target[:, 0]
    if target.shape != (n_samples,):
        raise ValueError(f"y should be a 1d array of {n_samples} classes, got shape {target.shape}")
    if target.dtype.kind == "f" and not np.all(np.isfinite(target) & (target == np.floor(target))):
        raise ValueError("Unknown label type: y holds continuous values; expected classes")
    return target
