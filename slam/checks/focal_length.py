"""Whether the focal lengths fit the motion between the frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roomgraph.datasets.camera import Camera, Intrinsics
from roomgraph.slam.checks.calibration import CalibrationSettings, Pair, measure_focal
from roomgraph.slam.checks.corrected_cameras import refocused
from roomgraph.slam.checks.finding import Finding
from roomgraph.slam.geometry.noise import SensorNoise

# Horizontal and vertical focal lengths whose logarithms differ by less are reported as one.
ALIKE = 0.02


def find_wrong_focal(
    pairs: Sequence[Pair], given: Camera, settings: CalibrationSettings, noise: SensorNoise
) -> Finding | None:
    """Judge focal lengths by whether points of one frame lie rigidly in another.

    Under a wrong focal length the points of a turning camera shear, and no rigid motion brings
    the two frames together. Where the camera does not turn, focal length and path cannot be
    separated (Triggs et al., 2000, section 9): the standard error is large then, and nothing is
    reported.
    """
    found, camera = measure_focal(pairs, settings, noise), pairs[0].camera
    if found is None:
        return None
    off = np.log([found.fx / camera.fx, found.fy / camera.fy])
    # Beyond the tolerance, the standard error itself is no more than a guess: too much is bent.
    known = found.sigma < settings.tolerance / 2
    sure = np.abs(off) > np.maximum(settings.tolerance, settings.min_sigmas * found.sigma)
    if not np.any(known & sure):
        return None
    # A camera that turns about one axis tells one of the two: pixels keep their given shape.
    off = np.where(known, off, off[np.argmin(found.sigma)])
    fx, fy = np.array([camera.fx, camera.fy]) * np.exp(off)
    observed = _described(camera, fx, fy)
    swapped = np.abs(np.log([fx / camera.fy, fy / camera.fx])).max()
    if known.all() and swapped < min(settings.tolerance, 0.5 * np.abs(off).max()):
        return Finding(
            "intrinsics", observed, "fx and fy look swapped: check the camera file (--camera)",
            refocused(given, camera.fy, camera.fx),
        )  # fmt: skip
    return Finding(
        "intrinsics", observed, "check fx and fy in the camera file (--camera)",
        refocused(given, fx, fy),
    )  # fmt: skip


def _described(camera: Intrinsics, fx: float, fy: float) -> str:
    """Return words for focal lengths that do not fit, with one figure where fx and fy are alike."""
    given, found = (camera.fx, camera.fy), (fx, fy)
    if all(abs(np.log(x / y)) < ALIKE for x, y in (given, found)):
        return (
            f"the focal length of the camera ({np.mean(given):.0f} pixels) does not fit the "
            f"images: about {np.mean(found):.0f} does"
        )
    return (
        f"the focal lengths of the camera (fx {camera.fx:.0f}, fy {camera.fy:.0f} pixels) do not "
        f"fit the images: about fx {fx:.0f}, fy {fy:.0f} do"
    )
