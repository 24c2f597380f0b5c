"""All textures of a building in one image, with smaller copies for surfaces far away."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.rendering.mesh import Image

WIDTH = 4096
LEVELS = 5
GUTTER = 8


@dataclass(frozen=True, slots=True, eq=False)
class Atlas:
    """A mip-mapped texture atlas.

    Attributes
    ----------
    image : (H, W, 3) uint8
        The full atlas with its reduced copies to the right of it.
    offsets : (LEVELS, 2) float32
        Where level 0, 1, 2 ... begins in `image`, in pixels x, y.
    """

    image: Image
    offsets: NDArray[np.float32]


def pack(sizes: Sequence[tuple[int, int]], width: int, gap: int) -> tuple[NDArray[np.int64], int]:
    """Place rectangles (height, width) on shelves of a width.

    Return their top left corners (N, 2), x, y, and the height of all shelves.
    """
    places = np.zeros((len(sizes), 2), dtype=np.int64)
    x = y = shelf = 0
    for index in sorted(range(len(sizes)), key=lambda i: (-sizes[i][0], -sizes[i][1])):
        rows, columns = sizes[index][0] + 2 * gap, sizes[index][1] + 2 * gap
        if x + columns > width:
            x, y, shelf = 0, y + shelf, 0
        places[index] = x + gap, y + gap
        x, shelf = x + columns, max(shelf, rows)
    return places, y + shelf


def build_atlas(images: Sequence[Image]) -> tuple[Atlas, NDArray[np.int64]]:
    """Pack images into an atlas; return it with each image's top left corner (N, 2) x, y."""
    places, height = pack([image.shape[:2] for image in images], WIDTH, GUTTER)
    height += -height % 2**LEVELS
    base = np.zeros((height, WIDTH, 3), dtype=np.uint8)
    for image, (x, y) in zip(images, places, strict=True):
        rows, columns = image.shape[:2]
        framed = cv2.copyMakeBorder(image, *[GUTTER] * 4, cv2.BORDER_REPLICATE)
        base[y - GUTTER : y + rows + GUTTER, x - GUTTER : x + columns + GUTTER] = framed
    whole = np.zeros((height, WIDTH + WIDTH // 2, 3), dtype=np.uint8)
    whole[:, :WIDTH] = base
    offsets, top = [(0, 0)], 0
    for _ in range(1, LEVELS):
        base = np.asarray(
            cv2.resize(base, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA), dtype=np.uint8
        )
        rows, columns = base.shape[:2]
        whole[top : top + rows, WIDTH : WIDTH + columns] = base
        offsets.append((WIDTH, top))
        top += rows
    return Atlas(whole, np.array(offsets, dtype=np.float32)), places
