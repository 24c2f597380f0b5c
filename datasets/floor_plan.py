"""The true floor plan of a rendered building: ``building.json`` beside its sequence."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from datasets.errors import DatasetError

FILE_NAME = "building.json"


@dataclass(frozen=True, slots=True)
class FloorPlanTruth:
    """True areas of the rooms, square metres, and the pairs of rooms that doorways join."""

    areas_m2: dict[str, float]
    doorways: tuple[tuple[str, str], ...]


def read_floor_plan(path: Path) -> FloorPlanTruth:
    """Read rooms and doorways of a building.

    Raises
    ------
    DatasetError
        The file is missing or describes no building.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        areas = {str(room["name"]): float(room["area"]) for room in content["rooms"]}
        pairs = [tuple(str(name) for name in door["rooms"]) for door in content["doorways"]]
        return FloorPlanTruth(areas, tuple((first, second) for first, second in pairs))
    except (OSError, UnicodeDecodeError, KeyError, TypeError, ValueError) as error:
        raise DatasetError(
            "floor plan not understood", where=path,
            expected="rooms with name and area, doorways with their rooms",
            got=f"{type(error).__name__} {error}",
        ) from error  # fmt: skip
