"""Labels along a route: frame by frame, voted, filtered, and smoothed over the graph."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.vectors import arc_lengths
from roomgraph.semantics.evaluation.splits import SplitResult
from roomgraph.semantics.graph.belief import propagate
from roomgraph.semantics.recognition.model import PlaceModel, PlacePrediction
from roomgraph.semantics.temporal.labeller import PlaceLabeller
from roomgraph.semantics.temporal.look import FrameInput
from roomgraph.semantics.temporal.settings import LabellerSettings

NODE_M = 1.0


def route_results(
    model: PlaceModel,
    predictions: Sequence[PlacePrediction],
    truth: Sequence[str],
    positions: NDArray[np.float64],
    settings: LabellerSettings,
) -> list[SplitResult]:
    """Return the accuracy of the labels of frames and nodes, with and without neighbours.

    Parameters
    ----------
    model : PlaceModel
        What predicted.
    predictions : sequence of PlacePrediction
        Of each frame alone, in time order.
    truth : sequence of str
        The true label of each.
    positions : (N, 3) float64
        Where the frames were taken, metres.
    settings : LabellerSettings
        Which frames decide on a label; every temporal model is tried.
    """
    known = np.array(truth)
    alone = np.array([prediction.label for prediction in predictions])
    voted = _labelled(model, predictions, positions, settings, "vote")
    filtered = _labelled(model, predictions, positions, settings, "filter")
    nodes = nodes_along(positions)
    smoothed = _smoothed(model, predictions, positions, nodes, settings.change_m)
    rows = {
        "frames alone": (known, alone),
        "frames, vote": (known, voted),
        "frames, filter": (known, filtered),
        "nodes alone": (known[nodes], alone[nodes]),
        "nodes, vote": (known[nodes], voted[nodes]),
        "nodes, filter": (known[nodes], filtered[nodes]),
        "nodes, smoothed": (known[nodes], smoothed),
    }
    return [SplitResult(row, true, found) for row, (true, found) in rows.items()]


def nodes_along(positions: NDArray[np.float64]) -> NDArray[np.intp]:
    """Return the frames (M,) at which another metre has been travelled, the first among them."""
    metres = arc_lengths(positions) / NODE_M
    return np.asarray(np.unique(np.floor(metres + 1e-9), return_index=True)[1])


def _labelled(
    model: PlaceModel,
    predictions: Sequence[PlacePrediction],
    positions: NDArray[np.float64],
    settings: LabellerSettings,
    method: str,
) -> NDArray[np.str_]:
    labeller = PlaceLabeller(model, settings.model_copy(update={"method": method}))
    found = []
    for i, (prediction, position) in enumerate(zip(predictions, positions, strict=True)):
        found += labeller.take(FrameInput(i, float(i), position_world=position), prediction)
    return np.array([label.label for label in [*found, *labeller.finish()]])


def _smoothed(
    model: PlaceModel,
    predictions: Sequence[PlacePrediction],
    positions: NDArray[np.float64],
    nodes: NDArray[np.intp],
    change_m: float,
) -> NDArray[np.str_]:
    """Return the labels of nodes from the mean looks of their frames, given their neighbours."""
    parts = np.split(np.array([p.probabilities[1:] for p in predictions]), nodes[1:])
    edges = [(i, i + 1, NODE_M) for i in range(len(nodes) - 1)]
    places = positions[nodes]
    for i in range(len(nodes)):
        lengths = np.linalg.norm(places[: max(0, i - 5)] - places[i], axis=1)
        if len(lengths) and lengths.min() < 0.6 * NODE_M:
            edges.append((int(lengths.argmin()), i, float(lengths.min())))
    beliefs = propagate(
        np.array([part.mean(axis=0) for part in parts]), edges, model.transitions,
        change_m,
    )  # fmt: skip
    return np.asarray(np.array(model.labels.names[1:])[beliefs.argmax(axis=1)])
