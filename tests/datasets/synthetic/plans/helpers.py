"""Floor plans to be tested, drawn once, and the geometry that they are measured with."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.synthetic.plans.layout import Doorway, FloorPlan, Rectangle
from roomgraph.datasets.synthetic.plans.registry import PLANS

FloatArray = NDArray[np.float64]
KINDS = ("ring", "suite", "open", "house")
SEEDS, FLOORS = range(30), (1, 2, 3)
SHAFTS = ("stairwell", "elevator")
AXIS = {"x": 0, "y": 1}


@cache
def plan(kind: str, floors: int, seed: int) -> FloorPlan:
    """Draw a plan as a building of that seed has it."""
    return PLANS[kind](np.random.default_rng((seed, 0)), floors)


def plans(kind: str) -> Iterator[FloorPlan]:
    """Return the plans of a kind, of one to three floors."""
    return (plan(kind, floors, seed) for floors in FLOORS for seed in SEEDS)


def gaps(a: Rectangle, b: Rectangle) -> tuple[float, float]:
    """Return how far two rectangles are apart in x and in y; negative where they overlap."""
    return (
        max(a.x0, b.x0) - min(a.x1, b.x1),
        max(a.y0, b.y0) - min(a.y1, b.y1),
    )


def span(rectangle: Rectangle, along: str) -> tuple[float, float]:
    """Return from where to where a rectangle reaches in a direction."""
    if along == "x":
        return rectangle.x0, rectangle.x1
    return rectangle.y0, rectangle.y1


def opening(door: Doorway) -> tuple[float, float]:
    """Return from where to where an opening reaches along its wall."""
    middle = door.xy[AXIS[door.along]]
    return middle - door.width_m / 2, middle + door.width_m / 2


def depth(p: FloatArray, q: FloatArray) -> float:
    """Return how deep convex polygons (N, 2) reach into each other; negative if they are apart.

    The least depth over the normals of all their sides.
    """
    least = float(np.min(np.minimum(p.max(0) - q.min(0), q.max(0) - p.min(0))))
    if least < 0:  # Apart along an axis.
        return least
    for corners in (p, q):
        side = np.roll(corners, -1, axis=0) - corners
        for normal in np.column_stack([side[:, 1], -side[:, 0]]):
            a, b = p @ normal / np.linalg.norm(normal), q @ normal / np.linalg.norm(normal)
            least = min(least, a.max() - b.min(), b.max() - a.min())
    return float(least)


def inside(polygon: FloatArray, points: FloatArray) -> float:
    """Return how far the outermost of some points (N, 2) is inside a convex polygon's sides."""
    side = np.roll(polygon, -1, axis=0) - polygon
    inwards = np.column_stack([-side[:, 1], side[:, 0]]) / np.linalg.norm(side, axis=1)[:, None]
    return float(np.einsum("kij,kj->ki", points[None] - polygon[:, None], inwards).min())
