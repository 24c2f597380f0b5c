"""Calibration corrections: cameras with which depth, colour and motion agree."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roomgraph.datasets.camera import Camera, DepthCamera
from roomgraph.slam.checks.finding import CameraCorrection
from roomgraph.slam.checks.registration import Alignment


def registered(camera: Camera, alignment: Alignment) -> CameraCorrection | None:
    """Return the correction that registers depth to colour by an alignment of their images.

    As if a camera of another focal length had taken it from the same point: what that is off by
    (a Kinect's 25 mm) is right at the distance at which most outlines lie. None where the depth's
    camera is known already.
    """
    if camera.depth is not None:
        return None
    colour, scale = camera.intrinsics, alignment.scale
    middle = np.array([colour.width - 1, colour.height - 1]) / 2
    shift = np.array([alignment.dx - colour.cx, alignment.dy - colour.cy])
    centre = middle - (middle + shift) / scale
    own = replace(
        colour, fx=colour.fx / scale, fy=colour.fy / scale, cx=float(centre[0]),
        cy=float(centre[1]), distortion=(),
    )  # fmt: skip
    return CameraCorrection(
        replace(camera, depth=DepthCamera(own, np.eye(4)), origin=_corrected(camera)),
        "the depth images are aligned by that; aligning them when recording would be more accurate",
    )


def refocused(camera: Camera, fx: float, fy: float) -> CameraCorrection:
    """Return the correction to other focal lengths; depth keeps its pixels."""
    colour, depth = camera.intrinsics, camera.depth
    if depth is not None and np.array_equal(depth.T_colour_depth, np.eye(4)):
        own = depth.intrinsics
        own = replace(own, fx=own.fx * fx / colour.fx, fy=own.fy * fy / colour.fy)
        depth = replace(depth, intrinsics=own)
    other = replace(
        camera, intrinsics=replace(colour, fx=fx, fy=fy), depth=depth, origin=_corrected(camera)
    )
    return CameraCorrection(
        other, f"fx {fx:.0f}, fy {fy:.0f} are used instead; calibrate the camera to be sure"
    )


def _corrected(camera: Camera) -> str:
    suffix = ", corrected from the images"
    return camera.origin.removesuffix(suffix) + suffix
