from dataclasses import replace

import numpy as np

from roomgraph.app.answers.explanations import node_words, place_reasons, ranges
from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.graph import GraphNode, SemanticGraph
from roomgraph.semantics.labels import LabelSpace

LABELS = LabelSpace.of(["elevator_area", "office"])


def node(i, evidence, place="office1"):
    return GraphNode(
        i, 10 * i, float(i), np.zeros(3), "office", 2, place, 0.8, np.empty(0), evidence
    )


FOR = Evidence(
    (("office", 0.75), ("elevator_area", 0.25), ("lab", 0.004)), (3, 5, 30), ((7, 0.4),), "office"
)
AGAINST = Evidence((("elevator_area", 0.75),), (40,), ((9, 0.4),), "elevator_area")


def test_a_place_says_what_spoke_for_it():
    nodes = (node(0, FOR), node(1, AGAINST), node(2, Evidence(), "office2"))
    assert place_reasons(SemanticGraph(LABELS, nodes, ())) == [
        {
            "name": "office1", "chances": "elevator area 50%, office 38%", "agreeing": "1 of 2",
            "count": "3", "frames": "3\N{EN DASH}5, 30", "words": "7",
        }
    ]  # fmt: skip


def test_a_node_says_what_spoke_for_it():
    words = node_words(node(0, AGAINST))
    assert words == "office1: elevator area 75%\n1 frame voted for elevator area"
    assert node_words(replace(node(0, FOR), evidence=Evidence())) == "office1"


def test_frames_are_told_as_ranges():
    assert ranges(()) == ""
    assert ranges((1, 2, 12, 23)) == "1\N{EN DASH}12, 23"
    assert ranges(range(0, 2000, 100)).endswith("500 and 14 more ranges")
