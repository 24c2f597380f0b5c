"""Compact storage of descriptors on disk."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Storage = Literal["binary", "bytes", "float16", "float32"]

# How descriptors lie in a file, by the name of their storage.
DTYPES = {"binary": "uint8", "bytes": "uint8", "float16": "float16", "float32": "float32"}
# OpenCV scales SIFT's descriptors to this norm; cutting values at 255 makes a few smaller.
SIFT_NORM, SIFT_NORM_SHARE = 512.0, 0.1
# Rounding may move a value by this share of its descriptor's norm: RootSIFT as bytes does so.
MAX_ROUNDING = 1e-3


def stored(descriptors: NDArray[Any]) -> tuple[Storage, NDArray[Any]]:
    """Return the storage format of descriptors (N, D), and the stored values (N, D).

    - ``binary``: binary descriptors (uint8) as they are.
    - ``bytes``: SIFT's, which are whole numbers up to 255, and RootSIFT's, rounded to such.
    - ``float16``: others, where that moves no value by more than `MAX_ROUNDING` of the norm.
    - ``float32``: all others.
    """
    if descriptors.dtype == np.uint8:
        return "binary", descriptors
    if _is_like_sift(descriptors):
        return "bytes", np.rint(descriptors).astype(np.uint8)
    with np.errstate(over="ignore"):
        halves = descriptors.astype(np.float16)
    bound = MAX_ROUNDING * np.linalg.norm(descriptors, axis=1, keepdims=True)
    if np.all(np.abs(halves.astype(np.float32) - descriptors) <= bound):
        return "float16", halves
    return "float32", descriptors.astype(np.float32)


def restored(storage: str, values: NDArray[Any]) -> NDArray[Any]:
    """Return descriptors (N, D) from what `stored` made: uint8 if binary, else float32.

    Raises
    ------
    ValueError
        There is no such storage, or the values are not of its type.
    """
    if storage not in DTYPES or values.dtype.name != DTYPES[storage]:
        raise ValueError(f"descriptors stored as {storage} in {values.dtype}")
    return values if storage == "binary" else values.astype(np.float32)


def _is_like_sift(descriptors: NDArray[Any]) -> bool:
    """Whether descriptors (N, D) have the norm and the range of values that SIFT's have."""
    norms = np.linalg.norm(descriptors, axis=1)
    return bool(
        np.all((descriptors >= 0) & (descriptors <= 255))
        and np.all(np.abs(norms - SIFT_NORM) <= SIFT_NORM_SHARE * SIFT_NORM)
    )
