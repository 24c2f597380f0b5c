"""A Kinect's depth sensor: a pattern of light, seen from the side."""

from __future__ import annotations

from roomgraph.datasets.camera import DepthCamera, Intrinsics
from roomgraph.datasets.synthetic.cameras import kinect
from roomgraph.datasets.synthetic.cameras.depth_sensor import Float32Array, Sighted


class StructuredLight:
    """A Kinect; its driver puts the depth on the colour image."""

    def camera(self, colour: Intrinsics) -> DepthCamera | None:
        """Return None: the depth lies on the colour image."""
        return None

    def measure(self, view: Sighted, noise: float, normal: Float32Array) -> Float32Array:
        """Return what `kinect.measure` gives; see `DepthSensor.measure`."""
        return kinect.measure(view.z, view.grazing, view.blind, noise, normal)
