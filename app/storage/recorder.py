"""Writes a run's files, as they come and at the end."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.app.storage.cloud import write_cloud
from roomgraph.app.storage.frames import FRAME_COLUMNS, LabelledFrame, unread_row
from roomgraph.app.storage.occupancy import write_occupancy
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.app.storage.thumbnails import ThumbnailWriter
from roomgraph.datasets.files import write_text
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.trajectory import Trajectory, write_tum
from roomgraph.semantics.graph.files import write_graph_json, write_graphml
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import LabelSpace, write_labels
from roomgraph.slam.backend.pose_graph import PoseGraph
from roomgraph.slam.reconstruction.occupancy_grid import OccupancyGrid
from roomgraph.slam.reconstruction.point_map import PointMap
from roomgraph.slam.relocalisation.keyframe_database import (
    KeyframeDatabase,
    write_keyframe_database,
)


class Recorder:
    """Keeps a run's folder up to date, so that an interrupted run loses nothing."""

    def __init__(self, folder: RunFolder) -> None:
        self.folder = folder
        self._file = folder.frames.open("w", newline="", encoding="utf-8")
        self._rows = csv.writer(self._file, lineterminator="\n")
        self._rows.writerow(FRAME_COLUMNS)
        self._thumbnails = ThumbnailWriter(folder.thumbnails)

    def add_frame(self, frame: LabelledFrame) -> None:
        """Write a frame's row with its state so far."""
        self._rows.writerow(frame.row)
        self._file.flush()

    def add_thumbnail(self, frame: Frame) -> None:
        """Keep a small picture of a keyframe."""
        self._thumbnails.add(frame.index, frame.colour)

    def rewrite_frames(
        self, frames: Sequence[LabelledFrame], unread_s: NDArray[np.float64]
    ) -> None:
        """Write all rows again with their final state, and rows of frames never reached."""
        self._file.close()
        text = io.StringIO()
        rows = csv.writer(text, lineterminator="\n")
        rows.writerow(FRAME_COLUMNS)
        rows.writerows(frame.row for frame in frames)
        rows.writerows(unread_row(float(stamp_s)) for stamp_s in unread_s)
        write_text(self.folder.frames, text.getvalue())

    def write_submap(self, number: int, trajectory: Trajectory) -> None:
        """Write the trajectory of a sub-map that never joined the map, in its own frame."""
        write_tum(self.folder.submap(number), trajectory)

    def write_trajectory(self, trajectory: Trajectory) -> None:
        """Write the poses of all tracked frames so far, as estimated now."""
        write_tum(self.folder.trajectory, trajectory)

    def write_pose_graph(self, graph: PoseGraph, stamps_s: Mapping[int, float]) -> None:
        """Write the poses and stamps of keyframes, and the constraints between them."""
        T = np.array([graph[key] for key in stamps_s]).reshape(-1, 4, 4)
        write_tum(self.folder.keyframes, Trajectory(np.array(list(stamps_s.values())), T))
        graph.write_g2o(self.folder.pose_graph, set(stamps_s))

    def write_keyframe_database(self, database: KeyframeDatabase | None) -> None:
        """Write the keyframe database, if there are keyframes."""
        if database is not None:
            write_keyframe_database(self.folder.keyframe_database, database)

    def write_map(
        self, points: PointMap, label_ids: NDArray[np.integer[Any]], labels: LabelSpace
    ) -> None:
        """Write the label space, and the labelled point map if there is one."""
        write_labels(self.folder.labels, labels)
        if len(points):
            write_cloud(
                self.folder.map, points.points_world, points.colours, label_ids, points.normals
            )

    def write_occupancy(self, grid: OccupancyGrid) -> None:
        """Write the occupancy grid."""
        write_occupancy(self.folder.occupancy, grid)

    def write_graph(self, graph: SemanticGraph) -> None:
        """Write the topological graph."""
        write_graph_json(self.folder.graph_json, graph)
        write_graphml(self.folder.graphml, graph)

    def write_metrics(self, metrics: Mapping[str, Any]) -> None:
        """Write the run's metrics."""
        write_text(self.folder.metrics, json.dumps(metrics, indent=1) + "\n")

    def close(self) -> None:
        """Close the open files."""
        self._file.close()
        self._thumbnails.close()
