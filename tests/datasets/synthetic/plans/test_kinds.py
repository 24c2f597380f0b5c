"""Kinds of rooms do not give themselves away by size and shape."""

from __future__ import annotations

import numpy as np
from sklearn.ensemble import RandomForestClassifier

from roomgraph.datasets.synthetic.plans.registry import PLANS
from roomgraph.datasets.synthetic.truth import room_shape, room_size

FAMILIES = ("ring", "suite", "open", "house")
ENCLOSED = {
    "office", "meeting_room", "kitchen", "bathroom", "bedroom", "living_room", "store_room",
    "printer_area", "dining_room", "laboratory",
}  # fmt: skip


def rooms_of(seeds):
    """Return size and shape of rooms (N, 5), and their kinds: a row a room, largest part."""
    features, kinds = [], []
    for family in FAMILIES:
        for seed in seeds:
            plan = PLANS[family](np.random.default_rng((seed, 0)), 1)
            by_name = {}
            for room in plan.rooms:
                by_name.setdefault(room.name, []).append(room)
            for parts in by_name.values():
                largest = max(parts, key=lambda room: room.floor.area)
                r = largest.floor
                short, long = sorted((r.x1 - r.x0, r.y1 - r.y0))
                area = sum(room.floor.area for room in parts)
                features.append((short, long, long / short, area, len(largest.polygon)))
                kinds.append(largest.label)
    return np.array(features), np.array(kinds)


def test_size_and_shape_alone_do_not_tell_the_kind():
    train, kinds = rooms_of(range(60))
    forest = RandomForestClassifier(200, min_samples_leaf=5, random_state=0).fit(train, kinds)
    unseen, truth = rooms_of(range(60, 90))
    assert (forest.predict(unseen) == truth).mean() < 0.45


def test_every_kind_comes_in_several_sizes_and_shapes():
    sizes: dict[str, set[str]] = {kind: set() for kind in ENCLOSED}
    shapes: dict[str, set[str]] = {kind: set() for kind in ENCLOSED}
    for family in FAMILIES:
        for seed in range(60):
            for room in PLANS[family](np.random.default_rng((seed, 0)), 1).rooms:
                if room.label in ENCLOSED:
                    sizes[room.label].add(room_size(room))
                    shapes[room.label].add(room_shape(room))
    assert all(found == {"small", "medium", "large"} for found in sizes.values()), sizes
    assert all(found == {"elongated", "rectangular", "square"} for found in shapes.values()), shapes
