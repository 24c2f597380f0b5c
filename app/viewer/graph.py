"""The topological graph in Rerun: in the map with rooms and doors, and as a plan."""

from __future__ import annotations

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from roomgraph.app.answers.explanations import node_words
from roomgraph.app.viewer.framing import Axes
from roomgraph.app.viewer.scene import LOOP_COLOUR
from roomgraph.datasets import se3
from roomgraph.semantics.graph.graph import EdgeKind, SemanticGraph
from roomgraph.semantics.labels import UNKNOWN, Colour
from roomgraph.semantics.rooms.doorway_lines import doorway_ends

FloatArray = NDArray[np.float64]

EDGE_COLOURS: dict[EdgeKind, Colour] = {
    EdgeKind.PATH: (235, 235, 235),
    EdgeKind.REVISIT: LOOP_COLOUR,
}
DOOR_COLOUR: Colour = (255, 140, 60)
# Half the width and height of the graph's own view, in its units: text has about 12.
PLAN_SIZE = (230.0, 130.0)
_MAX_PLAN_SCALE = 60.0
# Rooms are outlined just above the floor; doors are drawn as high as doors are.
_OUTLINE_M, _DOOR_M = 0.03, 2.0


def log_graph(recording: rr.RecordingStream, graph: SemanticGraph, axes: Axes) -> None:
    """Send the topological graph: in the map, and on its own laid out like the floor plan."""
    if not graph.nodes:
        return
    spots = place_spots(graph)
    named = np.array(list(spots.values()), dtype=np.intp)
    ends = np.array([(e.source, e.target) for e in graph.edges], dtype=np.intp).reshape(-1, 2)
    edges = rr.LineStrips3D(
        graph.positions[ends], colors=[EDGE_COLOURS[edge.kind] for edge in graph.edges],
        radii=rr.Radius.ui_points(1.2),
    )  # fmt: skip
    nodes = rr.Points3D(
        graph.positions, class_ids=[node.label_id for node in graph.nodes],
        radii=rr.Radius.ui_points(6.0), show_labels=False,
        labels=[node_words(node) for node in graph.nodes],
    )  # fmt: skip
    names = rr.Points3D(
        graph.positions[named], labels=list(spots), show_labels=True,
        colors=[_readable(_colour(graph, i)) for i in spots.values()],
        radii=rr.Radius.ui_points(8.0),
    )  # fmt: skip
    recording.log("world/graph/edges", edges)
    recording.log("world/graph/nodes", nodes)
    recording.log("world/graph/places", names)
    _log_floor(recording, graph)
    _log_plan(recording, graph, spots, axes)


def place_spots(graph: SemanticGraph) -> dict[str, int]:
    """Return the node that shows the name of each known place: the one in its middle."""
    places = np.array([node.place for node in graph.nodes])
    positions, spots = graph.positions, {}
    for place in graph.places:
        if place == UNKNOWN:
            continue
        members = np.flatnonzero(places == place)
        offsets = positions[members] - np.median(positions[members], axis=0)
        spots[place] = int(members[np.linalg.norm(offsets, axis=1).argmin()])
    return spots


def _log_floor(recording: rr.RecordingStream, graph: SemanticGraph) -> None:
    """Send the rooms' outlines on the floor and the frames of the doors, where they are known."""
    if graph.T_map_world is None:
        return
    T_world_map = se3.inverse(graph.T_map_world)

    def raised(points_map: FloatArray, height_m: float) -> FloatArray:
        heights = np.full(len(points_map), height_m)
        return se3.transform(T_world_map, np.column_stack([points_map, heights]))

    outlines = [np.vstack([e.polygon_map, e.polygon_map[:1]]) for e in graph.rooms]
    rooms = rr.LineStrips3D(
        [raised(outline, _OUTLINE_M) for outline in outlines],
        colors=[_readable(graph.labels.colours[e.label_id]) for e in graph.rooms],
        labels=[f"{e.name}: {e.area_m2:.1f} m²" for e in graph.rooms], show_labels=False,
        radii=rr.Radius.ui_points(1.6),
    )  # fmt: skip
    ends = [doorway_ends(graph, door) for door in graph.doorways]
    doors = rr.LineStrips3D(
        [np.vstack([raised(e, 0.0), raised(e[::-1], _DOOR_M)])[[1, 2, 3, 0]] for e in ends],
        colors=DOOR_COLOUR, radii=rr.Radius.ui_points(2.2), show_labels=False,
        labels=[f"{a} to {b}" for a, b in (door.places for door in graph.doorways)],
    )  # fmt: skip
    recording.log("world/graph/rooms", rooms)
    recording.log("world/graph/doors", doors)


def _log_plan(
    recording: rr.RecordingStream, graph: SemanticGraph, spots: dict[str, int], axes: Axes
) -> None:
    """Send every node as a dot, and the places' names over those in their middles."""
    ids = [str(node.id) for node in graph.nodes]
    positions, named = _laid_out(graph, axes), list(spots.values())
    # Of full strength: in a browser the background may be light.
    colours = [_colour(graph, i) for i in range(len(ids))]
    dots = rr.GraphNodes(ids, positions=positions, radii=5.0, colors=colours, show_labels=False)
    edges = rr.GraphEdges(
        [(ids[edge.source], ids[edge.target]) for edge in graph.edges], graph_type="undirected"
    )
    names = rr.GraphNodes(
        list(spots), positions=positions[named], labels=list(spots), show_labels=True,
        colors=[colours[i] for i in named],
    )  # fmt: skip
    recording.log("graph", dots, edges)
    recording.log("graph/places", names)


def _laid_out(graph: SemanticGraph, axes: Axes) -> FloatArray:
    """Return where the nodes lie on the plan (N, 2).

    Until there is a floor plan, whose long side lies across, it is turned for that.
    """
    plan = axes.on_floor(graph.positions) * (1.0, -1.0)
    if graph.T_map_world is None and np.ptp(plan[:, 1]) > np.ptp(plan[:, 0]):
        plan = plan[:, ::-1] * (-1.0, 1.0)
    half = np.ptp(plan, axis=0) / 2
    scale = min(_MAX_PLAN_SCALE, *(np.array(PLAN_SIZE) / np.maximum(half, 1e-6)))
    return np.asarray((plan - plan.min(axis=0) - half) * scale)


def _colour(graph: SemanticGraph, node: int) -> Colour:
    return graph.labels.colours[graph.nodes[node].label_id]


def _readable(colour: Colour) -> Colour:
    """Return a lighter colour, for text on a dark background."""
    red, green, blue = (round(0.55 * c + 0.45 * 255) for c in colour)
    return red, green, blue
