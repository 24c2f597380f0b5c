"""Baked light on disk: the same surfaces under the same lamps need not be lit twice."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from roomgraph.datasets.files import replacing
from roomgraph.datasets.synthetic.rendering.lighting import LightMap
from roomgraph.datasets.synthetic.rendering.mesh import Lamp, Quad

# Raised when the light is computed in another way.
VERSION = 1


def light_key(quads: Sequence[Quad], lamps: Sequence[Lamp], *rest: object) -> str:
    """Return a name for the light of surfaces: of corners, glow, lamps and all else that counts."""
    digest = hashlib.sha256(repr((VERSION, lamps, [_told(value) for value in rest])).encode())
    digest.update(np.concatenate([quad.corners for quad in quads]).tobytes())
    digest.update(repr([quad.material.glow for quad in quads]).encode())
    return digest.hexdigest()[:20]


def _told(value: object) -> object:
    return value.tolist() if isinstance(value, np.ndarray) else value


def cached_light(folder: Path | None, key: str, bake: Callable[[], LightMap]) -> LightMap:
    """Return the light of a name from a folder, or bake it and keep it there.

    Without a folder nothing is kept. A file that cannot be read is written anew.
    """
    if folder is None:
        return bake()
    path = folder / f"{key}.npz"
    try:
        # Opened here, or NumPy leaves a damaged file open.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
            return LightMap(stored["image"], stored["places"], stored["sizes"])
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):
        light = bake()
    folder.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        np.savez(temporary, image=light.image, places=light.places, sizes=light.sizes)
    return light
