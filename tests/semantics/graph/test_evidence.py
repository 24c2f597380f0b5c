import numpy as np
import pytest

from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.topology import TopologicalMap, TopologySettings
from roomgraph.semantics.temporal.labeller import PlaceLabeller
from roomgraph.semantics.temporal.settings import LabellerSettings
from tests.semantics.helpers import anchor, frame, tiny_model


def test_a_node_keeps_what_spoke_for_its_label():
    model = tiny_model()
    settings = LabellerSettings(window=3)
    labeller = PlaceLabeller(model, settings)
    topology = TopologicalMap(TopologySettings(), model.labels)
    labels = [label for i in range(6) for label in labeller.process(frame(i, word=1, x=0.5 * i))]
    for label in [*labels, *labeller.finish()]:
        topology.update(label, anchor(0.5 * label.index), {0: np.eye(4)})
    nodes = topology.snapshot({0: np.eye(4)}).nodes
    assert [node.frame for node in nodes] == [0, 2, 4]
    for node in nodes:
        assert node.evidence.voted == node.label == "kitchen"
        assert node.evidence.labels[0] == ("kitchen", pytest.approx(node.score))
        assert node.frame in node.evidence.voters
        assert node.evidence.words[0][0] == 1


def test_evidence_of_a_place_is_of_the_nodes_that_voted_for_it():
    parts = [
        Evidence((("office", 0.8), ("lab", 0.2)), (1, 2), ((4, 0.5),), "office"),
        Evidence((("office", 0.6),), (2, 3), ((4, 0.3), (5, 0.6)), "office"),
        Evidence((("lab", 0.9),), (9,), ((6, 0.9),), "lab"),
        Evidence(),
    ]
    found = Evidence.gathered(parts, "office")
    assert found.voted == "office"
    assert found.voters == (1, 2, 3)
    assert dict(found.labels) == pytest.approx({"office": 1.4 / 3, "lab": 1.1 / 3})
    assert found.labels[0][0] == "office"
    assert found.words == ((4, 0.4), (5, 0.3))
    assert Evidence.gathered(parts[3:], "office") == Evidence()
    assert Evidence.gathered(parts[2:], "office").voters == ()
