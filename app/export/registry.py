"""All formats by name."""

from __future__ import annotations

from pathlib import Path

from roomgraph.app.errors import AppError
from roomgraph.app.export.cloud import write_e57, write_las, write_pcd, write_ply
from roomgraph.app.export.exporter import Exporter, Notes
from roomgraph.app.export.graph import (
    edges_beside,
    write_csv_tables,
    write_dot,
    write_graphml,
    write_hydra,
    write_json,
)
from roomgraph.app.export.grid import picture_beside, write_nav2
from roomgraph.app.export.mesh import write_glb, write_mesh_ply, write_obj
from roomgraph.app.export.trajectory import (
    frames_beside,
    write_csv,
    write_g2o,
    write_kitti,
    write_tum,
)
from roomgraph.app.storage.run_folder import RunFolder, refuse_existing

EXPORTERS: dict[str, Exporter] = {
    "tum": Exporter("trajectory", "TUM: stamp, position, quaternion", "trajectory_export.tum",
                    write_tum),
    "kitti": Exporter("trajectory", "KITTI: 3 x 4 matrices, with a table of the frame of each line",
                      "trajectory.kitti", write_kitti, frames_beside),
    "csv": Exporter("trajectory", "CSV: every frame with its state, pose and label",
                    "trajectory.csv", write_csv),
    "g2o": Exporter("pose graph", "g2o: keyframes and constraints", "pose_graph_export.g2o",
                    write_g2o),
    "ply": Exporter("cloud", "PLY: a copy of map.ply", "map_export.ply", write_ply),
    "pcd": Exporter("cloud", "PCD, for PCL and Open3D", "map.pcd", write_pcd),
    "las": Exporter("cloud", "LAS 1.4 with labels, z up, for GIS tools", "map.las", write_las),
    "e57": Exporter("cloud", "E57, z up, for survey tools (pip install pye57)",
                    "map.e57", write_e57),
    "mesh-ply": Exporter("mesh", "PLY, for MeshLab and CloudCompare", "mesh.ply", write_mesh_ply),
    "obj": Exporter("mesh", "Wavefront OBJ, y up, for Blender", "mesh.obj", write_obj),
    "glb": Exporter("mesh", "binary glTF, y up, for the web", "mesh.glb", write_glb),
    "json": Exporter("graph", "node-link JSON, for networkx", "graph_export.json",
                     write_json),
    "graphml": Exporter("graph", "GraphML, for Gephi, yEd and networkx", "graph_export.graphml",
                        write_graphml),
    "dot": Exporter("graph", "DOT, for Graphviz", "graph.dot", write_dot),
    "graph-csv": Exporter("graph", "CSV: a table of nodes and a table of edges", "graph_nodes.csv",
                          write_csv_tables, edges_beside),
    "hydra": Exporter("graph", "Hydra's scene graph, z up (pip install spark-dsg)",
                      "scene_graph.json", write_hydra),
    "nav2": Exporter("occupancy grid", "YAML and PGM, for ROS map_server and Nav2",
                     "map_export.yaml", write_nav2, picture_beside),
}  # fmt: skip


def export_run(
    folder: RunFolder, name: str, output: Path | None, overwrite: bool
) -> tuple[tuple[Path, ...], Notes]:
    """Export an output of a run; return the files and notes on them.

    Raises
    ------
    AppError
        There is no such format or package, the run lacks the product, or the output exists.
    """
    exporter = EXPORTERS.get(name)
    if exporter is None:
        raise AppError(
            "no such format", where=name, expected=", ".join(EXPORTERS),
            hint="`roomgraph export --list` describes each",
        )  # fmt: skip
    path = output or folder.root / exporter.file_name
    files = (path, *exporter.beside(path))
    if folder.root.is_dir():
        for file in files:
            refuse_existing(file, overwrite)
    return files, exporter.write(folder, path)
