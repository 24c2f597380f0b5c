"""Dense local descriptors: gradient histograms on a grid over the image, at several scales."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.settings import Settings

FloatArray = NDArray[np.float32]

ORIENTATIONS = 8
CELLS = 4
LENGTH = CELLS * CELLS * ORIENTATIONS
# SIFT's limit on one number of a unit descriptor: what a highlight or an edge may contribute.
_LIMIT = 0.2
# An image is never made smaller than two descriptors across.
_SMALLEST = 2


class DenseSettings(Settings):
    """Positions, scales and size of the dense descriptors."""

    side: int = Field(
        default=200,
        ge=48,
        le=1024,
        description="images are resized to a square with sides of this many pixels",
    )
    scales: int = Field(
        default=4,
        ge=1,
        le=8,
        description="number of image sizes; each is smaller by the square root of two",
    )
    cell: int = Field(
        default=4, ge=2, le=16, description="side of a cell, pixels; a descriptor has 4 x 4 cells"
    )
    step: int = Field(
        default=5, ge=1, le=32, description="distance between neighbouring descriptors, pixels"
    )
    contrast: float = Field(
        default=10.0, gt=0, le=100,
        description="norm of a gradient histogram that gets half weight; flat patches get less",
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class DenseDescriptors:
    """The dense descriptors of one image.

    Attributes
    ----------
    descriptors : (N, 128) float32
        RootSIFT without rotation, of length 1 where there is contrast, shorter where not.
    positions : (N, 2) float32
        Of their centres across and down, -0.5 to 0.5 of the image's width and height.
    """

    descriptors: FloatArray
    positions: FloatArray

    def __len__(self) -> int:
        return len(self.descriptors)


def small_grey(colour: NDArray[np.uint8], settings: DenseSettings) -> NDArray[np.uint8]:
    """Return the grey image (h, w) of ``side * side`` pixels that the descriptors are made from.

    Parameters
    ----------
    colour : (H, W, 3) or (H, W) uint8
        The image, RGB or grey.
    settings : DenseSettings
        Its `side`.
    """
    grey = cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY) if colour.ndim == 3 else colour
    return np.asarray(_resized(grey, settings, settings.side / np.sqrt(grey.size)), dtype=np.uint8)


def describe_small(grey: NDArray[np.uint8], settings: DenseSettings) -> DenseDescriptors:
    """Return the dense descriptors of an image from `small_grey`.

    SIFT's descriptor (Lowe, 2004) on a regular grid and without its orientation, as scenes are
    described (Lazebnik et al., 2006), with the root taken (Arandjelovic and Zisserman, 2012).
    The histograms of all cells come from one triangular filter over eight images of gradients.
    """
    levels = [_level(grey, settings, 2.0 ** (-i / 2)) for i in range(settings.scales)]
    return DenseDescriptors(
        np.concatenate([descriptors for descriptors, _ in levels]),
        np.concatenate([positions for _, positions in levels]),
    )


def _level(
    grey: NDArray[np.uint8], settings: DenseSettings, scale: float
) -> tuple[FloatArray, FloatArray]:
    image = _resized(grey, settings, scale).astype(np.float32)
    height, width = image.shape
    cells = _cell_histograms(_orientations(image), settings.cell)
    rows, columns = (_centres(n, settings) for n in (height, width))
    # Cell centres lie 1.5 and 0.5 cells to either side of a descriptor's own.
    offsets = (np.arange(CELLS) - (CELLS - 1) / 2) * settings.cell
    y = np.rint(rows[:, None] + offsets).astype(np.intp)
    x = np.rint(columns[:, None] + offsets).astype(np.intp)
    blocks = cells[y[:, None, :, None], x[None, :, None, :]]
    across, down = np.meshgrid(columns / width - 0.5, rows / height - 0.5)
    positions = np.column_stack([across.ravel(), down.ravel()]).astype(np.float32)
    return _root(blocks.reshape(-1, LENGTH), settings.contrast), positions


def _resized(grey: NDArray[np.uint8], settings: DenseSettings, factor: float) -> NDArray[np.uint8]:
    height, width = grey.shape
    smallest = _SMALLEST * CELLS * settings.cell
    size = (max(smallest, round(width * factor)), max(smallest, round(height * factor)))
    method = cv2.INTER_AREA if size[0] < width else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(grey, size, interpolation=method), dtype=np.uint8)


def _orientations(image: FloatArray) -> FloatArray:
    """Return gradient magnitudes (H, W, 8), shared between the two nearest orientations."""
    image = cv2.GaussianBlur(image, (0, 0), 0.7).astype(np.float32)
    gx = cv2.Sobel(image, cv2.CV_32F, 1, 0, ksize=1, scale=0.5)
    gy = cv2.Sobel(image, cv2.CV_32F, 0, 1, ksize=1, scale=0.5)
    magnitude, angle = cv2.cartToPolar(gx, gy)
    where = angle.ravel() * np.float32(ORIENTATIONS / (2 * np.pi))
    lower = where.astype(np.int32)
    upper_share = magnitude.ravel() * (where - lower)
    first = np.arange(0, ORIENTATIONS * where.size, ORIENTATIONS, dtype=np.int32)
    found = np.zeros(ORIENTATIONS * where.size, dtype=np.float32)
    # ORIENTATIONS is a power of two: the last bits are the remainder.
    found[first + (lower & (ORIENTATIONS - 1))] = magnitude.ravel() - upper_share
    found[first + ((lower + 1) & (ORIENTATIONS - 1))] = upper_share
    return found.reshape(*image.shape, ORIENTATIONS)


def _cell_histograms(orientations: FloatArray, cell: int) -> FloatArray:
    """Return the histogram of the cell around each pixel, pixels weighted by a triangle."""
    triangle = (cell - np.abs(np.arange(1 - cell, cell))).astype(np.float32) / cell**2
    return np.asarray(
        cv2.sepFilter2D(orientations, -1, triangle, triangle, borderType=cv2.BORDER_CONSTANT),
        dtype=np.float32,
    )


def _centres(length: int, settings: DenseSettings) -> NDArray[np.float64]:
    """Return the centres of descriptors that lie wholly within `length` pixels."""
    margin = (CELLS / 2) * settings.cell
    return np.arange(margin, length - margin, settings.step)


def _root(blocks: FloatArray, contrast: float) -> FloatArray:
    """Normalise descriptors (N, 128), limit large numbers, and take the root."""
    length = np.sqrt(np.einsum("ij,ij->i", blocks, blocks))[:, None]
    found = blocks / np.maximum(length, 1e-6)
    np.minimum(found, _LIMIT, out=found)
    scale = length / (length + contrast) / np.maximum(found.sum(axis=1, keepdims=True), 1e-6)
    found *= scale
    return np.asarray(np.sqrt(found, out=found), dtype=np.float32)
