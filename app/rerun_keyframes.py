"""Keyframes with their pictures, standing in the map where they were taken."""

from __future__ import annotations

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from app.viewer import MapView
from datasets.camera import Intrinsics

FloatArray = NDArray[np.float64]
# Of the picture's plane from the camera.
_DISTANCE_M = 0.3
# Of the lines around it: thin and dim, as the path is to be seen through them. Points are negative.
_FRAME_COLOUR, _FRAME_POINTS = (90, 94, 104), -0.5
# A picture is set anew where its keyframe has moved by this much.
_MOVED_M = 0.01


class KeyframePictures:
    """Draws the pictures of keyframes that are apart from each other.

    Parameters
    ----------
    spacing_m : float
        Keyframes nearer than this to one that is drawn are not, unless they look elsewhere.
    turn_deg : float
        By how much at least they look elsewhere.
    """

    def __init__(self, spacing_m: float, turn_deg: float) -> None:
        self._spacing_m, self._cos_turn = spacing_m, float(np.cos(np.radians(turn_deg)))
        self._pictures: dict[int, tuple[bytes, Intrinsics]] = {}
        self._drawn: dict[int, FloatArray] = {}

    def keep(self, keyframe: int, jpeg: bytes, intrinsics: Intrinsics) -> None:
        """Take in a keyframe's small picture and the camera that it is of."""
        self._pictures[keyframe] = jpeg, intrinsics

    def draw(self, recording: rr.RecordingStream, view: MapView) -> None:
        """Draw those that are new in the map, and move along those that it has moved."""
        for keyframe, T in zip(view.keyframes, view.T_world_keyframe, strict=True):
            before = self._drawn.get(keyframe)
            if before is None and keyframe in self._pictures:
                picture = self._pictures.pop(keyframe)
                if self._is_apart(T):
                    self._put(recording, keyframe, T)
                    self._show(recording, keyframe, *picture)
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

    @staticmethod
    def _show(
        recording: rr.RecordingStream, keyframe: int, jpeg: bytes, camera: Intrinsics
    ) -> None:
        pinhole = rr.Pinhole(
            image_from_camera=camera.K, resolution=[camera.width, camera.height],
            camera_xyz=rr.ViewCoordinates.RDF, image_plane_distance=_DISTANCE_M,
            color=_FRAME_COLOUR, line_width=_FRAME_POINTS,
        )  # fmt: skip
        image = rr.EncodedImage(contents=jpeg, media_type="image/jpeg")
        recording.log(f"world/keyframes/{keyframe}", pinhole, image)
