"""An omnidirectional camera on a helmet: it looks up into a convex mirror that hangs over it.

The mirror is a hyperboloid with the camera in its other focus, so all rays meet in one point. The
image shows the ground around its middle and the horizon near the rim. It is a mirror image: what
is to the left of the front lies clockwise from it, and writing is reversed.

The camera's frame: z up along the mirror's axis, x to the rig's front, y to its left. Azimuth is
counted from x to y, elevation from the horizon upwards.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.files import write_text
from roomgraph.datasets.synthetic.rendering.eye import Eye

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

ABOVE_M = 0.25
LARGEST_PX = 8192


def _pixels_a_radian(rays: FloatArray) -> NDArray[np.float32]:
    """Return how densely unit rays (H, W, 3) lie: the mean along both axes of the image."""
    steps = [np.linalg.norm(np.gradient(rays, axis=axis), axis=2) for axis in (0, 1)]
    return np.asarray(1 / np.sqrt(np.maximum(steps[0] * steps[1], 1e-8)), dtype=np.float32)


@dataclass(frozen=True, slots=True)
class OmniModel:
    """The mirror camera, in pixels of its square image; pixel centres lie on whole numbers.

    A ray at an angle t from straight down is seen at the radius gamma sin t / (xi + cos t): the
    unified model of all cameras with one viewpoint.

    Attributes
    ----------
    size_px : int
        Width and height of the image.
    inner_px, outer_px : float
        Radii of the useful ring; by default from 60 degrees below to 20 above the horizon.
    centre : tuple of float
        Where the mirror's axis is, x and y.
    xi : float
        The mirror: 2 e / (1 + e^2) for a hyperbola of eccentricity e; 1 is a parabola.
    gamma_px : float
        Focal length of the camera and the mirror together. The horizon's radius is gamma / xi.
    front_deg : float
        Where in the image the front is, clockwise from its top. At 45 the image's four quarters
        are the four sectors.
    struts_deg : tuple of float
        Azimuths of the arms that hold the mirror.
    strut_px : float
        Their width.
    helmet_px, helmet_back_px : float
        Radius of the helmet's reflection, and how far behind the image's middle it lies.
    """

    size_px: int = 600
    inner_px: float = 48.75
    outer_px: float = 290.0
    centre: tuple[float, float] = (299.5, 299.5)
    xi: float = 0.9
    gamma_px: float = 172.2
    front_deg: float = 45.0
    struts_deg: tuple[float, ...] = (60.0, 180.0, 300.0)
    strut_px: float = 5.0
    helmet_px: float = 56.0
    helmet_back_px: float = 30.0

    def __post_init__(self) -> None:
        numbers = (*(getattr(self, name) for name in NUMBERS), *self.centre, *self.struts_deg)
        if not np.all(np.isfinite(numbers)):
            raise ValueError("a number is not finite")
        if not 0 < self.inner_px < self.outer_px or not 0 < self.size_px <= LARGEST_PX:
            raise ValueError("expected 0 < inner_px < outer_px and a size up to 8192")
        if not 0 < self.xi <= 1 or self.gamma_px <= 0:
            raise ValueError("expected 0 < xi <= 1 and gamma_px > 0")
        edges = [min(value, self.size_px - 1 - value) + 0.5 for value in self.centre]
        if len(edges) != 2 or min(edges) < self.outer_px:
            raise ValueError("the ring leaves the image")
        if min(self.strut_px, self.helmet_px) < 0:
            raise ValueError("a size is negative")

    @property
    def elevations_deg(self) -> tuple[float, float]:
        """Elevations of the ring's inner and outer edge."""
        radii = np.array([self.inner_px, self.outer_px])
        low, high = np.degrees(np.arctan2(*self._lifted(radii)[::-1]))
        return float(low), float(high)

    @property
    def horizon_px(self) -> float:
        """Radius at which the horizon is seen."""
        return self.gamma_px / self.xi

    def resized(self, size_px: int) -> OmniModel:
        """Return the camera whose images are this one's at another size."""
        scale = size_px / self.size_px
        lengths = ("inner_px", "outer_px", "gamma_px", "strut_px", "helmet_px", "helmet_back_px")
        scaled: dict[str, Any] = {name: getattr(self, name) * scale for name in lengths}
        x, y = ((value + 0.5) * scale - 0.5 for value in self.centre)
        return replace(self, size_px=size_px, centre=(x, y), **scaled)

    def rays(self) -> Eye:
        """Return the eye whose unit rays (H, W, 3) the pixels see; also those outside the ring."""
        radius, azimuth = self.polar()
        across, up = self._lifted(radius)
        rays = np.stack([across * np.cos(azimuth), across * np.sin(azimuth), up], axis=2)
        lengths = np.ones(radius.shape, dtype=np.float32)
        return Eye(rays.astype(np.float32), lengths, _pixels_a_radian(rays), is_pinhole=False)

    def project(self, points: NDArray[np.floating]) -> FloatArray:
        """Return the pixels (N, 2) of points (N, 3) in the camera's frame; NaN beside the ring."""
        x, y, z = np.asarray(points, dtype=np.float64).T
        # Straight up there is nothing: what is divided by zero is not seen.
        with np.errstate(divide="ignore", invalid="ignore"):
            across = np.hypot(x, y)
            below = self.xi * np.hypot(across, z) - z
            radius = self.gamma_px * across / below
        # A ray at the very edge may be rounded out of the ring.
        seen = (below > 0) & (radius > self.inner_px - 1e-3) & (radius < self.outer_px + 1e-3)
        bearing = np.arctan2(y, x) + np.deg2rad(self.front_deg)
        radius = np.where(seen, radius, np.nan)
        u, v = radius * np.sin(bearing), -radius * np.cos(bearing)
        return np.column_stack([u + self.centre[0], v + self.centre[1]])

    def mask(self) -> Mask:
        """Return where the image (H, W) is useful: neither outside nor the camera or helmet."""
        radius, azimuth = self.polar()
        covered = (radius < self.inner_px) | (radius > self.outer_px)
        return np.asarray(~(covered | self.on_strut(radius, azimuth) | (self.from_helmet() < 1)))

    def _lifted(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the unit ray's part across the axis and up along it, by the radius in pixels."""
        rho = radius / self.gamma_px
        eta = (self.xi + np.sqrt(1 + (1 - self.xi**2) * rho**2)) / (1 + rho**2)
        return eta * rho, self.xi - eta

    def polar(self) -> tuple[FloatArray, FloatArray]:
        """Return each pixel's radius and azimuth (H, W), radians."""
        x = np.arange(self.size_px) - self.centre[0]
        y = (np.arange(self.size_px) - self.centre[1])[:, None]
        return np.hypot(x, y), np.arctan2(x, -y) - np.deg2rad(self.front_deg)

    def on_strut(self, radius: FloatArray, azimuth: FloatArray) -> Mask:
        """Return where (H, W) the holder's arms are, by each pixel's radius and azimuth."""
        covered = np.zeros(radius.shape, dtype=np.bool_)
        for strut in np.deg2rad(self.struts_deg):
            across = radius * np.abs(np.sin(azimuth - strut))
            covered |= (across < self.strut_px / 2) & (np.cos(azimuth - strut) > 0)
        return covered

    def from_helmet(self) -> FloatArray:
        """Return each pixel's distance (H, W) from the helmet's middle, its edge being at 1."""
        back = np.deg2rad(self.front_deg + 180)
        x = np.arange(self.size_px) - (self.centre[0] + self.helmet_back_px * np.sin(back))
        y = np.arange(self.size_px) - (self.centre[1] - self.helmet_back_px * np.cos(back))
        return np.asarray(np.hypot(x, y[:, None]) / max(self.helmet_px, 1e-6))


NUMBERS = tuple(f.name for f in fields(OmniModel) if f.name not in ("centre", "struts_deg"))


def T_camera_omni(above_m: float = ABOVE_M) -> FloatArray:
    """Return the pose (4, 4) in the frame of the forward camera (x right, y down, z forward).

    The mirror's axis is fixed to the rig: its pitch and roll tilt the mirror too.
    """
    T = np.eye(4)
    T[:3, :3] = np.array([(0, -1, 0), (0, 0, -1), (1, 0, 0)])
    T[1, 3] = -above_m
    return T


def write_model(path: Path, model: OmniModel) -> None:
    """Write a model in the form that `read_model` reads, through a temporary file."""
    write_text(path, json.dumps(asdict(model), indent=1) + "\n")


def read_model(path: Path) -> OmniModel:
    """Read a model that `write_model` has written.

    Raises
    ------
    DatasetError
        The file is missing, is not JSON, lacks a value or holds an impossible one.
    """
    try:
        return _model(json.loads(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise DatasetError("omnidirectional camera file cannot be read", where=path) from error
    except (ArithmeticError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise DatasetError(
            "invalid omnidirectional camera file", where=path,
            expected=f"JSON with {', '.join(f.name for f in fields(OmniModel))}",
            got=f"{type(error).__name__} {error}",
        ) from error  # fmt: skip


def _model(values: dict[str, Any]) -> OmniModel:
    numbers: dict[str, Any] = {name: float(values[name]) for name in NUMBERS}
    size = int(numbers.pop("size_px"))
    if size != values["size_px"]:
        raise ValueError(f"size_px is {values['size_px']}")
    x, y = (float(value) for value in values["centre"])
    struts = tuple(float(value) for value in values["struts_deg"])
    return OmniModel(size, centre=(x, y), struts_deg=struts, **numbers)
