"""The rendered building: a procedural office floor, its camera walk and its ground truth."""

from datasets.building.building import Building, build
from datasets.building.settings import LIGHTS, BuildingSettings, Light
from datasets.building.synth import write_sequence, write_sequences
from datasets.building.walk import walk

__all__ = [
    "LIGHTS",
    "Building",
    "BuildingSettings",
    "Light",
    "build",
    "walk",
    "write_sequence",
    "write_sequences",
]
