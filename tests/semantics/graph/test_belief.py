"""Beliefs of a graph's nodes, given each other."""

from itertools import pairwise

import numpy as np
import pytest

from roomgraph.semantics.graph.belief import propagate
from tests.semantics.helpers import MOVES, looks


def test_on_a_chain_propagation_is_the_sum_over_all_paths():
    p = looks([0, 2, 1, 1])
    edges = [(i, i + 1, 1.0) for i in range(3)]
    leave = 1 - np.exp(-1.0 / 4.0)
    move = (1 - leave) * np.eye(3) + leave * (MOVES + MOVES.T) / 2
    total = np.zeros((4, 3))
    for path in np.ndindex(3, 3, 3, 3):
        chance = np.prod([p[i, k] for i, k in enumerate(path)])
        chance *= np.prod([move[a, b] for a, b in pairwise(path)])
        for i, kind in enumerate(path):
            total[i, kind] += chance
    found = propagate(p, edges, MOVES, 4.0)
    np.testing.assert_allclose(found, total / total.sum(axis=1, keepdims=True), rtol=1e-4)


def test_a_second_passing_speaks_for_the_first():
    p = np.array([[0.34, 0.33, 0.33]] + [[1 / 3] * 3] * 6 + [[0.05, 0.05, 0.9]])
    path = [(i, i + 1, 5.0) for i in range(7)]
    apart = propagate(p, path, MOVES, 4.0)
    joined = propagate(p, [*path, (0, 7, 0.2)], MOVES, 4.0)
    assert apart[0].argmax() != 2
    assert joined[0].argmax() == 2


def test_what_somebody_said_is_certain_and_speaks_for_its_neighbours():
    p = looks([0, 0, 0, 0, 0], sure=0.4)
    edges = [(i, i + 1, 0.5) for i in range(4)]
    found = propagate(p, edges, MOVES, 4.0, fixed={2: 1})
    assert found[2, 1] == pytest.approx(1)
    before = propagate(p, edges, MOVES, 4.0)
    assert (found[[1, 3], 1] > 2 * before[[1, 3], 1]).all()
    assert found[1, 1] > found[0, 1]


def test_without_edges_each_node_speaks_for_itself():
    np.testing.assert_allclose(propagate(looks([0, 2]), [], MOVES, 4.0), looks([0, 2]))
