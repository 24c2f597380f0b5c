"""The corridor walk is what the first version rendered, for the same seed and settings."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from roomgraph.datasets.synthetic.settings import BuildingSettings
from roomgraph.datasets.synthetic.writer import write_sequences

pytestmark = pytest.mark.slow

# Written by version 0.1.0: digests of the text files, and small copies of some images.
FIRST = json.loads((Path(__file__).parents[2] / "fixtures/corridor_seed11.json").read_text())
SETTINGS = BuildingSettings(seed=11, width=160, height=120, step_m=0.4, turn_deg=15)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    root = tmp_path_factory.mktemp("corridor")
    directories = {light: root / light for light in FIRST}
    write_sequences(directories, SETTINGS)
    return directories


@pytest.mark.parametrize("light", list(FIRST))
def test_its_text_files_have_the_same_bytes(folders, light):
    for name, digest in FIRST[light]["md5"].items():
        assert hashlib.md5((folders[light] / name).read_bytes()).hexdigest() == digest, name


@pytest.mark.parametrize("light", list(FIRST))
def test_it_has_no_other_files(folders, light):
    names = {path.name for path in folders[light].iterdir()}
    assert names == {"rgb", "depth", "depth.txt", *FIRST[light]["md5"]}
    assert len(list((folders[light] / "rgb").iterdir())) == FIRST[light]["frames"]


@pytest.mark.parametrize("light", list(FIRST))
def test_its_images_are_the_same(folders, light):
    """Compared as small copies: encoders of other machines may round differently."""
    for stamp, view in FIRST[light]["views"].items():
        colour = cv2.imread(str(folders[light] / "rgb" / f"{stamp}.jpg"))
        depth = cv2.imread(str(folders[light] / "depth" / f"{stamp}.png"), cv2.IMREAD_UNCHANGED)
        for image, told, within in ((colour, "colour", 1), (depth, "depth", 20)):
            small = cv2.resize(image.astype(np.float32), (6, 4), interpolation=cv2.INTER_AREA)
            assert np.abs(small.ravel() - view[told]).max() <= within, (stamp, told)
