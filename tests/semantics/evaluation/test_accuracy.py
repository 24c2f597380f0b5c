import numpy as np
import pytest

from roomgraph.datasets.places import PlaceTruth
from roomgraph.semantics.evaluation.accuracy import (
    compare_labels,
    evaluate_frames,
    evaluate_instances,
    evaluate_nodes,
)
from roomgraph.semantics.graph.graph import GraphNode, SemanticGraph
from tests.semantics.helpers import label_space, view


def graph_of(places: list[str]) -> SemanticGraph:
    labels = label_space()
    nodes = []
    for i, place in enumerate(places):
        label = place.rstrip("0123456789")
        nodes.append(
            GraphNode(i, i, float(i), np.zeros(3), label, labels.id_of(label), place, 1.0, view(0))
        )
    return SemanticGraph(labels, tuple(nodes), ())


def truth_of(rooms: list[str], with_instances: bool = True) -> PlaceTruth:
    return PlaceTruth(
        np.arange(len(rooms), dtype=float),
        tuple(room.rstrip("0123456789") for room in rooms),
        tuple(rooms) if with_instances else ("",) * len(rooms),
    )


def test_confusion():
    accuracy = compare_labels([("a", "a"), ("a", "a"), ("a", "b"), ("b", "b"), ("c", "a")])
    assert accuracy.names == ("a", "b", "c")
    np.testing.assert_array_equal(accuracy.confusion, [[2, 1, 0], [0, 1, 0], [1, 0, 0]])
    assert accuracy.count == 5
    assert accuracy.overall == pytest.approx(0.6)
    assert accuracy.per_label == pytest.approx({"a": 2 / 3, "b": 1.0, "c": 0.0})


def test_nothing_to_compare():
    assert np.isnan(compare_labels([]).overall)


def test_frames_without_truth_are_left_out():
    truth = truth_of(["office1", "corridor1"])
    accuracy = evaluate_frames([(0.0, "office"), (1.01, "office"), (7.0, "office")], truth)
    assert (accuracy.count, accuracy.overall) == (2, 0.5)


def test_nodes():
    accuracy = evaluate_nodes(
        graph_of(["office1", "office1", "corridor1"]),
        truth_of(["office2", "kitchen1", "corridor1"]),
    )
    assert accuracy.overall == pytest.approx(2 / 3)


def test_offices_told_apart():
    rooms = ["office1"] * 4 + ["corridor1"] * 3 + ["office2"] * 4
    found = ["office2"] * 4 + ["corridor1"] * 3 + ["office1"] * 3 + ["kitchen1"]
    result = evaluate_instances(graph_of(found), truth_of(rooms))
    assert result.matches == {
        "office1": "office2",
        "corridor1": "corridor1",
        "office2": "office1",
    }
    assert result.recall == 1
    assert set(result.places) - set(result.matches.values()) == {"kitchen1"}
    assert result.purity == 1


def test_offices_taken_for_one():
    rooms = ["office1"] * 5 + ["corridor1"] * 3 + ["office2"] * 4
    found = ["office1"] * 5 + ["corridor1"] * 3 + ["office1"] * 4
    result = evaluate_instances(graph_of(found), truth_of(rooms))
    assert result.recovered == ("office1", "corridor1")
    assert result.recall == pytest.approx(2 / 3)
    assert result.purity == pytest.approx(8 / 12)


def test_without_instances_each_label_is_a_room():
    result = evaluate_instances(
        graph_of(["office1", "office2", "office2"]), truth_of(["office1"] * 3, False)
    )
    assert result.rooms == ("office",)
    assert result.matches == {"office": "office2"}
    assert set(result.places) - set(result.matches.values()) == {"office1"}


def test_an_empty_graph():
    result = evaluate_instances(graph_of([]), truth_of(["office1"]))
    assert np.isnan(result.recall)
    assert np.isnan(result.purity)
