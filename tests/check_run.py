"""Check a run's folder from the outside: every product is there, whole, and good enough.

Usage: python tests/check_run.py RUN [--min-places SHARE] [--max-ate METRES]
"""

from __future__ import annotations

import argparse
import csv
import json
import sys
from pathlib import Path

import networkx
import numpy as np
import open3d as o3d
from rerun.chunk import RrdReader

REQUIRED = (
    "trajectory.tum", "frames.csv", "keyframes.tum", "keyframes.npz", "pose_graph.g2o", "map.ply",
    "labels.json", "graph.json", "graph.graphml", "metrics.json", "config.toml", "run.log",
    "recording.rrd", "map.pgm", "map.yaml", "thumbnails.zip", "floorplan.png", "floorplan.svg",
    "report.html",
)  # fmt: skip


def problems(root: Path, min_places: float | None, max_ate: float | None) -> list[str]:
    """Return what is wrong with a run, in words; nothing if all is well."""
    missing = [name for name in REQUIRED if not (root / name).exists()]
    if missing:
        return [f"missing: {', '.join(missing)}"]
    found = []
    metrics = json.loads((root / "metrics.json").read_text())
    with (root / "frames.csv").open() as file:
        rows = list(csv.DictReader(file))
    tracked = sum(row["state"] in ("ok", "relocalised") for row in rows)
    poses = np.loadtxt(root / "trajectory.tum")
    if len(rows) != metrics["frames"]:
        found.append(f"{metrics['frames']} frames but {len(rows)} rows in frames.csv")
    if not tracked == len(poses) == metrics["frames_tracked"]:
        found.append(
            f"{tracked} tracked rows, {len(poses)} poses, {metrics['frames_tracked']} said"
        )
    cloud = o3d.t.io.read_point_cloud(str(root / "map.ply"))
    if len(cloud.point.positions) != metrics["map_points"] or "label" not in cloud.point:
        found.append("map.ply does not hold the points it should, with labels")
    nodes = networkx.read_graphml(root / "graph.graphml").number_of_nodes()
    if nodes != metrics["graph_nodes"]:
        found.append(f"{nodes} nodes in graph.graphml, {metrics['graph_nodes']} said")
    entities = {str(c.entity_path) for c in RrdReader(root / "recording.rrd").store().stream()}
    for wanted in ("/world/camera", "/world/map/colour", "/world/map/labels", "/graph"):
        if wanted not in entities:
            found.append(f"recording lacks {wanted}")
    if max_ate is not None and not metrics["ate_rmse_m"] <= max_ate:
        found.append(f"ATE {metrics['ate_rmse_m']} m, wanted {max_ate} m")
    if min_places is not None and not metrics["place_accuracy"] >= min_places:
        found.append(f"{metrics['place_accuracy']} of nodes right, wanted {min_places}")
    offices = [room for room in metrics.get("rooms", ()) if room.startswith("office")]
    if min_places is not None:
        told_apart = {metrics["rooms_matched"].get(room) for room in offices} - {None}
        if len(told_apart) < len(offices):
            found.append(f"offices not told apart: {metrics['rooms_matched']}")
    return found


def main() -> int:
    """Print what is wrong; return the number of problems as exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path)
    parser.add_argument("--min-places", type=float)
    parser.add_argument("--max-ate", type=float)
    arguments = parser.parse_args()
    found = problems(arguments.run, arguments.min_places, arguments.max_ate)
    sys.stdout.write("\n".join(found) + "\n" if found else f"{arguments.run}: all well\n")
    return len(found)


if __name__ == "__main__":
    sys.exit(main())
