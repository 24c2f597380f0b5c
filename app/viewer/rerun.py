"""A viewer that records a run for Rerun, shows it live, or both."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from roomgraph.app.errors import AppError
from roomgraph.app.pacing import TimeGate
from roomgraph.app.settings import ViewerSettings
from roomgraph.app.viewer import images, scene
from roomgraph.app.viewer.blueprint import build_blueprint
from roomgraph.app.viewer.framing import Axes, below_ceiling, frame_scene, level_axes
from roomgraph.app.viewer.graph import log_graph
from roomgraph.app.viewer.keyframes import KeyframePictures
from roomgraph.app.viewer.scene import Pose
from roomgraph.app.viewer.sinks import open_sinks
from roomgraph.app.viewer.viewer import MapView, SessionView
from roomgraph.datasets.frame import Frame
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.slam.tracking import Tracking, TrackingState

__all__ = ["RerunViewer", "ViewerSettings"]

FloatArray = NDArray[np.float64]

_NOTHING = np.empty((0, 3))
# Frames of the path drawn since the last map: each frame that is shown sends them anew.
# A map may be late by many frames: it comes with keyframes, and its path with labels.
_RECENT = 1000
_TRACKING, _LABEL = "timeline/tracking", "timeline/label"


class RerunViewer:
    """Sends a run to Rerun. Without global state: several may work at once.

    Maps drawn during the run are thinned, and left out where they come too often. The last one is
    drawn densely, and the views are set on it, when the viewer is closed.

    Parameters
    ----------
    save : Path or None
        The recording to write (``.rrd``), with its layout.
    spawn : bool
        Whether to open a window and show the run as it goes on.
    settings : ViewerSettings
        What is drawn, and how finely.

    Raises
    ------
    AppError
        There is nothing to do: neither `save` nor `spawn`.
    """

    def __init__(
        self, save: Path | None, spawn: bool = False, settings: ViewerSettings | None = None
    ) -> None:
        if save is None and not spawn:
            raise AppError("the viewer has neither a window nor a file", hint="use NoViewer")
        self.settings = settings or ViewerSettings()
        self._save, self._spawn = save, spawn
        self._stamps: dict[int, float] = {}
        self._poses: list[Pose] = []
        self._recent: deque[Pose] = deque(maxlen=_RECENT)
        self._points_drawn = 0
        self._said: dict[str, str] = {}
        self._pictures = KeyframePictures(
            self.settings.picture_spacing_m, self.settings.picture_turn_deg
        )
        # Frames with an image whose label is not known yet.
        self._untold: dict[int, Tracking] = {}
        self._frame_gate = TimeGate(self.settings.frame_every_s)
        self._depth_gate = TimeGate(self.settings.depth_every_s)
        self._map: tuple[int, MapView] | None = None
        # The floor plan's, once there is one: until then those of the first camera.
        self._plan_axes: Axes | None = None

    def start(self, session: SessionView) -> None:
        """Open the file and the window; send what does not change.

        Raises
        ------
        AppError
            The file or the window cannot be opened.
        """
        self._session = session
        layout = self._layout(_NOTHING, _NOTHING if session.truth is None else session.truth)
        port = self.settings.port if self._spawn else None
        self._recording = open_sinks(session.name, self._save, port, layout)
        scene.log_fixed(self._recording, session, self.settings.depth_step)

    def show_frame(self, frame: Frame, tracking: Tracking) -> None:
        """Show a frame with its features and, where it has one in the world, its pose.

        Frames too soon after one that was shown are left out, but for lost and found ones and the
        last; their poses are on the path all the same.
        """
        self._stamps[tracking.index] = tracking.stamp_s
        if tracking.is_keyframe and tracking.anchor is not None:
            self._pictures.keep(tracking.anchor.keyframe, frame)
        T = tracking.T_world_camera
        if T is not None:
            pose = Pose(tracking.index, tracking.state, T)
            self._poses.append(pose)
            self._recent.append(pose)
        word = scene.state_word(tracking)
        is_last = tracking.index + 1 == self._session.frames
        matters = is_last or not word == self._said.get(_TRACKING) == TrackingState.OK.value
        if not self._frame_gate.opens(tracking.stamp_s, matters):
            return
        self._untold[tracking.index] = tracking.without_view()
        self._at(tracking.index)
        if self._depth_gate.opens(tracking.stamp_s, matters):
            self._show_depth(frame)
        self._show_colour(frame, tracking.pixels[: self.settings.max_keypoints])
        self._recording.log("plots/inliers", rr.Scalars(tracking.inliers))
        self._say(_TRACKING, word)
        if T is not None:
            self._recording.log(
                "world/camera", rr.Transform3D(translation=T[:3, 3], mat3x3=T[:3, :3])
            )
            self._draw_recent()

    def show_label(self, frame: int, label_id: int, label: str, score: float) -> None:
        """Show a frame's label, which is known a few frames after the frame.

        The status in words is that of frames whose image is shown.
        """
        tracking = self._untold.pop(frame, None)
        is_new = self._has_labels and self._said.get(_LABEL) != label
        if tracking is None and not is_new:
            return
        self._at(frame)
        if self._has_labels:
            self._recording.log("plots/score", rr.Scalars(score))
            self._say(_LABEL, label)
        if tracking is not None:
            words = f"{label.replace('_', ' ')} · {score:.2f}"
            self._show_status(tracking, words if self._has_labels else "places not labelled")

    def show_map(self, frame: int, draw: Callable[[], MapView]) -> None:
        """Show the map at a frame; it replaces the previous one."""
        view = draw()
        self._map = (frame, view)
        last = view.frames[-1] if view.frames else -1
        self._recent = deque((p for p in self._recent if p.frame >= last), maxlen=_RECENT)
        self._at(frame)
        self._draw_recent()
        self._draw_path(view)
        self._pictures.draw(self._recording, view)
        size = min(len(view.points), self.settings.max_points)
        if self._points_drawn + size <= self._points_allowed(frame):
            self._points_drawn += size
            self._draw_cloud(view, self.settings.max_points)

    def show_graph(self, frame: int, graph: SemanticGraph) -> None:
        """Show the topological graph at a frame."""
        if graph.T_map_world is not None:
            self._plan_axes = Axes.of_map(graph.T_map_world)
        self._at(frame)
        log_graph(self._recording, graph, self._axes())

    def log(self, frame: int, text: str) -> None:
        """Show an event: a loop closed, a place entered, tracking lost."""
        self._at(frame)
        self._recording.log("events", rr.TextLog(text, level=rr.TextLogLevel.INFO))

    def close(self) -> None:
        """Draw the final map densely, frame it in the views, and flush."""
        if self._map is not None:
            frame, view = self._map
            self._at(frame)
            visible = self._draw_cloud(view, self.settings.max_points_final)
            self._recording.send_blueprint(self._layout(visible, view.trajectory))
        self._recording.flush()
        self._recording.disconnect()

    def _layout(self, points_world: FloatArray, path: FloatArray) -> rrb.Blueprint:
        """Return the layout with views that frame the map, if there is one."""
        framing = None
        if len(points_world) or len(path):
            framing = frame_scene(points_world, path, self._axes())
        return build_blueprint(framing, self._has_labels)

    @property
    def _has_labels(self) -> bool:
        """Whether there are labels other than ``unknown``."""
        return len(self._session.labels) > 1

    def _at(self, frame: int) -> None:
        """Set the time of the next messages; a frame not yet received has no stamp."""
        self._recording.reset_time()
        self._recording.set_time("frame", sequence=frame)
        if frame in self._stamps:
            self._recording.set_time("stamp", duration=self._stamps[frame])

    def _say(self, entity: str, state: str) -> None:
        """Send a state if it differs from the previous one."""
        if self._said.get(entity) != state:
            self._said[entity] = state
            self._recording.log(entity, rr.StateChange(state=state))

    def _show_colour(self, frame: Frame, pixels: FloatArray) -> None:
        """Show a colour image with features (N, 2)."""
        log = self._recording.log
        jpeg = images.encode_colour(frame, self.settings.jpeg_quality)
        log("world/camera/image/colour", rr.EncodedImage.from_fields(blob=jpeg))
        usable = images.has_depth(frame, pixels)
        log(scene.FEATURES_PLAIN, rr.Points2D.from_fields(positions=pixels[~usable]))
        log(scene.FEATURES_USABLE, rr.Points2D.from_fields(positions=pixels[usable]))

    def _show_depth(self, frame: Frame) -> None:
        png = images.encode_depth(frame, self.settings.depth_step)
        blob = rr.EncodedDepthImage.from_fields(blob=png)
        self._recording.log("world/camera/depth/image", blob)

    def _draw_recent(self) -> None:
        """Draw the path since the last frame of the path in the last map."""
        positions = np.array([p.T_world_camera[:3, 3] for p in self._recent]).reshape(-1, 3)
        frames, states = [p.frame for p in self._recent], [p.state for p in self._recent]
        path = scene.trajectory(positions, frames, states)
        self._recording.log("world/trajectory/recent", path)

    def _show_status(self, tracking: Tracking, label: str) -> None:
        lines = [
            f"# {label}",
            f"frame {tracking.index + 1} of {self._session.frames} · "
            f"**{scene.state_word(tracking)}** · {tracking.inliers} inliers "
            f"({tracking.method})",
        ]
        document = rr.TextDocument("\n\n".join(lines), media_type=rr.MediaType.MARKDOWN)
        self._recording.log("status", document)

    def _draw_path(self, view: MapView) -> None:
        path = scene.trajectory(view.trajectory, view.frames, view.states)
        self._recording.log("world/trajectory/estimate", path)
        scene.log_pose_graph(self._recording, view)

    def _points_allowed(self, frame: int) -> float:
        """Return the number of points allowed until a frame: a share of the total, plus one map."""
        share = (frame + 1) / max(self._session.frames, 1)
        return self.settings.max_points + share * self.settings.max_points_total

    def _draw_cloud(self, whole: MapView, at_most: int) -> FloatArray:
        """Draw the map's points; return those (N, 3) that are not hidden."""
        view = thinned_map(whole, at_most)
        # Fewer points are drawn bigger, so that a map drawn during the run does not look like dust.
        thinning = len(whole.points) / max(len(view.points), 1)
        radius = self.settings.point_radius_m * min(max(thinning, 1.0) ** 0.5, 2.0)
        up = self._axes().up
        points = view.points.points_world.astype(np.float64)
        low = below_ceiling(points, view.trajectory, up, self.settings.headroom_m)
        scene.log_cloud(self._recording, view, low, radius)
        return points[low]

    def _axes(self) -> Axes:
        """Return the directions in which the scene is shown."""
        if self._plan_axes is not None:
            return self._plan_axes
        return level_axes(np.array([pose.T_world_camera for pose in self._poses] or [np.eye(4)]))


def thinned_map(view: MapView, at_most: int) -> MapView:
    """Return a map of `at_most` points, chosen evenly and the same way each time."""
    count = len(view.points)
    if count <= at_most:
        return view
    chosen = np.sort(np.random.default_rng(0).choice(count, at_most, replace=False, shuffle=False))
    return replace(view, points=view.points.chosen(chosen), label_ids=view.label_ids[chosen])
