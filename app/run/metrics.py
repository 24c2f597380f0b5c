"""The metrics of a run."""

from __future__ import annotations

import resource
from collections import Counter
from collections.abc import Iterable
from typing import Any

from roomgraph.app.clock import StageClock
from roomgraph.app.rounding import rounded
from roomgraph.app.run.frame_history import FrameHistory
from roomgraph.datasets.floor_plan import FILE_NAME, FloorPlanTruth, read_floor_plan
from roomgraph.datasets.places import PlaceTruth
from roomgraph.datasets.sequence import Sequence
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.semantics.evaluation.accuracy import (
    evaluate_frames,
    evaluate_instances,
    evaluate_nodes,
)
from roomgraph.semantics.evaluation.topology import (
    evaluate_doorways,
    evaluate_rooms,
    largest_error,
)
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.slam.errors import SlamError
from roomgraph.slam.evaluation import compare
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import TrackingState

SCHEMA = "roomgraph/metrics/1"


def run_metrics(
    sequence: Sequence,
    slam: Slam,
    history: FrameHistory,
    trajectory: Trajectory,
    graph: SemanticGraph,
    points: PointMap,
    clock: StageClock,
    warnings: Iterable[str] = (),
) -> dict[str, Any]:
    """Return what `metrics.json` holds."""
    trackings = [frame.tracking for frame in history.frames]
    states = Counter(tracking.state for tracking in trackings)
    tracked = sum(count for state, count in states.items() if state.has_pose)
    seconds = clock.elapsed_s
    metrics: dict[str, Any] = {
        "schema": SCHEMA,
        "sequence": str(sequence.root.resolve()),
        "frames": len(sequence),
        "frames_tracked": tracked,
        "frames_lost": states[TrackingState.LOST],
        "frames_skipped": len(sequence) - tracked - states[TrackingState.LOST],
        "frames_by_depth": sum(tracking.method == "depth" for tracking in trackings),
        "keyframes": len(slam.keyframes),
        "loop_closures": len(slam.closures),
        "path_length_m": round(trajectory.length_m, 4),
        "seconds_total": round(seconds, 3),
        "fps": round(len(trackings) / seconds, 2) if seconds else 0.0,
        "stage_ms": clock.summary(),
        "peak_rss_mb": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, 1),
        "map_points": len(points),
        **memory_metrics(slam, points),
        "graph_nodes": len(graph.nodes),
        "graph_edges": len(graph.edges),
        "labels": list(graph.labels.names[1:]),
        "places": list(graph.places),
        "warnings": list(warnings),
    }
    if sequence.ground_truth is not None:
        metrics |= trajectory_metrics(trajectory, sequence.ground_truth)
    if sequence.places is not None and len(graph.labels) > 1:
        stamps = [tracking.stamp_s for tracking in trackings]
        found = (frame.label.label for frame in history.frames)
        frames = list(zip(stamps, found, strict=True))
        metrics |= place_metrics(graph, frames, sequence.places)
        before = list(zip(stamps, history.online, strict=True))
        online = evaluate_frames(before, sequence.places).overall
        metrics["place_accuracy_per_frame_online"] = rounded(online)
        plan = sequence.root / FILE_NAME
        if plan.is_file():
            metrics |= topology_metrics(graph, read_floor_plan(plan), metrics["rooms_matched"])
    return metrics


def topology_metrics(
    graph: SemanticGraph, truth: FloorPlanTruth, matches: dict[str, str]
) -> dict[str, Any]:
    """Return the accuracy of rooms and doorways; `matches` maps room to place."""
    places, errors = evaluate_rooms(graph, truth.areas_m2, matches)
    doorways = evaluate_doorways(graph, truth.doorways, matches)
    return {
        "place_precision": rounded(places.precision),
        "place_recall": rounded(places.recall),
        "doorway_precision": rounded(doorways.precision),
        "doorway_recall": rounded(doorways.recall),
        "area_error": {room: rounded(error) for room, error in errors.items()},
        "area_error_max": rounded(largest_error(errors)),
    }


def memory_metrics(slam: Slam, points: PointMap) -> dict[str, Any]:
    """Return the memory of keyframes and map, also per area of observed surface."""
    held = sum(keyframe.nbytes for keyframe in slam.keyframes.values()) + points.nbytes
    area = points.surface_m2()
    return {
        "surface_m2": round(area, 2),
        "map_bytes": held,
        "map_bytes_per_m2": round(held / area) if area else None,
    }


def trajectory_metrics(trajectory: Trajectory, truth: Trajectory) -> dict[str, Any]:
    """Return ATE and RPE; empty if too few poses have ground truth."""
    try:
        error = compare(trajectory, truth)
    except SlamError:
        return {}
    return {
        "ate_rmse_m": round(error.ate_rmse_m, 6),
        "ate_median_m": round(error.ate_median_m, 6),
        "ate_max_m": round(error.ate_max_m, 6),
        "rpe_trans_rmse_m": round(error.rpe_trans_rmse_m, 6),
        "rpe_rot_rmse_deg": round(error.rpe_rot_rmse_deg, 6),
    }


def place_metrics(
    graph: SemanticGraph, frames: list[tuple[float, str]], truth: PlaceTruth
) -> dict[str, Any]:
    """Return label accuracy of nodes and frames, and which rooms were separated."""
    nodes, per_frame = evaluate_nodes(graph, truth), evaluate_frames(frames, truth)
    instances = evaluate_instances(graph, truth)
    return {
        "place_accuracy": rounded(nodes.overall),
        "place_accuracy_per_frame": rounded(per_frame.overall),
        "place_accuracy_by_label": {
            name: rounded(value) for name, value in per_frame.per_label.items()
        },
        "rooms": list(instances.rooms),
        "rooms_recovered": list(instances.recovered),
        "rooms_matched": instances.matches,
        "place_purity": rounded(instances.purity),
    }
