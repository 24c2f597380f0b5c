import numpy as np

from roomgraph.semantics.recognition.model import PlacePrediction
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.semantics.temporal.filter import PlaceFilter
from roomgraph.semantics.temporal.look import Look
from tests.semantics.helpers import KINDS, MOVES, looks

CHANGE_M = 4.0


def look(order, way_m, probabilities):
    probabilities = np.concatenate([[0.0], probabilities])
    label_id = int(probabilities.argmax())
    prediction = PlacePrediction(
        KINDS[label_id - 1], label_id, probabilities[label_id], probabilities, np.empty(0)
    )
    return Look(order, order, way_m, prediction)


def last_belief(ways, p, advanced=0):
    """The belief at the last look, after some were taken for good."""
    found = PlaceFilter(MOVES, CHANGE_M)
    taken = [look(i, way, row) for i, (way, row) in enumerate(zip(ways, p, strict=True))]
    for item in taken[:advanced]:
        found.advance(item)
    return found.belief(len(taken) - 1, taken[advanced:], taken[advanced:]).probabilities[1:]


def test_transitions_are_those_walked():
    np.testing.assert_allclose(MOVES.sum(axis=1), 1)
    assert not np.diag(MOVES).any()
    assert MOVES[0, 1] > 0.95
    assert 0 < MOVES[0, 2] < 0.05
    np.testing.assert_allclose(count_transitions((), KINDS)[0], [0, 0.5, 0.5])


def test_the_filter_is_bayes_rule_by_hand():
    p = looks([0, 2])
    # Less than the independent 0.5 m from the one before: it counts for less.
    prior = p[0] ** 0.3
    prior /= prior.sum()
    leave = 1 - np.exp(-2.0 / 4.0)
    ahead = prior @ ((1 - leave) * np.eye(3) + leave * MOVES)
    by_hand = ahead * p[1]
    for advanced in (0, 1):
        belief = last_belief([0.15, 2.0], p, advanced)
        np.testing.assert_allclose(belief, by_hand / by_hand.sum(), rtol=1e-9)


def test_smoothing_agrees_with_all_paths_counted():
    kinds = [0, 0, 2, 1, 1]
    p, ways = looks(kinds), [0.15, 1.0, 1.0, 1.0, 1.0]
    found = PlaceFilter(MOVES, CHANGE_M).smoothed(ways, p)
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
    found = PlaceFilter(MOVES, CHANGE_M).smoothed([1.0] * 11, looks(kinds))
    assert list(found.argmax(axis=1)) == [0] * 7 + [1] * 4


def test_standing_still_says_nothing_new():
    once = last_belief([0.5], looks([2]))
    still = last_belief([0.5] + 9 * [0.0], looks([2] * 10))
    apart = last_belief(10 * [0.5], looks([2] * 10))
    assert once[2] < still[2] < apart[2]
    assert still[2] < 0.9
