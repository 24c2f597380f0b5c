"""Where triangles show the atlas and the light map, and at which level of detail."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.rendering.atlas import LEVELS, Atlas, build_atlas
from roomgraph.datasets.synthetic.rendering.lighting import LightMap
from roomgraph.datasets.synthetic.rendering.mesh import FloatArray, Quad

Float32Array = NDArray[np.float32]


def in_level(
    atlas: Atlas, place: Float32Array, level: NDArray[np.uint8]
) -> tuple[Float32Array, Float32Array]:
    """Return the pixels x, y (H, W) of the atlas's image that show places of a level."""
    tables = np.zeros((3, 256), dtype=np.float32)
    tables[0, :LEVELS] = scales = np.exp2(-np.arange(LEVELS))
    tables[1:, :LEVELS] = (atlas.offsets + 0.5 * scales[:, None] - 0.5).T
    scale, left, top = (cv2.LUT(level, table) for table in tables)
    return (
        np.asarray(cv2.add(cv2.multiply(place[..., 0], scale), left), dtype=np.float32),
        np.asarray(cv2.add(cv2.multiply(place[..., 1], scale), top), dtype=np.float32),
    )


def lay_out(quads: Sequence[Quad]) -> tuple[Atlas, FloatArray, FloatArray]:
    """Return the atlas, each quad's corners in it (N, 4, 2), and its pixels a metre (N,)."""
    images = {id(quad.material.image): quad.material.image for quad in quads}
    atlas, places = build_atlas(list(images.values()))
    place_of = dict(zip(images, places, strict=True))
    corners = np.empty((len(quads), 4, 2))
    density = np.empty(len(quads))
    for index, quad in enumerate(quads):
        rows, columns = quad.material.image.shape[:2]
        left, top, right, bottom = quad.window
        unit = np.array([(left, top), (right, top), (right, bottom), (left, bottom)])
        corners[index] = place_of[id(quad.material.image)] - 0.5 + unit * (columns, rows)
        across = np.linalg.norm(quad.corners[1] - quad.corners[0])
        down = np.linalg.norm(quad.corners[3] - quad.corners[0])
        shown = (right - left) * columns * (bottom - top) * rows
        density[index] = np.sqrt(max(shown, 1.0) / max(float(across * down), 1e-8))
    return atlas, corners, density


def light_corners(light: LightMap) -> FloatArray:
    """Return each quad's corners (N, 4, 2) in the light map."""
    unit = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    return np.asarray(light.places[:, None] + unit * (light.sizes[:, None] - 1), dtype=np.float64)


def triangle_table(*corners: FloatArray) -> Float32Array:
    """Return (3, 2 N, 4): the value at a triangle's first corner, and the steps to the others."""
    both = np.concatenate(corners, axis=2)
    triangles = both[:, [(0, 1, 2), (0, 2, 3)]].reshape(-1, 3, both.shape[2])
    triangles[:, 1:] -= triangles[:, :1]
    return np.ascontiguousarray(triangles.swapaxes(0, 1), dtype=np.float32)
