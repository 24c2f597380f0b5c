"""Check of the alignment of depth and colour images."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy import fft

from roomgraph.datasets.settings import Settings
from roomgraph.slam.checks.edges import Outlines
from roomgraph.slam.checks.statistics import gain_error

FloatArray = NDArray[np.float64]


class RegistrationSettings(Settings):
    """How a misalignment of depth and colour images is found, and when it is reported."""

    reach: float = Field(
        default=0.1,
        gt=0,
        le=0.3,
        description="largest shift searched, as a share of the image's width",
    )
    scale_range: float = Field(
        default=0.16, ge=0, le=0.4, description="largest change of scale searched, as a share"
    )
    tolerance: float = Field(
        default=0.015, gt=0, le=0.2,
        description="largest RMS displacement that is not reported, as a share of the image's "
        "width",
    )  # fmt: skip
    min_outline: int = Field(
        default=100, ge=10, description="minimum number of outline pixels for a frame to count"
    )
    min_windows: int = Field(
        default=5, ge=4, description="minimum number of windows of frames for a report"
    )
    min_score: float = Field(
        default=0.3, gt=0, description="minimum mean strength of colour edges at depth outlines"
    )
    min_gain: float = Field(
        default=3.0, ge=2, description="minimum gain in fit over no alignment, standard errors"
    )


@dataclass(frozen=True, slots=True)
class Alignment:
    """Where a pixel of the depth image is seen in colour: scaled about the middle and shifted."""

    scale: float = 1.0
    dx: float = 0.0
    dy: float = 0.0

    def apply(self, pixels: NDArray[np.float32], shape: tuple[int, ...]) -> FloatArray:
        """Move pixels (N, 2) of an image of a shape (h, w)."""
        middle = np.array([shape[1] - 1, shape[0] - 1]) / 2
        return np.asarray(self.scale * (pixels - middle) + middle + (self.dx, self.dy))

    def resized(self, factor: float) -> Alignment:
        """Return the alignment for scaled images."""
        return Alignment(self.scale, self.dx * factor, self.dy * factor)

    def displacement(self, shape: tuple[int, ...]) -> float:
        """Return the root mean square of how far it moves the pixels of an image (h, w)."""
        spread = (shape[0] ** 2 + shape[1] ** 2) / 12
        return float(np.sqrt(self.dx**2 + self.dy**2 + (self.scale - 1) ** 2 * spread))


@dataclass(frozen=True, slots=True)
class Misplaced:
    """The required alignment of depth, in image pixels, and the fit of outlines with it."""

    alignment: Alignment
    score: float


def score(found: Outlines, alignment: Alignment | None = None) -> float:
    """Return how strong the colour edges are under the depth's outline; 0 is no relation at all.

    Outlines that `alignment` (working pixels) moves out of the image count as 0.
    """
    pixels, (height, width) = found.pixels, found.edges.shape
    if not len(pixels):
        return 0.0
    if alignment is not None:
        pixels = alignment.apply(pixels, (height, width)).astype(np.float32)
    x, y = np.rint(pixels.T).astype(np.intp)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    return float(found.edges[y[inside], x[inside]].sum() / len(pixels))


def find_misplacement(
    windows: Sequence[Sequence[Outlines]], settings: RegistrationSettings
) -> Misplaced | None:
    """Return the misalignment of depth and colour; None if they fit or evidence is missing.

    Outlines of the foreground are edges in the colour image too, if the one lies on the other.
    Over all sizes and shifts, the correlation of both has its peak at the true alignment. It is
    searched in each half of the windows and believed if both halves agree and if the windows of
    the one fit better under the alignment of the other than without any.
    """
    voting = [[f for f in window if len(f.pixels) >= settings.min_outline] for window in windows]
    voting = [window for window in voting if window]
    if len(voting) < settings.min_windows:
        return None
    shape, step = voting[0][0].edges.shape, voting[0][0].step
    tolerance = settings.tolerance * shape[1]
    halves = voting[::2], voting[1::2]
    with ThreadPoolExecutor(len(halves)) as pool:
        first, second = pool.map(
            lambda half: _search([f for window in half for f in window], settings), halves
        )
    between = Alignment(1 + first.scale - second.scale, first.dx - second.dx, first.dy - second.dy)
    if between.displacement(shape) > tolerance:
        return None
    if min(first.displacement(shape), second.displacement(shape)) <= tolerance:
        return None
    rows = np.concatenate([
        _compare(half, alignment, settings.reach * shape[1])
        for half, alignment in zip(halves, (second, first), strict=True)
    ])  # fmt: skip
    best, none, wrong = rows[:, 0], rows[:, 1], rows[:, 2:]
    # That two independent halves agree is rare by chance already: the gain need not be as sure.
    error = gain_error(wrong, np.ones((len(rows), 2), dtype=np.int64))
    if best.mean() < settings.min_score or np.mean(best - none) < settings.min_gain * error:
        return None
    middle = Alignment(
        (first.scale + second.scale) / 2, (first.dx + second.dx) / 2, (first.dy + second.dy) / 2
    )
    return Misplaced(middle.resized(step), float(best.mean()))


def _compare(windows: Sequence[Sequence[Outlines]], alignment: Alignment, far: float) -> FloatArray:
    """Return scores of windows (N, 10): under an alignment, under none, and under wrong ones.

    The wrong ones are off by `far` working pixels, in eight directions.
    """
    directions = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    wrong = [
        replace(alignment, dx=alignment.dx + far * np.cos(a), dy=alignment.dy + far * np.sin(a))
        for a in directions
    ]
    return np.array([
        [np.mean([score(frame, tried) for frame in window]) for tried in (alignment, None, *wrong)]
        for window in windows
    ])  # fmt: skip


def _search(frames: Sequence[Outlines], settings: RegistrationSettings) -> Alignment:
    """Return the alignment, in working pixels, at which outlines lie on the strongest edges."""
    shape = frames[0].edges.shape
    reach = round(settings.reach * shape[1])
    # A pad as wide as the reach keeps the correlation from wrapping round.
    padded = tuple(int(fft.next_fast_len(side + reach, real=True)) for side in shape)
    spectra = [fft.rfft2(f.edges, padded) for f in frames]
    window = np.arange(-reach, reach + 1)
    best, highest = Alignment(), -np.inf
    for scale in _scales(shape, settings.scale_range):
        product = np.zeros_like(spectra[0])
        for frame, spectrum in zip(frames, spectra, strict=True):
            product += spectrum * np.conj(fft.rfft2(_drawn(frame, scale), padded))
        surface = fft.irfft2(product, padded)[np.ix_(window, window)]
        if surface.max() > highest:
            highest = float(surface.max())
            y, x = np.unravel_index(int(surface.argmax()), surface.shape)
            best = Alignment(float(scale), float(x - reach), float(y - reach))
    return best


def _scales(shape: tuple[int, ...], scale_range: float) -> FloatArray:
    """Return sizes whose neighbours differ by two edge widths at the sides of the image."""
    step = 4.0 / (shape[1] / 2)
    count = int(scale_range / step)
    return np.asarray(1 + step * np.arange(-count, count + 1))


def _drawn(frame: Outlines, scale: float) -> NDArray[np.float32]:
    """Draw the outline, scaled about the middle, with a sum of 1."""
    height, width = frame.edges.shape
    image = np.zeros((height, width), np.float32)
    x, y = np.rint(Alignment(scale).apply(frame.pixels, image.shape).T).astype(np.intp)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    np.add.at(image, (y[inside], x[inside]), np.float32(1 / len(frame.pixels)))
    return image
