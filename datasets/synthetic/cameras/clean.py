"""A depth sensor without faults, for comparison."""

from __future__ import annotations

from roomgraph.datasets.camera import DepthCamera, Intrinsics
from roomgraph.datasets.synthetic.cameras.depth_sensor import Float32Array, Sighted, in_range

MIN_DEPTH_M, MAX_DEPTH_M = 0.3, 10.0


class Clean:
    """Exact depth on the colour image, within the range."""

    def camera(self, colour: Intrinsics) -> DepthCamera | None:
        """Return None: the depth lies on the colour image."""
        return None

    def measure(self, view: Sighted, noise: float, normal: Float32Array) -> Float32Array:
        """Return the exact depth; see `DepthSensor.measure`."""
        return in_range(view.z, MIN_DEPTH_M, MAX_DEPTH_M)
