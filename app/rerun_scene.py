"""What is sent to Rerun, by entity: the fixed things, the map, the topological graph."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from app.report_evidence import node_words
from app.rerun_framing import Axes
from app.rerun_images import DEPTH_UNITS_PER_M, thinned
from app.viewer import MapView, SessionView
from datasets.camera import Intrinsics
from semantics.graph import EdgeKind, SemanticGraph
from semantics.labels import UNKNOWN, Colour, LabelSpace
from slam.tracking import TrackingState

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

STATE_COLOURS: dict[TrackingState, Colour] = {
    TrackingState.OK: (70, 200, 255),
    TrackingState.RELOCALISED: (255, 170, 40),
    TrackingState.LOST: (255, 60, 60),
    TrackingState.SKIPPED: (150, 150, 150),
}
TRUTH_COLOUR: Colour = (255, 214, 10)
KEYFRAME_COLOUR: Colour = (255, 255, 255)
LINK_COLOUR: Colour = (150, 150, 165)
LOOP_COLOUR: Colour = (255, 80, 220)
USABLE_COLOUR: Colour = (60, 255, 120)
PLAIN_COLOUR: Colour = (170, 170, 170)
EDGE_COLOURS: dict[EdgeKind, Colour] = {
    EdgeKind.PATH: (235, 235, 235),
    EdgeKind.REVISIT: LOOP_COLOUR,
}
# Half the width and height of the graph's own view, in its units: text has about 12.
PLAN_SIZE = (230.0, 130.0)
_MAX_PLAN_SCALE = 60.0
_FRUSTUM_M = 0.4


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the camera was at a frame, and how that was found."""

    frame: int
    state: TrackingState
    T_world_camera: FloatArray


def log_fixed(recording: rr.RecordingStream, session: SessionView, depth_step: int) -> None:
    """Send what does not change: axes, labels, camera, true path, names and colours of plots."""

    def log(entity: str, *what: object) -> None:
        recording.log(entity, *what, static=True)

    log("world", rr.ViewCoordinates.RIGHT_HAND_Y_DOWN, _annotation(session.labels))
    log("world/camera/image", _pinhole(session.intrinsics))
    log("world/camera/depth", _pinhole(thinned(session.intrinsics, depth_step)))
    if session.truth is not None:
        truth = rr.LineStrips3D(
            [session.truth], colors=TRUTH_COLOUR, radii=rr.Radius.ui_points(1.2)
        )
        log("world/trajectory/truth", truth)
    log("plots/inliers", rr.SeriesLines(names="inliers", colors=USABLE_COLOUR, widths=1.5))
    log("plots/score", rr.SeriesLines(names="label score", colors=TRUTH_COLOUR, widths=1.5))
    names = [name.replace("_", " ") for name in session.labels.names]
    log("timeline/label", _states(session.labels.names, names, session.labels.colours))
    states = [state.value for state in STATE_COLOURS]
    log("timeline/tracking", _states(states, states, STATE_COLOURS.values()))


def _states(
    values: Iterable[str], labels: Iterable[str], colours: Iterable[Colour]
) -> rr.StateConfiguration:
    return rr.StateConfiguration(values=list(values), labels=list(labels), colors=list(colours))


def _annotation(labels: LabelSpace) -> rr.AnnotationContext:
    rows = zip(labels.names, labels.colours, strict=True)
    return rr.AnnotationContext(
        [rr.AnnotationInfo(id=i, label=name, color=colour) for i, (name, colour) in enumerate(rows)]
    )


def _pinhole(camera: Intrinsics) -> rr.Pinhole:
    return rr.Pinhole(
        image_from_camera=camera.K, resolution=[camera.width, camera.height],
        camera_xyz=rr.ViewCoordinates.RDF, image_plane_distance=_FRUSTUM_M,
    )  # fmt: skip


def depth_image(png: bytes) -> rr.EncodedDepthImage:
    """Return the recorded depth image."""
    return rr.EncodedDepthImage(
        png, media_type="image/png", meter=DEPTH_UNITS_PER_M, colormap="turbo",
        depth_range=(0.0, 5.0 * DEPTH_UNITS_PER_M),
    )  # fmt: skip


def keypoints(pixels: FloatArray, colour: Colour) -> rr.Points2D:
    """Draw features (N, 2)."""
    return rr.Points2D(pixels, colors=colour, radii=rr.Radius.ui_points(2.0))


