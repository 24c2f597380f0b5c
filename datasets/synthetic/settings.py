"""Settings of the rendered building."""

from __future__ import annotations

from typing import Literal, get_args

from pydantic import Field

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.settings import Settings

Light = Literal["day", "dusk", "night"]
LIGHTS: tuple[Light, ...] = get_args(Light)


class BuildingSettings(Settings):
    """What is built, how it is lit, walked through and recorded.

    Attributes
    ----------
    seed : int
        Chooses the floor plan, the furniture and every texture.
    light : {"day", "dusk", "night"}
        Sun through the windows, both, or lamps only.
    noise : float
        Scale of the noise of both images; 1 is a Kinect's, 0 is none at all.
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

    @property
    def intrinsics(self) -> Intrinsics:
        """The pinhole camera: 525 px of focal length at a width of 640."""
        focal = 525.0 * self.width / 640.0
        centre = (self.width - 1) / 2, (self.height - 1) / 2
        return Intrinsics(self.width, self.height, focal, focal, *centre)
