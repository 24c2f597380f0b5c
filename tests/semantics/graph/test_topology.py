import numpy as np
import pytest

from roomgraph.datasets.se3 import pose
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.graph import EdgeKind
from roomgraph.semantics.graph.topology import TopologicalMap, TopologySettings
from tests.semantics.helpers import anchor, frame_label, label_space, view

STILL = {0: np.eye(4)}


def walk(stops, step=0.1, settings=None):
    """Walk along the x axis: (x to walk to, label, signature) one after the other."""
    graph = TopologicalMap(settings or TopologySettings(), label_space())
    x, index = 0.0, 0
    for target, label, signature in stops:
        direction = np.sign(target - x)
        for _ in range(round(abs(target - x) / step)):
            graph.update(frame_label(index, label, signature), anchor(x), STILL)
            x, index = x + direction * step, index + 1
    return graph.snapshot(STILL)


def test_a_node_for_each_metre_and_one_at_the_start():
    graph = walk([(10.15, "office", view(0))])
    np.testing.assert_allclose(graph.positions[:, 0], np.arange(11), atol=0.06)
    assert graph.nodes[0].frame == 0
    assert [(e.source, e.target) for e in graph.edges] == [(i, i + 1) for i in range(10)]
    for edge in graph.edges:
        assert edge.kind is EdgeKind.PATH
        assert edge.length_m == pytest.approx(1, abs=0.11)


def test_travel_is_along_the_path_not_as_the_crow_flies():
    graph = TopologicalMap(TopologySettings(), label_space())
    for i in range(126):  # twice round a circle of 0.5 m radius: 6.3 m
        a = i / 10
        graph.update(frame_label(i), anchor(0.5 * np.cos(a), 0.5 * np.sin(a)), STILL)
    assert len(graph) == 7


def test_jitter_on_the_spot_is_not_travel():
    graph = TopologicalMap(TopologySettings(), label_space())
    noise = np.random.default_rng(0).normal(0, 0.006, (2000, 2))
    for i, (x, y) in enumerate(noise):
        graph.update(frame_label(i), anchor(x, y), STILL)
    assert len(graph) == 1


def test_lost_frames_do_not_move_it():
    graph = TopologicalMap(TopologySettings(), label_space())
    assert not graph.update(frame_label(0), None, STILL)
    assert graph.update(frame_label(1), anchor(0), STILL)
    assert not graph.update(frame_label(2), None, STILL)
    assert len(graph) == 1


def test_two_offices_far_apart_and_different():
    graph = walk([(3, "office", view(0)), (9, "corridor", view(1)), (12, "office", view(2))])
    assert graph.places == ("office1", "corridor1", "office2")


def test_near_or_similar_offices_are_one():
    near = walk([(3, "office", view(0)), (6, "corridor", view(1)), (9, "office", view(2))])
    assert near.places == ("office1", "corridor1")
    similar = view(0) + 0.3 * view(2)
    similar /= np.linalg.norm(similar)
    alike = walk([(3, "office", view(0)), (12, "corridor", view(1)), (15, "office", similar)])
    assert alike.places == ("office1", "corridor1")


def test_a_return_keeps_the_name_even_if_it_looks_different():
    graph = walk(
        [
            (3, "office", view(0)),
            (9, "corridor", view(1)),
            (12, "office", view(2)),
            (3, "corridor", view(1)),
            (0, "office", view(5)),
            (9, "corridor", view(6)),
            (12, "office", view(7)),
        ]
    )
    offices = [node.place for node in graph.nodes if node.label == "office"]
    assert graph.places == ("office1", "corridor1", "office2")
    runs = [p for i, p in enumerate(offices) if i == 0 or p != offices[i - 1]]
    assert runs == ["office1", "office2", "office1", "office2"]


def test_one_long_room_stays_one_place():
    graph = TopologicalMap(TopologySettings(), label_space())
    for i in range(300):
        graph.update(frame_label(i, "corridor", view(i // 20)), anchor(0.1 * i), STILL)
    assert graph.snapshot(STILL).places == ("corridor1",)


def test_a_single_wrong_node_near_its_like_opens_no_place():
    graph = walk(
        [(3, "office", view(0)), (4, "corridor", view(1)), (5, "office", view(3)),
         (9, "corridor", view(1))]
    )  # fmt: skip
    assert graph.places == ("office1", "corridor1")


def test_a_jump_to_another_office_opens_it():
    graph = TopologicalMap(TopologySettings(), label_space())
    graph.update(frame_label(0, signature=view(0)), anchor(0), STILL)
    graph.update(frame_label(1, signature=view(1)), anchor(20), STILL)
    assert graph.snapshot(STILL).places == ("office1", "office2")


def test_unknown_is_not_numbered():
    graph = walk([(3, "unknown", view(0)), (9, "office", view(1)), (20, "unknown", view(2))])
    assert graph.places == ("unknown", "office1")


def test_passing_again_joins_the_graph_to_itself():
    graph = walk([(10, "office", view(0)), (0, "office", view(0))])
    revisits = [e for e in graph.edges if e.kind is EdgeKind.REVISIT]
    assert revisits
    for edge in revisits:
        assert edge.target - edge.source > TopologySettings().revisit_gap
        assert edge.length_m <= TopologySettings().revisit_radius_m
    assert len({(e.source, e.target) for e in graph.edges}) == len(graph.edges)


def test_nodes_move_with_their_keyframes():
    """A square walk that drifted; closing the loop moves keyframe 1 and with it half the nodes."""
    graph = TopologicalMap(TopologySettings(), label_space())
    drifted = {0: np.eye(4), 1: pose(t=[6.0, 3.0, 0.0])}
    for i in range(60):
        graph.update(frame_label(i), anchor(0.1 * i), drifted)
    for i in range(70):
        graph.update(frame_label(60 + i), anchor(-0.1 * i, keyframe=1), drifted)
    before = graph.snapshot(drifted)
    corrected = {0: np.eye(4), 1: pose(t=[6.0, 0.2, 0.0])}
    after = graph.snapshot(corrected)
    moved = np.array([node.frame >= 60 for node in after.nodes])
    np.testing.assert_array_equal(after.positions[~moved], before.positions[~moved])
    np.testing.assert_allclose(
        after.positions[moved] - before.positions[moved], [[0, -2.8, 0]] * moved.sum(), atol=1e-12
    )
    assert not any(e.kind is EdgeKind.REVISIT for e in before.edges)
    assert any(e.kind is EdgeKind.REVISIT for e in after.edges)
    for edge in after.edges:
        a, b = after.positions[[edge.source, edge.target]]
        assert edge.length_m == pytest.approx(np.linalg.norm(a - b))


def test_a_turned_keyframe_turns_its_nodes():
    graph = TopologicalMap(TopologySettings(), label_space())
    graph.update(frame_label(0), anchor(2.0), STILL)
    quarter = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    turned = graph.snapshot({0: pose(quarter, [1.0, 1.0, 0.0])})
    np.testing.assert_allclose(turned.positions, [[1, 3, 0]])


def test_a_keyframe_without_pose_is_told():
    graph = TopologicalMap(TopologySettings(), label_space())
    with pytest.raises(SemanticsError, match="keyframe 0"):
        graph.update(frame_label(0), anchor(0), {})


def test_an_empty_map_is_an_empty_graph():
    graph = TopologicalMap(TopologySettings(), label_space()).snapshot({})
    assert (graph.nodes, graph.edges, graph.places) == ((), (), ())
    assert graph.positions.shape == (0, 3)
