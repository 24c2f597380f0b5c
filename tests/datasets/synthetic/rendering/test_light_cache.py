"""Baked light is kept on disk, and baked anew when anything that counts has changed."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.rendering.light_cache import cached_light, light_key
from roomgraph.datasets.synthetic.rendering.lighting import LightMap
from roomgraph.datasets.synthetic.rendering.mesh import Lamp, Material, Surfaces
from roomgraph.datasets.synthetic.rendering.stand import Stand

GREY = Material(np.full((4, 4, 3), 128, np.uint8))
LAMP = Lamp((0.0, 0.0, 2.0), (0, 0, -1), 1.0, 1)


def quads(height=0.5):
    surfaces = Surfaces(np.random.default_rng(0))
    Stand(surfaces, (0.0, 0.0, 0.0), 0.0).box((0, 1), (0, 1), (0, height), GREY)
    return surfaces.quads


class Baker:
    def __init__(self):
        self.times = 0

    def __call__(self):
        self.times += 1
        rng = np.random.default_rng(self.times)
        return LightMap(rng.random((3, 5, 4), dtype=np.float32), np.zeros((2, 2), np.int64),
                        np.ones((2, 2), np.int64))  # fmt: skip


def test_light_is_baked_once_and_read_again(tmp_path):
    bake = Baker()
    first = cached_light(tmp_path / "scenes", "a", bake)
    again = cached_light(tmp_path / "scenes", "a", bake)
    assert bake.times == 1
    assert np.array_equal(first.image, again.image)
    assert np.array_equal(first.sizes, again.sizes)
    cached_light(tmp_path / "scenes", "b", bake)
    assert bake.times == 2


def test_without_a_folder_nothing_is_kept():
    bake = Baker()
    cached_light(None, "a", bake)
    cached_light(None, "a", bake)
    assert bake.times == 2


@pytest.mark.parametrize("content", [b"", b"no archive", b"PK\x03\x04 cut off"])
def test_a_damaged_file_is_written_anew(tmp_path, content):
    bake = Baker()
    cached_light(tmp_path, "a", bake)
    (tmp_path / "a.npz").write_bytes(content)
    fresh = cached_light(tmp_path, "a", bake)
    assert bake.times == 2
    assert np.array_equal(cached_light(tmp_path, "a", bake).image, fresh.image)
    assert bake.times == 2


def test_the_key_tells_surfaces_lamps_and_the_rest_apart():
    key = light_key(quads(), [LAMP], 1)
    assert key == light_key(quads(), [LAMP], 1)
    brighter = Lamp(LAMP.position, LAMP.direction, 2.0, 1)
    others = [
        light_key(quads(0.6), [LAMP], 1), light_key(quads(), [brighter], 1),
        light_key(quads(), [], 1), light_key(quads(), [LAMP], 2),
        light_key(quads(), [LAMP], np.array([0.0, 0.0, 1.0])),
    ]  # fmt: skip
    assert len({key, *others}) == 6
