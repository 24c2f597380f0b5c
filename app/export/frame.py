"""The frame that tools for buildings expect: z up, the floor at 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.export.exporter import Notes
from roomgraph.app.storage.occupancy import read_occupancy
from roomgraph.app.storage.run_folder import RunFolder

# The first camera's axes turned upright, as if it had been held level: x right, y ahead, z up.
_T_LEVEL_WORLD = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


def T_upright_world(folder: RunFolder) -> tuple[NDArray[np.float64], Notes]:
    """Return the transform (4, 4) from the run's world to the map frame, and notes on it."""
    if folder.occupancy.exists():
        return read_occupancy(folder.occupancy).T_map_world, ()
    return _T_LEVEL_WORLD, ("no floor was found: the up direction is that of the first camera",)
