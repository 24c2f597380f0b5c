import json
from dataclasses import replace

import networkx
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from roomgraph.datasets.se3 import pose
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.files import (
    read_graph_json,
    read_graphml,
    write_graph_json,
    write_graphml,
)
from roomgraph.semantics.graph.graph import (
    Doorway,
    EdgeKind,
    GraphEdge,
    GraphNode,
    RoomPolygon,
    SemanticGraph,
)
from roomgraph.semantics.labels import LabelSpace
from tests.semantics.helpers import label_space


@pytest.fixture
def graph():
    labels = label_space()
    rng = np.random.default_rng(0)
    nodes = tuple(
        GraphNode(
            i, 10 * i, 1.5e9 + i / 3, rng.normal(0, 5, 3).round(6), name, labels.id_of(name),
            f"{name}1", 0.25 * i, rng.random(4).round(6),
            Evidence(((name, 0.75), ("attic", 0.125)), (10 * i, 10 * i + 1), ((7, 0.5),) * i, name),
        )
        for i, name in enumerate(["corridor", "office", "kitchen", "corridor"])
    )  # fmt: skip
    edges = (
        GraphEdge(0, 1, 1.0, EdgeKind.PATH),
        GraphEdge(1, 2, 1.25, EdgeKind.PATH),
        GraphEdge(2, 3, 0.5, EdgeKind.PATH),
        GraphEdge(0, 3, 0.123456, EdgeKind.REVISIT),
    )
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.5], [0.0, 2.5]])
    rooms = (
        RoomPolygon("corridor1", "corridor", 1, 0.75, square, 5.0, np.array([1.0, 1.25])),
        RoomPolygon("office1", "office", 3, 0.5, square * [1, 2], 10.0, np.array([1.0, 2.5])),
    )
    doorways = (
        Doorway(("corridor1", "office1"), np.array([2.05, 1.0]), 0.9),
        Doorway(("corridor1", "kitchen1"), np.array([0.0, 1.0]), None),
    )
    T = pose(Rotation.from_rotvec([0.1, -0.4, 1.2]).as_matrix(), [0.5, -1, 0.8])
    return SemanticGraph(labels, nodes, edges, rooms, doorways, T)


def assert_same(a: SemanticGraph, b: SemanticGraph) -> None:
    assert a.labels == b.labels
    assert sorted(a.edges, key=str) == sorted(b.edges, key=str)
    assert len(a.nodes) == len(b.nodes)
    for ours, theirs in zip(a.nodes, b.nodes, strict=True):
        np.testing.assert_allclose(ours.position_world, theirs.position_world, atol=1e-6)
        np.testing.assert_allclose(ours.signature, theirs.signature, atol=1e-6)
        for name in ("id", "frame", "stamp_s", "label", "label_id", "place", "score", "evidence"):
            assert getattr(ours, name) == getattr(theirs, name)
    for ours, theirs in zip(a.rooms, b.rooms, strict=True):
        np.testing.assert_allclose(ours.polygon_map, theirs.polygon_map, atol=1e-4)
        np.testing.assert_allclose(ours.centre_map, theirs.centre_map, atol=1e-4)
        for name in ("name", "label", "label_id", "score", "area_m2"):
            assert getattr(ours, name) == getattr(theirs, name)
    for ours, theirs in zip(a.doorways, b.doorways, strict=True):
        assert (ours.places, ours.width_m) == (theirs.places, theirs.width_m)
        np.testing.assert_allclose(ours.position_map, theirs.position_map, atol=1e-4)
    assert (a.T_map_world is None) == (b.T_map_world is None)
    if a.T_map_world is not None:
        np.testing.assert_allclose(a.T_map_world, b.T_map_world, atol=1e-8)


ROUND_TRIPS = [(write_graph_json, read_graph_json), (write_graphml, read_graphml)]


@pytest.mark.parametrize(("write", "read"), ROUND_TRIPS)
def test_round_trip(tmp_path, graph, write, read):
    write(tmp_path / "graph", graph)
    assert_same(read(tmp_path / "graph"), graph)
    assert [path.name for path in tmp_path.iterdir()] == ["graph"]


@pytest.mark.parametrize(("write", "read"), ROUND_TRIPS)
def test_empty_graph_and_graph_without_model(tmp_path, write, read):
    write(tmp_path / "graph", SemanticGraph(LabelSpace(), (), ()))
    assert_same(read(tmp_path / "graph"), SemanticGraph(LabelSpace(), (), ()))
    node = GraphNode(0, 0, 0.0, np.zeros(3), "unknown", 0, "unknown", 0.0, np.empty(0))
    write(tmp_path / "graph", SemanticGraph(LabelSpace(), (node,), ()))
    assert_same(read(tmp_path / "graph"), SemanticGraph(LabelSpace(), (node,), ()))


def test_older_versions_are_still_read(tmp_path, graph):
    path = tmp_path / "graph.json"
    write_graph_json(path, graph)
    content = json.loads(path.read_text())
    content["links"] = content.pop("edges")
    path.write_text(json.dumps(content | {"version": 3}))
    assert_same(read_graph_json(path), graph)
    nodes = tuple(replace(node, evidence=Evidence()) for node in graph.nodes)
    for node in content["nodes"]:
        del node["evidence"]
    path.write_text(json.dumps(content | {"version": 2}))
    assert_same(read_graph_json(path), replace(graph, nodes=nodes))
    for name in ("T_map_world", "places", "doorways"):
        del content[name]
    path.write_text(json.dumps(content | {"version": 1}))
    assert_same(read_graph_json(path), SemanticGraph(graph.labels, nodes, graph.edges))
    path.write_text(json.dumps(content | {"version": 5}))
    with pytest.raises(SemanticsError, match="version 4"):
        read_graph_json(path)
    path.write_text(json.dumps(content | {"version": 4}))
    with pytest.raises(SemanticsError, match="KeyError 'edges'"):
        read_graph_json(path)


def test_json_says_what_it_is_and_networkx_reads_it(tmp_path, graph):
    write_graph_json(tmp_path / "graph.json", graph)
    content = json.loads((tmp_path / "graph.json").read_text())
    assert (content["schema"], content["version"]) == ("roomgraph/semantic-graph", 4)
    assert content["frame"] == "world"
    assert content["units"]["position"] == content["units"]["length"] == "m"
    drawn = networkx.node_link_graph(content)
    assert networkx.shortest_path_length(drawn, 0, 2, weight="length") == pytest.approx(0.623456)


@pytest.mark.parametrize("read", [read_graph_json, read_graphml])
@pytest.mark.parametrize(
    "text", ["", "{", "<graphml>", '{"schema": "roomgraph/semantic-graph", "version": 1}']
)
def test_readers_refuse_other_files(tmp_path, read, text):
    path = tmp_path / "graph.x"
    path.write_text(text)
    with pytest.raises(SemanticsError, match=r"graph\.x"):
        read(path)


@pytest.mark.parametrize("read", [read_graph_json, read_graphml])
def test_readers_name_a_missing_file(tmp_path, read):
    with pytest.raises(SemanticsError, match="none"):
        read(tmp_path / "none")


def test_reader_refuses_a_node_without_position(tmp_path, graph):
    path = tmp_path / "graph.json"
    write_graph_json(path, graph)
    content = json.loads(path.read_text())
    content["nodes"][1]["position"] = [1, 2]
    path.write_text(json.dumps(content))
    with pytest.raises(SemanticsError, match="invalid semantic graph"):
        read_graph_json(path)
