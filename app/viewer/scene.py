"""Entities sent to Rerun: the static ones, the map, the path."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from roomgraph.app.viewer.images import DEPTH_UNITS_PER_M, thinned
from roomgraph.app.viewer.viewer import MapView, SessionView
from roomgraph.datasets.camera import Intrinsics
from roomgraph.semantics.labels import Colour, LabelSpace
from roomgraph.slam.tracking import Tracking, TrackingState

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

STATE_COLOURS: dict[TrackingState, Colour] = {
    TrackingState.OK: (70, 200, 255),
    TrackingState.RELOCALISED: (255, 170, 40),
    TrackingState.LOST: (255, 60, 60),
    TrackingState.SKIPPED: (150, 150, 150),
}
# A frame with a pose in a sub-map that has not met the map, and so with none in the world.
SUBMAP, SUBMAP_COLOUR = "sub-map", (190, 120, 255)
TRUTH_COLOUR: Colour = (255, 214, 10)
KEYFRAME_COLOUR: Colour = (255, 255, 255)
LINK_COLOUR: Colour = (150, 150, 165)
LOOP_COLOUR: Colour = (255, 80, 220)
USABLE_COLOUR: Colour = (60, 255, 120)
PLAIN_COLOUR: Colour = (170, 170, 170)
# Features without and with a depth reading.
FEATURES_PLAIN = "world/camera/image/features/plain"
FEATURES_USABLE = "world/camera/image/features/with_depth"
_FRUSTUM_M = 0.4


@dataclass(frozen=True, slots=True)
class Pose:
    """Pose of the camera at a frame, and its tracking state."""

    frame: int
    state: TrackingState
    T_world_camera: FloatArray


def log_fixed(recording: rr.RecordingStream, session: SessionView, depth_step: int) -> None:
    """Send static entities: axes, labels, camera, true path, style of images and plots."""

    def log(entity: str, *what: object) -> None:
        recording.log(entity, *what, static=True)

    log("world", rr.ViewCoordinates.RIGHT_HAND_Y_DOWN, _annotation(session.labels))
    log("world/camera/image", _pinhole(session.intrinsics))
    log("world/camera/depth", _pinhole(thinned(session.intrinsics, depth_step)))
    # What all images and all features have alike is sent once, not with each.
    log("world/camera/image/colour", rr.EncodedImage.from_fields(media_type="image/jpeg"))
    log("world/camera/depth/image", _depth_style())
    for entity, colour in ((FEATURES_PLAIN, PLAIN_COLOUR), (FEATURES_USABLE, USABLE_COLOUR)):
        log(entity, rr.Points2D.from_fields(colors=colour, radii=rr.Radius.ui_points(2.0)))
    if session.truth is not None:
        truth = rr.LineStrips3D(
            [session.truth], colors=TRUTH_COLOUR, radii=rr.Radius.ui_points(1.0)
        )
        log("world/trajectory/truth", truth)
    log("plots/inliers", rr.SeriesLines(names="inliers", colors=USABLE_COLOUR, widths=1.5))
    if len(session.labels) > 1:
        log("plots/score", rr.SeriesLines(names="probability", colors=TRUTH_COLOUR, widths=1.5))
        names = [name.replace("_", " ") for name in session.labels.names]
        log("timeline/label", _states(session.labels.names, names, session.labels.colours))
    states = [*(state.value for state in STATE_COLOURS), SUBMAP]
    log("timeline/tracking", _states(states, states, [*STATE_COLOURS.values(), SUBMAP_COLOUR]))


def state_word(tracking: Tracking) -> str:
    """Return the tracking state of a frame as a word."""
    apart = tracking.anchor is not None and tracking.T_world_camera is None
    return SUBMAP if apart else tracking.state.value


def _states(
    values: Iterable[str], labels: Iterable[str], colours: Iterable[Colour]
) -> rr.StateConfiguration:
    return rr.StateConfiguration(values=list(values), labels=list(labels), colors=list(colours))


def _annotation(labels: LabelSpace) -> rr.AnnotationContext:
    rows = zip(labels.names, labels.colours, strict=True)
    return rr.AnnotationContext(
        [rr.AnnotationInfo(id=i, label=name, color=colour) for i, (name, colour) in enumerate(rows)]
    )


def _pinhole(camera: Intrinsics) -> rr.Pinhole:
    return rr.Pinhole(
        image_from_camera=camera.K, resolution=[camera.width, camera.height],
        camera_xyz=rr.ViewCoordinates.RDF, image_plane_distance=_FRUSTUM_M,
    )  # fmt: skip


def _depth_style() -> rr.EncodedDepthImage:
    return rr.EncodedDepthImage.from_fields(
        media_type="image/png", meter=DEPTH_UNITS_PER_M, colormap=rr.components.Colormap.Turbo,
        depth_range=(0.0, 5.0 * DEPTH_UNITS_PER_M),
    )  # fmt: skip


def trajectory(
    positions: FloatArray, frames: Sequence[int], states: Sequence[TrackingState]
) -> rr.LineStrips3D:
    """Draw a path (F, 3) coloured by the state of each frame; red across lost frames."""
    colours = [
        STATE_COLOURS[TrackingState.LOST if b - a > 1 else state]
        for (a, b), state in zip(pairwise(frames), states[1:], strict=True)
    ]
    turns = [i for i in range(1, len(colours)) if colours[i] != colours[i - 1]]
    spans = [(a, b) for a, b in zip([0, *turns], [*turns, len(colours)], strict=True) if b > a]
    return rr.LineStrips3D(
        [positions[a : b + 1] for a, b in spans], colors=[colours[a] for a, _ in spans],
        radii=rr.Radius.ui_points(1.8),
    )  # fmt: skip


def log_cloud(recording: rr.RecordingStream, view: MapView, low: Mask, radius: float) -> None:
    """Send the map's points; those above `low` would hide the others and are sent separately."""
    points, colours = view.points.points_world, view.points.colours
    log = recording.log
    log("world/map/colour", rr.Points3D(points[low], colors=colours[low], radii=radius))
    log("world/map/above", rr.Points3D(points[~low], colors=colours[~low], radii=radius))
    labels = rr.Points3D(
        points[low], class_ids=view.label_ids[low], radii=radius, show_labels=False
    )
    log("world/map/labels", labels)


def log_pose_graph(recording: rr.RecordingStream, view: MapView) -> None:
    """Send the keyframes and the constraints between them."""
    log = recording.log
    keyframes = rr.Points3D(
        view.T_world_keyframe[:, :3, 3], colors=KEYFRAME_COLOUR, radii=rr.Radius.ui_points(2.0)
    )
    log("world/keyframes", keyframes)
    log("world/pose_graph/constraints", _lines(view.constraints, LINK_COLOUR, 0.4))
    log("world/pose_graph/loops", _lines(view.loops, LOOP_COLOUR, 0.6))


def _lines(ends: FloatArray, colour: Colour, radius: float) -> rr.LineStrips3D:
    return rr.LineStrips3D(ends, colors=colour, radii=rr.Radius.ui_points(radius))
