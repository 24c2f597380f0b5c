"""A world to be recorded: a building, the camera's way through it, and all that moves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roomgraph.datasets.synthetic.animation import Animation, animate
from roomgraph.datasets.synthetic.building import Building, build
from roomgraph.datasets.synthetic.motion.hand import Stretch, carry_by_hand
from roomgraph.datasets.synthetic.motion.journey import Journey, travel
from roomgraph.datasets.synthetic.motion.spline import MotionSpline
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.trajectory import Trajectory


@dataclass(frozen=True, slots=True, eq=False)
class World:
    """What is recorded.

    Attributes
    ----------
    settings : BuildingSettings
    building : Building
    journey : Journey
        The whole way; a recording may stop earlier.
    planned : Trajectory
        The way as it was before a hand carried the camera along it.
    stretches : tuple of Stretch
        What the hand did to the camera.
    animation : Animation
    motion : MotionSpline
        The true motion at any time.
    """

    settings: BuildingSettings
    building: Building
    journey: Journey
    planned: Trajectory
    stretches: tuple[Stretch, ...]
    animation: Animation
    motion: MotionSpline

    @property
    def trajectory(self) -> Trajectory:
        """The true poses of the frames that are recorded."""
        count = self.settings.frames or len(self.journey.trajectory)
        whole = self.journey.trajectory
        return Trajectory(whole.stamps_s[:count], whole.T_world_camera[:count])

    def level_of(self, index: int) -> int:
        """Return the level that a frame is nearest to."""
        plan = self.building.plan
        level = round(float(self.journey.floor_m[index]) / plan.storey_m)
        return min(max(level, 0), plan.levels - 1)


def make_world(settings: BuildingSettings) -> World:
    """Build a world. The same settings make the same one; `frames` does not matter."""
    building = build(settings.seed, settings.plan, settings.floors, settings.visit)
    journey = travel(building, settings.model_copy(update={"frames": None}))
    planned = journey.trajectory
    stretches: tuple[Stretch, ...] = ()
    if settings.hand:
        carried = carry_by_hand(planned, np.random.default_rng((settings.seed, 12)))
        journey = replace(journey, trajectory=carried.trajectory)
        stretches = tuple(carried.stretches)
    animation = animate(building, journey, settings.people)
    motion = MotionSpline(journey.trajectory)
    return World(settings, building, journey, planned, stretches, animation, motion)
