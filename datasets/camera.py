"""The pinhole camera and camera files."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roomgraph.datasets.errors import DatasetError
from roomgraph.datasets.files import write_text

# Calibrations published with the TUM RGB-D benchmark, by the name of the camera in the sequence's
# folder: fx, fy, cx, cy, then k1, k2, p1, p2, k3.
TUM_CALIBRATIONS: dict[str, tuple[float, ...]] = {
    "freiburg1": (517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633),
    "freiburg2": (520.9, 521.0, 325.1, 249.7, 0.2312, -0.7849, -0.0033, -0.0001, 0.9172),
    "freiburg3": (535.4, 539.2, 320.1, 247.6, 0.0, 0.0, 0.0, 0.0, 0.0),
}
DEFAULT_CALIBRATION: tuple[float, ...] = (525.0, 525.0, 319.5, 239.5, 0.0, 0.0, 0.0, 0.0, 0.0)
TUM_DEPTH_SCALE = 5000.0
# Between two cameras of one rig, metres: a number beyond is in another unit.
FARTHEST_M = 1.0


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """A pinhole camera, in pixels; pixel centres lie on whole numbers.

    `distortion` holds OpenCV's k1, k2, p1, p2, k3. Readers hand out undistorted frames, so the
    rest of the house sees a camera without it.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, ...] = ()

    @property
    def parameters(self) -> NDArray[np.float64]:
        """``fx, fy, cx, cy`` (4,), pixels."""
        return np.array([self.fx, self.fy, self.cx, self.cy])

    @property
    def K(self) -> NDArray[np.float64]:
        """The (3, 3) camera matrix."""
        return np.array([[self.fx, 0, self.cx], [0, self.fy, self.cy], [0, 0, 1.0]])

    @property
    def view_deg(self) -> float:
        """Field of view across, degrees."""
        return float(np.degrees(2 * np.arctan(self.width / 2 / self.fx)))

    @property
    def is_distorted(self) -> bool:
        """Whether the lens distortion is other than zero."""
        return any(self.distortion)

    def resized(self, width: int, height: int) -> Intrinsics:
        """Return the camera whose images are this one's at another size."""
        across, down = width / self.width, height / self.height
        return replace(
            self, width=width, height=height, fx=self.fx * across, fy=self.fy * down,
            cx=(self.cx + 0.5) * across - 0.5, cy=(self.cy + 0.5) * down - 0.5,
        )  # fmt: skip

    def project(self, points_camera: NDArray[np.floating]) -> NDArray[np.float64]:
        """Project points (N, 3) in the camera frame, z > 0, to pixels (N, 2)."""
        xy = points_camera[:, :2] / points_camera[:, 2:3]
        return np.asarray(xy * (self.fx, self.fy) + (self.cx, self.cy), dtype=np.float64)

    def backproject(
        self, pixels: NDArray[np.floating], depth_m: NDArray[np.floating]
    ) -> NDArray[np.float64]:
        """Return the points (N, 3) in the camera frame seen at pixels (N, 2) with depth (N,)."""
        rays = (pixels - np.array([self.cx, self.cy])) / np.array([self.fx, self.fy])
        return np.column_stack([rays * depth_m[:, None], depth_m]).astype(np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class DepthCamera:
    """A separate depth camera, and the transform (4, 4) from it to the colour camera."""

    intrinsics: Intrinsics
    T_colour_depth: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Camera:
    """Intrinsics with the raw depth units per metre, and where both come from.

    `depth` is the camera of depth images that do not lie on the colour images; None if they do.
    """

    intrinsics: Intrinsics
    depth_scale: float
    origin: str
    depth: DepthCamera | None = None


def read_camera(path: Path) -> Camera:
    """Read a camera from JSON: roomgraph's own flat form, or Open3D's.

    Own form: ``width height fx fy cx cy`` and optionally ``distortion`` and ``depth_scale``.
    Open3D's: ``width height intrinsic_matrix`` (column-major, nine numbers). A missing depth
    scale is 1000 (millimetres).

    Either may hold ``depth``, the camera of depth images that are not registered to the colour:
    in the same form, with ``T_colour_depth`` (4, 4), metres. Without a motion both look from the
    same point; without a focal length the depth camera sees what the colour camera sees.

    Raises
    ------
    DatasetError
        The file is missing, is not JSON, or lacks a value.
    """
    try:
        values: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        intrinsics, scale = _intrinsics(values), float(values.get("depth_scale", 1000.0))
        depth = _depth_camera(values["depth"], intrinsics) if "depth" in values else None
    except OSError as error:
        raise DatasetError(
            "camera file cannot be read", where=path, hint="give one with --camera FILE.json"
        ) from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise DatasetError(
            "invalid camera file", where=path,
            expected="JSON with width, height, fx, fy, cx, cy [, depth_scale], or Open3D's form",
            got=f"{type(error).__name__} {error}",
        ) from error  # fmt: skip
    for camera in (intrinsics, depth.intrinsics) if depth else (intrinsics,):
        _check(camera, scale, path)
    if depth is not None and not _is_motion(depth.T_colour_depth):
        raise DatasetError(
            "invalid transform in camera file", where=path,
            expected=f"T_colour_depth of 4 x 4 numbers: a rotation, and at most {FARTHEST_M:g} m",
            got=str(depth.T_colour_depth.tolist()), hint="its last column is in metres",
        )  # fmt: skip
    return Camera(intrinsics, scale, str(path), depth)


def _intrinsics(values: dict[str, Any]) -> Intrinsics:
    if "intrinsic_matrix" in values:
        fx, _, _, _, fy, _, cx, cy, _ = (float(v) for v in values["intrinsic_matrix"])
    else:
        fx, fy, cx, cy = (float(values[k]) for k in ("fx", "fy", "cx", "cy"))
    return Intrinsics(
        width=int(values["width"]), height=int(values["height"]), fx=fx, fy=fy, cx=cx, cy=cy,
        distortion=tuple(float(v) for v in values.get("distortion", ())),
    )  # fmt: skip


def _depth_camera(values: dict[str, Any], colour: Intrinsics) -> DepthCamera:
    if "fx" in values or "intrinsic_matrix" in values:
        intrinsics = _intrinsics(values)
    else:
        same = replace(colour, distortion=())
        intrinsics = same.resized(int(values["width"]), int(values["height"]))
    return DepthCamera(intrinsics, np.array(values.get("T_colour_depth", np.eye(4)), np.float64))


def _check(camera: Intrinsics, scale: float, path: Path) -> None:
    """Raise if a camera has an invalid value."""
    numbers = *camera.parameters, scale, *camera.distortion
    if not np.all(np.isfinite(numbers)) or len(camera.distortion) not in (0, 4, 5, 8):
        raise DatasetError(
            "invalid value in camera file", where=path,
            expected="finite numbers, and 4, 5 or 8 of them for distortion",
            got=", ".join(f"{number:g}" for number in numbers),
        )  # fmt: skip
    positive = camera.width, camera.height, camera.fx, camera.fy, scale
    if min(positive) <= 0:
        raise DatasetError(
            "value in camera file must be positive", where=path,
            expected="width, height, fx, fy, depth_scale > 0",
            got=", ".join(f"{number:g}" for number in positive),
        )  # fmt: skip


def _is_motion(T: NDArray[np.float64]) -> bool:
    """Whether a matrix is a motion from one camera of a rig to another."""
    if T.shape != (4, 4) or not np.all(np.isfinite(T)) or not np.array_equal(T[3], [0, 0, 0, 1]):
        return False
    R = T[:3, :3]
    is_rotation = np.allclose(R @ R.T, np.eye(3), atol=1e-3) and np.linalg.det(R) > 0
    return bool(is_rotation and np.linalg.norm(T[:3, 3]) <= FARTHEST_M)


def write_camera(
    path: Path, intrinsics: Intrinsics, depth_scale: float, depth: DepthCamera | None = None
) -> None:
    """Write a camera in the form that `read_camera` reads, through a temporary file."""
    values = _values(intrinsics) | {"depth_scale": depth_scale}
    if depth is not None:
        motion = {"T_colour_depth": depth.T_colour_depth.tolist()}
        values["depth"] = _values(depth.intrinsics) | motion
    write_text(path, json.dumps(values, indent=1) + "\n")


def _values(intrinsics: Intrinsics) -> dict[str, Any]:
    values = asdict(intrinsics)
    if not intrinsics.is_distorted:
        del values["distortion"]
    return values


def tum_camera(name: str, width: int = 640, height: int = 480) -> Camera:
    """Return the published TUM calibration for the sequence's `name`."""
    values, origin = DEFAULT_CALIBRATION, "default Kinect calibration (525 px)"
    for key, published in TUM_CALIBRATIONS.items():
        if key in name or key.replace("freiburg", "fr") + "_" in name + "_":
            values, origin = published, f"published TUM calibration of {key}"
    fx, fy, cx, cy, *distortion = values
    intrinsics = Intrinsics(
        width=width, height=height, fx=fx, fy=fy, cx=cx, cy=cy, distortion=tuple(distortion)
    )
    return Camera(intrinsics, TUM_DEPTH_SCALE, origin)
