"""Ray casting against the building's surfaces, with Open3D."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.rendering.mesh import Quad

FloatArray = NDArray[np.float64]
THREADS = os.cpu_count() or 1


@dataclass(frozen=True, slots=True, eq=False)
class Hits:
    """Where rays end.

    Attributes
    ----------
    t : (...) float32
        How far away, in lengths of the ray's direction; infinite where there is nothing.
    triangle : (...) int32
        Which triangle is hit; -1 for none.
    uv : (..., 2) float32
        Where in the triangle.
    normals : (..., 3) float32
        The triangle's normal, towards either side.
    """

    t: NDArray[np.float32]
    triangle: NDArray[np.int32]
    uv: NDArray[np.float32]
    normals: NDArray[np.float32]


class Scene:
    """The triangles of a list of quads, two a quad: corners 0, 1, 2 and corners 0, 2, 3."""

    def __init__(self, quads: Sequence[Quad]) -> None:
        self._fill(np.concatenate([quad.corners for quad in quads]))

    @classmethod
    def of(cls, corners: FloatArray) -> Scene:
        """Return the scene of quads with these corners (N, 4, 3)."""
        scene = cls.__new__(cls)
        scene._fill(corners.reshape(-1, 3))
        return scene

    def _fill(self, corners: FloatArray) -> None:
        import open3d as o3d

        self._core = o3d.core
        vertices = corners.astype(np.float32)
        first = np.arange(len(corners) // 4, dtype=np.uint32)[:, None, None] * 4
        triangles = (first + np.array([[(0, 1, 2), (0, 2, 3)]], dtype=np.uint32)).reshape(-1, 3)
        self._scene = o3d.t.geometry.RaycastingScene(nthreads=THREADS)
        self._scene.add_triangles(self._core.Tensor(vertices), self._core.Tensor(triangles))

    def cast(self, rays: NDArray[np.float32]) -> Hits:
        """Cast rays (..., 6): origin, direction."""
        answer = self._scene.cast_rays(self._core.Tensor(rays), nthreads=THREADS)
        # Open3D's mark of a miss, the largest uint32, is -1 here.
        triangle = answer["primitive_ids"].numpy().view(np.int32)
        return Hits(
            answer["t_hit"].numpy(),
            triangle,
            answer["primitive_uvs"].numpy(),
            answer["primitive_normals"].numpy(),
        )

    def distances(self, origins: FloatArray, directions: FloatArray) -> FloatArray:
        """Return how far rays (N, 3) go before they meet a surface; infinite if they never do."""
        rays = np.concatenate([origins, directions], axis=1).astype(np.float32)
        answer = self._scene.cast_rays(self._core.Tensor(rays), nthreads=THREADS)
        return np.asarray(answer["t_hit"].numpy(), dtype=np.float64)
