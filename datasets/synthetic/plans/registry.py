"""The families of floor plans by name."""

from __future__ import annotations

import numpy as np

from roomgraph.datasets.synthetic.plans import corridor, house, open_plan, ring, suite
from roomgraph.datasets.synthetic.plans.draft import Planner
from roomgraph.datasets.synthetic.plans.layout import FloorPlan


def _corridor(rng: np.random.Generator, levels: int) -> FloorPlan:
    return corridor.plan_floor(rng)


PLANS: dict[str, Planner] = {
    "corridor": _corridor,
    "ring": ring.plan,
    "suite": suite.plan,
    "open": open_plan.plan,
    "house": house.plan,
}
