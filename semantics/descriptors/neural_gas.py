"""Neural Gas: prototypes that spread over the data like a gas fills a room."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roomgraph.semantics.estimator import Estimator

# A unit whose neighbourhood weight is below this moves by nothing that float32 would notice.
_NEGLIGIBLE = 1e-3
# With fewer steps the ranges shrink faster than the prototypes can spread.
_MIN_STEPS = 500
# Samples looked at together where all are.
_BLOCK = 8192


class NeuralGas(Estimator):
    """Vector quantisation by Neural Gas (Martinetz, Berkovich and Schulten, 1993).

    For each sample x the prototypes are ranked by distance, k = 0 for the nearest, and each moves
    by ``eps * exp(-k / lambda) * (x - w)`` (eq. 7); eps and lambda decay geometrically from their
    initial to their final values (eq. 14). Here a batch of samples is ranked at once and each
    prototype takes the steps of the whole batch in one: ``1 - exp(-eps * sum(h))`` of the way to
    the h-weighted mean, where the sample-by-sample steps would have led it to first order.

    Parameters
    ----------
    n_vectors : int
        Number of prototypes, the paper's Q.
    n_epochs : int
        Passes over the data, the paper's t_max.
    batch_size : int
        Samples ranked at once, at most.
    initial_step, final_step : float
        eps at the first and the last batch, in (0, 1].
    initial_range, final_range : float
        lambda at the first and the last batch, in ranks; at first ``n_vectors / 2`` at most.
        These defaults and those of the steps are what Fritzke (1997) names as the paper's.
    settling : int
        Passes at the end in which each prototype goes to the mean of its samples: the limit of
        range 0, where Neural Gas is k-means (section II of the paper), without the last steps'
        jitter.
    random_state : int, Generator or None
        Seeds the choice of the first prototypes and the order of the samples.

    Attributes
    ----------
    prototypes_ : (n_vectors, D) float32
        The quantisation vectors.
    quantization_error_ : float
        Mean squared distance from the samples to their nearest prototypes.
    n_features_in_ : int
        D.
    """

    def __init__(
        self,
        n_vectors: int = 100,
        n_epochs: int = 5,
        batch_size: int = 256,
        initial_step: float = 0.5,
        final_step: float = 0.005,
        initial_range: float = 10.0,
        final_range: float = 0.01,
        settling: int = 2,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_vectors = n_vectors
        self.n_epochs = n_epochs
        self.batch_size = batch_size
        self.initial_step = initial_step
        self.final_step = final_step
        self.initial_range = initial_range
        self.final_range = final_range
        self.settling = settling
        self.random_state = random_state

    @classmethod
    def from_prototypes(cls, prototypes: NDArray[np.float32]) -> Self:
        """Return a fitted estimator with the given prototypes (Q, D)."""
        gas = cls(n_vectors=len(prototypes))
        gas.prototypes_ = np.asarray(prototypes, dtype=np.float32)
        gas.n_features_in_ = prototypes.shape[1]
        return gas

    def fit(self, X: ArrayLike, y: object = None) -> Self:
        """Learn the prototypes of `X` (N, D); `y` is ignored.

        Raises
        ------
        ValueError
            `X` is not a finite (N, D) array, or a parameter is out of range.
        """
        self._check_params()
        samples = self._check_X(X, np.float32, reset=True)
        random = np.random.default_rng(self.random_state)
        # The mean is taken off while learning: |w|^2 - 2 w.x loses fewer digits near the origin.
        mean = samples.mean(axis=0)
        prototypes = samples[self._first_choice(len(samples), random)] - mean
        batches = self._batches(len(samples), random)
        first_range = min(self.initial_range, self.n_vectors / 2)
        for progress, batch in zip(np.linspace(0, 1, len(batches)), batches, strict=True):
            step = self.initial_step * (self.final_step / self.initial_step) ** progress
            reach = first_range * (self.final_range / first_range) ** progress
            _adapt(prototypes, samples[batch] - mean, float(step), float(reach))
        for _ in range(self.settling):
            prototypes = _settled(prototypes, samples, mean)
        self.prototypes_ = prototypes + mean
        self.quantization_error_ = self._error(samples)
        return self

    def partial_fit(self, X: ArrayLike, y: object = None) -> Self:
        """Go on learning from more samples `X` (N, D), without starting over; `y` is ignored.

        The first call learns like `fit`. Later ones pass once over the samples at the final step
        and range: the gas has cooled, and its prototypes follow what is new a little.

        Raises
        ------
        ValueError
            `X` is not a finite (N, D) array, or a parameter is out of range.
        """
        if not self.__sklearn_is_fitted__():
            return self.fit(X)
        self._check_params()
        samples = self._check_X(X, np.float32)
        mean = samples.mean(axis=0)
        prototypes = self.prototypes_ - mean
        for i in range(0, len(samples), self.batch_size):
            batch = samples[i : i + self.batch_size] - mean
            _adapt(prototypes, batch, self.final_step, self.final_range)
        self.prototypes_ = prototypes + mean
        self.quantization_error_ = self._error(samples)
        return self

    def transform(self, X: ArrayLike) -> NDArray[np.float32]:
        """Return the distances (N, Q) from samples (N, D) to the prototypes."""
        self._check_fitted()
        samples = self._check_X(X, np.float32)
        squared = _scores(samples, self.prototypes_) + (samples**2).sum(axis=1, keepdims=True)
        return np.asarray(np.sqrt(np.maximum(squared, 0)), dtype=np.float32)

    def fit_transform(self, X: ArrayLike, y: object = None) -> NDArray[np.float32]:
        """Learn the prototypes of `X` and return the distances to them."""
        return self.fit(X).transform(X)

    def predict(self, X: ArrayLike) -> NDArray[np.int64]:
        """Return the index (N,) of the prototype nearest to each of the samples (N, D)."""
        self._check_fitted()
        samples = self._check_X(X, np.float32)
        return np.asarray(_scores(samples, self.prototypes_).argmin(axis=1), dtype=np.int64)

    def __sklearn_tags__(self) -> Any:
        from sklearn.utils import InputTags, Tags, TargetTags, TransformerTags

        return Tags(
            estimator_type=None,
            target_tags=TargetTags(required=False),
            transformer_tags=TransformerTags(preserves_dtype=["float32"]),
            input_tags=InputTags(),
        )

    def _first_choice(self, n_samples: int, random: np.random.Generator) -> NDArray[np.int64]:
        """Return the samples that the prototypes start on, repeated only if there are too few."""
        return random.choice(n_samples, self.n_vectors, replace=n_samples < self.n_vectors)

    def _batches(self, n_samples: int, random: np.random.Generator) -> list[NDArray[np.int64]]:
        """Return the samples of each step; smaller batches where the steps would be too few."""
        size = max(1, min(self.batch_size, self.n_epochs * n_samples // _MIN_STEPS))
        orders = [random.permutation(n_samples) for _ in range(self.n_epochs)]
        return [order[i : i + size] for order in orders for i in range(0, n_samples, size)]

    def _check_params(self) -> None:
        at_least_one = {n: getattr(self, n) for n in ("n_vectors", "n_epochs", "batch_size")}
        for name, value in at_least_one.items():
            if value < 1:
                raise ValueError(f"{name} must be 1 or more, got {value}")
        if self.settling < 0:
            raise ValueError(f"settling must be 0 or more, got {self.settling}")
        for name in ("initial_step", "final_step"):
            if not 0 < getattr(self, name) <= 1:
                raise ValueError(f"{name} must be in (0, 1], got {getattr(self, name)}")
        for name in ("initial_range", "final_range"):
            value = getattr(self, name)
            if value <= 0:
                raise ValueError(f"{name} must be above 0, got {value}")

    def _error(self, samples: NDArray[np.float32]) -> float:
        """Return the mean squared distance to the nearest prototype, a block at a time."""
        total = 0.0
        for i in range(0, len(samples), _BLOCK):
            block = samples[i : i + _BLOCK]
            residual = block - self.prototypes_[_scores(block, self.prototypes_).argmin(axis=1)]
            total += float(np.square(residual, dtype=np.float64).sum())
        return total / len(samples)


def _scores(samples: NDArray[np.float32], prototypes: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return squared distances (N, Q) less each sample's own squared norm."""
    scores = samples @ (-2 * prototypes.T)
    scores += (prototypes**2).sum(axis=1)
    return np.asarray(scores)


