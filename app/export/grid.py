"""The occupancy grid for robots."""

from __future__ import annotations

from pathlib import Path

from roomgraph.app.export.exporter import Notes, named, product
from roomgraph.app.storage.occupancy import read_occupancy, write_occupancy
from roomgraph.app.storage.run_folder import RunFolder


def write_nav2(folder: RunFolder, path: Path) -> Notes:
    """Write ``NAME.yaml`` and ``NAME.pgm`` as ROS's map_server reads them."""
    write_occupancy(named(path, ".yaml", ".yml"), read_occupancy(product(folder.occupancy)))
    return ()


def picture_beside(path: Path) -> tuple[Path, ...]:
    """Return the picture that comes with the YAML file."""
    return (path.with_suffix(".pgm"),)
