"""Clouds with colours and labels as binary PLY."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.errors import AppError
from datasets.files import replacing


def write_cloud(
    path: Path,
    points: NDArray[np.float32],
    colours: NDArray[np.uint8],
    label_ids: NDArray[np.integer[Any]],
    normals: NDArray[np.float32] | None = None,
) -> None:
    """Write ``x y z [nx ny nz] red green blue label``.

    Points (N, 3) are in metres, colours (N, 3), labels (N,), normals (N, 3) of unit length.
    """
    import open3d as o3d

    cloud = o3d.t.geometry.PointCloud(o3d.core.Tensor(np.ascontiguousarray(points)))
    cloud.point.colors = o3d.core.Tensor(np.ascontiguousarray(colours))
    if normals is not None:
        cloud.point.normals = o3d.core.Tensor(np.ascontiguousarray(normals))
    cloud.point["label"] = o3d.core.Tensor(label_ids.astype(np.int32)[:, None])
    with replacing(path) as temporary:
        if not len(points) or not o3d.t.io.write_point_cloud(str(temporary), cloud):
            raise AppError("map cannot be written", where=path, got=f"{len(points)} points")


def read_cloud(path: Path) -> tuple[NDArray[np.float32], NDArray[np.uint8], NDArray[np.int32]]:
    """Read points (N, 3), colours (N, 3) and labels (N,) written by `write_cloud`."""
    import open3d as o3d

    if not path.exists():
        raise AppError("no such file", where=path, expected="a map.ply")
    cloud = o3d.t.io.read_point_cloud(str(path))
    try:
        return (
            cloud.point.positions.numpy(),
            cloud.point.colors.numpy(),
            cloud.point["label"].numpy()[:, 0],
        )
    except (KeyError, RuntimeError) as error:
        raise AppError(
            "not a labelled cloud", where=path, expected="x y z red green blue label"
        ) from error


def read_normals(path: Path) -> NDArray[np.float32] | None:
    """Read the normals (N, 3) written by `write_cloud`; None where there are none."""
    import open3d as o3d

    if not path.exists():
        raise AppError("no such file", where=path, expected="a map.ply")
    cloud = o3d.t.io.read_point_cloud(str(path))
    return cloud.point.normals.numpy() if "normals" in cloud.point else None
