"""Occupancy grids on disk, as ROS's map_server and Nav2 read them: a picture and its YAML."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import yaml

from roomgraph.app.errors import AppError
from roomgraph.datasets.files import replacing, write_text
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid

# Grey values of the "trinary" mode. 205 is unknown for every reader at a free threshold of 0.196.
_GREYS = {FREE: 254, OCCUPIED: 0, UNKNOWN: 205}


def write_occupancy(path: Path, grid: OccupancyGrid) -> None:
    """Write ``NAME.yaml`` and, beside it, ``NAME.pgm`` with the highest y at the top.

    The key ``T_map_world`` is ours; map_server passes over it.
    """
    image = np.full(grid.cells.shape, _GREYS[UNKNOWN], dtype=np.uint8)
    for state in (FREE, OCCUPIED):
        image[grid.cells == state] = _GREYS[state]
    picture = path.with_suffix(".pgm")
    with replacing(picture) as temporary:
        if not cv2.imwrite(str(temporary), np.ascontiguousarray(image[::-1])):
            raise AppError("grid cannot be written", where=picture)
    x, y = (round(float(value), 6) for value in grid.origin_xy)
    content = {
        "image": picture.name, "mode": "trinary", "resolution": float(grid.cell_m),
        "origin": [x, y, 0.0], "negate": 0, "occupied_thresh": 0.65, "free_thresh": 0.196,
        "T_map_world": grid.T_map_world.round(9).tolist(),
    }  # fmt: skip
    write_text(path, yaml.safe_dump(content, sort_keys=False, default_flow_style=None))


def read_occupancy(path: Path) -> OccupancyGrid:
    """Read what `write_occupancy` wrote.

    Raises
    ------
    AppError
        The file or its picture is missing, or is not such a grid.
    """
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
        picture = path.parent / str(content["image"])
        image = cv2.imread(str(picture), cv2.IMREAD_GRAYSCALE)
        if image is None:
            raise ValueError(f"no picture {picture.name}")
        cells = np.full(image.shape, UNKNOWN, dtype=np.int8)
        for state in (FREE, OCCUPIED):
            cells[image[::-1] == _GREYS[state]] = state
        return OccupancyGrid(
            cells, float(content["resolution"]),
            np.array(content["origin"][:2], dtype=np.float64),
            np.array(content["T_map_world"], dtype=np.float64).reshape(4, 4),
        )  # fmt: skip
    except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError) as error:
        raise AppError(
            "invalid occupancy grid", where=path, expected="map.yaml with its map.pgm",
            got=f"{type(error).__name__} {error}",
            hint="create one with: roomgraph run SEQUENCE -o DIR",
        ) from error  # fmt: skip
