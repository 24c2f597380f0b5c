"""A surface through the map's points, for modelling and the web."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.errors import AppError
from roomgraph.app.export.exporter import Notes, named, product
from roomgraph.app.export.frame import T_upright_world
from roomgraph.app.settings import load_settings
from roomgraph.app.storage.cloud import read_cloud, read_normals
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.files import replacing

# From z up to y up, as Wavefront's and glTF's readers expect.
_T_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


def write_mesh_ply(folder: RunFolder, path: Path) -> Notes:
    """Write binary PLY in the run's world."""
    with replacing(named(path, ".ply")) as temporary:
        _mesh(folder, np.eye(4)).export(temporary)
    return ()


def write_obj(folder: RunFolder, path: Path) -> Notes:
    """Write Wavefront OBJ, y up, with a colour at each vertex."""
    T, notes = T_upright_world(folder)
    with replacing(named(path, ".obj")) as temporary:
        _mesh(folder, _T_Y_UP @ T).export(temporary, include_color=True, include_normals=True)
    return notes


def write_glb(folder: RunFolder, path: Path) -> Notes:
    """Write binary glTF, y up, with a colour at each vertex."""
    T, notes = T_upright_world(folder)
    mesh = _mesh(folder, _T_Y_UP @ T)
    mesh.visual.vertex_colors = _linear(np.asarray(mesh.visual.vertex_colors)[:, :3])
    with replacing(named(path, ".glb")) as temporary:
        mesh.export(temporary, include_normals=True, tree_postprocessor=_matt)
    return notes


def _mesh(folder: RunFolder, T_mesh_world: NDArray[np.float64]) -> Any:
    """Return the run's surface as trimesh has it, moved by a rigid motion (4, 4)."""
    import trimesh

    from roomgraph.slam.reconstruction.mesh import mesh_from_points

    points, colours, _ = read_cloud(product(folder.map))
    normals = read_normals(folder.map)
    if normals is None:
        raise AppError(
            "the map has no normals, which a mesh needs", where=folder.map,
            hint="map the sequence again with `roomgraph run`",
        )  # fmt: skip
    voxel_m = load_settings(
        folder.existing(folder.config), only=["slam.map.voxel_m"]
    ).slam.map.voxel_m
    mesh = mesh_from_points(points, normals, colours, voxel_m)
    return trimesh.Trimesh(
        se3.transform(T_mesh_world, mesh.vertices), mesh.triangles,
        vertex_normals=mesh.normals @ T_mesh_world[:3, :3].T, vertex_colors=mesh.colours,
        process=False,
    )  # fmt: skip


def _linear(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return sRGB colours in linear light, which glTF has its vertices in (IEC 61966-2-1)."""
    share = colours / 255.0
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return np.asarray(np.rint(255 * linear), dtype=np.uint8)


def _matt(tree: dict[str, Any]) -> None:
    """Give the meshes of a glTF tree a matt material; the default one shines like metal."""
    surface = {"metallicFactor": 0.0, "roughnessFactor": 1.0}
    tree["materials"] = [{"pbrMetallicRoughness": surface, "doubleSided": True}]
    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            primitive["material"] = 0
