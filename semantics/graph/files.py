"""The semantic graph on disk: node-link JSON and GraphML, each with its reader."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from roomgraph.datasets.files import replacing
from roomgraph.semantics.documents import read_document, write_document
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.evidence import Evidence
from roomgraph.semantics.graph.graph import (
    Doorway,
    EdgeKind,
    GraphEdge,
    GraphNode,
    RoomPolygon,
    SemanticGraph,
)
from roomgraph.semantics.labels import LabelSpace

# Version 3 named the edges "links", as networkx did; version 2 kept no evidence for labels;
# version 1 knew no places' rooms and no doorways either.
SCHEMA, VERSION, OLD_VERSIONS = "roomgraph/semantic-graph", 4, (3, 2, 1)
_UNITS = {"position": "m", "length": "m", "stamp": "s", "area": "m2", "width": "m"}


def write_graph_json(path: Path, graph: SemanticGraph) -> None:
    """Write node-link JSON: networkx from 3.6 on reads it by ``node_link_graph(content)``."""
    content = {
        "frame": "world",
        "units": _UNITS,
        "directed": False,
        "multigraph": False,
        "graph": _label_space(graph.labels),
        "nodes": [
            {**_node(node), "position": node.position_world.round(6).tolist(),
             "histogram": node.signature.round(6).tolist(), "evidence": node.evidence.content()}
            for node in graph.nodes
        ],
        "edges": [
            {"source": e.source, "target": e.target, "length": round(e.length_m, 6),
             "kind": str(e.kind)}
            for e in graph.edges
        ],
        **_floor(graph),
    }  # fmt: skip
    write_document(path, SCHEMA, VERSION, content)


def read_graph_json(path: Path) -> SemanticGraph:
    """Read what `write_graph_json` wrote, of this version or one before.

    Raises
    ------
    SemanticsError
        The file is missing or is not such a graph.
    """
    content = read_document(path, SCHEMA, VERSION, *OLD_VERSIONS)
    try:
        edges = content["edges" if content["version"] > 3 else "links"]
        return _graph(content["graph"], content["nodes"], edges, content)
    except (KeyError, TypeError, ValueError) as error:
        raise _not_understood(path, error) from error


def write_graphml(path: Path, graph: SemanticGraph) -> None:
    """Write GraphML; positions as x, y, z and the histogram as numbers between spaces."""
    import networkx

    drawn = networkx.Graph(
        schema=SCHEMA, version=VERSION, frame="world", units=json.dumps(_UNITS),
        **{
            key: json.dumps(value)
            for key, value in (_label_space(graph.labels) | _floor(graph)).items()
        },
    )  # fmt: skip
    for node in graph.nodes:
        x, y, z = (float(value) for value in node.position_world)
        histogram = " ".join(f"{value:.6g}" for value in node.signature)
        values = _node(node)
        evidence = json.dumps(node.evidence.content())
        drawn.add_node(
            values.pop("id"), **values, x=x, y=y, z=z, histogram=histogram, evidence=evidence
        )
    for edge in graph.edges:
        drawn.add_edge(edge.source, edge.target, length=edge.length_m, kind=str(edge.kind))
    with replacing(path) as temporary:
        networkx.write_graphml(drawn, temporary)


def read_graphml(path: Path) -> SemanticGraph:
    """Read what `write_graphml` wrote.

    Raises
    ------
    SemanticsError
        The file is missing or is not such a graph.
    """
    import networkx

    try:
        drawn = networkx.read_graphml(path, node_type=int)
        labels = {key: json.loads(drawn.graph[key]) for key in ("labels", "colours")}
        nodes = [
            {**values, "id": i, "position": [values["x"], values["y"], values["z"]],
             "histogram": [float(v) for v in (values["histogram"] or "").split()],
             "evidence": json.loads(values.get("evidence", "null"))}
            for i, values in drawn.nodes(data=True)
        ]  # fmt: skip
        edges = [{"source": a, "target": b, **values} for a, b, values in drawn.edges(data=True)]
        floor = {key: json.loads(drawn.graph[key]) for key in _FLOOR if key in drawn.graph}
        return _graph(labels, nodes, edges, floor)
    except OSError as error:
        raise SemanticsError("file cannot be read", where=path, got=str(error)) from error
    except (KeyError, TypeError, ValueError, SyntaxError, networkx.NetworkXError) as error:
        raise _not_understood(path, error) from error


def _label_space(labels: LabelSpace) -> dict[str, Any]:
    return {"labels": list(labels.names), "colours": [list(colour) for colour in labels.colours]}


def _node(node: GraphNode) -> dict[str, Any]:
    return {
        "id": node.id, "frame": node.frame, "stamp": node.stamp_s, "label": node.label,
        "label_id": node.label_id, "place": node.place, "score": round(node.score, 6),
    }  # fmt: skip


_FLOOR = ("T_map_world", "places", "doorways")


def _floor(graph: SemanticGraph) -> dict[str, Any]:
    """Return what lies on the floor, in the map frame: z up, floor at 0."""
    T = graph.T_map_world
    return {
        "T_map_world": None if T is None else T.round(9).tolist(),
        "places": [
            {"name": e.name, "label": e.label, "label_id": e.label_id, "score": round(e.score, 6),
             "area": round(e.area_m2, 4), "centre": e.centre_map.round(4).tolist(),
             "polygon": e.polygon_map.round(4).tolist()}
            for e in graph.rooms
        ],
        "doorways": [
            {"places": list(door.places), "position": door.position_map.round(4).tolist(),
             "width": None if door.width_m is None else round(door.width_m, 4)}
            for door in graph.doorways
        ],
    }  # fmt: skip


def _graph(
    labels: dict[str, Any],
    nodes: list[dict[str, Any]],
    edges: list[dict[str, Any]],
    floor: dict[str, Any],
) -> SemanticGraph:
    colours = tuple((int(r), int(g), int(b)) for r, g, b in labels["colours"])
    T = floor.get("T_map_world")
    return SemanticGraph(
        labels=LabelSpace(tuple(labels["labels"]), colours),
        nodes=tuple(_read_node(node) for node in nodes),
        edges=tuple(_read_edge(edge) for edge in edges),
        rooms=tuple(_read_room(values) for values in floor.get("places", ())),
        doorways=tuple(_read_doorway(values) for values in floor.get("doorways", ())),
        T_map_world=None if T is None else np.array(T, dtype=np.float64).reshape(4, 4),
    )


def _read_node(values: dict[str, Any]) -> GraphNode:
    evidence = values.get("evidence")
    return GraphNode(
        id=int(values["id"]), frame=int(values["frame"]), stamp_s=float(values["stamp"]),
        position_world=np.array(values["position"], dtype=np.float64).reshape(3),
        label=str(values["label"]), label_id=int(values["label_id"]), place=str(values["place"]),
        score=float(values["score"]), signature=np.array(values["histogram"], dtype=np.float64),
        evidence=Evidence() if evidence is None else Evidence.from_content(evidence),
    )  # fmt: skip


def _read_edge(values: dict[str, Any]) -> GraphEdge:
    source, target = sorted((int(values["source"]), int(values["target"])))
    return GraphEdge(source, target, float(values["length"]), EdgeKind(values["kind"]))


def _read_room(values: dict[str, Any]) -> RoomPolygon:
    return RoomPolygon(
        name=str(values["name"]), label=str(values["label"]), label_id=int(values["label_id"]),
        score=float(values["score"]),
        polygon_map=np.array(values["polygon"], dtype=np.float64).reshape(-1, 2),
        area_m2=float(values["area"]),
        centre_map=np.array(values["centre"], dtype=np.float64).reshape(2),
    )  # fmt: skip


def _read_doorway(values: dict[str, Any]) -> Doorway:
    first, second = (str(name) for name in values["places"])
    width = values["width"]
    position = np.array(values["position"], dtype=np.float64).reshape(2)
    return Doorway((first, second), position, None if width is None else float(width))


def _not_understood(path: Path, error: Exception) -> SemanticsError:
    return SemanticsError(
        "invalid semantic graph", where=path, expected=f"{SCHEMA} version {VERSION}",
        got=f"{type(error).__name__} {error}",
    )  # fmt: skip
