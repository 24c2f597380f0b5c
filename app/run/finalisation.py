"""What comes of a run once its last frame is tracked: way, rooms, cloud, and their files."""

from __future__ import annotations

import logging
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.clock import StageClock
from roomgraph.app.run.frame_history import Journal
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.recorder import Recorder
from roomgraph.app.viewer.viewer import MapView, Viewer
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.graph.topology import TopologicalMap
from roomgraph.semantics.rooms.polygons import with_extents
from roomgraph.slam.reconstruction.floor_analysis import Survey, survey
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.relocalisation.keyframe_database import remember
from roomgraph.slam.slam import Slam

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Products:
    """What was made of a run.

    Attributes
    ----------
    trajectory : Trajectory
        Of the frames with a place in the world.
    graph : SemanticGraph
        With extents and doorways, where there is a floor.
    points : PointMap
        The cloud.
    warnings : tuple of str
        What could not be made as it should be.
    """

    trajectory: Trajectory
    graph: SemanticGraph
    points: PointMap
    warnings: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ProductMaker:
    """Makes the products of what both layers found, writes and shows them.

    Attributes
    ----------
    stamps_s : (N,) float64
        Of all frames of the sequence, seconds.
    slam, topology, journal : Slam, TopologicalMap, Journal
        What the run found.
    settings : AppSettings
        Of both layers.
    recorder, viewer : Recorder, Viewer
        Write and show it.
    clock : StageClock
        Times it.
    """

    stamps_s: NDArray[np.float64]
    slam: Slam
    topology: TopologicalMap
    journal: Journal
    settings: AppSettings
    recorder: Recorder
    viewer: Viewer
    clock: StageClock

    def make(self) -> Products:
        """Make, write and show everything, the cloud in a thread of its own; end the viewer."""
        self._settle()
        trajectory = self.journal.trajectory()
        with ThreadPoolExecutor(1, thread_name_prefix="cloud") as pool:
            fused = pool.submit(self._fuse)
            with self.clock.stage("write"):
                self._write_way(trajectory)
            surveyed = self._survey()
            graph = self._graph(surveyed)
            self.journal.settle_labels(graph)
            with self.clock.stage("write graph"):
                self._write_frames()
                self._write_graph(graph, surveyed)
            points = fused.result()
            view = self.journal.map_view(points, graph)
            written = pool.submit(self._write_map, view)
            self._show(view, graph)
            written.result()
        warnings = () if surveyed is None else surveyed.warnings
        return Products(trajectory, graph, points, warnings)

    def _settle(self) -> None:
        """Write down where frames turned out to be."""
        apart = self.journal.settle()
        self.topology.keep(self.slam.placed_poses)
        self._write_frames()
        for number, way in enumerate(apart, 1):
            self.recorder.write_submap(number, way)

    def _fuse(self) -> PointMap:
        with self.clock.stage("map"):
            return self.slam.build_map()

    def _survey(self) -> Survey | None:
        """Find the floor and the free space of the finished map."""
        settings = self.settings.slam
        with self.clock.stage("survey"):
            found = survey(
                self.slam.keyframes, self.slam.placed_poses, settings.ground, settings.space,
                settings.noise,
            )  # fmt: skip
        for warning in () if found is None else found.warnings:
            logger.warning("%s", warning)
        return found

    def _graph(self, surveyed: Survey | None) -> SemanticGraph:
        """Return the graph with the places' extents and the doorways between them."""
        with self.clock.stage("extents"):
            graph = self.topology.snapshot(self.slam.keyframe_poses)
            if surveyed is None:
                return graph
            votes = self.journal.votes(surveyed.keyframes)
            return with_extents(graph, surveyed, votes, self.settings.semantics.extents)

    def _show(self, view: MapView, graph: SemanticGraph) -> None:
        with self.clock.stage("view"):
            last = max(0, len(self.journal.labels) - 1)
            self.viewer.show_map(last, lambda: view)
            self.viewer.show_graph(last, graph)
        with self.clock.stage("close"):
            self.viewer.close()

    def _write_frames(self) -> None:
        """Write what is known now of each frame, and which the run did not get to."""
        labels = self.journal.labels
        self.recorder.rewrite_frames(labels, self.stamps_s[len(labels) :])

    def _write_way(self, trajectory: Trajectory) -> None:
        """Write where the camera was, and what its keyframes saw."""
        placed = self.slam.placed_poses
        keyframes = [k for k in self.slam.keyframes.values() if k.id in placed]
        self.recorder.write_trajectory(trajectory)
        if keyframes:
            stamps_s = {k.id: k.stamp_s for k in keyframes}
            self.recorder.write_pose_graph(self.slam.mapper.graph, stamps_s)
        self.recorder.write_memory(remember(keyframes, placed))

    def _write_graph(self, graph: SemanticGraph, surveyed: Survey | None) -> None:
        self.recorder.write_graph(graph)
        if surveyed is not None:
            self.recorder.write_occupancy(surveyed.grid)

    def _write_map(self, view: MapView) -> None:
        with self.clock.stage("write map"):
            self.recorder.write_map(view.points, view.label_ids, self.topology.labels)
