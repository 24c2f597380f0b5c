"""Settings of the rooms that the floor is cut into."""

from __future__ import annotations

from pydantic import Field

from roomgraph.datasets.settings import Settings


class RegionSettings(Settings):
    """What is taken for a room of its own."""

    door_width_m: float = Field(
        1.3, gt=0, le=5, description="a passage no wider separates rooms, whatever lies behind it"
    )
    narrowing: float = Field(
        0.8, gt=0, le=1, description="a passage separates rooms if it is narrower than this share"
    )
    narrowing_labelled: float = Field(
        0.95, gt=0, le=1, description="the same between places of different labels"
    )
    min_area_m2: float = Field(1.0, ge=0, description="a smaller region is part of its neighbour")
    min_unvisited_m2: float = Field(
        3.0, ge=0, description="the same of a region that the camera never was in"
    )
    lintel_low_m: float = Field(1.8, gt=0, description="height from which a lintel may hang")
    lintel_high_m: float = Field(2.35, gt=0, description="height above which it is the ceiling")
    reach_m: float = Field(
        0.15, ge=0, le=1, description="from the last free cell to the wall behind it, at most"
    )
    gap_m: float = Field(
        0.6, ge=0, le=3, description="unseen stretches up to this wide between seen ones are room"
    )
    detail_m: float = Field(
        0.4, ge=0, le=2, description="narrower bulges of a region are holes in its wall"
    )
    squareness: float = Field(
        0.9, gt=0, le=1, description="a region that fills this share of its rectangle is all of it"
    )
    closet_m: float = Field(
        1.0, ge=0, le=3,
        description="an unseen block whose shorter side is no longer is a cupboard or stall",
    )  # fmt: skip
