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
from roomgraph.datasets.places import write_places
from roomgraph.datasets.synthetic import tables
from roomgraph.datasets.synthetic.cameras.omni import OmniModel, write_model
from roomgraph.datasets.synthetic.cameras.omni_image import SECTORS, sectors, unwrap
from roomgraph.datasets.synthetic.motion.imu import measure_imu, write_imu
from roomgraph.datasets.synthetic.motion.wheels import drive
from roomgraph.datasets.synthetic.recorder import Recorded, Recorder
from roomgraph.datasets.synthetic.rendering.mesh import Image
from roomgraph.datasets.synthetic.settings import LIGHTS, BuildingSettings, Light
from roomgraph.datasets.synthetic.truth import Box, BoxFinder, describe, object_truth, place_truth
from roomgraph.datasets.synthetic.world import World, make_world
from roomgraph.datasets.trajectory import Trajectory, write_tum

Progress = Callable[[int, int], None]
JPEG_QUALITY, PHOTO_QUALITY = 95, 85
# Boxes around objects are told of every so manieth frame.
BOXES_EVERY = 5


def write_sequences(
    directories: Mapping[Light, Path],
    settings: BuildingSettings,
    progress: Progress | None = None,
    cache: Path | None = None,
) -> None:
    """Render the walk once for several lights, a folder each; `settings.light` does not matter.

    Each folder gets ``rgb/``, ``depth/``, ``rgb.txt``, ``depth.txt``, ``groundtruth.txt``,
    ``camera.json``, ``places.csv`` and ``building.json``; all but the first version's plain walk
    also ``objects.csv`` and ``boxes.csv``; with people ``masks/``, with an IMU ``imu.csv`` and
    ``odometry.txt``, with an omnidirectional camera ``omni/``. It appears under its name only
    when it is whole. The same settings give the same bytes; the poses, the depth and the noise of
    a light are the same as when it is written alone.

    Parameters
    ----------
    directories : mapping of str to Path
        The folder to make for each light.
    settings : BuildingSettings
        What to render.
    progress : callable, optional
        Called with the number of frames written and the number of all frames.
    cache : Path, optional
        A folder where baked light is kept for the next time.

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
        _write(temporary, settings, progress, cache)
        for light, directory in directories.items():
            replace_folder(temporary[light], directory)
    finally:
        for folder in temporary.values():
            shutil.rmtree(folder, ignore_errors=True)


def _write(
    directories: Mapping[Light, Path],
    settings: BuildingSettings,
    progress: Progress | None,
    cache: Path | None,
) -> None:
    world = make_world(settings)
    trajectory = world.trajectory
    lights = sorted(directories, key=LIGHTS.index)
    recorder = Recorder(world, lights, cache)
    for light, directory in directories.items():
        for name in _folders(recorder):
            (directory / name).mkdir(parents=True)
        _write_truth(directory, world, recorder, light)
    finder = None if settings.is_plain else BoxFinder(object_truth(world))

    def write(index: int) -> tuple[int, list[Box]]:
        frame = recorder.record(index)
        _write_frame(directories, _stamp(trajectory, index), frame, recorder)
        seen = finder is not None and index % BOXES_EVERY == 0
        return index, finder.boxes(frame.sight) if finder is not None and seen else []

    rows: list[tuple[str, Box]] = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, (index, boxes) in enumerate(pool.map(write, range(len(trajectory))), 1):
            rows += [(_stamp(trajectory, index), box) for box in boxes]
            if progress is not None:
                progress(done, len(trajectory))
    if finder is not None:
        for directory in directories.values():
            tables.write_objects(directory / "objects.csv", finder.objects)
            tables.write_boxes(directory / "boxes.csv", rows, finder.objects)


def _folders(recorder: Recorder) -> list[str]:
    """Return the folders of images that a sequence has."""
    names = ["rgb", "depth"]
    if recorder.world.animation.people:
        names.append("masks")
    if recorder.omni is not None:
        names += [f"omni/{name}" for name in ("mirror", "panorama", *SECTORS)]
    return names


def _stamp(trajectory: Trajectory, index: int) -> str:
    return f"{trajectory.stamps_s[index]:.6f}"


def _write_frame(
    directories: Mapping[Light, Path], stamp: str, frame: Recorded, recorder: Recorder
) -> None:
    """Write a frame's depth into every folder and its colours into the folder of their light."""
    raw = np.rint(frame.depth * np.float32(TUM_DEPTH_SCALE)).astype(np.uint16)
    depth = _encode(".png", raw, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    settings = recorder.world.settings
    quality = PHOTO_QUALITY if settings.has_real_optics else JPEG_QUALITY
    mask = b""
    if recorder.world.animation.people:
        seen = recorder.renderer.people_mask(frame.sight)
        mask = _encode(".png", seen.astype(np.uint8) * 255, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    for light, directory in directories.items():
        bgr = cv2.cvtColor(frame.colours[light], cv2.COLOR_RGB2BGR)
        colour = _encode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, quality])
        (directory / "rgb" / f"{stamp}.jpg").write_bytes(colour)
        (directory / "depth" / f"{stamp}.png").write_bytes(depth)
        if mask:
            (directory / "masks" / f"{stamp}.png").write_bytes(mask)
        if recorder.omni is not None:
            _write_mirror(directory / "omni", stamp, frame.mirrors[light], recorder.omni)


