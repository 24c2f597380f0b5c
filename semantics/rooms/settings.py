"""Settings of the segmentation into rooms."""

from __future__ import annotations

from pydantic import Field

from roomgraph.datasets.settings import Settings


class RegionSettings(Settings):
    """Which regions of the floor are separate rooms."""

    door_width_m: float = Field(
        default=1.3, gt=0, le=5, description="passages up to this width separate rooms, metres"
    )
    narrowing: float = Field(
        default=0.8,
        gt=0,
        le=1,
        description="wider passages separate rooms if narrower than this share of the rooms' width",
    )
    narrowing_labelled: float = Field(
        default=0.95, gt=0, le=1, description="the same, between places with different labels"
    )
    min_area_m2: float = Field(
        default=1.0, ge=0, description="smaller regions are merged into a neighbour, square metres"
    )
    min_unvisited_m2: float = Field(
        default=3.0, ge=0, description="the same, for regions that the camera was never in"
    )
    lintel_low_m: float = Field(
        default=1.8, gt=0, description="height above which a lintel is searched for, metres"
    )
    lintel_high_m: float = Field(
        default=2.35, gt=0, description="height above which it is the ceiling, metres"
    )
    reach_m: float = Field(
        default=0.15,
        ge=0,
        le=1,
        description="maximum distance from the last free cell to the wall behind it, metres",
    )
    gap_m: float = Field(
        default=0.6,
        ge=0,
        le=3,
        description="unobserved gaps in a room up to this width are filled, metres",
    )
    detail_m: float = Field(
        default=0.4,
        ge=0,
        le=2,
        description="narrower bulges of a region are holes in its wall, metres",
    )
    squareness: float = Field(
        default=0.9,
        gt=0,
        le=1,
        description="a region that fills this share of its bounding rectangle becomes the "
        "rectangle",
    )
    closet_m: float = Field(
        default=1.0, ge=0, le=3,
        description="an unobserved block whose shorter side is at most this is a cupboard or "
        "stall, metres",
    )  # fmt: skip
