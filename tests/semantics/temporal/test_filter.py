from itertools import pairwise

import numpy as np
import pytest

from roomgraph.semantics.graph.belief import propagate
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.semantics.temporal.filter import PlaceFilter

NAMES = ("bathroom", "corridor", "kitchen")
# Rooms are only reached through the corridor.
MOVES = count_transitions([["bathroom", "corridor", "kitchen", "corridor"] * 40], NAMES)


def looks(kinds, sure=0.6):
    other = (1 - sure) / 2
    return np.array([[sure if k == i else other for i in range(3)] for k in kinds])


def test_transitions_are_those_walked():
    np.testing.assert_allclose(MOVES.sum(axis=1), 1)
    assert not np.diag(MOVES).any()
    assert MOVES[0, 1] > 0.95
    assert 0 < MOVES[0, 2] < 0.05
    np.testing.assert_allclose(count_transitions((), NAMES)[0], [0, 0.5, 0.5])


def test_the_filter_is_bayes_rule_by_hand():
    found = PlaceFilter(MOVES, change_m=4.0, independent_m=1.0)
    p = looks([0, 2])
    found.advance(0.3, p[0])
    # Less than the independent 1 m from the one before: it counts for less.
    prior = p[0] ** 0.3
    prior /= prior.sum()
    leave = 1 - np.exp(-2.0 / 4.0)
    ahead = prior @ ((1 - leave) * np.eye(3) + leave * MOVES)
    by_hand = ahead * p[1]
    belief = found.advance(2.0, p[1])
    np.testing.assert_allclose(belief, by_hand / by_hand.sum(), rtol=1e-9)


def test_smoothing_agrees_with_all_paths_counted():
    kinds = [0, 0, 2, 1, 1]
    p, ways = looks(kinds), [0.3, 1.0, 1.0, 1.0, 1.0]
    found = PlaceFilter(MOVES, change_m=4.0, independent_m=1.0).smoothed(ways, p)
    leave = 1 - np.exp(-1.0 / 4.0)
    move = (1 - leave) * np.eye(3) + leave * MOVES
    total = np.zeros((5, 3))
    for path in np.ndindex(*(3,) * 5):
        chance = p[0, path[0]] ** 0.3 / 3
        for i in range(1, 5):
            chance *= move[path[i - 1], path[i]] * p[i, path[i]]
        for i, kind in enumerate(path):
            total[i, kind] += chance
    np.testing.assert_allclose(found, total / total.sum(axis=1, keepdims=True), rtol=1e-9)


def test_a_lone_mistake_is_put_right_and_a_change_is_kept():
    kinds = [0, 0, 0, 2, 0, 0, 0, 1, 1, 1, 1]
    found = PlaceFilter(MOVES, change_m=4.0).smoothed([1.0] * 11, looks(kinds))
    assert list(found.argmax(axis=1)) == [0] * 7 + [1] * 4


def test_standing_still_says_nothing_new():
    found = PlaceFilter(MOVES, change_m=4.0)
    once = found.advance(0.5, looks([2])[0])
    for _ in range(9):
        belief = found.advance(0.0, looks([2])[0])
    apart = PlaceFilter(MOVES, change_m=4.0)
    for _ in range(10):
        sure = apart.advance(0.5, looks([2])[0])
    assert once[2] < belief[2] < sure[2]
    assert belief[2] < 0.9


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
