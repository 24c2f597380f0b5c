"""Pictures of keyframes, shown in the map where they were taken."""

from __future__ import annotations

import cv2
import numpy as np
import rerun as rr
from numpy.typing import NDArray

from roomgraph.app.viewer.viewer import MapView
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame

FloatArray = NDArray[np.float64]
# Of the picture's plane from the camera; and how many pixels wide it is.
_DISTANCE_M, _WIDTH = 0.3, 128
# A picture is set anew where its keyframe has moved by this much.
_MOVED_M = 0.01


class KeyframePictures:
    """Draws the pictures of keyframes with a minimum distance between them.

    Parameters
    ----------
    spacing_m : float
        Keyframes nearer than this to one that is drawn are not, unless they look elsewhere.
    turn_deg : float
        By how much at least they look elsewhere.
    """

    def __init__(self, spacing_m: float, turn_deg: float) -> None:
        self._spacing_m, self._cos_turn = spacing_m, float(np.cos(np.radians(turn_deg)))
        self._pictures: dict[int, tuple[NDArray[np.uint8], Intrinsics]] = {}
        self._drawn: dict[int, FloatArray] = {}

    def keep(self, keyframe: int, frame: Frame) -> None:
        """Store the picture of a keyframe."""
        height = max(1, round(frame.colour.shape[0] * _WIDTH / frame.colour.shape[1]))
        small = cv2.resize(frame.colour, (_WIDTH, height), interpolation=cv2.INTER_AREA)
        self._pictures[keyframe] = small, frame.intrinsics

    def draw(self, recording: rr.RecordingStream, view: MapView) -> None:
        """Draw new pictures, and move those whose keyframes have moved."""
        for keyframe, T in zip(view.keyframes, view.T_world_keyframe, strict=True):
            before = self._drawn.get(keyframe)
            if before is None and keyframe in self._pictures:
                picture = self._pictures.pop(keyframe)
                if self._is_apart(T):
                    self._put(recording, keyframe, T)
                    recording.log(f"world/keyframes/{keyframe}", _picture(*picture))
            elif before is not None and np.abs(T[:3] - before[:3]).max() > _MOVED_M:
                self._put(recording, keyframe, T)

    def _is_apart(self, T: FloatArray) -> bool:
        if not self._drawn:
            return True
        drawn = np.array(list(self._drawn.values()))
        near = np.linalg.norm(drawn[:, :3, 3] - T[:3, 3], axis=1) < self._spacing_m
        return not bool(np.any(near & (drawn[:, :3, 2] @ T[:3, 2] > self._cos_turn)))

    def _put(self, recording: rr.RecordingStream, keyframe: int, T: FloatArray) -> None:
        self._drawn[keyframe] = T
        pose = rr.Transform3D(translation=T[:3, 3], mat3x3=T[:3, :3])
        recording.log(f"world/keyframes/{keyframe}", pose)


def _picture(small: NDArray[np.uint8], camera: Intrinsics) -> rr.Mesh3D:
    """Return a frame's small image as a plane that fills the camera's view.

    Not as an image in a camera: Rerun complains of those at times before they are there.
    """
    right, bottom = camera.width - 0.5, camera.height - 0.5
    pixels = np.array([(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom)])
    return rr.Mesh3D(
        vertex_positions=camera.backproject(pixels, np.full(4, _DISTANCE_M)),
        vertex_texcoords=[(0, 0), (1, 0), (1, 1), (0, 1)],
        triangle_indices=[(0, 2, 1), (0, 3, 2)], albedo_texture=small,
    )  # fmt: skip