def trajectory(positions: FloatArray, poses: list[Pose]) -> rr.LineStrips3D:
    """Draw a path (F, 3) coloured by what each frame's state was; red across lost frames."""
    colours = [STATE_COLOURS[TrackingState.OK]] * max(len(positions) - 1, 0)
    if len(poses) == len(positions):
        colours = [_step_colour(a, b) for a, b in pairwise(poses)]
    turns = [i for i in range(1, len(colours)) if colours[i] != colours[i - 1]]
    spans = [(a, b) for a, b in zip([0, *turns], [*turns, len(colours)], strict=True) if b > a]
    return rr.LineStrips3D(
        [positions[a : b + 1] for a, b in spans], colors=[colours[a] for a, _ in spans],
        radii=rr.Radius.ui_points(1.8),
    )  # fmt: skip


def _step_colour(before: Pose, after: Pose) -> Colour:
    if after.frame - before.frame > 1:
        return STATE_COLOURS[TrackingState.LOST]
    return STATE_COLOURS[after.state]


def log_cloud(recording: rr.RecordingStream, view: MapView, low: Mask, radius: float) -> None:
    """Send the map's points; those that are not `low` hide the others and go apart."""
    points, colours = view.points.points_world, view.points.colours
    log = recording.log
    log("world/map/colour", rr.Points3D(points[low], colors=colours[low], radii=radius))
    log("world/map/above", rr.Points3D(points[~low], colors=colours[~low], radii=radius))
    labels = rr.Points3D(
        points[low], class_ids=view.label_ids[low], radii=radius, show_labels=False
    )
    log("world/map/labels", labels)


def log_pose_graph(recording: rr.RecordingStream, view: MapView) -> None:
    """Send the keyframes and what joins them."""
    log = recording.log
    keyframes = rr.Points3D(
        view.keyframe_positions, colors=KEYFRAME_COLOUR, radii=rr.Radius.ui_points(2.0)
    )
    log("world/keyframes", keyframes)
    log("world/pose_graph/links", _lines(view.links, LINK_COLOUR, 0.6))
    log("world/pose_graph/loops", _lines(view.loops, LOOP_COLOUR, 1.5))


def _lines(ends: FloatArray, colour: Colour, radius: float) -> rr.LineStrips3D:
    return rr.LineStrips3D(ends, colors=colour, radii=rr.Radius.ui_points(radius))


def place_spots(graph: SemanticGraph) -> dict[str, int]:
    """Return the node that bears the name of each known place: the one in its middle."""
    places = np.array([node.place for node in graph.nodes])
    positions, spots = graph.positions, {}
    for place in graph.places:
        if place == UNKNOWN:
            continue
        members = np.flatnonzero(places == place)
        offsets = positions[members] - np.median(positions[members], axis=0)
        spots[place] = int(members[np.linalg.norm(offsets, axis=1).argmin()])
    return spots


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
    _log_plan(recording, graph, spots, axes)


def _log_plan(
    recording: rr.RecordingStream, graph: SemanticGraph, spots: dict[str, int], axes: Axes
) -> None:
    """Draw every node as a dot and every place's name over one of its nodes."""
    plan = axes.on_floor(graph.positions) * (1.0, -1.0)
    half = np.ptp(plan, axis=0) / 2
    scale = min(_MAX_PLAN_SCALE, *(np.array(PLAN_SIZE) / np.maximum(half, 1e-6)))
    plan = (plan - plan.min(axis=0) - half) * scale
    ids = [str(node.id) for node in graph.nodes]
    nodes = rr.GraphNodes(
        ids, positions=plan, radii=5.0, show_labels=False,
        colors=[_colour(graph, i) for i in range(len(ids))],
    )  # fmt: skip
    edges = rr.GraphEdges(
        [(ids[edge.source], ids[edge.target]) for edge in graph.edges], graph_type="undirected"
    )
    names = rr.GraphNodes(
        list(spots), positions=plan[np.array(list(spots.values()), dtype=np.intp)],
        labels=list(spots), show_labels=True,
        colors=[_readable(_colour(graph, i)) for i in spots.values()],
    )  # fmt: skip
    recording.log("graph/nodes", nodes, edges)
    recording.log("graph/places", names)


def _colour(graph: SemanticGraph, node: int) -> Colour:
    return graph.labels.colours[graph.nodes[node].label_id]


def _readable(colour: Colour) -> Colour:
    """Return a lighter colour, for text on dark ground."""
    red, green, blue = (round(0.55 * c + 0.45 * 255) for c in colour)
    return red, green, blue
