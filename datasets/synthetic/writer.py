"""Writing the walk through a building as a sequence in the layout of the TUM RGB-D benchmark."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.camera import TUM_DEPTH_SCALE, write_camera
from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.files import replace_folder, write_text
from roomgraph.datasets.places import PlaceTruth, write_places
from roomgraph.datasets.synthetic.building import Building, build
from roomgraph.datasets.synthetic.renderer import Rendered, Renderer
from roomgraph.datasets.synthetic.settings import LIGHTS, BuildingSettings, Light
from roomgraph.datasets.synthetic.walk import walk
from roomgraph.datasets.trajectory import Trajectory, write_tum

Progress = Callable[[int, int], None]
JPEG_QUALITY = 95
WORKERS = 2


def write_sequences(
    directories: Mapping[Light, Path], settings: BuildingSettings, progress: Progress | None = None
) -> None:
    """Render the walk once for several lights, a folder each; `settings.light` does not matter.

    Each folder gets ``rgb/``, ``depth/``, ``rgb.txt``, ``depth.txt``, ``groundtruth.txt``,
    ``camera.json``, ``places.csv`` and ``building.json``. It appears under its name only when it
    is whole. The same settings give the same bytes; the poses, the depth and the noise of a light
    are the same as when it is written alone.

    Parameters
    ----------
    directories : mapping of str to Path
        The folder to make for each light.
    settings : BuildingSettings
        What to render.
    progress : callable, optional
        Called with the number of frames written and the number of all frames.

    Raises
    ------
    DatasetError
        A folder is there already and not empty.
    """
    for directory in directories.values():
        if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
            raise DatasetError(
                "folder is there already", where=directory, hint="name a new one, or remove it"
            )
    temporary = {
        light: directory.with_name(f".{directory.name}.{os.getpid()}")
        for light, directory in directories.items()
    }
    try:
        _write(temporary, settings, progress)
        for light, directory in directories.items():
            replace_folder(temporary[light], directory)
    finally:
        for folder in temporary.values():
            shutil.rmtree(folder, ignore_errors=True)


def _write(
    directories: Mapping[Light, Path], settings: BuildingSettings, progress: Progress | None
) -> None:
    building = build(settings.seed)
    trajectory = walk(building, settings)
    for light, directory in directories.items():
        (directory / "rgb").mkdir(parents=True)
        (directory / "depth").mkdir()
        _write_truth(directory, building, trajectory, settings.model_copy(update={"light": light}))
    renderer = Renderer(building, settings.intrinsics)
    lights = sorted(directories, key=LIGHTS.index)

    def write(index: int) -> None:
        view = renderer.render(
            trajectory.T_world_camera[index], lights, settings.noise, (settings.seed, index)
        )
        _write_frame(directories, _stamp(trajectory, index), view)

    with ThreadPoolExecutor(WORKERS) as pool:
        for done, _ in enumerate(pool.map(write, range(len(trajectory))), 1):
            if progress is not None:
                progress(done, len(trajectory))


def _stamp(trajectory: Trajectory, index: int) -> str:
    return f"{trajectory.stamps_s[index]:.6f}"


def _write_frame(directories: Mapping[Light, Path], stamp: str, view: Rendered) -> None:
    """Write a frame's depth into every folder and its colours into the folder of their light."""
    raw = np.rint(view.depth * np.float32(TUM_DEPTH_SCALE)).astype(np.uint16)
    depth = _encode(".png", raw, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    for light, directory in directories.items():
        bgr = cv2.cvtColor(view.colours[light], cv2.COLOR_RGB2BGR)
        colour = _encode(".jpg", np.asarray(bgr), [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
        (directory / "rgb" / f"{stamp}.jpg").write_bytes(colour)
        (directory / "depth" / f"{stamp}.png").write_bytes(depth)


def _encode(suffix: str, image: NDArray[np.generic], flags: list[int]) -> bytes:
    done, data = cv2.imencode(suffix, image, flags)
    if not done:
        raise DatasetError("image cannot be encoded", expected=suffix, got=str(image.shape))
    return bytes(data.tobytes())


def _write_truth(
    directory: Path, building: Building, trajectory: Trajectory, settings: BuildingSettings
) -> None:
    """Write everything about a sequence but its images."""
    for kind, suffix in (("rgb", "jpg"), ("depth", "png")):
        stamps = [_stamp(trajectory, index) for index in range(len(trajectory))]
        rows = [f"{stamp} {kind}/{stamp}.{suffix}" for stamp in stamps]
        write_text(directory / f"{kind}.txt", "\n".join(["# timestamp filename", *rows]) + "\n")
    write_tum(directory / "groundtruth.txt", trajectory)
    write_camera(directory / "camera.json", settings.intrinsics, TUM_DEPTH_SCALE)
    rooms = [building.room_at(xy) for xy in trajectory.positions[:, :2]]
    truth = PlaceTruth(
        trajectory.stamps_s, tuple(room.label for room in rooms), tuple(room.name for room in rooms)
    )
    write_places(directory / "places.csv", truth)
    text = json.dumps(describe(building, settings), indent=1)
    write_text(directory / "building.json", text + "\n")


def describe(building: Building, settings: BuildingSettings) -> dict[str, object]:
    """Return the layout of a building and the settings as plain values, in metres."""
    return {
        "settings": settings.model_dump(),
        "rooms": [
            {
                "name": room.name, "label": room.label,
                "polygon": np.round(room.floor.polygon, 4).tolist(),
                "area": round(room.floor.area, 3),
            }
            for room in building.rooms
        ],
        "doorways": [
            {
                "rooms": list(door.rooms), "xy": [round(value, 4) for value in door.xy],
                "width": round(door.width_m, 3), "height": round(door.height_m, 3),
            }
            for door in building.doorways
        ],
    }  # fmt: skip
