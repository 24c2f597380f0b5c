"""Belief propagation over the nodes of a graph: neighbours are mostly of one kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

FloatArray = NDArray[np.float64]

# Below this a node's own look would rule a kind out for good.
_LEAST = 1e-3
# Messages are mixed with the last ones, so that they settle on graphs with loops.
_MIXING = 0.5
_ENOUGH = 1e-6


def propagate(
    probabilities: FloatArray,
    edges: Sequence[tuple[int, int, float]],
    transitions: FloatArray,
    change_m: float,
    fixed: Mapping[int, int] | None = None,
    steps: int = 200,
) -> FloatArray:
    """Return the belief (N, K) of each node, given the predictions of all nodes.

    A Markov field over the graph: two nodes joined by an edge are of different kinds with the
    chance of having left a kind of place in between, ``1 - exp(-length / change_m)``, and then as
    `transitions` say. Solved by loopy belief propagation (Pearl, 1988), which is exact where the
    graph is a chain: then it is the forward-backward algorithm.

    Parameters
    ----------
    probabilities : (N, K) float64
        What each node's own look says.
    edges : sequence of (node, node, metres)
        Of the graph: along the path, and where it was passed again.
    transitions : (K, K) float64
        Chance of each kind (column) after leaving a kind (row).
    change_m : float
        Metres walked in one kind of place, on average.
    fixed : mapping of int to int, optional
        Nodes whose kind is known, because somebody said so.
    steps : int
        Maximum number of rounds.
    """
    own = np.log(np.maximum(probabilities, _LEAST))
    for node, kind in (fixed or {}).items():
        own[node] = -np.inf
        own[node, kind] = 0.0
    if not edges:
        return _normalised(own)
    source, target, coupling = _directed(edges, transitions, change_m)
    opposite = np.concatenate(np.split(np.arange(len(source)), 2)[::-1])
    messages = np.zeros((len(source), own.shape[1]))
    for _ in range(steps):
        total = own.copy()
        np.add.at(total, target, messages)
        outgoing = total[source] - messages[opposite]
        fresh = logsumexp(outgoing[:, :, None] + coupling, axis=1)
        fresh -= logsumexp(fresh, axis=1, keepdims=True)
        change = float(np.abs(np.exp(fresh) - np.exp(messages)).max())
        messages = np.logaddexp(messages + np.log(1 - _MIXING), fresh + np.log(_MIXING))
        if change < _ENOUGH:
            break
    total = own.copy()
    np.add.at(total, target, messages)
    return _normalised(total)


def _directed(
    edges: Sequence[tuple[int, int, float]], transitions: FloatArray, change_m: float
) -> tuple[NDArray[np.intp], NDArray[np.intp], FloatArray]:
    """Return both directions of each edge and the log chance (2E, K, K) of kind to kind."""
    a = np.array([edge[0] for edge in edges], dtype=np.intp)
    b = np.array([edge[1] for edge in edges], dtype=np.intp)
    leave = -np.expm1(-np.array([edge[2] for edge in edges]) / change_m)[:, None, None]
    # Edges have no direction: what is joined to what counts, not what came first.
    mutual = (transitions + transitions.T) / 2
    move = (1 - leave) * np.eye(len(mutual)) + leave * mutual
    coupling = np.log(np.maximum(move, 1e-12))
    return np.concatenate([a, b]), np.concatenate([b, a]), np.concatenate([coupling, coupling])


def _normalised(scores: FloatArray) -> FloatArray:
    return np.asarray(np.exp(scores - logsumexp(scores, axis=1, keepdims=True)))
