"""Check of the intrinsics against the size of the images."""

from __future__ import annotations

from dataclasses import replace

from pydantic import Field

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.settings import Settings
from roomgraph.slam.checks.finding import Finding


class IntrinsicsSettings(Settings):
    """When intrinsics are implausible for the size of the images."""

    near_middle: float = Field(
        default=0.05, gt=0, lt=0.5,
        description="a principal point is central within this share of the image's size",
    )  # fmt: skip
    off_middle: float = Field(
        default=0.15,
        gt=0,
        lt=0.5,
        description="a principal point further from the centre, as a share of the image's size, "
        "is implausible",
    )
    min_view_deg: float = Field(
        default=20,
        gt=0,
        lt=180,
        description="narrowest plausible horizontal field of view, degrees",
    )
    max_view_deg: float = Field(
        default=140, gt=0, lt=180, description="widest plausible horizontal field of view, degrees"
    )


def find_wrong_intrinsics(intrinsics: Intrinsics, settings: IntrinsicsSettings) -> Finding | None:
    """Judge the numbers alone: principal point and field of view against the images' size."""
    width, height = intrinsics.width, intrinsics.height
    off = _off_middle(intrinsics, width, height)
    scale = round((intrinsics.cx + 0.5) / width + (intrinsics.cy + 0.5) / height, 2)
    turned = replace(intrinsics, cx=intrinsics.cy, cy=intrinsics.cx)
    suggestion = None
    if off > 2 * settings.near_middle and _off_middle(turned, width, height) < settings.near_middle:
        suggestion = (
            "cx and cy look swapped (and perhaps fx and fy): check the camera file (--camera)"
        )
    elif off > settings.off_middle and (
        _off_middle(intrinsics, scale * width, scale * height) < settings.near_middle
    ):
        suggestion = (
            f"the camera file seems to be for images of {scale * width:.0f}x{scale * height:.0f}: "
            f"divide fx, fy, cx and cy by {scale:g}"
        )
    elif off > settings.off_middle:
        suggestion = "check cx and cy in the camera file (--camera), unless the images were cropped"
    if suggestion is not None:
        where = f"cx {intrinsics.cx:g}, cy {intrinsics.cy:g} in images of {width}x{height}"
        observed = f"the principal point is far from the centre of the images: {where}"
        return Finding("intrinsics", observed, suggestion)
    view = intrinsics.view_deg
    if not settings.min_view_deg <= view <= settings.max_view_deg:
        return Finding(
            "intrinsics",
            f"fx {intrinsics.fx:g} gives an implausible field of view of {view:.0f} degrees",
            "check that fx and fy in the camera file (--camera) are in pixels of these images",
        )  # fmt: skip
    return None


def _off_middle(intrinsics: Intrinsics, width: float, height: float) -> float:
    """Return how far the principal point lies from the middle of a size, as a share of it."""
    x, y = (intrinsics.cx + 0.5) / width, (intrinsics.cy + 0.5) / height
    return max(abs(x - 0.5), abs(y - 0.5))
