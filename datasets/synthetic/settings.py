"""Settings of the rendered building."""

from __future__ import annotations

from typing import Any, Literal, get_args

from pydantic import Field, model_validator

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.settings import Settings

Light = Literal["day", "dusk", "night"]
LIGHTS: tuple[Light, ...] = get_args(Light)
PlanName = Literal["corridor", "ring", "suite", "open", "house"]
SensorName = Literal["kinect", "stereo", "tof", "clean"]
# How high a camera is carried: by a robot, in the hand, under the mirror on a helmet.
ROBOT_HEIGHT_M, HAND_HEIGHT_M, HEAD_HEIGHT_M = 0.8, 1.4, 1.5


class BuildingSettings(Settings):
    """What is built, how it is lit, walked through and recorded.

    Attributes
    ----------
    seed : int
        Chooses the floor plan, the furniture and every texture.
    light : {"day", "dusk", "night"}
        Sun through the windows, both, or lamps only.
    noise : float
        Scale of the noise of both images; 1 is a real camera's, 0 is none at all.
    width, height : int
        Size of the images, pixels. The field of view is a Kinect's across the width.
    step_m : float
        Way between two frames, metres, where the path is straight.
    turn_deg : float
        Largest rotation between two frames, degrees.
    laps : int
        How often the walk is repeated.
    frames : int or None
        Only the first so many frames of the walk.
    rate_hz : float
        Frames a second; sets the time stamps only.
    plan : {"corridor", "ring", "suite", "open", "house"}
        The family of floor plans.
    floors : int
        Number of floors, joined by stairs and an elevator; the corridor plan has one.
    visit : int
        0 is the first visit of the building; at a later one things have changed.
    people : int
        Number of people in the building.
    sensor : {"kinect", "stereo", "tof", "clean"}
        The depth camera: structured light, active stereo, time of flight, or an exact one.
    hand : bool
        A hand-held walk instead of a robot's.
    optics : {"ideal", "real"} or None
        A colour camera without faults, or one with motion blur, rolling shutter, automatic
        exposure and white balance. None: real for hand-held walks, stereo and tof.
    omni : bool
        Also the images of an omnidirectional camera on a helmet.
    imu : bool
        Also the readings of an IMU and of wheels.
    """

    seed: int = Field(default=0, ge=0)
    light: Light = "day"
    noise: float = Field(default=1.0, ge=0, le=5)
    width: int = Field(default=640, ge=32, le=1920)
    height: int = Field(default=480, ge=24, le=1440)
    step_m: float = Field(default=0.08, ge=0.01, le=0.5)
    turn_deg: float = Field(default=4.1, ge=0.2, le=20)
    laps: int = Field(default=1, ge=1, le=10)
    frames: int | None = Field(default=None, ge=1)
    rate_hz: float = Field(default=30.0, gt=0, le=240)
    plan: PlanName = "corridor"
    floors: int = Field(default=1, ge=1, le=4)
    visit: int = Field(default=0, ge=0, le=1000)
    people: int = Field(default=0, ge=0, le=20)
    sensor: SensorName = "kinect"
    hand: bool = False
    optics: Literal["ideal", "real"] | None = None
    omni: bool = False
    imu: bool = False

    @model_validator(mode="before")
    @classmethod
    def _carried(cls, values: Any) -> Any:
        """Walk slower with a camera in the hand, if the step is not given."""
        if isinstance(values, dict) and values.get("hand"):
            return {"step_m": 0.035, "turn_deg": 2.5} | values
        return values

    @model_validator(mode="after")
    def _corridor_is_as_it_was(self) -> BuildingSettings:
        if self.plan == "corridor" and (self.floors > 1 or self.visit > 0):
            raise ValueError(
                "one floor and visit 0 for the corridor plan; for more, --plan ring, suite, open "
                "or house"
            )
        return self

    @property
    def intrinsics(self) -> Intrinsics:
        """The pinhole camera: 525 px of focal length at a width of 640."""
        focal = 525.0 * self.width / 640.0
        centre = (self.width - 1) / 2, (self.height - 1) / 2
        return Intrinsics(self.width, self.height, focal, focal, *centre)

    @property
    def camera_height_m(self) -> float:
        """How high the camera is carried above the floor."""
        if self.omni:
            return HEAD_HEIGHT_M
        return HAND_HEIGHT_M if self.hand else ROBOT_HEIGHT_M

    @property
    def has_real_optics(self) -> bool:
        """Whether the colour camera has the faults of a real one."""
        if self.optics is not None:
            return self.optics == "real"
        return self.hand or self.sensor in ("stereo", "tof")

    @property
    def is_plain(self) -> bool:
        """Whether nothing is asked for but what the first version wrote."""
        return all(getattr(self, name) == type(self).model_fields[name].default for name in ADDED)


# What later versions added: named in ``building.json`` only where it is not the default.
ADDED = (
    "plan", "floors", "visit", "people", "sensor", "hand", "optics", "omni", "imu",
)  # fmt: skip
