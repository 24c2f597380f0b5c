"""Finalisation of a run after its last frame: trajectory, rooms, point map, and their files."""

from __future__ import annotations

import logging
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.clock import StageClock
from roomgraph.app.run.frame_history import FrameHistory
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.recorder import Recorder
from roomgraph.app.viewer.viewer import MapView, Viewer
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.graph.topology import TopologicalMap
from roomgraph.semantics.rooms.polygons import with_rooms
from roomgraph.slam.reconstruction.floor_analysis import FloorAnalysis, analyse_floor
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.relocalisation.keyframe_database import database_of
from roomgraph.slam.slam import Slam

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Products:
    """The outputs of a run.

    Attributes
    ----------
    trajectory : Trajectory
        Of the frames with a place in the world.
    graph : SemanticGraph
        With rooms and doorways, where there is a floor.
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
class Finalisation:
    """Makes, writes and shows the outputs of a run.

    Attributes
    ----------
    stamps_s : (N,) float64
        Of all frames of the sequence, seconds.
    slam, topology, history : Slam, TopologicalMap, FrameHistory
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
    history: FrameHistory
    settings: AppSettings
    recorder: Recorder
    viewer: Viewer
    clock: StageClock

    def make(self) -> Products:
        """Make, write and show all outputs, the point map in its own thread; close the viewer."""
        self._settle()
        trajectory = self.history.trajectory()
        with ThreadPoolExecutor(1, thread_name_prefix="cloud") as pool:
            fused = pool.submit(self._fuse)
            with self.clock.stage("write"):
                self._write_way(trajectory)
            floor = self._analyse_floor()
            graph = self._graph(floor)
            self.history.settle_labels(graph)
            with self.clock.stage("write graph"):
                self._write_frames()
                self._write_graph(graph, floor)
            points = fused.result()
            view = self.history.map_view(points, graph)
            written = pool.submit(self._write_map, view)
            self._show(view, graph)
            written.result()
        warnings = () if floor is None else floor.warnings
        return Products(trajectory, graph, points, warnings)

    def _settle(self) -> None:
        """Write the final poses of the frames."""
        apart = self.history.settle()
        self.topology.keep(self.slam.placed_poses)
        self._write_frames()
        for number, way in enumerate(apart, 1):
            self.recorder.write_submap(number, way)

    def _fuse(self) -> PointMap:
        with self.clock.stage("map"):
            return self.slam.build_map()

    def _analyse_floor(self) -> FloorAnalysis | None:
        """Find the floor and the free space of the finished map."""
        settings = self.settings.slam
        with self.clock.stage("floor"):
            found = analyse_floor(
                self.slam.keyframes, self.slam.placed_poses, settings.floor_plane,
                settings.occupancy_volume, settings.noise,
            )  # fmt: skip
        for warning in () if found is None else found.warnings:
            logger.warning("%s", warning)
        return found

    def _graph(self, floor: FloorAnalysis | None) -> SemanticGraph:
        """Return the graph with the rooms of its places and the doorways between them."""
        with self.clock.stage("rooms"):
            graph = self.topology.snapshot(self.slam.keyframe_poses)
            if floor is None:
                return graph
            votes = self.history.votes(floor.keyframes)
            return with_rooms(graph, floor, votes, self.settings.semantics.rooms)

    def _show(self, view: MapView, graph: SemanticGraph) -> None:
        with self.clock.stage("view"):
            last = max(0, len(self.history.frames) - 1)
            self.viewer.show_map(last, lambda: view)
            self.viewer.show_graph(last, graph)
        with self.clock.stage("close"):
            self.viewer.close()

    def _write_frames(self) -> None:
        """Write the final state of each frame, and the frames that the run did not reach."""
        frames = self.history.frames
        self.recorder.rewrite_frames(frames, self.stamps_s[len(frames) :])

    def _write_way(self, trajectory: Trajectory) -> None:
        """Write the trajectory and the keyframe database."""
        placed = self.slam.placed_poses
        keyframes = [k for k in self.slam.keyframes.values() if k.id in placed]
        self.recorder.write_trajectory(trajectory)
        if keyframes:
            stamps_s = {k.id: k.stamp_s for k in keyframes}
            self.recorder.write_pose_graph(self.slam.pose_graph, stamps_s)
        self.recorder.write_keyframe_database(database_of(keyframes, placed))

    def _write_graph(self, graph: SemanticGraph, floor: FloorAnalysis | None) -> None:
        self.recorder.write_graph(graph)
        if floor is not None:
            self.recorder.write_occupancy(floor.grid)

    def _write_map(self, view: MapView) -> None:
        with self.clock.stage("write map"):
            self.recorder.write_map(view.points, view.label_ids, self.topology.labels)
