"""The depth sensors by name."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from roomgraph.datasets.synthetic.cameras.clean import Clean
from roomgraph.datasets.synthetic.cameras.depth_sensor import DepthSensor
from roomgraph.datasets.synthetic.cameras.stereo import ActiveStereo
from roomgraph.datasets.synthetic.cameras.structured_light import StructuredLight
from roomgraph.datasets.synthetic.cameras.tof import TimeOfFlight

SENSORS: Mapping[str, DepthSensor] = MappingProxyType(
    {
        "kinect": StructuredLight(),
        "stereo": ActiveStereo(),
        "tof": TimeOfFlight(),
        "clean": Clean(),
    }
)


def sensor(name: str) -> DepthSensor:
    """Return the depth sensor of a name.

    Raises
    ------
    ValueError
        There is none of this name.
    """
    if name not in SENSORS:
        raise ValueError(f"no depth sensor {name!r}; there are {', '.join(SENSORS)}")
    return SENSORS[name]
