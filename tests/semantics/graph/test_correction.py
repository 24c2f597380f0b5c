import numpy as np
import pytest

from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.correction import correct
from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.graph import EdgeKind, GraphEdge, GraphNode, SemanticGraph
from roomgraph.semantics.labels import LabelSpace
from tests.semantics.helpers import descriptors_of, features, frame_label, tiny_model

LABELS = LabelSpace.of(["corridor", "kitchen", "office"])


def graph_of(places, scores):
    nodes = tuple(
        GraphNode(
            i, 10 * i, i / 3, np.array([float(i), 0, 0]), place.rstrip("0123456789"),
            LABELS.id_of(place.rstrip("0123456789")), place, score, np.empty(0),
        )
        for i, (place, score) in enumerate(zip(places, scores, strict=True))
    )  # fmt: skip
    edges = tuple(GraphEdge(i, i + 1, 1.0, EdgeKind.PATH) for i in range(len(nodes) - 1))
    return SemanticGraph(LABELS, nodes, edges)


def test_a_place_gets_a_new_name_and_unsure_neighbours_follow():
    graph = graph_of(
        ["corridor1", "corridor1", "office1", "office1", "kitchen1", "corridor1", "corridor1"],
        [0.95, 0.95, 0.9, 0.9, 0.3, 0.95, 0.95],
    )
    found = correct(graph, "office1", "library", change_m=4.0)
    assert found.place == "library1"
    assert found.told == (2, 3)
    assert found.inferred == (4,)
    assert [n.place for n in found.graph.nodes] == [
        "corridor1", "corridor1", "library1", "library1", "library1", "corridor1", "corridor1",
    ]  # fmt: skip
    assert found.graph.labels.names == (*LABELS.names, "library")
    assert found.graph.labels.colours[:4] == LABELS.colours
    assert found.graph.nodes[2].label_id == 4
    assert graph.nodes[2].place == "office1"


def test_sure_neighbours_stay_and_numbers_are_free():
    graph = graph_of(["office1", *["corridor1"] * 3, "kitchen1", "kitchen1"], [0.9] * 6)
    found = correct(graph, "kitchen1", "office", change_m=4.0)
    assert found.place == "office2"
    assert found.inferred == ()
    places = [n.place for n in found.graph.nodes]
    assert places == ["office1", *["corridor1"] * 3, "office2", "office2"]


@pytest.mark.parametrize(("place", "label"), [("attic1", "office"), ("office1", "unknown")])
def test_wrong_names_are_told(place, label):
    with pytest.raises(SemanticsError):
        correct(graph_of(["office1"], [0.9]), place, label, change_m=4.0)


def test_evidence_names_the_word_that_spoke_and_comes_back():
    model = tiny_model()
    prediction = model.predict(None, features(descriptors_of(1)))
    assert prediction.words[0][0] == 1
    assert prediction.words[0][1] > 0
    label = frame_label(3)
    object.__setattr__(label, "probabilities", np.array([0, 0.2, 0.1, 0.7]))
    object.__setattr__(label, "voters", (1, 2, 3))
    object.__setattr__(label, "words", prediction.words)
    evidence = Evidence.of(label, LABELS)
    assert evidence.labels == (("office", 0.7), ("corridor", 0.2), ("kitchen", 0.1))
    again = Evidence.from_content(evidence.content())
    assert (again.labels, again.voters) == (evidence.labels, evidence.voters)
    assert again.voted == "office"
    assert Evidence.of(frame_label(3), LABELS) == Evidence()
