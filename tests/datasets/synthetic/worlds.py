"""Worlds that several tests look at: each is built once, for it takes seconds."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.plans.layout import Doorway, FloorPlan, Rectangle, Room
from roomgraph.datasets.synthetic.recorder import Recorder
from roomgraph.datasets.synthetic.renderer import Renderer
from roomgraph.datasets.synthetic.rendering.mesh import Lamp, Material, Surfaces
from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.world import World, make_world

FloatArray = NDArray[np.float64]
SMALL = {"width": 96, "height": 72}
HOUSE = BuildingSettings(seed=1, plan="house", floors=2, people=6, **SMALL)
SUITE = BuildingSettings(seed=3, plan="suite", people=2, hand=True, noise=0, **SMALL)


@lru_cache(maxsize=1)
def house() -> World:
    """A house of two floors, stairs and an elevator, with six people."""
    return make_world(HOUSE)


@lru_cache(maxsize=1)
def suite() -> World:
    """One floor through which somebody carries a camera by hand; two people."""
    return make_world(SUITE)


@lru_cache(maxsize=1)
def suite_renderer() -> Renderer:
    """The suite, lit."""
    world = suite()
    moving = world.animation
    return Renderer(
        world.building, world.settings.intrinsics, moving.bodies, moving.people, moving.lamps
    )


def recorder(monkeypatch, lights=("day",), **changes) -> Recorder:
    """Return a recorder of the suite under other settings, without lighting it once more."""
    world = suite()
    monkeypatch.setattr(
        "roomgraph.datasets.synthetic.recorder.Renderer", lambda *_: suite_renderer()
    )
    settings = world.settings.model_copy(update=changes)
    return Recorder(replace(world, settings=settings), lights)


def turns_deg(T: FloatArray) -> FloatArray:
    """Return the angles (N - 1,) between poses (N, 4, 4) and the next ones, degrees."""
    steps = T[:-1, :3, :3].swapaxes(1, 2) @ T[1:, :3, :3]
    return np.degrees(np.arccos(np.clip((np.trace(steps, axis1=1, axis2=2) - 1) / 2, -1, 1)))


TWO_ROOMS = FloorPlan(
    (Room("a", "office", Rectangle(0, 0, 4, 3)), Room("b", "office", Rectangle(4.14, 0, 8.14, 3))),
    (Doorway(("a", "b"), (4.07, 1.5), "y", 0.9, 2.0, "door", "open"),),
    "house",
)
BOX = Rectangle(0, 0, 6, 5)


def box_room() -> Building:
    """An empty room of 6 x 5 x 2.6 m with a lamp."""
    surfaces = Surfaces(np.random.default_rng(0))
    grey = Material(np.full((8, 8, 3), 150, np.uint8))
    floor, top = (np.column_stack([BOX.polygon, np.full(4, z)]) for z in (0.0, 2.6))
    for i in range(4):
        j = (i + 1) % 4
        surfaces.picture(np.array([top[i], top[j], floor[j], floor[i]]), grey)
    surfaces.picture(floor[::-1], grey)
    surfaces.picture(top, grey)
    plan = FloorPlan((Room("a", "office", BOX),), (), "house")
    lamp = Lamp((3.0, 2.5, 2.5), (0.0, 0.0, -1.0), 2.0, 1)
    return Building(0, plan, surfaces.quads, np.zeros((0, 4)), [lamp])
