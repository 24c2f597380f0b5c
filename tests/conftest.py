"""What many tests share: random motions and a small recorded room."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from roomgraph.datasets import se3
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.synthetic.settings import BuildingSettings


def pytest_collection_modifyitems(items):
    """What looks at a rendered walk, or at a run of one, takes seconds."""
    for item in items:
        if "rendered_walk" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.slow)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture
def random_poses(rng):
    """Twenty rigid motions with rotations of any size."""
    R = Rotation.random(20, rng=rng).as_matrix()
    return np.array([se3.pose(R[i], t) for i, t in enumerate(rng.normal(size=(20, 3)))])


@pytest.fixture(scope="session")
def rendered_walk(tmp_path_factory) -> Path:
    """A short walk through a rendered building, in TUM layout: 60 frames of 320 x 240."""
    from roomgraph.datasets.synthetic.writer import write_sequences

    root = tmp_path_factory.mktemp("rendered") / "walk"
    settings = BuildingSettings(seed=3, width=320, height=240, frames=60)
    write_sequences({"day": root}, settings)
    return root


@pytest.fixture
def rendered_sequence(rendered_walk):
    return open_sequence(rendered_walk)
