"""Finding the place of a mapped building in which an image was taken."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.app.settings import load_settings
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.datasets import se3
from roomgraph.datasets.camera import Camera
from roomgraph.datasets.frame import Frame
from roomgraph.semantics.graph.files import read_graph_json
from roomgraph.semantics.graph.graph import GraphNode, SemanticGraph
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.slam.features.extraction import FeatureExtractor
from roomgraph.slam.features.view import View
from roomgraph.slam.frontend.tracker import Tracker
from roomgraph.slam.relocalisation.keyframe_database import read_keyframe_database
from roomgraph.slam.relocalisation.relocaliser import (
    Relocaliser,
    RelocaliserSettings,
    Relocation,
    Resemblance,
)

# By looks alone, a place is named only if it has more than this share of what looks alike.
_MAJORITY = 0.5
# Of a run's settings: those that its keyframes were made with, and images are compared with.
_NEEDED = (
    "seed", "slam.max_depth_m", "slam.features", "slam.noise", "slam.motion", "slam.tracker",
    "slam.word_index",
)  # fmt: skip
# Poses this near to each other are one answer.
_SAME_POSE_M = 0.5


@dataclass(frozen=True, slots=True)
class Whereabouts:
    """The answer for one image.

    Attributes
    ----------
    place, label : str
        ``office2``, ``office``; ``unknown`` where nothing was recognised.
    node : int or None
        The nearest node of the graph.
    sureness : float
        0 to 1. With a pose: the matches that agree with it, of these and those that agree with
        another pose (at least as many as would count). Without: the share of the place among the
        keyframes that look alike.
    inliers : int
        Matches that agree with the pose; 0 without one.
    T_world_camera : (4, 4) float64 or None
        The pose in the run's world.
    """

    place: str = UNKNOWN
    label: str = UNKNOWN
    node: int | None = None
    sureness: float = 0.0
    inliers: int = 0
    T_world_camera: NDArray[np.float64] | None = None


class Locator:
    """Locates images in one run; its database is loaded once.

    Raises
    ------
    RoomgraphError
        The folder is no finished run's.
    """

    def __init__(self, folder: RunFolder) -> None:
        settings = load_settings(folder.existing(folder.config), only=_NEEDED)
        slam = settings.slam
        self.graph = read_graph_json(folder.existing(folder.graph_json))
        self._database = read_keyframe_database(folder.existing(folder.keyframe_database))
        self._extractor = FeatureExtractor(slam.features)
        self._max_depth_m = slam.max_depth_m
        self._relocation = RelocaliserSettings()
        tracker = Tracker(slam.tracker, slam.motion, slam.noise, settings.seed)
        self._relocaliser = Relocaliser(self._database, tracker, self._relocation, slam.word_index)

    @property
    def camera(self) -> Camera:
        """The camera of the run, depth in millimetres."""
        return Camera(self._database.intrinsics, 1000.0, "the run")

    def locate(self, frame: Frame) -> Whereabouts:
        """Return where a frame was taken; without depth readings, its colours alone are used."""
        found = self._relocaliser.locate(View(frame, self._extractor, self._max_depth_m))
        if not self.graph.nodes or found.best is None:
            return Whereabouts()
        if found.T_world_camera is None:
            return self._by_looks(found)
        T = found.T_world_camera
        node = self._nearest(T[:3, 3])
        place, label = self._place_at(T[:3, 3]) or (node.place, node.label)
        sureness = _sureness(found, self._relocation.min_inliers)
        return Whereabouts(
            place=place,
            label=label,
            node=node.id,
            sureness=sureness,
            inliers=found.best.inliers,
            T_world_camera=T,
        )

    def _by_looks(self, found: Relocation) -> Whereabouts:
        """Return the place of most of the similar keyframes."""
        weights: defaultdict[str, float] = defaultdict(float)
        nodes: dict[str, GraphNode] = {}
        for resemblance in found.resemblances:
            node = self._nearest(resemblance.keyframe.T_world_keyframe[:3, 3])
            weights[node.place] += resemblance.likeness
            nodes.setdefault(node.place, node)
        place = max(weights, key=lambda name: weights[name])
        share = weights[place] / max(sum(weights.values()), 1e-9)
        if share <= _MAJORITY:
            return Whereabouts(sureness=share)
        node = nodes[place]
        return Whereabouts(place=place, label=node.label, node=node.id, sureness=share)

    def _nearest(self, position_world: NDArray[np.float64]) -> GraphNode:
        distances = np.linalg.norm(self.graph.positions - position_world, axis=1)
        return self.graph.nodes[int(distances.argmin())]

    def _place_at(self, position_world: NDArray[np.float64]) -> tuple[str, str] | None:
        """Return the place that contains a position, with its label; None outside all places."""
        if self.graph.T_map_world is None:
            return None
        x, y, _ = se3.transform(self.graph.T_map_world, position_world[None])[0]
        for room in self.graph.rooms:
            outline = room.polygon_map.astype(np.float32)
            if cv2.pointPolygonTest(outline, (float(x), float(y)), False) >= 0:
                return room.name, room.label
        return None


def _sureness(found: Relocation, min_inliers: int) -> float:
    best = found.resemblances[0]
    others = [r.inliers for r in found.resemblances[1:] if _elsewhere(best, r)]
    return best.inliers / (best.inliers + max([min_inliers, *others]))


def _elsewhere(best: Resemblance, other: Resemblance) -> bool:
    if best.T_world_camera is None or other.T_world_camera is None:
        return False
    gap = best.T_world_camera[:3, 3] - other.T_world_camera[:3, 3]
    return bool(np.linalg.norm(gap) > _SAME_POSE_M)


def position_map(graph: SemanticGraph, where: Whereabouts) -> tuple[float, float, float] | None:
    """Return the camera's x, y (metres) and heading (degrees from x to y) in the map frame."""
    if graph.T_map_world is None or where.T_world_camera is None:
        return None
    T = graph.T_map_world @ where.T_world_camera
    heading = float(np.degrees(np.arctan2(T[1, 2], T[0, 2])))
    return float(T[0, 3]), float(T[1, 3]), heading
