"""The occupancy grid for robots."""

from __future__ import annotations

from pathlib import Path

from app.exports.exporter import Notes, named, product
from app.occupancy_io import read_occupancy, write_occupancy
from app.run_folder import RunFolder


def write_nav2(folder: RunFolder, path: Path) -> Notes:
    """Write ``NAME.yaml`` and ``NAME.pgm`` as ROS's map_server reads them."""
    write_occupancy(named(path, ".yaml", ".yml"), read_occupancy(product(folder.occupancy)))
    return ()


def picture_beside(path: Path) -> tuple[Path, ...]:
    """Return the picture that comes with the YAML file."""
    return (path.with_suffix(".pgm"),)
