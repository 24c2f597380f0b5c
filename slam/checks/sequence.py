"""All checks on a sequence, from some stretches of its frames."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets.camera import Camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.sequence import Sequence
from roomgraph.datasets.settings import Settings
from roomgraph.slam.checks.calibration import CalibrationSettings, Pair, pair_of
from roomgraph.slam.checks.corrected_cameras import registered
from roomgraph.slam.checks.delay import Delay, DelaySettings, find_delay
from roomgraph.slam.checks.depth_scale import DepthScaleSettings, find_wrong_scale
from roomgraph.slam.checks.edges import Outlines, outlines
from roomgraph.slam.checks.finding import Finding
from roomgraph.slam.checks.focal_length import find_wrong_focal
from roomgraph.slam.checks.intrinsics import IntrinsicsSettings, find_wrong_intrinsics
from roomgraph.slam.checks.registration import Misplaced, RegistrationSettings, find_misplacement
from roomgraph.slam.geometry.noise import SensorNoise

# Of each frame, every so manieth row and column goes into the statistics of depth.
DEPTH_STEP = 8
# Of each window, every so manieth frame says whether depth lies on colour: its neighbours see
# the same.
REGISTRATION_STEP = 2
# Frames after the first of a window that it is matched with: the furthest that shows enough of
# the same, for the more the camera turned, the more it says of the focal lengths.
MATCHED_AFTER = (24, 7, 3, 1)
# Windows looked at side by side: their images are in memory at once.
THREADS = 4


class CheckSettings(Settings):
    """The checks of a sequence before it is mapped."""

    enabled: bool = Field(
        default=True, description="check the sequence before it is mapped, and warn"
    )
    correct_camera: bool = Field(
        default=True,
        description="correct the camera where the images show how: align the depth images to the "
        "colour images, replace focal lengths that do not fit the images",
    )
    windows: int = Field(
        default=10,
        ge=1,
        le=100,
        description="number of windows of successive frames that are checked",
    )
    window: int = Field(default=8, ge=1, le=100, description="number of frames in each window")
    intrinsics: IntrinsicsSettings = IntrinsicsSettings()
    calibration: CalibrationSettings = CalibrationSettings()
    depth_scale: DepthScaleSettings = DepthScaleSettings()
    registration: RegistrationSettings = RegistrationSettings()
    delay: DelaySettings = DelaySettings()


@dataclass(frozen=True, slots=True)
class Evidence:
    """What the checks need of the frames, which are let go.

    Attributes
    ----------
    windows : tuple of tuple of Outlines
        Of successive frames each.
    depths_m : (N,) float32
        Readings from all over the frames, metres; none is 0.
    """

    windows: tuple[tuple[Outlines, ...], ...]
    depths_m: NDArray[np.float32]


def check_sequence(
    sequence: Sequence, settings: CheckSettings, noise: SensorNoise
) -> tuple[Finding, ...]:
    """Return what does not agree in a sequence, with the likeliest cause of each.

    `noise` is that of the sensor that took the sequence. Frames that cannot be read are left to
    those that need them.
    """
    camera = sequence.camera
    wrong = find_wrong_intrinsics(camera.intrinsics, settings.intrinsics)
    found = [] if wrong is None else [wrong]
    evidence = _gather(sequence, settings)
    scale = find_wrong_scale(evidence.depths_m, camera.depth_scale, settings.depth_scale)
    if scale is not None:
        hint = (
            f"--depth-scale {scale.depth_scale:g} gives typical indoor distances"
            if scale.depth_scale
            else "check the unit of the depth images (--depth-scale)"
        )
        found.append(Finding(
            "depth scale",
            f"a depth scale of {camera.depth_scale:g} units per metre does not fit the images: "
            f"the median depth is {scale.median_m:.3g} m",
            hint,
        ))  # fmt: skip
    found += _out_of_step(sequence, evidence, settings)
    # With anything else wrong, points do not move rigidly either.
    return tuple(found or _calibration(sequence, settings, noise))


def _calibration(sequence: Sequence, settings: CheckSettings, noise: SensorNoise) -> list[Finding]:
    """Report focal lengths that do not fit the motion between frames."""

    def look(window: range) -> Pair | None:
        later = (window[0] + step for step in MATCHED_AFTER if window[0] + step < len(sequence))
        try:
            return pair_of(sequence[window[0]], (sequence[k] for k in later), settings.calibration)
        except DatasetError:
            return None

    windows = _windows(len(sequence), settings.windows, settings.window)
    with ThreadPoolExecutor(THREADS) as pool:
        known = [pair for pair in pool.map(look, windows) if pair is not None]
    if not known:
        return []
    finding = find_wrong_focal(known, sequence.camera, settings.calibration, noise)
    return [] if finding is None else [finding]


def _gather(sequence: Sequence, settings: CheckSettings) -> Evidence:
    def look(window: range) -> tuple[tuple[Outlines, ...], list[NDArray[np.float32]]] | None:
        try:
            frames = [sequence[index] for index in window]
        except DatasetError:
            return None
        depths = [_sampled(frame) for frame in frames[::REGISTRATION_STEP]]
        return tuple(outlines(frame) for frame in frames), depths

    windows = _windows(len(sequence), settings.windows, settings.window)
    with ThreadPoolExecutor(THREADS) as pool:
        found = [seen for seen in pool.map(look, windows) if seen is not None]
    depths = [depth for _, window in found for depth in window]
    return Evidence(
        tuple(window for window, _ in found),
        np.concatenate(depths) if depths else np.empty(0, np.float32),
    )


def _windows(frames: int, count: int, length: int) -> list[range]:
    """Return up to `count` stretches of frames, evenly spread and not overlapping."""
    count = min(count, max(1, frames // length))
    starts = np.linspace(0, max(0, frames - length), count).astype(int)
    return [range(int(start), min(int(start) + length, frames)) for start in starts]


def _sampled(frame: Frame) -> NDArray[np.float32]:
    depth = frame.depth[::DEPTH_STEP, ::DEPTH_STEP]
    return np.asarray(depth[depth > 0])


def _out_of_step(sequence: Sequence, evidence: Evidence, settings: CheckSettings) -> list[Finding]:
    """Report depth images that do not fit the colour images: in position, or in time.

    Each can look like the other while the camera moves evenly: the better fit is believed.
    """
    delay = find_delay(evidence.windows, settings.delay)
    spread = [window[::REGISTRATION_STEP] for window in evidence.windows]
    misplaced = find_misplacement(spread, settings.registration)
    if misplaced is None:
        return [] if delay is None else [_late(delay, sequence)]
    if delay is not None and delay.score >= misplaced.score:
        return [_late(delay, sequence)]
    step = spread[0][0].step
    later = find_delay(evidence.windows, settings.delay, misplaced.alignment.resized(1 / step))
    found = [_unregistered(misplaced, sequence.camera)]
    return found if later is None else [*found, _late(later, sequence)]


def _late(delay: Delay, sequence: Sequence) -> Finding:
    period = float(np.median(np.diff(sequence.stamps_s)))
    frames = f"{abs(delay.frames)} frame{'s' if abs(delay.frames) > 1 else ''}"
    seconds, sign = abs(delay.frames) * period, "-" if delay.frames > 0 else "+"
    return Finding(
        "time offset",
        f"the depth images are {frames} ({seconds:.3g} s) "
        f"{'later' if delay.frames > 0 else 'earlier'} than the colour images they are paired with",
        f"add {sign}{seconds:.3g} s to the time stamps of the depth images, "
        "then pair the images again",
    )


def _unregistered(misplaced: Misplaced, camera: Camera) -> Finding:
    alignment = misplaced.alignment
    scaled = f"scaled by {alignment.scale:.2f} and " if abs(alignment.scale - 1) >= 0.01 else ""
    return Finding(
        "registration",
        "the depth images are not aligned to the colour images: they fit when "
        f"{scaled}shifted by ({alignment.dx:+.0f}, {alignment.dy:+.0f}) pixels",
        "switch on the alignment of depth to colour when recording, or "
        'describe the depth camera as "depth" in the camera file',
        registered(camera, alignment),
    )