def _write_mirror(directory: Path, stamp: str, mirror: Image, model: OmniModel) -> None:
    """Write the omnidirectional image, its panorama and its four sectors."""
    images = {"mirror": mirror, "panorama": unwrap(mirror, model, 2 * model.size_px)}
    for name, image in (images | sectors(mirror, model)).items():
        bgr = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
        data = _encode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
        (directory / name / f"{stamp}.jpg").write_bytes(data)


def _encode(suffix: str, image: Image | NDArray[np.uint16], options: list[int]) -> bytes:
    done, data = cv2.imencode(suffix, image, options)
    if not done:
        raise DatasetError("image cannot be encoded", expected=suffix, got=str(image.shape))
    return bytes(data.tobytes())


def _write_truth(directory: Path, world: World, recorder: Recorder, light: Light) -> None:
    """Write everything about a sequence but its images."""
    trajectory = world.trajectory
    settings = world.settings.model_copy(update={"light": light})
    stamps = [_stamp(trajectory, index) for index in range(len(trajectory))]
    for kind, suffix in (("rgb", "jpg"), ("depth", "png")):
        rows = [f"{stamp} {kind}/{stamp}.{suffix}" for stamp in stamps]
        write_text(directory / f"{kind}.txt", "\n".join(["# timestamp filename", *rows]) + "\n")
    write_tum(directory / "groundtruth.txt", trajectory)
    depth = recorder.depth_camera
    write_camera(directory / "camera.json", settings.intrinsics, TUM_DEPTH_SCALE, depth)
    write_places(directory / "places.csv", place_truth(world))
    text = json.dumps(describe(world, settings), indent=1)
    write_text(directory / "building.json", text + "\n")
    if settings.imu:
        _write_motion(directory, world)
    if recorder.omni is not None:
        write_model(directory / "omni.json", recorder.omni)
        mask = recorder.omni.mask().astype(np.uint8) * 255
        (directory / "omni_mask.png").write_bytes(_encode(".png", mask, []))


def _write_motion(directory: Path, world: World) -> None:
    """Write what an IMU and the wheels measure on the way."""
    trajectory, seed = world.trajectory, world.settings.seed
    begin, end = float(trajectory.stamps_s[0]), float(trajectory.stamps_s[-1])
    rng = np.random.default_rng((seed, 13))
    write_imu(directory / "imu.csv", measure_imu(world.motion, begin, end, rng))
    planned = Trajectory(trajectory.stamps_s, world.planned.T_world_camera[: len(trajectory)])
    write_tum(directory / "odometry.txt", drive(planned, np.random.default_rng((seed, 14))))
