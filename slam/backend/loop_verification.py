"""Loop verification: by the size of the correction, and by agreement with other loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from roomgraph.datasets import se3
from roomgraph.datasets.settings import Settings
from roomgraph.slam.backend.alignment import Measured
from roomgraph.slam.backend.pose_graph import Constraint, PoseGraph

FloatArray = NDArray[np.float64]


class LoopVerificationSettings(Settings):
    """Bounds on likely and on possible drift."""

    slack_m: float = Field(
        default=0.1, gt=0, le=100, description="correction that is always accepted, metres"
    )
    slack_deg: float = Field(
        default=3.0, gt=0, le=180, description="correction that is always accepted, degrees"
    )
    drift_share: float = Field(
        default=0.01,
        gt=0,
        le=1,
        description="likely drift, as a share of the path length between the two keyframes",
    )
    drift_deg_per_m: float = Field(
        default=0.2,
        gt=0,
        le=90,
        description="likely rotation drift for each metre of path, degrees",
    )
    doubt: float = Field(
        default=3.0,
        ge=1,
        le=100,
        description="multiple of the likely drift that is still possible if other loops confirm it",
    )
    confirmations: int = Field(
        default=2,
        ge=0,
        le=20,
        description="number of other keyframes that must ask for the same correction",
    )
    join_way_m: float = Field(
        default=1.0,
        ge=0,
        le=100,
        description="distance over which loops must agree before they join two sub-maps, metres",
    )
    join_turn_deg: float = Field(
        default=60.0,
        ge=0,
        le=180,
        description="or minimum turn of both sub-maps' cameras, so that they see different "
        "things, degrees",
    )
    patience: int = Field(
        default=30, ge=1, description="number of keyframes for which a loop waits for confirmation"
    )


class LoopVerifier:
    """Accepts likely loops, and holds possible ones until others agree with them.

    Look-alike places (the doors of a corridor, its two ends) match well but lie elsewhere: the
    correction that they ask for is larger than the way in between can have caused. A correction
    within the likely drift along the shortest way of constraints passes at once; a larger one waits
    for loops of other keyframes that form a consistent cycle with it; one beyond the possible
    drift is dropped. A loop between two sub-maps always waits, and needs agreement over some way,
    or over a turn that shows other things.
    """

    def __init__(self, settings: LoopVerificationSettings) -> None:
        self.settings = settings
        self.held: list[Measured] = []

    def admit(self, measured: Measured, graph: PoseGraph, view_deg: float = 0.0) -> list[Measured]:
        """Return the loops to accept: this one and the held ones that it confirms, or none.

        `view_deg` is the camera's field of view across: turned as far, it sees nothing of what it
        saw.
        """
        constraint = measured.constraint
        joins = graph.component_of(constraint.first) != graph.component_of(constraint.second)
        if not joins:
            if self._can_be_drift(constraint, graph, 1.0):
                return [measured]
            if not self._can_be_drift(constraint, graph, self.settings.doubt):
                return []
        oldest = constraint.second - self.settings.patience
        self.held = [
            m for m in self.held if m.constraint.second >= oldest and _holds(m.constraint, graph)
        ]
        agreeing = [m for m in self.held if self._agree(m.constraint, constraint, graph)]
        self.held.append(measured)
        if (
            len({m.constraint.second for m in agreeing} - {constraint.second})
            < self.settings.confirmations
        ):
            return []
        taken = [*agreeing, measured]
        if joins and not self._is_wide(taken, graph, view_deg):
            return []
        self.held = [m for m in self.held if not any(m is t for t in taken)]
        return taken

    def _is_wide(self, agreeing: list[Measured], graph: PoseGraph, view_deg: float) -> bool:
        """Whether loops are based on more than one similar-looking object.

        Successive keyframes that see the same poster agree with each other, but are no witnesses of
        one another: the camera must have moved on, or have turned to something else, and have met
        several keyframes.
        """
        met = sorted({m.constraint.first for m in agreeing})
        if len(met) < 2:
            return False
        seconds = np.array([graph[m.constraint.second] for m in agreeing])
        centres = seconds[:, :3, 3]
        if np.linalg.norm(centres[:, None] - centres, axis=-1).max() >= self.settings.join_way_m:
            return True
        # What was met must have turned along: else it is one thing, seen at either edge.
        turn = min(_turn_deg(seconds), _turn_deg(np.array([graph[k] for k in met])))
        return turn >= max(self.settings.join_turn_deg, view_deg)

    def _can_be_drift(self, constraint: Constraint, graph: PoseGraph, times: float) -> bool:
        """Whether drift along the shortest path of constraints can explain the correction."""
        believed = se3.inverse(graph[constraint.first]) @ graph[constraint.second]
        metres, degrees = _size(se3.inverse(believed) @ constraint.T_first_second)
        s = self.settings
        way = max(
            (metres / times - s.slack_m) / s.drift_share,
            (degrees / times - s.slack_deg) / s.drift_deg_per_m,
        )
        return way <= 0 or not np.isfinite(
            graph.path_length(constraint.first, constraint.second, way)
        )

    def _agree(self, one: Constraint, other: Constraint, graph: PoseGraph) -> bool:
        """Whether two loops ask for the same correction: the cycle through both must close."""
        for end, end_too in ((one.first, other.first), (one.second, other.second)):
            if graph.component_of(end) != graph.component_of(end_too):
                return False
        T_firsts = se3.inverse(graph[other.first]) @ graph[one.first]
        T_seconds = se3.inverse(graph[one.second]) @ graph[other.second]
        cycle = T_firsts @ one.T_first_second @ T_seconds @ se3.inverse(other.T_first_second)
        way = float(np.linalg.norm(T_firsts[:3, 3]) + np.linalg.norm(T_seconds[:3, 3]))
        metres, degrees = _size(cycle)
        s = self.settings
        return (
            metres <= s.slack_m + s.drift_share * way
            and degrees <= s.slack_deg + s.drift_deg_per_m * way
        )


def _size(motion: FloatArray) -> tuple[float, float]:
    """Return the translation (metres) and rotation (degrees) of a motion."""
    metres = float(np.linalg.norm(motion[:3, 3]))
    return metres, float(np.degrees(se3.rotation_angle(motion)))


def _turn_deg(T_world_camera: FloatArray) -> float:
    """Return the largest angle between the optical axes of cameras (N, 4, 4), degrees."""
    axes = T_world_camera[:, :3, 2]
    return float(np.degrees(np.arccos(np.clip(axes @ axes.T, -1.0, 1.0).min())))


def _holds(constraint: Constraint, graph: PoseGraph) -> bool:
    return constraint.first in graph and constraint.second in graph
