"""Which voxel of space is kept in which row: a hash of small blocks."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from roomgraph.slam.errors import SlamError

Kind = TypeVar("Kind", bound=np.generic)
IntArray = NDArray[np.int64]
# Blocks of 8 voxels a side: surfaces fill an eighth of them and more, so that a table of all
# their voxels costs little beside what is kept of each voxel (Niessner et al., 2013).
SIDE_BITS = 3
PER_BLOCK = 1 << 3 * SIDE_BITS
# Blocks are numbered by 18 bits a coordinate, voxels within by 9: 63 bits in all.
BLOCK_BITS = 18
REACH = 1 << BLOCK_BITS + SIDE_BITS - 1


def keys_of(cells: NDArray[np.int32]) -> IntArray:
    """Return a number (N,) for each voxel (N, 3); sorted, voxels of a block follow each other.

    Raises
    ------
    SlamError
        A voxel lies further from the origin than numbers reach, 2**20 voxels.
    """
    if len(cells) and np.abs(cells).max() >= REACH:
        raise SlamError(
            "map is too large for its voxels", expected=f"less than {REACH} voxels from the "
            "origin", got=str(int(np.abs(cells).max())), hint="use larger voxels",
        )  # fmt: skip
    x, y, z = (cells[:, axis].astype(np.int64) + REACH for axis in range(3))
    low, side = (1 << SIDE_BITS) - 1, SIDE_BITS
    block = ((x >> side) << BLOCK_BITS | (y >> side)) << BLOCK_BITS | (z >> side)
    return ((block << side | (x & low)) << side | (y & low)) << side | (z & low)


def voxels_of(points: NDArray[np.floating], voxel_m: float) -> IntArray:
    """Return the numbers (N,) of the voxels of side `voxel_m` that points (N, 3) lie in."""
    return keys_of(np.floor(points / voxel_m).astype(np.int32))


def cells_of(keys: IntArray) -> NDArray[np.int32]:
    """Return the voxels (N, 3) that have numbers `keys` (N,)."""
    low, side, block = (1 << SIDE_BITS) - 1, SIDE_BITS, keys >> 3 * SIDE_BITS
    mask = (1 << BLOCK_BITS) - 1
    coordinates = [
        (((block >> (2 - axis) * BLOCK_BITS) & mask) << side)
        + ((keys >> (2 - axis) * side) & low)
        - REACH
        for axis in range(3)
    ]
    return np.stack(coordinates, axis=-1).astype(np.int32)


class VoxelTable:
    """Gives every voxel that is asked for a row, counting up from 0; flat in time and memory."""

    def __init__(self) -> None:
        self._blocks: IntArray = np.empty(0, np.int64)
        self._slots: NDArray[np.int32] = np.empty(0, np.int32)
        self._rows: NDArray[np.int32] = np.empty((0, PER_BLOCK), np.int32)
        self._keys: IntArray = np.empty(0, np.int64)
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def keys(self) -> IntArray:
        """The voxels' numbers, by row."""
        return self._keys[: self._count]

    @property
    def nbytes(self) -> int:
        """Bytes held."""
        arrays = (self._blocks, self._slots, self._rows, self._keys)
        return sum(array.nbytes for array in arrays)

    def rows(self, keys: IntArray) -> NDArray[np.int32]:
        """Return the rows (N,) of voxels (N,), sorted and each but once; new ones get new rows."""
        blocks = keys >> 3 * SIDE_BITS
        starts = np.flatnonzero(np.r_[True, blocks[1:] != blocks[:-1]]) if len(keys) else blocks
        slots = np.repeat(self._slots_of(blocks[starts]), np.diff(np.r_[starts, len(keys)]))
        within = keys & PER_BLOCK - 1
        rows: NDArray[np.int32] = self._rows[slots, within]
        new = np.flatnonzero(rows < 0)
        rows[new] = np.arange(self._count, self._count + len(new))
        self._rows[slots[new], within[new]] = rows[new]
        self._count += len(new)
        self._keys = grown(self._keys, self._count)
        self._keys[rows[new]] = keys[new]
        return rows

    def _slots_of(self, blocks: IntArray) -> NDArray[np.int32]:
        """Return where the tables of blocks (M,), sorted, lie; new ones are made."""
        at = np.searchsorted(self._blocks, blocks)
        known = np.zeros(len(blocks), bool)
        inside = at < len(self._blocks)
        known[inside] = self._blocks[at[inside]] == blocks[inside]
        fresh = blocks[~known]
        if len(fresh):
            first, end = len(self._blocks), len(self._blocks) + len(fresh)
            self._rows = grown(self._rows, end)
            self._rows[first:end] = -1
            self._blocks = np.insert(self._blocks, at[~known], fresh)
            self._slots = np.insert(self._slots, at[~known], np.arange(first, end))
            at = np.searchsorted(self._blocks, blocks)
        return np.asarray(self._slots[at])


def grown(array: NDArray[Kind], rows: int) -> NDArray[Kind]:
    """Return the array, or a copy half as long again if it has fewer rows than asked for."""
    if rows <= len(array):
        return array
    longer = np.zeros((max(rows, len(array) * 3 // 2), *array.shape[1:]), array.dtype)
    longer[: len(array)] = array
    return longer
