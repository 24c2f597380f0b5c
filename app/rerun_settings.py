"""What of a run is drawn, and how finely."""

from __future__ import annotations

from pydantic import Field

from datasets.settings import Settings


class ViewerSettings(Settings):
    """How much the Rerun recording holds."""

    frame_every_s: float = Field(
        0.2, ge=0, description="a frame is shown every so many seconds of the sequence; "
        "lost and found ones and the last one always",
    )  # fmt: skip
    depth_every_s: float = Field(0.4, ge=0, description="the depth of a frame, likewise")
    jpeg_quality: int = Field(75, ge=10, le=100, description="of the colour images")
    depth_step: int = Field(3, ge=1, le=16, description="every n-th row and column of the depth")
    max_keypoints: int = Field(400, ge=0, description="strongest features drawn a frame")
    picture_spacing_m: float = Field(
        1.5, gt=0, description="between keyframes whose pictures stand in the map"
    )
    picture_turn_deg: float = Field(
        90.0, gt=0, le=180, description="or by how much nearer ones look elsewhere"
    )
    max_points: int = Field(60_000, ge=1000, description="points of a map on the way")
    max_points_total: int = Field(
        1_500_000, ge=0, description="points of all maps on the way, spread over the frames"
    )
    max_points_final: int = Field(300_000, ge=1000, description="points of the last map")
    point_radius_m: float = Field(0.013, gt=0, le=1, description="of the dense map's points")
    headroom_m: float = Field(
        0.7, gt=0, description="points higher than this above the path are hidden: the ceiling"
    )
    port: int = Field(9876, ge=1024, le=65535, description="where the live window listens")
