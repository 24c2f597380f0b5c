"""The semantic topological graph in other formats."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.export.exporter import Notes, missing_package, named, product
from roomgraph.app.export.frame import T_upright_world
from roomgraph.app.export.trajectory import copy
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.files import replacing, write_text
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.semantics.graph.graph import GraphNode, SemanticGraph


def write_json(folder: RunFolder, path: Path) -> Notes:
    """Copy the run's node-link JSON."""
    copy(product(folder.graph_json), path)
    return ()


def write_graphml(folder: RunFolder, path: Path) -> Notes:
    """Copy the run's GraphML."""
    copy(product(folder.graphml), path)
    return ()


def write_dot(folder: RunFolder, path: Path) -> Notes:
    """Write Graphviz' DOT, as seen from above; ``neato -n`` keeps the positions."""
    graph = read_graph_json(folder.graph_json)
    T, notes = T_upright_world(folder)
    lines = ["graph roomgraph {", "  node [shape=circle, style=filled];"]
    # Graphviz counts in points, 72 an inch: an inch a metre.
    for node, (x, y, _) in zip(graph.nodes, 72 * se3.transform(T, graph.positions), strict=True):
        red, green, blue = graph.labels.colours[node.label_id]
        lines.append(
            f'  {node.id} [label="{node.place}", fillcolor="#{red:02x}{green:02x}{blue:02x}", '
            f'pos="{x:.1f},{y:.1f}"];'
        )
    lines += [f"  {e.source} -- {e.target} [len={e.length_m:.3f}];" for e in graph.edges]
    write_text(path, "\n".join([*lines, "}"]) + "\n")
    return notes


def write_csv_tables(folder: RunFolder, path: Path) -> Notes:
    """Write a table of the nodes and, beside it, one of the edges."""
    graph = read_graph_json(folder.graph_json)
    _write_table(
        path,
        ("id", "timestamp", "x", "y", "z", "label", "place", "score"),
        (
            (n.id, f"{n.stamp_s:.6f}", *(f"{v:.6f}" for v in n.position_world), n.label, n.place,
             f"{n.score:.4f}")
            for n in graph.nodes
        ),
    )  # fmt: skip
    (edges,) = edges_beside(path)
    _write_table(
        edges,
        ("source", "target", "length", "kind"),
        ((e.source, e.target, f"{e.length_m:.6f}", str(e.kind)) for e in graph.edges),
    )
    return (f"edges in {edges.name}",)


def edges_beside(path: Path) -> tuple[Path, ...]:
    """Return the table of edges that comes with one of nodes."""
    stem = path.stem.removesuffix("_nodes")
    return (path.with_name(f"{stem}_edges{path.suffix}"),)


def write_hydra(folder: RunFolder, path: Path) -> Notes:
    """Write Hydra's scene graph: a building, its rooms, and the nodes as places in them, z up."""
    try:
        import spark_dsg
    except ImportError as error:
        raise missing_package("spark-dsg") from error
    graph = read_graph_json(folder.graph_json)
    T, notes = T_upright_world(folder)
    scene = _scene(spark_dsg, graph, se3.transform(T, graph.positions))
    with replacing(named(path, ".json")) as temporary:
        scene.save(str(temporary), False)
    return notes


def _scene(dsg: Any, graph: SemanticGraph, positions: NDArray[np.float64]) -> Any:
    """Build the scene graph with spark_dsg, from nodes at upright positions (N, 3)."""
    scene = dsg.DynamicSceneGraph()
    scene.metadata.add({"frame": "map, z up, metres", "source": "roomgraph"})
    building = dsg.NodeSymbol("B", 0).value
    attributes = dsg.SemanticNodeAttributes()
    attributes.name, attributes.position = "building", positions.mean(axis=0)
    scene.add_node(dsg.DsgLayers.BUILDINGS, building, attributes)
    rooms = {}
    for i, name in enumerate(graph.places):
        inside = [node for node in graph.nodes if node.place == name]
        rooms[name] = dsg.NodeSymbol("R", i).value
        attributes = _described(dsg.RoomNodeAttributes(), graph, inside)
        attributes.name = name
        attributes.position = positions[[node.id for node in inside]].mean(axis=0)
        scene.add_node(dsg.DsgLayers.ROOMS, rooms[name], attributes)
        scene.insert_edge(building, rooms[name])
    for node in graph.nodes:
        attributes = _described(dsg.PlaceNodeAttributes(), graph, [node])
        attributes.name, attributes.position = f"node {node.id}", positions[node.id]
        place = dsg.NodeSymbol("p", node.id).value
        scene.add_node(dsg.DsgLayers.PLACES, place, attributes)
        scene.insert_edge(rooms[node.place], place)
    for edge in graph.edges:
        weight = dsg.EdgeAttributes()
        weight.weighted, weight.weight = True, edge.length_m
        ends = (dsg.NodeSymbol("p", end).value for end in (edge.source, edge.target))
        scene.insert_edge(*ends, weight)
    for a, b in _neighbours(graph):
        scene.insert_edge(rooms[a], rooms[b])
    for layer in (dsg.DsgLayers.ROOMS, dsg.DsgLayers.PLACES):
        space = dsg.Labelspace(dict(enumerate(graph.labels.names)))
        scene.set_labelspace(space, layer)
    return scene


def _described(attributes: Any, graph: SemanticGraph, nodes: Sequence[GraphNode]) -> Any:
    """Give a scene node the label that most of `nodes` have, and its colour."""
    label_id = Counter(node.label_id for node in nodes).most_common(1)[0][0]
    attributes.semantic_label = label_id
    attributes.color = graph.labels.palette[label_id]
    return attributes


def _neighbours(graph: SemanticGraph) -> list[tuple[str, str]]:
    """Return the pairs of places that an edge joins, each once."""
    pairs = (
        sorted((graph.nodes[e.source].place, graph.nodes[e.target].place)) for e in graph.edges
    )
    return [(a, b) for (a, b), _ in groupby(sorted((a, b) for a, b in pairs)) if a != b]


def _write_table(path: Path, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    write_text(path, text.getvalue())
