"""The true floor plan of a rendered building: ``building.json`` beside its sequence."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.errors import DatasetError

FILE_NAME = "building.json"


@dataclass(frozen=True, slots=True, eq=False)
class RoomTruth:
    """A room: its name (``office2``), kind (``office``), area and outline (N, 2), metres."""

    name: str
    label: str
    area_m2: float
    outline: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FloorPlanTruth:
    """The rooms, and the pairs of them that doorways join."""

    rooms: tuple[RoomTruth, ...]
    doorways: tuple[tuple[str, str], ...]

    @property
    def areas_m2(self) -> dict[str, float]:
        """Areas of the rooms by name, square metres."""
        return {room.name: room.area_m2 for room in self.rooms}


def read_floor_plan(path: Path) -> FloorPlanTruth:
    """Read rooms and doorways of a building.

    Raises
    ------
    DatasetError
        The file is missing or describes no building.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        rooms = tuple(_room(room) for room in content["rooms"])
        pairs = [tuple(str(name) for name in door["rooms"]) for door in content["doorways"]]
        return FloorPlanTruth(rooms, tuple((first, second) for first, second in pairs))
    except (OSError, UnicodeDecodeError, KeyError, TypeError, ValueError) as error:
        raise DatasetError(
            "invalid floor plan", where=path,
            expected="rooms with name, label, area and polygon, doorways with their rooms",
            got=f"{type(error).__name__} {error}",
        ) from error  # fmt: skip


def _room(content: dict[str, Any]) -> RoomTruth:
    outline = np.array(content["polygon"], dtype=np.float64).reshape(-1, 2)
    return RoomTruth(str(content["name"]), str(content["label"]), float(content["area"]), outline)
