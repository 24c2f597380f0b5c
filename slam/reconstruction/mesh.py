"""Triangles for the map: from points with normals."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.slam.errors import SlamError

FloatArray = NDArray[np.float64]
# Blocks of 8 voxels a side hug surfaces closer than Open3D's usual 16: half the memory.
BLOCK = 8
# Distances are kept this many voxels to either side of a surface.
TRUNCATION = 4.0
# Points whose planes a voxel's distance is taken from, and voxels looked at in one go.
NEIGHBOURS, QUERIES = 8, 1 << 17


@dataclass(frozen=True, slots=True)
class Mesh:
    """Coloured triangles in the world.

    Attributes
    ----------
    vertices : (V, 3) float32
        Metres.
    triangles : (F, 3) int32
        Three vertices each, counterclockwise as seen from outside.
    colours : (V, 3) uint8
        Red, green, blue.
    normals : (V, 3) float32
        Unit vectors, out of the surface.
    """

    vertices: NDArray[np.float32]
    triangles: NDArray[np.int32]
    colours: NDArray[np.uint8]
    normals: NDArray[np.float32]


def mesh_from_points(
    points: NDArray[np.floating],
    normals: NDArray[np.floating],
    colours: NDArray[np.uint8],
    voxel_m: float,
) -> Mesh:
    """Draw a surface through points (N, 3), metres, with unit normals (N, 3) and colours (N, 3).

    The distance of a place from the surface is that from the tangent planes of the points next to
    it (Hoppe et al., 1992), known only near points: nothing is made up between them. For a
    finished run, of whose keyframes' depth nothing is left.

    Raises
    ------
    SlamError
        No surface is found.
    """
    import open3d as o3d

    near = TRUNCATION / 2 * voxel_m
    with _one_thread():
        grid = _grid(voxel_m)
        if len(points):
            blocks = _blocks_near(points, near, BLOCK * voxel_m)
            rows, _ = grid.hashmap().activate(o3d.core.Tensor(blocks))
            where, index = grid.voxel_coordinates_and_flattened_indices(rows)
            _fill(grid, where.numpy(), index.numpy(), (points, normals, colours), near)
        return _surface(grid)


def _blocks_near(points: NDArray[np.floating], near: float, side_m: float) -> NDArray[np.int32]:
    """Return the blocks (M, 3) with a corner of a cube of half side `near` around a point."""
    corners = np.stack(np.meshgrid(*[(-near, near)] * 3), axis=-1).reshape(-1, 3)
    where = points.astype(np.float64)
    lowest = np.floor((where.min(axis=0) - near) / side_m).astype(np.int64)
    size = tuple(np.floor((where.max(axis=0) + near) / side_m).astype(np.int64) - lowest + 1)
    # Blocks as single numbers, which sort many times faster than rows of three.
    touched = []
    for corner in corners:
        block = np.floor((where + corner) / side_m).astype(np.int64) - lowest
        touched.append(np.unique(np.ravel_multi_index(tuple(block.T), size)))
    blocks = np.unravel_index(np.unique(np.concatenate(touched)), size)
    return np.asarray(np.column_stack(blocks) + lowest, dtype=np.int32)


def _fill(
    grid: Any,
    where: FloatArray,
    index: NDArray[np.int64],
    cloud: tuple[NDArray[Any], NDArray[Any], NDArray[Any]],
    near: float,
) -> None:
    """Write distances and colours into voxels at `where` (M, 3), kept at `index` (M,)."""
    from scipy.spatial import cKDTree

    points, normals, colours = cloud
    tree: Any = cKDTree(points)
    tsdf, weight, colour = (
        layer.reshape((-1, layer.shape[-1])).numpy()
        for layer in (grid.attribute(name) for name in ("tsdf", "weight", "color"))
    )
    for first in range(0, len(where), QUERIES):
        places, rows = where[first : first + QUERIES], index[first : first + QUERIES]
        distance, neighbour = tree.query(
            places, k=NEIGHBOURS, distance_upper_bound=near, workers=-1
        )
        known = np.isfinite(distance[:, 0])
        places, rows = places[known], rows[known]
        distance, neighbour = distance[known], neighbour[known]
        nearest = neighbour[:, 0]
        height = np.einsum("ni,ni->n", places - points[nearest], normals[nearest])
        # Beside the nearest point by more than a voxel's face is wide, a border is overstepped.
        known = distance[:, 0] ** 2 - height**2 < 2 * (2 * near / TRUNCATION) ** 2
        places, rows = places[known], rows[known]
        distance, neighbour = distance[known], neighbour[known]
        share = np.where(np.isfinite(distance), np.exp(-((2 * distance / near) ** 2)), 0.0)
        share /= share.sum(axis=1, keepdims=True)
        neighbour = np.where(share > 0, neighbour, neighbour[:, :1])
        height = np.einsum("nki,nki->nk", places[:, None] - points[neighbour], normals[neighbour])
        tsdf[rows, 0] = (share * height).sum(axis=1) / near
        colour[rows] = np.rint(np.einsum("nk,nki->ni", share, colours[neighbour]))
        weight[rows] = 1


def _grid(voxel_m: float) -> Any:
    import open3d as o3d

    kinds = (o3d.core.float32, o3d.core.uint16, o3d.core.uint16)
    return o3d.t.geometry.VoxelBlockGrid(
        ("tsdf", "weight", "color"), kinds, ((1), (1), (3)), voxel_m, BLOCK, 1024
    )


def _surface(grid: Any) -> Mesh:
    if grid.hashmap().size():
        # Open3D wants weights above the threshold, not at it; known voxels have a weight of 1.
        mesh = grid.extract_triangle_mesh(weight_threshold=0.5)
        if "indices" in mesh.triangle and len(mesh.triangle.indices):
            colours = np.rint(255 * mesh.vertex.colors.numpy())
            return Mesh(
                mesh.vertex.positions.numpy().copy(),
                mesh.triangle.indices.numpy().astype(np.int32),
                np.clip(colours, 0, 255).astype(np.uint8),
                mesh.vertex.normals.numpy().copy(),
            )
    raise SlamError(
        "mesh is empty", expected="points of a surface at least a few voxels wide",
        hint="use smaller voxels",
    )  # fmt: skip


@contextmanager
def _one_thread() -> Iterator[None]:
    """Let Open3D work in one thread: with more, vertices come in another order each time."""
    import open3d as o3d

    before = o3d.utility.get_max_threads()
    o3d.utility.set_max_threads(1)
    try:
        yield
    finally:
        o3d.utility.set_max_threads(before)
