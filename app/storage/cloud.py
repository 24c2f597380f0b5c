"""Clouds with colours and labels as binary PLY."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.errors import AppError
from roomgraph.datasets.files import replacing

_PLY_KINDS = {"<f4": "float", "u1": "uchar", "<i4": "int"}


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
    # Written here, not by Open3D: a run needs none of it, and to import it takes a second.
    columns: list[tuple[str, str, NDArray[Any]]] = [
        (name, "<f4", column) for name, column in zip("xyz", points.T, strict=True)
    ]
    if normals is not None:
        names = ("nx", "ny", "nz")
        columns += [(n, "<f4", column) for n, column in zip(names, normals.T, strict=True)]
    names = ("red", "green", "blue")
    columns += [(n, "u1", column) for n, column in zip(names, colours.T, strict=True)]
    columns.append(("label", "<i4", label_ids))
    rows = np.empty(len(points), dtype=[(name, kind) for name, kind, _ in columns])
    for name, _, column in columns:
        rows[name] = column
    properties = "".join(f"property {_PLY_KINDS[kind]} {name}\n" for name, kind, _ in columns)
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\n{properties}"
    with replacing(path) as temporary:
        if not len(points):
            raise AppError("map cannot be written", where=path, got="0 points")
        with temporary.open("wb") as file:
            file.write(f"{header}end_header\n".encode("ascii"))
            rows.tofile(file)


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
