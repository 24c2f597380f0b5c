"""Fisher vectors: deviation of an image's descriptors from each visual word's distribution."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.vectors import unit
from roomgraph.semantics.descriptors.dense import DenseDescriptors, DenseSettings
from roomgraph.semantics.descriptors.neural_gas import NeuralGas

FloatArray = NDArray[np.float32]

# Arrays that make an encoder, by name.
ARRAYS = ("mean", "projection", "position_scale", "means", "variances", "weights")
# No descriptor of a flat image has a larger number than this.
_FLAT = 1e-2
# A posterior below this, relative to the largest one of its descriptor, counts as none.
_NEGLIGIBLE = 1e-4
# A word that no descriptor belongs to keeps a little width and weight.
_SMALLEST_VARIANCE, _SMALLEST_WEIGHT = 1e-4, 1e-5


class FisherEncoder:
    """Turns dense descriptors into one vector (Perronnin, Sanchez and Mensink, 2010).

    The visual words are Neural Gas prototypes, made into a mixture of Gaussians by a few steps of
    expectation maximisation. A descriptor belongs to words by its posterior; the vector holds,
    for each word, the mean deviation of the image's descriptors from the word's centre and width.
    The position in the image is part of each descriptor, so the layout of a room counts (Sanchez
    et al., 2012, in place of a spatial pyramid). Root and length 1 at the end.

    Parameters
    ----------
    settings : DenseSettings
        How images are described.
    arrays : mapping
        ``mean`` (128,) and ``projection`` (128, D) on principal axes of equal variance,
        ``position_scale`` (2,), and the words' ``means`` and ``variances`` (K, D + 2) and
        ``weights`` (K,).

    Raises
    ------
    ValueError
        The arrays do not belong together.
    """

    def __init__(self, settings: DenseSettings, arrays: Mapping[str, NDArray[Any]]) -> None:
        self.settings = settings
        self.arrays = {name: np.asarray(arrays[name], dtype=np.float32) for name in ARRAYS}
        self._check_shapes()
        self._prepare()

    @classmethod
    def fit(
        cls,
        sample: DenseDescriptors,
        settings: DenseSettings,
        n_words: int,
        n_components: int,
        n_epochs: int,
        random: np.random.Generator,
        em_steps: int = 10,
    ) -> Self:
        """Learn axes and words from a sample of many images' descriptors."""
        arrays = _axes(sample, min(n_components, sample.descriptors.shape[1]))
        points = _project(sample, arrays)
        gas = NeuralGas(n_words, n_epochs, random_state=random).fit(points)
        arrays |= _mixture(points, gas, em_steps)
        return cls(settings, arrays)

    @property
    def length(self) -> int:
        """Numbers of a Fisher vector."""
        return 2 * self.arrays["means"].size

    @property
    def n_words(self) -> int:
        """Number of visual words."""
        return len(self.arrays["weights"])

    def encode(self, image: DenseDescriptors) -> FloatArray:
        """Return the Fisher vector (length,) of an image, of length 1; zeros if all of it is flat.

        Eq. 16 to 18 of Sanchez et al. (2013), "Image classification with the Fisher vector".
        """
        if not len(image) or float(np.abs(image.descriptors).max()) < _FLAT:
            return np.zeros(self.length, dtype=np.float32)
        points = _project(image, self.arrays)
        posterior = self.posteriors(points)
        means, weights = self.arrays["means"], self.arrays["weights"]
        s0 = posterior.sum(axis=0)[:, None]
        s1 = posterior.T @ points
        s2 = posterior.T @ (points * points)
        root_weight = np.sqrt(weights)[:, None]
        by_mean = (s1 - s0 * means) / self._deviation / root_weight
        by_width = s2 - 2 * s1 * means + s0 * (means * means - self.arrays["variances"])
        by_width /= self.arrays["variances"] * root_weight * np.float32(np.sqrt(2))
        vector = np.concatenate([by_mean.ravel(), by_width.ravel()])
        vector = np.sign(vector) * np.sqrt(np.abs(vector))
        return unit(vector).astype(np.float32)

    def posteriors(self, points: FloatArray) -> FloatArray:
        """Return how much each of the projected descriptors (N, D + 2) belongs to each word."""
        return _softmax(points @ self._linear + (points * points) @ self._square + self._constant)

    def project(self, image: DenseDescriptors) -> FloatArray:
        """Return descriptors with positions on the encoder's axes (N, D + 2)."""
        return _project(image, self.arrays)

    def _check_shapes(self) -> None:
        """Raise ValueError where the arrays do not belong together."""
        (n_words,), length = self.arrays["weights"].shape[:1], self.arrays["mean"].shape[0]
        n_axes = self.arrays["projection"].shape[-1]
        shapes = {
            "mean": (length,), "projection": (length, n_axes), "position_scale": (2,),
            "means": (n_words, n_axes + 2), "variances": (n_words, n_axes + 2),
            "weights": (n_words,),
        }  # fmt: skip
        for name, shape in shapes.items():
            if self.arrays[name].shape != shape:
                raise ValueError(f"{name} of shape {self.arrays[name].shape}, expected {shape}")

    def _prepare(self) -> None:
        means, variances = self.arrays["means"], self.arrays["variances"]
        self._deviation = np.sqrt(variances)
        self._linear, self._square, self._constant = _log_terms(
            means, variances, self.arrays["weights"]
        )


