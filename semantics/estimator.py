"""What the estimators share: scikit-learn's conventions without its import.

Importing scikit-learn takes seconds, and a run that only predicts needs none of it. So these
estimators do not inherit from ``BaseEstimator``: they follow its protocol (``get_params``,
``set_params``, ``__sklearn_tags__``), which is what ``clone``, pipelines and the estimator checks
ask for.
"""

from __future__ import annotations

import inspect
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Estimator:
    """Parameters are the arguments of ``__init__``; learned values end in an underscore."""

    n_features_in_: int

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """Return the constructor's parameters by name (`deep` is there for the protocol)."""
        names = inspect.signature(type(self).__init__).parameters
        return {name: getattr(self, name) for name in names if name != "self"}

    def set_params(self, **params: Any) -> Self:
        """Set parameters by name.

        Raises
        ------
        ValueError
            The estimator has no parameter of that name.
        """
        valid = self.get_params()
        for name, value in params.items():
            if name not in valid:
                owner, names = type(self).__name__, ", ".join(valid)
                raise ValueError(f"{owner} has no parameter {name!r}; expected one of {names}")
            setattr(self, name, value)
        return self

    def clone(self, **changes: Any) -> Self:
        """Return an unfitted estimator with the same parameters, but for some."""
        return type(self)(**(self.get_params() | changes))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in self.get_params().items())
        return f"{type(self).__name__}({values})"

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "n_features_in_")

    def _check_fitted(self) -> None:
        if not self.__sklearn_is_fitted__():
            from sklearn.exceptions import NotFittedError

            raise NotFittedError(f"{type(self).__name__} is not fitted; call fit first")

    def _check_X(
        self, X: ArrayLike, dtype: type[np.floating] = np.float64, reset: bool = False
    ) -> NDArray[Any]:
        """Return `X` as a finite (N, D) array; `reset` learns D, otherwise D must agree.

        Raises
        ------
        ValueError
            `X` is not such an array.
        """
        matrix = as_matrix(X, dtype, type(self).__name__)
        if reset:
            self.n_features_in_ = matrix.shape[1]
        elif matrix.shape[1] != self.n_features_in_:
            raise ValueError(
                f"X has {matrix.shape[1]} features, but {type(self).__name__} is expecting "
                f"{self.n_features_in_} features as input"
            )
        return matrix


def as_matrix(X: ArrayLike, dtype: type[np.floating], owner: str) -> NDArray[Any]:
    """Return `X` as a finite (N, D) array of `dtype` with at least one row and one column.

    Raises
    ------
    ValueError
        `X` is sparse, complex, not two-dimensional, empty, or holds NaN or infinity.
    """
    if hasattr(X, "tocsr"):
        raise TypeError(f"{owner} does not take sparse input; expected a dense array")
    matrix = np.asarray(X)
    if np.iscomplexobj(matrix):
        raise ValueError(f"Complex data not supported by {owner}; expected real numbers")
    if matrix.ndim != 2:
        raise ValueError(
            f"{owner} expected a 2D array (N, D), got {matrix.ndim} dimension(s). "
            "Reshape your data: X.reshape(1, -1) for a single sample"
        )
    for axis, what in enumerate(("sample(s)", "feature(s)")):
        if not matrix.shape[axis]:
            raise ValueError(
                f"Found array with 0 {what} (shape={matrix.shape}) while a minimum of 1 is "
                f"required by {owner}."
            )
    matrix = matrix.astype(dtype, copy=False)
    if not np.isfinite(matrix).all():
        raise ValueError(f"Input X of {owner} contains NaN or infinity")
    return matrix
