"""A viewer that works in its own thread."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack

from roomgraph.app.viewer.viewer import MapView, SessionView, Viewer
from roomgraph.datasets.frame import Frame
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.slam.tracking import Tracking

# Calls handed on together: waking the thread for each would take as long as many of them do.
_TOGETHER = 8
# Such parcels that may wait. Each frame among them takes a few megabytes.
_WAITING = 4


class ThreadedViewer:
    """Makes another viewer and passes all calls to it, in order, in a separate thread.

    Where the other viewer falls behind, the run waits. What goes wrong in the thread is raised by
    one of the next calls, and by `close` at the latest.

    Parameters
    ----------
    make : callable
        Makes the other viewer; called at once, in the thread, for that may take its time. The
        viewer is used from the thread only.
    """

    def __init__(self, make: Callable[[], Viewer]) -> None:
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="viewer")
        self._made = self._pool.submit(make)
        self._parcel: list[Callable[[], None]] = []
        self._waiting: deque[Future[None]] = deque()

    def start(self, session: SessionView) -> None:
        """Start the other viewer and wait until it is ready."""
        self._pool.submit(lambda: self._viewer.start(session)).result()

    def show_frame(self, frame: Frame, tracking: Tracking) -> None:
        """Pass on a frame."""
        self._later(lambda: self._viewer.show_frame(frame, tracking))

    def show_label(self, frame: int, label_id: int, label: str, score: float) -> None:
        """Pass on a frame's label."""
        self._later(lambda: self._viewer.show_label(frame, label_id, label, score))

    def show_map(self, frame: int, draw: Callable[[], MapView]) -> None:
        """Pass on the function that draws the map."""
        self._later(lambda: self._viewer.show_map(frame, draw))

    def show_graph(self, frame: int, graph: SemanticGraph) -> None:
        """Pass on the topological graph."""
        self._later(lambda: self._viewer.show_graph(frame, graph))

    def log(self, frame: int, text: str) -> None:
        """Pass on an event."""
        self._later(lambda: self._viewer.log(frame, text))

    def close(self) -> None:
        """Wait until all calls are done, and close the other viewer."""
        self._hand_on()
        self._waiting.append(self._pool.submit(lambda: self._viewer.close()))
        try:
            while self._waiting:
                self._waiting.popleft().result()
        finally:
            self._pool.shutdown()

    @property
    def _viewer(self) -> Viewer:
        """The other viewer, which the thread makes first."""
        return self._made.result()

    def _later(self, call: Callable[[], None]) -> None:
        self._parcel.append(call)
        if len(self._parcel) >= _TOGETHER:
            self._hand_on()
            while self._waiting and (len(self._waiting) > _WAITING or self._waiting[0].done()):
                self._waiting.popleft().result()

    def _hand_on(self) -> None:
        parcel, self._parcel = self._parcel, []
        self._waiting.append(self._pool.submit(_make_all, parcel))


def _make_all(calls: list[Callable[[], None]]) -> None:
    """Make calls in order; a failed call does not stop the later ones."""
    with ExitStack() as stack:
        for call in reversed(calls):
            stack.callback(call)
