"""What holds for every temporal model."""

import numpy as np
import pytest

from roomgraph.semantics.recognition.model import PlacePrediction
from roomgraph.semantics.recognition.transitions import count_transitions
from roomgraph.semantics.temporal.look import Look
from roomgraph.semantics.temporal.registry import TEMPORAL_MODELS
from roomgraph.semantics.temporal.settings import LabellerSettings
from tests.semantics.helpers import KINDS

EVEN = count_transitions((), KINDS)


def look(order, label_id, sure=0.6):
    probabilities = np.full(4, (1 - sure) / 2)
    probabilities[0], probabilities[label_id] = 0.0, sure
    prediction = PlacePrediction(KINDS[label_id - 1], label_id, sure, probabilities, np.empty(0))
    return Look(order, order, 0.5, prediction)


@pytest.fixture(params=list(TEMPORAL_MODELS))
def model(request):
    return TEMPORAL_MODELS[request.param](EVEN, 4.0)


def test_looks_that_agree_are_believed(model):
    looks = [look(i, 2) for i in range(5)]
    found = model.belief(2, looks, looks)
    assert found.label_id == 2
    assert found.probabilities.shape == (4,)
    assert found.probabilities.sum() == pytest.approx(1)
    assert found.probabilities.argmax() == 2


def test_a_lone_mistake_is_outvoted(model):
    looks = [look(i, 3 if i == 2 else 1) for i in range(5)]
    assert model.belief(2, looks, looks).label_id == 1


def test_looks_taken_for_good_are_not_needed_again(model):
    for i in range(5):
        model.advance(look(i, 2))
    after = [look(5, 2), look(6, 2)]
    assert model.belief(6, after, after).label_id == 2


def test_a_tie_of_votes_goes_to_the_surer_label():
    vote = TEMPORAL_MODELS["vote"](EVEN, 4.0)
    looks = [look(0, 1, 0.5), look(1, 3, 0.9)]
    found = vote.belief(0, looks, looks)
    assert found.label_id == 3
    np.testing.assert_allclose(found.probabilities, [0, 0.275, 0.15, 0.575])


def test_a_method_that_is_none_is_refused():
    with pytest.raises(ValueError, match="vote, filter"):
        LabellerSettings(method="oracle")
