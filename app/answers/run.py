"""A finished run, opened from Python."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.answers.queries import fitted_camera
from roomgraph.app.storage.cloud import read_cloud, read_normals
from roomgraph.app.storage.occupancy import read_occupancy
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.graph.routing import Route, find_route
from roomgraph.semantics.graph.visits import PlaceSummary, summarise
from roomgraph.slam.reconstruction.occupancy_grid import OccupancyGrid

if TYPE_CHECKING:
    from roomgraph.app.answers.locating import Locator, Whereabouts


@dataclass(frozen=True, slots=True)
class LabelledPoints:
    """The points of a map.

    Attributes
    ----------
    points_world : (N, 3) float32
        Metres.
    colours : (N, 3) uint8
        Red, green, blue.
    label_ids : (N,) int32
        Of the place that each lies in; ids of the graph's `labels`.
    normals : (N, 3) float32 or None
        Of the surface, unit length.
    """

    points_world: NDArray[np.float32]
    colours: NDArray[np.uint8]
    label_ids: NDArray[np.int32]
    normals: NDArray[np.float32] | None

    def __len__(self) -> int:
        return len(self.points_world)


class Run:
    """The results of a run, read when they are first used.

    Parameters
    ----------
    folder : RunFolder
        The run's folder, which is not changed.

    Examples
    --------
    >>> run = open_run("out")  # doctest: +SKIP
    >>> print(run.graph.places, run.route("office1", "kitchen").length_m)  # doctest: +SKIP
    """

    def __init__(self, folder: RunFolder) -> None:
        self.folder = folder

    def __repr__(self) -> str:
        return f"Run({str(self.folder.root)!r}): {', '.join(self.graph.places) or 'no places'}"

    @cached_property
    def metrics(self) -> dict[str, Any]:
        """The figures of the run, as in ``metrics.json``."""
        return self.folder.read_metrics()

    @cached_property
    def trajectory(self) -> Trajectory:
        """The pose of each tracked frame."""
        return self.folder.read_trajectory()

    @cached_property
    def frames(self) -> list[dict[str, str]]:
        """The rows of ``frames.csv``, by column: one for every input frame."""
        return self.folder.read_frames()

    @cached_property
    def graph(self) -> SemanticGraph:
        """The semantic topological graph."""
        return read_graph_json(self.folder.existing(self.folder.graph_json))

    @cached_property
    def points(self) -> LabelledPoints:
        """The points of the map."""
        path = self.folder.existing(self.folder.map)
        points, colours, label_ids = read_cloud(path)
        return LabelledPoints(points, colours, label_ids, read_normals(path))

    @cached_property
    def occupancy(self) -> OccupancyGrid | None:
        """The occupancy grid; None if the run found no floor."""
        path = self.folder.occupancy
        return read_occupancy(path) if path.exists() else None

    @property
    def places(self) -> tuple[PlaceSummary, ...]:
        """The places, in the order in which they were entered."""
        return summarise(self.graph)

    def route(self, start: str, goal: str) -> Route:
        """Return the shortest route from a place, a label or coordinates to another.

        Raises
        ------
        SemanticsError
            Start or goal is not known, or no way leads from one to the other.
        """
        return find_route(self.graph, start, goal, self.occupancy)

    def locate(
        self, colour: NDArray[np.uint8], depth_m: NDArray[np.float32] | None = None
    ) -> Whereabouts:
        """Return where in the map an image was taken by the run's camera.

        Parameters
        ----------
        colour : (H, W, 3) uint8
            The image, RGB, without distortion.
        depth_m : (H, W) float32, optional
            Its depth, metres, 0 where there is no reading.

        Raises
        ------
        AppError
            The image is no colour image of the camera's aspect ratio.
        """
        camera = fitted_camera(self._locator.camera, colour, "image")
        depth = np.zeros(colour.shape[:2], np.float32) if depth_m is None else depth_m
        return self._locator.locate(Frame(0, 0.0, colour, depth, camera.intrinsics))

    @cached_property
    def _locator(self) -> Locator:
        from roomgraph.app.answers.locating import Locator

        return Locator(self.folder)


def open_run(path: str | Path) -> Run:
    """Open the folder that `roomgraph run` wrote.

    Raises
    ------
    AppError
        There is no finished run.
    """
    folder = RunFolder(Path(path))
    folder.existing(folder.config)
    folder.existing(folder.metrics)
    return Run(folder)
