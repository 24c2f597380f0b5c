"""The interface of image descriptors: an image as a vector."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.settings import Settings
from roomgraph.datasets.vectors import unit
from roomgraph.slam.features.extraction import Features, FeatureSettings

Image = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Description:
    """One image as vectors.

    Attributes
    ----------
    vector : (D,) float
        What a classifier sees.
    signature : (S,) float64
        What two views of a place are compared by (the visual memory of Kostavelis & Gasteratos,
        2013, section 3.3): of unit length, or zeros where there is too little to compare.
    """

    vector: NDArray[Any]
    signature: NDArray[np.float64]

    @classmethod
    def of(cls, vector: NDArray[Any]) -> Description:
        """Return the description whose signature is the vector itself, at unit length."""
        return cls(vector, unit(vector))


class ImageDescriptor(Protocol):
    """Turns images into vectors, and saves what it has learned as named arrays.

    Subclasses implement `prepare` and, where that does not make the vector already, `describe`.
    One that learns from images also implements `fit`, `arrays` and `with_arrays`.

    Parameters
    ----------
    settings : Settings, optional
        An instance of the class's `settings_class`.
    features : FeatureSettings, optional
        How local features are extracted; kept only by a descriptor that uses them.

    Attributes
    ----------
    name : str
        What it is called in settings, in files and on the command line.
    settings_class : type
        Its settings; the default has none.
    uses_features : bool
        Whether it looks at local features. A run then extracts them as `features` say, once for
        tracking and for this.
    length : int
        Numbers D of a vector.
    signature_length : int
        Numbers S of a signature.
    """

    name: ClassVar[str]
    settings_class: ClassVar[type[Settings]] = Settings
    uses_features: ClassVar[bool] = False

    settings: Any
    features: FeatureSettings | None

    def __init__(
        self, settings: Settings | None = None, features: FeatureSettings | None = None
    ) -> None:
        self.settings = self.settings_class() if settings is None else settings
        self.features = (features or FeatureSettings()) if self.uses_features else None

    @property
    @abstractmethod
    def length(self) -> int:
        """Numbers D of a vector."""
        ...

    @property
    def signature_length(self) -> int:
        """Numbers S of a signature."""
        return self.length

    def can_describe(self, colour: Image | None, features: Features | None) -> bool:
        """Whether the image has what this descriptor needs."""
        return colour is not None

    @abstractmethod
    def prepare(
        self, colour: Image | None, features: Features | None = None, to_fit: bool = False
    ) -> Any:
        """Return the part of the description that needs no training, None for too few features.

        It is what is kept of each training image until all are there, so it should be small.
        Several threads may call this at once.

        Parameters
        ----------
        colour : (H, W, 3) uint8 or None
            The image, RGB.
        features : Features, optional
            Its local features, where they are known already.
        to_fit : bool
            Whether the result is to be learned from.
        """
        ...

    def fit(self, prepared: Sequence[Any], random: np.random.Generator) -> Self:
        """Learn from many prepared images; the default has nothing to learn."""
        return self

    def describe(self, prepared: Any) -> Description | None:
        """Return the description of a prepared image, None for too few features.

        By default what `prepare` returns is the vector.
        """
        return Description.of(prepared)

    def view(self, description: Description) -> NDArray[np.float64]:
        """Return what change from image to image is measured by, of unit length (or zeros).

        By default the vector that a classifier sees.
        """
        return unit(description.vector)

    def words(self, shares: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Return the contributions (D,) of a vector's numbers to a decision, by visual word.

        None, as by default, where the numbers stand for nothing that has a number of its own.
        """
        return None

    def summary(self) -> dict[str, Any]:
        """Return a summary of what was learned."""
        return {}

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return what was learned, as named arrays."""
        return {}

    def with_arrays(self, arrays: Mapping[str, NDArray[Any]]) -> Self:
        """Restore what `arrays` returned; return self.

        Raises
        ------
        KeyError, ValueError
            An array is missing, or is not of the right shape.
        """
        return self


def vectors_of(
    descriptor: ImageDescriptor, prepared: Sequence[Any], threads: int
) -> list[NDArray[Any] | None]:
    """Return the vector (D,) of each prepared image, None for too few features."""

    def vector(item: Any) -> NDArray[Any] | None:
        description = None if item is None else descriptor.describe(item)
        return None if description is None else description.vector

    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(vector, prepared))
