"""The map's points in other formats."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from roomgraph.app.errors import AppError
from roomgraph.app.export.exporter import Notes, missing_package, named, product
from roomgraph.app.export.frame import T_upright_world
from roomgraph.app.export.trajectory import copy
from roomgraph.app.storage.cloud import read_cloud
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.files import replacing
from roomgraph.semantics.labels import read_labels

# Of LAS coordinates, which are whole numbers: a tenth of a millimetre.
_LAS_STEP_M = 1e-4


def write_ply(folder: RunFolder, path: Path) -> Notes:
    """Copy the run's map."""
    copy(product(folder.map), path)
    return ()


def write_pcd(folder: RunFolder, path: Path) -> Notes:
    """Write binary PCD with all that the map's points have: colours, labels, normals."""
    import open3d as o3d

    cloud = o3d.t.io.read_point_cloud(str(product(folder.map)))
    with replacing(named(path, ".pcd")) as temporary:
        if not o3d.t.io.write_point_cloud(str(temporary), cloud):
            raise AppError("cloud cannot be written", where=path)
    return ()


def write_las(folder: RunFolder, path: Path) -> Notes:
    """Write LAS 1.4: metres, z up, 16-bit colours, the label id as a dimension ``label``."""
    import laspy

    points, colours, label_ids = read_cloud(product(folder.map))
    T, notes = T_upright_world(folder)
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.add_extra_dim(laspy.ExtraBytesParams("label", np.uint16, description="as labels.json"))
    header.scales = np.full(3, _LAS_STEP_M)
    header.generating_software = "roomgraph"
    cloud = laspy.LasData(header)
    cloud.xyz = se3.transform(T, points)
    # LAS wants the whole range of 16 bits.
    cloud.red, cloud.green, cloud.blue = (colours.astype(np.uint16) * 257).T
    cloud["label"] = label_ids.astype(np.uint16)
    with replacing(path) as temporary, temporary.open("wb") as file:
        cloud.write(file, do_compress=False)
    return notes


def write_e57(folder: RunFolder, path: Path) -> Notes:
    """Write E57: metres, z up, one scan with colours; the label id as intensity."""
    try:
        import pye57
    except ImportError as error:
        raise missing_package("pye57") from error

    points, colours, label_ids = read_cloud(product(folder.map))
    T, notes = T_upright_world(folder)
    x, y, z = se3.transform(T, points).T
    values = {
        "cartesianX": x, "cartesianY": y, "cartesianZ": z,
        "colorRed": colours[:, 0], "colorGreen": colours[:, 1], "colorBlue": colours[:, 2],
        "intensity": label_ids.astype(np.float64),
    }  # fmt: skip
    with replacing(path) as temporary:
        file = pye57.E57(str(temporary), mode="w")
        file.write_scan_raw({k: np.ascontiguousarray(v) for k, v in values.items()}, name="map")
        file.close()
    names = read_labels(product(folder.labels)).names
    meanings = ", ".join(f"{i} {name}" for i, name in enumerate(names))
    return (*notes, f"the intensity of a point is its label id: {meanings}")
