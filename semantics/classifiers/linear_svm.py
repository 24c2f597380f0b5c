"""The place classifier: a linear support vector machine, one class against all others."""

from __future__ import annotations

import warnings
from collections.abc import Hashable, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roomgraph.semantics.classifiers.folds import assign_folds
from roomgraph.semantics.classifiers.platt import fit_sigmoid, fit_softmax, sigmoid, softmax
from roomgraph.semantics.estimator import Estimator


class PlaceClassifier(Estimator):
    """One linear SVM for each class against all others (paper, section 3.2.3; C = 10).

    Training needs scikit-learn; prediction is a product with stored coefficients.

    Parameters
    ----------
    C : float
        Penalty of errors.
    n_folds : int
        Folds of the cross-validation that the probabilities are fitted on.
    random_state : int, Generator or None
        Deals samples without groups to folds.

    Attributes
    ----------
    classes_ : (K,) array
        The classes, sorted.
    coef_, intercept_ : (K, D) and (K,) float64
        The decision of class k is ``X @ coef_[k] + intercept_[k]``.
    sigmoid_ : (K, 2) float64
        Slope and offset of each class's sigmoid (Platt, 1999): does it fit this class at all?
    scaling_ : (K + 1,) float64
        Slope of all margins and offset of each class, under the softmax that makes them
        probabilities: which class fits best?
    familiarity_ : (N,) float64
        `familiarity` of each sample when its fold was left out; NaN where it never was.
    cross_validated_accuracy_ : float
        Share of samples that were right when their fold was left out; NaN if a class has a single
        sample.
    """

    def __init__(
        self,
        C: float = 10.0,
        n_folds: int = 5,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.C = C
        self.n_folds = n_folds
        self.random_state = random_state

    @classmethod
    def from_arrays(
        cls,
        classes: Sequence[str],
        coef: NDArray[np.float64],
        intercept: NDArray[np.float64],
        sigmoids: NDArray[np.float64],
        scaling: NDArray[np.float64] | None = None,
    ) -> Self:
        """Return a fitted classifier from stored arrays (see the attributes)."""
        classifier = cls()
        classifier.classes_ = np.array(classes)
        classifier.coef_, classifier.intercept_ = coef, intercept
        classifier.sigmoid_ = sigmoids
        classifier.scaling_ = _plain_scaling(len(classes)) if scaling is None else scaling
        classifier.n_features_in_ = coef.shape[1]
        return classifier

    def fit(self, X: ArrayLike, y: ArrayLike, groups: Sequence[Hashable] | None = None) -> Self:
        """Learn from histograms `X` (N, D) and their classes `y` (N,).

        Samples of the same group (a visit to a room) are never on both sides of the
        cross-validation, see `assign_folds`.

        Raises
        ------
        ValueError
            `X` or `y` is not such an array, or there are fewer than two classes.
        """
        matrix = self._check_X(X, reset=True)
        target = _check_y(y, len(matrix))
        self.classes_, index = np.unique(target, return_inverse=True)
        if len(self.classes_) < 2:
            raise ValueError(f"expected two classes or more, got one class: {self.classes_[0]!r}")
        n_folds = min(self.n_folds, int(np.bincount(index).min()))
        self.sigmoid_ = np.tile([1.0, 0.0], (len(self.classes_), 1))
        self.scaling_ = _plain_scaling(len(self.classes_))
        self.cross_validated_accuracy_ = float("nan")
        self.familiarity_ = np.full(len(matrix), np.nan)
        axes = _axes(matrix)
        matrix = matrix if axes is None else matrix @ axes
        if n_folds >= 2:
            folds = assign_folds(index, groups, n_folds, np.random.default_rng(self.random_state))
            self._calibrate(matrix, index, folds)
        coef, self.intercept_ = self._fit_svm(matrix, index)
        self.coef_ = coef if axes is None else coef @ axes.T
        return self

    def decision_function(self, X: ArrayLike) -> NDArray[np.float64]:
        """Return signed margins (N, K); of two classes only the second's (N,), as elsewhere."""
        decisions = self._decisions(X)
        return decisions[:, 1] if len(self.classes_) == 2 else decisions

    def predict(self, X: ArrayLike) -> NDArray[Any]:
        """Return the class (N,) whose machine has the largest margin."""
        decisions = self._decisions(X)
        return np.asarray(self.classes_[decisions.argmax(axis=1)])

    def predict_proba(self, X: ArrayLike) -> NDArray[np.float64]:
        """Return the probability (N, K) of each class."""
        return self.probabilities(self._decisions(X))

    def probabilities(self, decisions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return probabilities (N, K) from margins (N, K)."""
        return softmax(decisions * self.scaling_[0] + self.scaling_[1:])

    def familiarity(self, decisions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the largest probability (N,) that a machine alone gives, from margins (N, K).

        It is low where all machines say no: the image may be of none of the classes.
        """
        alone = sigmoid(decisions * self.sigmoid_[:, 0] + self.sigmoid_[:, 1])
        return np.asarray(alone.max(axis=1))

    def score(self, X: ArrayLike, y: ArrayLike) -> float:
        """Return the share of `X` (N, D) that is predicted as `y` (N,)."""
        return float(np.mean(self.predict(X) == np.asarray(y)))

    def __sklearn_tags__(self) -> Any:
        from sklearn.utils import ClassifierTags, InputTags, Tags, TargetTags

        return Tags(
            estimator_type="classifier",
            target_tags=TargetTags(required=True),
            classifier_tags=ClassifierTags(),
            input_tags=InputTags(),
        )

    def _decisions(self, X: ArrayLike) -> NDArray[np.float64]:
        self._check_fitted()
        return np.asarray(self._check_X(X) @ self.coef_.T + self.intercept_)

    def _calibrate(
        self, X: NDArray[np.float64], index: NDArray[np.int64], folds: NDArray[np.int64]
    ) -> None:
        """Fit the sigmoids on the decisions about samples that were left out of training."""
        decisions = np.full((len(X), len(self.classes_)), np.nan)
        for fold in np.unique(folds):
            test = folds == fold
            if len(np.unique(index[~test])) == len(self.classes_):
                coef, intercept = self._fit_svm(X[~test], index[~test])
                decisions[test] = X[test] @ coef.T + intercept
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

    def _fit_svm(
        self, X: NDArray[np.float64], index: NDArray[np.int64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        from sklearn.svm import LinearSVC

        # The primal solver draws no random numbers; `auto` takes it wherever it is the faster one.
        svm = LinearSVC(C=self.C, dual=False, max_iter=10000).fit(X, index)
        if len(svm.classes_) == 2:
            return np.vstack([-svm.coef_, svm.coef_]), np.hstack([-svm.intercept_, svm.intercept_])
        return svm.coef_, svm.intercept_


def _axes(X: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return axes (D, N) that span the N samples, None if there are fewer features than samples.

    The machines' coefficients are sums of samples, so learning along these axes gives the same
    machines, from N numbers a sample instead of D.
    """
    if X.shape[1] <= 2 * X.shape[0]:
        return None
    values, vectors = np.linalg.eigh(X @ X.T)
    kept = values > values[-1] * 1e-10
    return np.asarray(X.T @ (vectors[:, kept] / np.sqrt(values[kept])))


def _plain_scaling(n_classes: int) -> NDArray[np.float64]:
    return np.concatenate([[1.0], np.zeros(n_classes)])


def _check_y(y: ArrayLike, n_samples: int) -> NDArray[Any]:
    if y is None:
        raise ValueError("PlaceClassifier requires y to be passed, but the target y is None")
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