def _axes(sample: DenseDescriptors, n_components: int) -> dict[str, FloatArray]:
    """Return mean and principal axes of the descriptors, and the scale of the positions."""
    mean = sample.descriptors.mean(axis=0)
    centred = sample.descriptors - mean
    values, vectors = np.linalg.eigh(centred.T @ centred / len(centred))
    order = np.argsort(-values)[:n_components]
    scale = 1 / np.sqrt(np.maximum(values[order], 1e-8))
    spread = np.maximum(sample.positions.std(axis=0), 1e-6)
    return {
        "mean": mean,
        "projection": np.asarray(vectors[:, order] * scale, dtype=np.float32),
        "position_scale": np.asarray(1 / spread, dtype=np.float32),
    }


def _project(image: DenseDescriptors, arrays: Mapping[str, FloatArray]) -> FloatArray:
    appearance = (image.descriptors - arrays["mean"]) @ arrays["projection"]
    return np.hstack([appearance, image.positions * arrays["position_scale"]])


def _mixture(points: FloatArray, gas: NeuralGas, steps: int) -> dict[str, FloatArray]:
    """Return the mixture of diagonal Gaussians that starts from the gas's words."""
    nearest = gas.predict(points)
    posterior = np.zeros((len(points), len(gas.prototypes_)), dtype=np.float32)
    posterior[np.arange(len(points)), nearest] = 1
    squares = points * points
    for step in range(steps + 1):
        mass = np.maximum(posterior.sum(axis=0), np.float32(1e-3))[:, None]
        means = posterior.T @ points / mass
        variances = np.maximum(posterior.T @ squares / mass - means**2, _SMALLEST_VARIANCE)
        weights = np.maximum(mass[:, 0] / len(points), _SMALLEST_WEIGHT)
        if step < steps:
            linear, square, constant = _log_terms(means, variances, weights)
            posterior = _softmax(points @ linear + squares @ square + constant)
    return {"means": means, "variances": variances, "weights": weights}


def _log_terms(
    means: FloatArray, variances: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the terms, linear, square and constant, of the words' log densities."""
    constant = np.log(weights) - 0.5 * (means**2 / variances + np.log(variances)).sum(axis=1)
    return (means / variances).T.copy(), (-0.5 / variances).T.copy(), constant


def _softmax(scores: NDArray[Any]) -> FloatArray:
    scores -= scores.max(axis=1, keepdims=True)
    np.exp(scores, out=scores)
    # What is next to nothing is left out (Sanchez et al., 2013): numbers near the
    # smallest that float32 holds make products a dozen times slower.
    scores[scores < _NEGLIGIBLE] = 0
    scores /= scores.sum(axis=1, keepdims=True)
    return np.asarray(scores, dtype=np.float32)
