import numpy as np
import pytest

from roomgraph.slam.errors import SlamError
from roomgraph.slam.geometry.voxel_hash import REACH, VoxelTable, cells_of, keys_of


def test_numbers_and_voxels_turn_into_each_other(rng):
    cells = rng.integers(-REACH + 1, REACH, (1000, 3)).astype(np.int32)
    cells[:4] = [(0, 0, 0), (-1, -1, -1), (REACH - 1,) * 3, (-REACH + 1,) * 3]
    assert np.array_equal(cells_of(keys_of(cells)), cells)
    assert len(np.unique(keys_of(cells))) == len(np.unique(cells, axis=0))


def test_sorted_numbers_keep_blocks_together(rng):
    cells = rng.integers(-40, 40, (5000, 3)).astype(np.int32)
    blocks = cells_of(np.sort(keys_of(cells))) // 8
    changes = 1 + np.any(np.diff(blocks, axis=0), axis=1).sum()
    assert changes == len(np.unique(blocks, axis=0))


def test_every_voxel_keeps_its_row(rng):
    table, known = VoxelTable(), {}
    for _ in range(30):
        centre = rng.integers(-30, 30, 3)
        keys = np.unique(keys_of((centre + rng.integers(-9, 9, (300, 3))).astype(np.int32)))
        rows = table.rows(keys)
        for key, row in zip(keys.tolist(), rows.tolist(), strict=True):
            assert known.setdefault(key, row) == row
    assert sorted(known.values()) == list(range(len(table)))
    assert all(table.keys[row] == key for key, row in known.items())


def test_memory_follows_the_space_not_the_questions(rng):
    table = VoxelTable()
    keys = np.unique(keys_of(rng.integers(0, 50, (4000, 3)).astype(np.int32)))
    table.rows(keys)
    held = table.nbytes
    for _ in range(20):
        table.rows(keys[rng.random(len(keys)) < 0.5])
    assert table.nbytes == held


def test_a_voxel_out_of_reach_is_said():
    with pytest.raises(SlamError, match="larger voxels"):
        keys_of(np.array([[0, 0, REACH]], np.int32))


def test_nothing_asked_nothing_kept():
    table = VoxelTable()
    assert len(table.rows(np.empty(0, np.int64))) == len(table) == 0
