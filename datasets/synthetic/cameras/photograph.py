"""What a phone's colour camera makes of the light that reaches it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.se3 import exponential, logarithm

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
Photo = TypeVar("Photo", NDArray[np.uint8], NDArray[np.float32])

TARGET_MEAN = 115.0
EXPOSURE_LAG_S, BALANCE_LAG_S = 0.4, 1.0
# The exposure time that goes with gain 1, and its limits. Beyond the longest one the sensor's
# signal is amplified, up to so many times.
EXPOSURE_S, SHORTEST_S, LONGEST_S = 1 / 60, 1 / 250, 1 / 25
MOST_AMPLIFICATION = 8.0
BALANCE_LIMITS = 0.7, 1.45
# Variance of the shot noise for each level of the image, and sigma of the read noise, out of 255,
# without amplification.
SHOT_NOISE, READ_NOISE = 0.03, 0.8
# Highlights bend from here, to white at twice the distance from here to 255.
SHOULDER = 175.0
# What the corners of the image lose.
VIGNETTING = 0.22
FEWEST_SAMPLES, MOST_SAMPLES = 5, 13
SHARP_PX, SAMPLE_PX = 0.7, 2.0


@dataclass(frozen=True, slots=True, eq=False)
class ExposureSeries:
    """The exposure of each image of a sequence.

    Attributes
    ----------
    gain : (N,) float64
        What the image is brighter than the light (`develop_real`): time and amplification both.
    exposure_s : (N,) float64
        Exposure time, seconds.
    """

    gain: FloatArray
    exposure_s: FloatArray


def exposure_series(brightness: NDArray[np.floating], rate_hz: float) -> ExposureSeries:
    """Return what an automatic exposure does over a sequence.

    It follows the logarithm of the brightness with a lag, beginning adapted. The exposure time
    serves first; in dim rooms, where it is at its limit, the amplification.

    Parameters
    ----------
    brightness : (N,) floating
        Mean brightness of the scene at gain 1, 0 to 255.
    rate_hz : float
        Images a second.
    """
    level = np.exp(_lagging(np.log(np.maximum(brightness, 0.1)), rate_hz, EXPOSURE_LAG_S))
    darkest, brightest = SHORTEST_S / EXPOSURE_S, MOST_AMPLIFICATION * LONGEST_S / EXPOSURE_S
    gain = np.clip(TARGET_MEAN / level, darkest, brightest)
    return ExposureSeries(gain, np.minimum(gain * EXPOSURE_S, LONGEST_S))


def white_balance_series(means: NDArray[np.floating], rate_hz: float) -> FloatArray:
    """Return the gains (N, 3) of the channels: half the way to a grey world, with a lag.

    Parameters
    ----------
    means : (N, 3) floating
        Mean of each channel of the scene.
    rate_hz : float
        Images a second.
    """
    levels = np.log(np.maximum(means, 0.1))
    cast = levels - levels.mean(axis=1, keepdims=True)
    return np.clip(np.exp(-0.5 * _lagging(cast, rate_hz, BALANCE_LAG_S)), *BALANCE_LIMITS)


def _lagging(values: NDArray[np.floating], rate_hz: float, lag_s: float) -> FloatArray:
    """Return values (N, ...) late by a lag of the first order, each made of those before it."""
    keep = float(np.exp(-1 / (rate_hz * lag_s)))
    if not len(values):
        return np.zeros(values.shape)
    # The filter's state before the first value is that of one long at rest.
    late, _ = lfilter([0.0, 1 - keep], [1.0, -keep], values, axis=0, zi=values[:1])
    return np.asarray(late, dtype=np.float64)


def motion_blur(
    image: Photo,
    depth: Float32Array,
    intrinsics: Intrinsics,
    T_start_end: FloatArray,
) -> Photo:
    """Return an image as a camera takes it that moves during the exposure.

    Each pixel is the mean along its own path, taken straight and even. The image stays as it is
    where even the longest path is shorter than `SHARP_PX`.

    Parameters
    ----------
    image : (H, W, 3) uint8 or float32
        The sharp image, taken from the middle of the motion.
    depth : (H, W) float32
        Its depth, metres; 0 is far away.
    intrinsics : Intrinsics
        The camera.
    T_start_end : (4, 4) float64
        The camera at the end of the exposure in the frame of the camera at its start.
    """
    half = exponential(logarithm(T_start_end) / 2)
    across, down = _moves(depth, intrinsics, half)
    longest = 2 * float(cv2.magnitude(across, down).max())
    if longest < SHARP_PX:
        return image
    samples = int(np.clip(np.ceil(longest / SAMPLE_PX), FEWEST_SAMPLES, MOST_SAMPLES))
    u, v = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in image.shape[1::-1]))
    # Four channels are moved in a third of the time that three take.
    wide = cv2.cvtColor(image, cv2.COLOR_BGR2BGRA)
    x, y, moved = np.empty_like(u), np.empty_like(v), np.empty_like(wide)
    total = np.zeros(wide.shape, dtype=np.float32)
    for share in (2 * np.arange(samples) + 1) / samples - 1:
        cv2.scaleAdd(across, share, u, dst=x)
        cv2.scaleAdd(down, share, v, dst=y)
        cv2.remap(wide, x, y, cv2.INTER_LINEAR, dst=moved, borderMode=cv2.BORDER_REPLICATE)
        cv2.accumulate(moved, total)
    mean = np.asarray(cv2.cvtColor(total, cv2.COLOR_BGRA2BGR), dtype=np.float32)
    mean *= np.float32(1 / samples)
    if image.dtype == np.uint8:
        np.rint(mean, out=mean)
    return mean.astype(image.dtype)


def _moves(
    depth: Float32Array, camera: Intrinsics, T: FloatArray
) -> tuple[Float32Array, Float32Array]:
    """Return how far, across and down (H, W), what a pixel shows is away when the camera moves.

    `T` is the moved camera's pose in the frame of the image's; it sees the same `depth`, nearly.
    """
    homography = (camera.K @ T[:3, :3] @ np.linalg.inv(camera.K)).astype(np.float32)
    shift = (camera.K @ T[:3, 3]).astype(np.float32)
    nearness = np.divide(1, depth, out=np.zeros_like(depth), where=depth > 0)
    u = np.arange(camera.width, dtype=np.float32)
    v = np.arange(camera.height, dtype=np.float32)[:, None]
    x, y, z = (
        cv2.scaleAdd(nearness, float(along), (row[0] * u + row[2]) + row[1] * v)
        for row, along in zip(homography, shift, strict=True)
    )
    np.maximum(z, np.float32(0.05), out=z)
    x /= z
    y /= z
    return np.subtract(x, u, out=x), np.subtract(y, v, out=y)


def develop_real(
    radiance: Float32Array,
    gain: float,
    white_balance: NDArray[np.floating],
    noise: float,
    normal: Float32Array,
) -> NDArray[np.uint8]:
    """Return the photograph of the light that reaches the camera.

    Parameters
    ----------
    radiance : (H, W, 3) float32
        The light, 255 being white at gain 1; may be brighter.
    gain : float
        The exposure's, see `ExposureSeries`. Beyond the longest exposure time noise grows with it.
    white_balance : (3,) floating
        Gains of the channels, in the order of the image's.
    noise : float
        Scale of the noise; 0 is none.
    normal : (H, W, 3) float32
        Standard normal values.
    """
    rows, columns = radiance.shape[:2]
    # Channels lie side by side in a row: numpy is slow over an axis of three.
    signal = radiance.reshape(rows, -1) * _vignette(rows, columns, gain)
    if noise:
        amplification = max(gain * EXPOSURE_S / LONGEST_S, 1.0)
        sigma = signal * np.float32(SHOT_NOISE * amplification)
        sigma += np.float32((READ_NOISE * amplification) ** 2)
        cv2.sqrt(sigma, dst=sigma)
        sigma *= normal.reshape(rows, -1)
        signal = cv2.scaleAdd(sigma, noise, signal)
    signal *= np.tile(np.asarray(white_balance, dtype=np.float32), columns)
    return _with_shoulder(signal).reshape(rows, columns, 3)


def _vignette(rows: int, columns: int, gain: float) -> Float32Array:
    """Return the gain (H, 3 W) that falls off towards the corners, three times for each pixel."""
    x = np.repeat(np.linspace(-1, 1, columns, dtype=np.float32), 3) * columns
    y = np.linspace(-1, 1, rows, dtype=np.float32)[:, None] * rows
    strength = np.float32(gain * VIGNETTING / (rows**2 + columns**2))
    return np.asarray((gain - strength * x**2) - strength * y**2, dtype=np.float32)


def _with_shoulder(signal: Float32Array) -> NDArray[np.uint8]:
    """Clip to 0 to 255, the highlights bent by a parabola rather than cut."""
    span = 255 - SHOULDER
    over = np.clip(signal - np.float32(SHOULDER), 0, np.float32(2 * span))
    bent = np.clip(signal, 0, np.float32(SHOULDER))
    bent += over
    over *= over
    return np.asarray(cv2.convertScaleAbs(cv2.scaleAdd(over, -1 / (4 * span), bent)), np.uint8)
