"""Telling rooms of the same kind apart: office1, office2."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from datasets.settings import Settings


class InstanceSettings(Settings):
    """When a node opens a new place of its kind."""

    min_difference: float = Field(
        0.8, ge=0, le=1.5, description="L2 distance of unit histograms above which views differ"
    )
    min_distance_m: float = Field(
        5.0, ge=0, description="metres from all nodes of a place beyond which it is another one"
    )


def find_place(
    histogram: NDArray[np.float64],
    position: NDArray[np.float64],
    memories: Sequence[NDArray[np.float64]],
    positions: NDArray[np.float64],
    places: Sequence[str],
    settings: InstanceSettings,
) -> str | None:
    """Return the known place of its kind that a node belongs to, None if it is a new one.

    The rule of section 3.3: a node is of a new place if it differs from all memories of a place
    by more than `min_difference` and lies more than `min_distance_m` from all of its nodes. A
    return to a known place is caught by the second condition. Where several places qualify, the
    one with the nearest node within the distance wins, else the one with the most similar view.

    Parameters
    ----------
    histogram, position : (Q,) and (3,) float64
        Of the node in question.
    memories, positions, places : (N, ...) sequences
        Histograms, positions and place names of all nodes with the same label.
    """
    if not places:
        return None
    distances = np.linalg.norm(positions - position, axis=1)
    if distances.min() <= settings.min_distance_m:
        return places[int(distances.argmin())]
    differences = np.linalg.norm(np.array(memories) - histogram, axis=1)
    if differences.min() <= settings.min_difference:
        return places[int(differences.argmin())]
    return None
