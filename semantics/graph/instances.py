"""Separating places of the same kind: office1, office2."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings


class InstanceSettings(Settings):
    """When a node opens a new place of its kind.

    The paper sets `min_difference` to 0.8. Between histograms of unit length, two views of one room
    a metre apart differ by 0.4 to 1.2, two offices of one building by 0.4 and more: at 0.8 rooms
    of a kind would become one. 0.4 keeps what the rule is for: a view that is all but the same is
    of the same place, wherever the path believes it is.
    """

    min_difference: float = Field(
        default=0.4,
        ge=0,
        le=1.5,
        description="L2 distance of unit signatures above which two views are of different places",
    )
    min_distance_m: float = Field(
        default=5.0,
        ge=0,
        description="distance from all nodes of a place beyond which a new place begins, metres",
    )


@dataclass(frozen=True, slots=True)
class Observation:
    """A position with the signature of its view.

    Attributes
    ----------
    position : (3,) float64
        World, metres.
    signature : (S,) float64
        What views are compared by, of unit length.
    """

    position: NDArray[np.float64]
    signature: NDArray[np.float64]


@dataclass(slots=True)
class _Stay:
    place: str = ""
    is_settled: bool = False


class PlaceNames:
    """Decides which place of its kind a node belongs to (paper, section 3.3).

    The paper's rule: a node is of a new place if it differs from all memories of the known ones
    by more than `min_difference` and lies more than `min_distance_m` from all their nodes; the
    second condition keeps a return to a known place from opening another.

    The rule is put to a stay as a whole: the nodes of one label that are connected in space. Were
    each node asked alone, the first one in a second office, still in its door, would often
    resemble some view of the first office, and all that follow would be near that first one. So a
    stay that is far from the known nodes, but resembles one, bears that one's name for the time
    being. It is settled by its first node that is near a known place after all, or that differs
    from everything known: then it is a new place, from its beginning.
    """

    def __init__(self, settings: InstanceSettings) -> None:
        self.settings = settings
        self._stays: list[_Stay] = []
        self._count: Counter[str] = Counter()

    def name(self, stay: int) -> str:
        """Return the place that a stay is assigned to."""
        return self._stays[stay].place

    def assign(
        self,
        label: str,
        here: Observation,
        known: Sequence[Observation],
        stays: Sequence[int],
        follows_last: bool,
    ) -> int:
        """Return the stay that a new node belongs to; it may open one, or settle its name.

        Parameters
        ----------
        label : str
            The node's.
        here : Observation
            What the node saw where.
        known : sequence of Observation
            The same of all earlier nodes with this label, at their current positions, in order.
        stays : sequence of int
            The stay of each of these.
        follows_last : bool
            Whether the last of these is the node just before the new one: one does not step from
            one office into the next without passing something else.
        """
        distances = _lengths([observation.position - here.position for observation in known])
        stay = self._find(distances, stays, follows_last)
        if not self._stays[stay].is_settled:
            others = [i for i, other in enumerate(stays) if other != stay]
            differences = _lengths([known[i].signature - here.signature for i in others])
            names = [self.name(stays[i]) for i in others]
            self._stays[stay] = self._judge(label, distances[others], differences, names)
        return stay

    def _find(
        self, distances: NDArray[np.float64], stays: Sequence[int], follows_last: bool
    ) -> int:
        """Return the stay that a node continues, or a new one."""
        near = distances <= self.settings.min_distance_m
        if follows_last and near[-1]:
            return stays[-1]
        if near.any():
            return stays[int(distances.argmin())]
        self._stays.append(_Stay())
        return len(self._stays) - 1

    def _judge(
        self,
        label: str,
        distances: NDArray[np.float64],
        differences: NDArray[np.float64],
        names: Sequence[str],
    ) -> _Stay:
        """Apply the rule to a node against all nodes (N,) of other stays and their names."""
        if len(names) and distances.min() <= self.settings.min_distance_m:
            return _Stay(names[int(distances.argmin())], is_settled=True)
        if len(names) and differences.min() <= self.settings.min_difference:
            return _Stay(names[int(differences.argmin())], is_settled=False)
        self._count[label] += 1
        return _Stay(f"{label}{self._count[label]}", is_settled=True)


def free_name(label: str, taken: Container[str]) -> str:
    """Return the first name of a place of this label, ``office1`` and so on, that is not taken."""
    number = 1
    while f"{label}{number}" in taken:
        number += 1
    return f"{label}{number}"


def _lengths(vectors: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the lengths (N,) of N vectors."""
    return np.array([np.linalg.norm(vector) for vector in vectors], dtype=np.float64)
