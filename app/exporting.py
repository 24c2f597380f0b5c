"""The formats that a run's products can be had in."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.cloud_io import read_cloud
from app.errors import AppError
from app.run_folder import RunFolder, refuse_existing
from datasets import poses
from datasets.files import replacing, write_text
from datasets.trajectory import write_kitti
from semantics.graph_io import read_graph_json


@dataclass(frozen=True, slots=True)
class Exporter:
    """The usual file name of a format, and what writes it."""

    file_name: str
    write: Callable[[RunFolder, Path], None]


def export_run(folder: RunFolder, format: str, output: Path | None, overwrite: bool) -> Path:
    """Write a run's product in a format; return where.

    Raises
    ------
    AppError
        The format is unknown, the run lacks the product, or the output exists.
    """
    exporter = EXPORTERS.get(format)
    if exporter is None:
        raise AppError("no such format", where=format, expected=", ".join(EXPORTERS))
    path = output or folder.root / exporter.file_name
    refuse_existing(path, overwrite)
    exporter.write(folder, path)
    return path


def _copy(name: str) -> Callable[[RunFolder, Path], None]:
    def write(folder: RunFolder, path: Path) -> None:
        source = folder.root / name
        if not source.exists():
            raise AppError("the run lacks this product", where=source, expected="a finished run")
        with replacing(path) as temporary:
            shutil.copyfile(source, temporary)

    return write


def _kitti(folder: RunFolder, path: Path) -> None:
    write_kitti(path, folder.read_trajectory())


def _csv(folder: RunFolder, path: Path) -> None:
    trajectory = folder.read_trajectory()
    rows = np.column_stack([
        trajectory.stamps_s, trajectory.positions, poses.to_quaternion(trajectory.T_world_camera),
    ])  # fmt: skip
    lines = ["timestamp,tx,ty,tz,qx,qy,qz,qw"]
    lines += [",".join(f"{value:.9f}" for value in row) for row in rows]
    write_text(path, "\n".join(lines) + "\n")


def _pcd(folder: RunFolder, path: Path) -> None:
    import open3d as o3d

    points, colours, _ = read_cloud(folder.map)
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points.astype(np.float64)))
    cloud.colors = o3d.utility.Vector3dVector(colours / 255.0)
    with replacing(path) as temporary:
        if not o3d.io.write_point_cloud(str(temporary), cloud):
            raise AppError("cloud cannot be written", where=path)


def _dot(folder: RunFolder, path: Path) -> None:
    graph = read_graph_json(folder.graph_json)
    lines = ["graph roomgraph {", "  node [shape=circle, style=filled];"]
    for node in graph.nodes:
        red, green, blue = graph.labels.colours[node.label_id]
        x, y, z = node.position_world
        lines.append(
            f'  {node.id} [label="{node.place}", fillcolor="#{red:02x}{green:02x}{blue:02x}", '
            f'pos="{x:.3f},{-z:.3f}", comment="y {y:.3f}"];'
        )
    lines += [f"  {e.source} -- {e.target} [len={e.length_m:.3f}];" for e in graph.edges]
    write_text(path, "\n".join([*lines, "}"]) + "\n")


EXPORTERS: dict[str, Exporter] = {
    "tum": Exporter("trajectory_export.tum", _copy("trajectory.tum")),
    "kitti": Exporter("trajectory.kitti", _kitti),
    "csv": Exporter("trajectory.csv", _csv),
    "ply": Exporter("map_export.ply", _copy("map.ply")),
    "pcd": Exporter("map.pcd", _pcd),
    "g2o": Exporter("pose_graph_export.g2o", _copy("pose_graph.g2o")),
    "json": Exporter("graph_export.json", _copy("graph.json")),
    "graphml": Exporter("graph_export.graphml", _copy("graph.graphml")),
    "dot": Exporter("graph.dot", _dot),
}
