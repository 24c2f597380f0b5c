"""Classifier ``linear_svm``: linear support vector machines, one class against all others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.classifiers.calibrated import CalibratedClassifier, Machine

FloatArray = NDArray[np.float64]


class LinearSvmSettings(Settings):
    """Settings of the linear SVM."""

    C: float = Field(default=10.0, gt=0, description="penalty of training errors (paper: 10)")


class LinearSvm(CalibratedClassifier):
    """One linear SVM for each class (Kostavelis & Gasteratos, 2013, section 3.2.3; C = 10).

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
    coef_, intercept_ : (K, D) and (K,) float64
        The decision of class k is ``X @ coef_[k] + intercept_[k]``.
    """

    name = "linear_svm"
    settings_class = LinearSvmSettings

    def __init__(
        self,
        C: float = 10.0,
        n_folds: int = 5,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.C = C
        self.n_folds = n_folds
        self.random_state = random_state

    @property
    def coef_(self) -> FloatArray:
        """Coefficients (K, D) of the machines."""
        return self.machine_["coef"]

    @property
    def intercept_(self) -> FloatArray:
        """Offsets (K,) of the machines."""
        return self.machine_["intercept"]

    def contributions(self, vector: FloatArray, winner: int) -> FloatArray:
        """Return the contribution of each number of a vector (D,) to a class against the mean."""
        coef = self.coef_
        others = (coef.sum(axis=0) - coef[winner]) / (len(coef) - 1)
        return np.asarray((coef[winner] - others) * vector)

    def _learn(self, X: FloatArray, index: NDArray[np.int64]) -> Machine:
        from sklearn.svm import LinearSVC

        # The primal solver draws no random numbers; `auto` takes it wherever it is the faster one.
        svm = LinearSVC(C=self.C, dual=False, max_iter=10000).fit(X, index)
        coef, intercept = svm.coef_, svm.intercept_
        if len(svm.classes_) == 2:
            coef, intercept = np.vstack([-coef, coef]), np.hstack([-intercept, intercept])
        return {"coef": coef, "intercept": intercept}

    def _decide(self, machine: Machine, X: FloatArray) -> FloatArray:
        return np.asarray(X @ machine["coef"].T + machine["intercept"])

    def _axes(self, X: FloatArray) -> FloatArray | None:
        """Return axes (D, N) that span the N samples, None if there are fewer features.

        The machines' coefficients are sums of samples, so learning along these axes gives the
        same machines, from N numbers a sample instead of D.
        """
        if X.shape[1] <= 2 * X.shape[0]:
            return None
        values, vectors = np.linalg.eigh(X @ X.T)
        kept = values > values[-1] * 1e-10
        return np.asarray(X.T @ (vectors[:, kept] / np.sqrt(values[kept])))

    def _lifted(self, machine: Machine, axes: FloatArray) -> Machine:
        return machine | {"coef": machine["coef"] @ axes.T}

    def _shapes(self, n_classes: int, n_features: int) -> dict[str, tuple[int, ...]]:
        return {"coef": (n_classes, n_features), "intercept": (n_classes,)}

    def _width(self, machine: Machine) -> int:
        return int(machine["coef"].shape[-1])
