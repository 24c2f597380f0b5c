"""The pipeline of a run: frames in, a run folder out."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import closing
from dataclasses import replace
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from roomgraph.app.clock import StageClock
from roomgraph.app.pacing import GrowthGate
from roomgraph.app.prefetch import prefetch
from roomgraph.app.run.finalisation import Finalisation
from roomgraph.app.run.frame_history import FrameHistory
from roomgraph.app.run.metrics import run_metrics
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.recorder import Recorder
from roomgraph.app.viewer.viewer import MapView, SessionView, Viewer
from roomgraph.datasets import se3
from roomgraph.datasets.sequence import Sequence
from roomgraph.semantics.graph.topology import TopologicalMap
from roomgraph.semantics.labels import UNKNOWN, LabelSpace
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.temporal.labeller import FrameLabel, PlaceLabeller
from roomgraph.semantics.temporal.look import FrameInput
from roomgraph.slam.features.view import View
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import LoopClosure, Tracking, TrackingState

logger = logging.getLogger(__name__)

Progress = Callable[[int, int, str], None]

# Frames that labelling stays behind tracking.
LABEL_LAG = 8
# A large map or graph is drawn again once it has grown by this fraction (1 / n), even if a loop has
# bent it before: all drawings together cost about as much as n of the last.
GROWTH_PARTS = 16


class Pipeline:
    """Runs SLAM and labelling on a sequence, and passes the results to recorder and viewer.

    Parameters
    ----------
    sequence : Sequence
        What to map.
    settings : AppSettings
        Of both layers.
    model : PlaceModel or None
        Without one every label is ``unknown``.
    recorder : Recorder
        Writes the files.
    viewer : Viewer
        Shows or records.
    progress : callable
        Called with frames done, frames in all and a word on the state.
    warnings : iterable of str
        What is known to be wrong with the data; goes into the metrics.
    """

    def __init__(
        self,
        sequence: Sequence,
        settings: AppSettings,
        model: PlaceModel | None,
        recorder: Recorder,
        viewer: Viewer,
        progress: Progress,
        warnings: Iterable[str] = (),
    ) -> None:
        self.sequence, self.settings, self.recorder = sequence, settings, recorder
        self.viewer, self.progress = viewer, progress
        self.warnings = list(warnings)
        self.clock = StageClock()
        self.slam = Slam(settings.slam, settings.seed)
        self.labels = model.labels if model is not None else LabelSpace.of(())
        self.labeller = PlaceLabeller(model, settings.semantics.labeller)
        self.topology = TopologicalMap(settings.semantics.topology, self.labels)
        self.history = FrameHistory(self.slam)
        # Frames that the labeller has not been given, and that it has not labelled yet.
        self._unlabelled: deque[Tracking] = deque()
        self._awaiting: deque[Tracking] = deque()
        self._map_gate = GrowthGate(settings.recording.map_every, GROWTH_PARTS)
        self._graph_gate = GrowthGate(1, GROWTH_PARTS)
        self._done = 0

    def run(self) -> dict[str, Any]:
        """Map the whole sequence and return its metrics.

        Whatever ends it, an unreadable frame or the user, what was found so far is written.
        """
        # The matrices are small: BLAS threads would only get in the way of those that read ahead.
        with closing(self.recorder), threadpool_limits(1, user_api="blas"):
            self.viewer.start(self._session())
            try:
                for view in self._views():
                    tracking = self._track(view)
                    self._label(tracking)
                    self._show(view, tracking)
                    self._checkpoint(tracking)
            finally:
                metrics = self._finish()
        return metrics

    def _views(self) -> Iterator[View]:
        """Yield frames, read and prepared ahead of time in a thread."""

        def prepare(index: int) -> View:
            with self.clock.stage("read"):
                frame = self.sequence[index]
            with self.clock.stage("features"):
                return self.slam.prepare(frame)

        return prefetch(prepare, range(len(self.sequence)))

    def _track(self, view: View) -> Tracking:
        with self.clock.stage("track"):
            return self.slam.process(view)

    def _label(self, tracking: Tracking) -> None:
        """Label frames a little later than tracking, as keyframe features come from a thread."""
        self._unlabelled.append(tracking)
        self._label_but(LABEL_LAG)

    def _label_but(self, count: int) -> None:
        """Label the waiting frames except the last few."""
        while len(self._unlabelled) > count:
            tracking = self._unlabelled[0]
            with self.clock.stage("label"):
                labels = self.labeller.process(self._input_of(tracking))
            self._unlabelled.popleft()
            self._awaiting.append(tracking.without_view())
            self._take(labels)

    def _input_of(self, tracking: Tracking) -> FrameInput:
        """Return the labeller's input: features if it uses them, and images of keyframes."""
        view, T = tracking.view, tracking.T_world_camera
        return FrameInput(
            tracking.index, tracking.stamp_s,
            colour=view.frame.colour if view is not None and tracking.is_keyframe else None,
            # Features of a keyframe that is still being made are waited for.
            features=tracking.features if self.labeller.uses_features else None,
            position_world=None if T is None else T[:3, 3],
        )  # fmt: skip

    def _take(self, labels: list[FrameLabel]) -> None:
        """Extend the graph by frames whose labels are final, and record these frames."""
        for label in labels:
            tracking = self._awaiting.popleft()
            with self.clock.stage("graph"):
                dropped = self.topology.update(label, tracking.anchor, self.slam.keyframe_poses)
            self.recorder.add_frame(self.history.add(tracking, label))
            self.viewer.show_label(label.index, label.label_id, label.label, label.score)
            if dropped:
                self._enter(label.index)

    def _enter(self, frame: int) -> None:
        """Show the graph with its new node if it is due, or if the node is in another place."""
        graph = self.topology.snapshot(self.slam.placed_poses, partial=True)
        places = [node.place for node in graph.nodes[-2:]]
        is_there = bool(places) and graph.nodes[-1].frame == frame  # else in a sub-map, nowhere yet
        enters = is_there and places[-1] != UNKNOWN and places[:-1] != places[-1:]
        if enters:
            logger.info("frame %d: entering %s", frame, places[-1])
            self.viewer.log(frame, f"entering {places[-1]}")
        if self._graph_gate.opens(len(graph.nodes)) or enters:
            self.viewer.show_graph(frame, graph)

    def _show(self, view: View, tracking: Tracking) -> None:
        with self.clock.stage("view"):
            self.viewer.show_frame(view.frame, self._in_world(tracking))
            if tracking.is_keyframe:
                self.recorder.add_thumbnail(view.frame)
            for event in _events(tracking):
                self.viewer.log(tracking.index, event)
            if self._map_gate.opens(len(self.slam.keyframes)):
                self.viewer.show_map(tracking.index, self._sketch())
        self._done = tracking.index + 1
        self.progress(self._done, len(self.sequence), self._state(tracking))

    def _sketch(self) -> Callable[[], MapView]:
        """Return a function that draws the map as it is now, timed where it runs."""
        draw = self.history.sketch()

        def timed() -> MapView:
            with self.clock.stage("sketch"):
                return draw()

        return timed

    def _in_world(self, tracking: Tracking) -> Tracking:
        """Return a frame without its pose if that is in a sub-map not yet joined to the map."""
        anchor = tracking.anchor
        if anchor is None or self.slam.is_placed(anchor):
            return tracking
        return replace(tracking, T_world_camera=None)

    def _checkpoint(self, tracking: Tracking) -> None:
        if (tracking.index + 1) % self.settings.recording.checkpoint_every == 0:
            self.recorder.write_trajectory(self.history.trajectory())

    def _finish(self) -> dict[str, Any]:
        """Write all outputs of a complete or interrupted run."""
        self.progress(self._done, len(self.sequence), "making map, rooms and files")
        failure = self._wait()
        self._label_but(0)
        self._take(self.labeller.finish())
        maker = Finalisation(
            stamps_s=self.sequence.stamps_s, slam=self.slam, topology=self.topology,
            history=self.history, settings=self.settings, recorder=self.recorder,
            viewer=self.viewer, clock=self.clock,
        )  # fmt: skip
        made = maker.make()
        metrics = run_metrics(
            sequence=self.sequence, slam=self.slam, history=self.history,
            trajectory=made.trajectory, graph=made.graph, points=made.points, clock=self.clock,
            warnings=[*self.warnings, *made.warnings],
        )  # fmt: skip
        self.recorder.write_metrics(metrics)
        if failure is not None:
            raise failure
        return metrics

    def _wait(self) -> Exception | None:
        """Wait for pending keyframes; return an error, to be raised at the end."""
        try:
            for closure in self.slam.finish():
                frame = self.slam.keyframes[closure.keyframe].frame_index
                self.viewer.log(frame, _loop_event(closure))
        except Exception as error:
            logger.exception("keyframe processing failed: the map lacks its last keyframes")
            return error
        return None

    def _session(self) -> SessionView:
        truth = self.sequence.ground_truth
        centres = None
        if truth is not None:
            first = max(0, int(truth.nearest(self.sequence.stamps_s[:1], np.inf)[0]))
            last = int(truth.nearest(self.sequence.stamps_s[-1:], np.inf)[0])
            path = truth.positions[first : last + 1]
            centres = se3.transform(se3.inverse(truth.T_world_camera[first]), path)
        return SessionView(
            name=self.sequence.name, frames=len(self.sequence),
            intrinsics=self.sequence.camera.intrinsics, labels=self.labels, truth=centres,
        )  # fmt: skip

    def _state(self, tracking: Tracking) -> str:
        said = [tracking.state.value, f"{len(self.slam.keyframe_poses)} keyframes"]
        if self.labels.names[1:] and self.history.online:
            said.insert(1, self.history.online[-1])
        return ", ".join(said)


def _events(tracking: Tracking) -> list[str]:
    """Return the events of a frame to display."""
    events = [_loop_event(closure) for closure in tracking.closures]
    if tracking.state is not TrackingState.OK:
        events.append(f"frame {tracking.index} {tracking.state.value}")
    return events


def _loop_event(closure: LoopClosure) -> str:
    return f"loop closed with keyframe {closure.matched_keyframe} ({closure.inliers} matches)"
