"""What an omnidirectional mirror camera shows, and its images cut and unrolled."""

from __future__ import annotations

from functools import lru_cache
from typing import TypeVar, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.cameras.omni import OmniModel
from roomgraph.datasets.synthetic.cameras.photograph import develop_real

Float32Array = NDArray[np.float32]
Picture = TypeVar("Picture", NDArray[np.uint8], NDArray[np.float32], NDArray[np.bool_])

# The sectors by the azimuth of their middle, in the order of their names.
SECTORS = {"front": 0.0, "left": 90.0, "back": 180.0, "right": 270.0}
# Blur (sigma, px of a 600 px image) in the middle and at the rim; what the rim loses of the light.
BLUR_PX = 0.5, 1.5
VIGNETTING = 0.3
# How bright the camera, its lens's ring, the helmet and the struts are next to the room.
HOUSING, LENS_RING, HELMET, STRUT = 0.10, 0.32, 0.26, 0.07


def mirror_image(
    radiance: Float32Array, model: OmniModel, normal: Float32Array, gain: float, noise: float = 1.0
) -> NDArray[np.uint8]:
    """Return what the camera makes of the light that comes along its rays.

    Parameters
    ----------
    radiance : (H, W, 3) float32
        The light along `OmniModel.rays`, 255 being white at gain 1.
    model : OmniModel
        The camera.
    normal : (H, W, 3) float32
        Standard normal values, for the noise.
    gain : float
        The exposure's, see `develop_real`.
    noise : float
        Scale of the noise; 0 is none.
    """
    far, clear, outside, dark = _coverings(model)
    scale = model.size_px / 600
    near, rim = (cv2.GaussianBlur(radiance, (0, 0), sigma * scale) for sigma in BLUR_PX)
    room = near + far[..., None] * (rim - near)
    # What the mirror shows of the camera and the helmet is lit by the room.
    level = np.asarray(cv2.mean(radiance, clear.astype(np.uint8))[:3], dtype=np.float32)
    light = room * clear[..., None] + (1 - clear)[..., None] * dark[..., None] * level
    light *= (outside * (1 - np.float32(VIGNETTING) * far))[..., None]
    return develop_real(light, gain, np.ones(3), noise, normal)


@lru_cache(maxsize=4)
def _coverings(model: OmniModel) -> tuple[Float32Array, ...]:
    """Return images (H, W): squared radius, where the room is seen, the mirror, and how dark.

    Edges are as soft as the lens is.
    """
    radius, azimuth = model.polar()
    far = np.minimum(radius / model.outer_px, 1) ** 2
    mirror = np.clip(model.outer_px - radius + 0.5, 0, 1)
    dark = np.full(radius.shape, STRUT)
    # A helmet is round: it is brightest where it faces the ceiling, dark at its edge.
    helmet = model.from_helmet()
    dark = np.where(helmet < 1, HELMET * (1 - 0.75 * helmet**2), dark)
    dark = np.where(model.on_strut(radius, azimuth), STRUT, dark)
    inner = radius / model.inner_px
    dark = np.where(inner < 1, HOUSING * (1.2 - 0.5 * inner), dark)
    dark = np.where(np.abs(inner - 0.5) < 0.06, LENS_RING, dark)
    dark = np.where(inner < 0.4, 0.02, dark)
    covered = model.mask() | (radius > model.outer_px)
    soft = (cv2.GaussianBlur(image.astype(np.float32), (0, 0), 0.7) for image in (covered, dark))
    clear, dark_soft = soft
    return far.astype(np.float32), clear, mirror.astype(np.float32), dark_soft


def sectors(image: Picture, model: OmniModel, turn_deg: float = 0.0) -> dict[str, Picture]:
    """Cut an image (H, W, ...) into four square sectors, turned to one orientation.

    Each is a quarter of the image, as wide as the ring's outer radius. The mirror's axis is at
    its lower left corner, the middle of the sector at the upper right. Pixels are only moved, not
    mixed, where the model's front is at 45 degrees. Give it a mask for the sectors' masks.

    Parameters
    ----------
    image : (H, W, ...) uint8, float32 or bool
        The mirror image, or a mask.
    model : OmniModel
        The camera.
    turn_deg : float
        Turns the sectors to the left; 45 gives the second partition, between the first one's.
    """
    side = int(np.ceil(model.outer_px))
    right, up = np.arange(side) + 0.5, (np.arange(side)[::-1] + 0.5)[:, None]
    parts = {}
    for name, azimuth in SECTORS.items():
        turn = np.deg2rad(azimuth + turn_deg + model.front_deg - 45)
        # Exact zeros and ones at right angles.
        c, s = np.round([np.cos(turn), np.sin(turn)], 12)
        x = model.centre[0] + right * c + up * s
        y = model.centre[1] - up * c + right * s
        parts[name] = _looked_up(image, x, y)
    return parts


def unwrap(image: Picture, model: OmniModel, width: int = 1200) -> Picture:
    """Return the image on a cylinder around the mirror's axis: upright edges stand upright.

    The front is in the middle, what is to its left is left of it: writing can be read. A row is
    the tangent of an elevation. What is not seen is 0; give it a mask for the panorama's mask.
    """
    return _looked_up(image, *_cylinder(model, width))


@lru_cache(maxsize=4)
def _cylinder(model: OmniModel, width: int) -> tuple[Float32Array, Float32Array]:
    """Return which pixels x, y the panorama's pixels show; NaN for none."""
    low, high = np.tan(np.deg2rad(model.elevations_deg))
    step = 2 * np.pi / width
    azimuth = np.pi - (np.arange(width) + 0.5) * step
    rise = high - (np.arange(int((high - low) / step)) + 0.5) * step
    across, up = np.meshgrid(azimuth, rise)
    points = np.stack([np.cos(across), np.sin(across), up], axis=2)
    x, y = model.project(points.reshape(-1, 3)).T.reshape(2, *across.shape)
    return x.astype(np.float32), y.astype(np.float32)


def _looked_up(image: Picture, x: NDArray[np.floating], y: NDArray[np.floating]) -> Picture:
    """Return the image at places; 0 outside it and where they are NaN."""
    places = (np.nan_to_num(part, nan=-9.0).astype(np.float32) for part in (x, y))
    is_mask = image.dtype == np.bool_
    method = cv2.INTER_NEAREST if is_mask else cv2.INTER_LINEAR
    seen = cv2.remap(image.astype(np.uint8) if is_mask else image, *places, method)
    return cast(Picture, seen.astype(image.dtype))