def _adapt(
    prototypes: NDArray[np.float32], batch: NDArray[np.float32], step: float, reach: float
) -> None:
    """Move `prototypes` (Q, D), in place, towards the samples of `batch` (B, D)."""
    weights = np.exp(-np.arange(len(prototypes)) / reach).astype(np.float32)
    weights = weights[: max(1, int((weights > _NEGLIGIBLE).sum()))]
    nearest = _nearest(_scores(batch, prototypes), len(weights))
    h = np.zeros((len(batch), len(prototypes)), dtype=np.float32)
    np.put_along_axis(h, nearest, weights[None, :], axis=1)
    total = h.sum(axis=0)[:, None]
    mean = (h.T @ batch) / np.maximum(total, np.float32(1e-12))
    prototypes += -np.expm1(-step * total) * (mean - prototypes)


def _settled(
    prototypes: NDArray[np.float32], samples: NDArray[np.float32], mean: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Return the means of the samples (N, D), less `mean`, that are nearest to each prototype.

    Those that are nearest to none stay.
    """
    sums, counts = np.zeros(prototypes.shape), np.zeros((len(prototypes), 1))
    for i in range(0, len(samples), _BLOCK):
        block = samples[i : i + _BLOCK] - mean
        nearest = _scores(block, prototypes).argmin(axis=1)
        belongs = (nearest == np.arange(len(prototypes))[:, None]).astype(np.float32)
        sums += belongs @ block
        counts += belongs.sum(axis=1, keepdims=True)
    return np.where(counts > 0, sums / np.maximum(counts, 1), prototypes).astype(np.float32)


def _nearest(scores: NDArray[np.float32], count: int) -> NDArray[np.int64]:
    """Return the columns (N, count) of the lowest scores of each row, lowest first."""
    if count == 1:
        return np.asarray(scores.argmin(axis=1)[:, None])
    if count > scores.shape[1] // 4:
        return scores.argsort(axis=1)[:, :count]
    some = np.argpartition(scores, count - 1, axis=1)[:, :count]
    order = np.take_along_axis(scores, some, axis=1).argsort(axis=1)
    return np.take_along_axis(some, order, axis=1)
