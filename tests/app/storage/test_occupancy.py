"""The grid as ROS's map_server and Nav2 would see it: with Pillow and a YAML parser."""

import numpy as np
import pytest
import yaml
from PIL import Image

from roomgraph.app.errors import AppError
from roomgraph.app.storage.occupancy import read_occupancy, write_occupancy
from roomgraph.datasets.se3 import pose
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid


@pytest.fixture
def grid(rng):
    cells = rng.choice([FREE, OCCUPIED, UNKNOWN], size=(7, 11)).astype(np.int8)
    T = pose([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], [0, 0, 1.2])
    return OccupancyGrid(cells, 0.05, np.array([-1.25, 3.4]), T)


def test_round_trip(tmp_path, grid):
    write_occupancy(tmp_path / "map.yaml", grid)
    back = read_occupancy(tmp_path / "map.yaml")
    assert (back.cells == grid.cells).all()
    assert back.cell_m == grid.cell_m
    np.testing.assert_allclose(back.origin_xy, grid.origin_xy)
    np.testing.assert_allclose(back.T_map_world, grid.T_map_world)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["map.pgm", "map.yaml"]


def test_it_means_to_nav2_what_it_means_here(tmp_path, grid):
    """Read as nav2_map_server's `loadMapFromFile` does in trinary mode."""
    write_occupancy(tmp_path / "map.yaml", grid)
    content = yaml.safe_load((tmp_path / "map.yaml").read_text())
    assert content["mode"] == "trinary" and content["negate"] == 0
    assert content["origin"] == [-1.25, 3.4, 0.0]
    image = np.asarray(Image.open(tmp_path / content["image"]))
    occupancy = (255 - image.astype(float)) / 255
    states = np.full(image.shape, -1)
    states[occupancy > content["occupied_thresh"]] = 100
    states[occupancy < content["free_thresh"]] = 0
    # A picture's first row is at the top: the highest y.
    assert (states[::-1] == grid.cells).all()


@pytest.mark.parametrize("text", ["", "image: map.pgm\n", "- 1\n", "image: [\n"])
def test_what_is_no_grid_is_said_so(tmp_path, text):
    (tmp_path / "map.yaml").write_text(text)
    with pytest.raises(AppError, match="invalid occupancy grid"):
        read_occupancy(tmp_path / "map.yaml")
