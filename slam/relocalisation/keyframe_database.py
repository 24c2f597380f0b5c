"""The keyframe database on disk, for relocalisation after the run."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.files import replacing
from roomgraph.slam.errors import SlamError
from roomgraph.slam.features.extraction import Features
from roomgraph.slam.frontend.local_map import LocalMap, local_map
from roomgraph.slam.keyframe import Keyframe
from roomgraph.slam.relocalisation.descriptor_storage import restored, stored

FloatArray = NDArray[np.float64]

SCHEMA = "roomgraph/keyframes/2"
# The first form had `is_binary` in place of `descriptor_storage`, and bytes for all descriptors.
FIRST_SCHEMA = "roomgraph/keyframes/1"
# Maximum number of features with depth kept per keyframe, the strongest: about 75 kB.
MAX_FEATURES = 500


@dataclass(frozen=True, slots=True)
class StoredKeyframe:
    """A keyframe as stored for recognition and pose estimation.

    Attributes
    ----------
    id : int
        The keyframe's.
    stamp_s : float
        Time stamp of its frame, seconds.
    T_world_keyframe : (4, 4) float64
        Maps its camera's points to the world.
    features : Features
        N features with depth, the strongest first.
    points : (N, 3) float64
        Where they lie in its camera, metres.
    """

    id: int
    stamp_s: float
    T_world_keyframe: FloatArray
    features: Features
    points: FloatArray


@dataclass(frozen=True, slots=True)
class KeyframeDatabase:
    """The keyframes of a run with the (undistorted) camera that saw them."""

    keyframes: tuple[StoredKeyframe, ...]
    intrinsics: Intrinsics

    @property
    def positions(self) -> FloatArray:
        """Camera centres of the keyframes (K, 3), metres."""
        return np.array([k.T_world_keyframe[:3, 3] for k in self.keyframes]).reshape(-1, 3)


def database_of(
    keyframes: Iterable[Keyframe], T_world_keyframe: Mapping[int, FloatArray]
) -> KeyframeDatabase | None:
    """Return the database of keyframes with poses (4, 4) by id; None if there are none."""
    every = list(keyframes)
    kept = []
    for keyframe in every:
        rows = np.flatnonzero(np.isfinite(keyframe.points[:, 2]))[:MAX_FEATURES]
        found = keyframe.features
        features = Features(found.pixels[rows], found.descriptors[rows], found.sizes[rows])
        T = np.array(T_world_keyframe[keyframe.id])
        kept.append(
            StoredKeyframe(keyframe.id, keyframe.stamp_s, T, features, keyframe.points[rows])
        )
    return KeyframeDatabase(tuple(kept), every[0].intrinsics) if kept else None


def joined(keyframes: Iterable[StoredKeyframe]) -> LocalMap:
    """Join keyframes into one map in the camera frame of the first."""
    return local_map([(k, k.T_world_keyframe) for k in keyframes])


def write_keyframe_database(path: Path, database: KeyframeDatabase) -> None:
    """Write ``keyframes.npz``: positions as float32, descriptors as `stored` says, no pickle."""
    camera, found = database.intrinsics, [k.features for k in database.keyframes]
    storage, descriptors = stored(np.concatenate([f.descriptors for f in found]))
    values: dict[str, NDArray[Any]] = {
        "schema": np.array(SCHEMA),
        "size": np.array([camera.width, camera.height]),
        "camera": np.array([camera.fx, camera.fy, camera.cx, camera.cy]),
        "ids": np.array([k.id for k in database.keyframes]),
        "stamps_s": np.array([k.stamp_s for k in database.keyframes]),
        "T_world_keyframe": np.array([k.T_world_keyframe for k in database.keyframes]),
        "counts": np.array([len(features) for features in found]),
        "descriptor_storage": np.array(storage),
        "pixels": np.concatenate([f.pixels for f in found]).astype(np.float32),
        "sizes": np.concatenate([f.sizes for f in found]).astype(np.float16),
        "points": np.concatenate([k.points for k in database.keyframes]).astype(np.float32),
        "descriptors": descriptors,
    }
    # Compressed it would take a quarter less room, and thirty times as long.
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez(file, allow_pickle=False, **values)


def read_keyframe_database(path: Path) -> KeyframeDatabase:
    """Read what `write_keyframe_database` wrote.

    Raises
    ------
    SlamError
        The file is missing or is not such a database.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            values = {name: file[name] for name in file.files}
        if str(values["schema"]) not in (SCHEMA, FIRST_SCHEMA):
            raise ValueError(f"schema {values['schema']}")
        width, height = (int(v) for v in values["size"])
        fx, fy, cx, cy = (float(v) for v in values["camera"])
        intrinsics = Intrinsics(width, height, fx, fy, cx, cy)
        return KeyframeDatabase(tuple(_keyframes(values)), intrinsics)
    except FileNotFoundError as error:
        raise SlamError(
            "keyframe database not found", where=path, expected="a finished run",
            got="no such file", hint="map the sequence again with `roomgraph run`",
        ) from error  # fmt: skip
    except (OSError, ValueError, KeyError, IndexError, zipfile.BadZipFile, EOFError) as error:
        raise SlamError(
            "keyframe database cannot be read", where=path, expected=SCHEMA,
            got=f"{type(error).__name__} {error}",
            hint="map the sequence again with `roomgraph run`",
        ) from error  # fmt: skip


def _keyframes(values: Mapping[str, NDArray[Any]]) -> list[StoredKeyframe]:
    descriptors = restored(_storage(values), values["descriptors"])
    pixels, points = values["pixels"].astype(np.float64), values["points"].astype(np.float64)
    sizes = values["sizes"].astype(np.float32)
    ends = np.cumsum(values["counts"])
    if not len(pixels) == len(points) == len(sizes) == len(descriptors) == int(ends[-1]):
        raise ValueError("features of different number")
    kept = []
    for i, (end, count) in enumerate(zip(ends, values["counts"], strict=True)):
        rows = slice(int(end - count), int(end))
        features = Features(pixels[rows], descriptors[rows], sizes[rows])
        kept.append(
            StoredKeyframe(
                int(values["ids"][i]), float(values["stamps_s"][i]),
                values["T_world_keyframe"][i], features, points[rows],
            )
        )  # fmt: skip
    return kept


def _storage(values: Mapping[str, NDArray[Any]]) -> str:
    if str(values["schema"]) == FIRST_SCHEMA:
        return "binary" if values["is_binary"] else "bytes"
    return str(values["descriptor_storage"])
