"""A viewer in a thread: everything in order, nothing lost, no failure passed over."""

import threading
import time
from types import SimpleNamespace

import pytest

from roomgraph.app.errors import AppError
from roomgraph.app.viewer.threaded import ThreadedViewer


class Witness:
    """Notes what it is told, from which thread; slow, and failing if asked to."""

    def __init__(self, fails_at=None):
        self.heard, self.threads, self.fails_at = [], set(), fails_at

    def _hear(self, *what):
        time.sleep(0.001)
        self.threads.add(threading.get_ident())
        self.heard.append(what)
        if what == self.fails_at:
            raise AppError("the disk is full")

    def start(self, session):
        self._hear("start", session)

    def show_frame(self, frame, tracking):
        self._hear("frame", frame, tracking)

    def show_label(self, *what):
        self._hear("label", *what)

    def show_map(self, frame, draw):
        self._hear("map", frame, draw())

    def show_graph(self, frame, graph):
        self._hear("graph", frame, graph)

    def log(self, frame, text):
        self._hear("log", frame, text)

    def close(self):
        self._hear("close")


def test_it_hands_on_everything_in_order_from_one_thread():
    witness = Witness()
    viewer = ThreadedViewer(lambda: witness)
    viewer.start("session")
    wanted = [("start", "session")]
    drawn_in = set()

    def draw(i):
        drawn_in.add(threading.get_ident())
        return f"map {i}"

    for i in range(100):
        viewer.show_frame(i, "tracked")
        viewer.show_label(i, 1, "office", 0.5)
        wanted += [("frame", i, "tracked"), ("label", i, 1, "office", 0.5)]
        if i % 10 == 0:
            viewer.show_map(i, lambda i=i: draw(i))
            viewer.show_graph(i, "graph")
            viewer.log(i, "loop closed")
            wanted += [("map", i, f"map {i}"), ("graph", i, "graph"), ("log", i, "loop closed")]
    viewer.close()
    assert witness.heard == [*wanted, ("close",)]
    assert len(witness.threads) == 1
    assert drawn_in == witness.threads


def test_the_run_waits_for_a_viewer_that_falls_behind():
    gate = threading.Event()
    inner = SimpleNamespace(log=lambda frame, text: gate.wait(), close=lambda: None)
    viewer = ThreadedViewer(lambda: inner)
    done = []

    def run():
        for i in range(1000):
            viewer.log(i, "")
            done.append(i)

    runner = threading.Thread(target=run)
    runner.start()
    time.sleep(0.2)
    waiting = len(done)
    gate.set()
    runner.join()
    viewer.close()
    assert 0 < waiting < 100
    assert len(done) == 1000


def test_what_goes_wrong_is_raised_and_the_viewer_closed_all_the_same():
    witness = Witness(fails_at=("log", 3, "x"))
    viewer = ThreadedViewer(lambda: witness)
    viewer.start("session")
    with pytest.raises(AppError, match="disk is full"):
        for i in range(1000):
            viewer.log(i, "x")
    viewer.close()
    assert witness.heard[-1] == ("close",)


def test_after_a_failure_the_rest_is_shown_all_the_same():
    witness = Witness(fails_at=("log", 3, "x"))
    viewer = ThreadedViewer(lambda: witness)
    raised = 0
    for i in range(200):
        try:
            viewer.log(i, "x")
        except AppError:
            raised += 1
    viewer.close()
    assert raised == 1
    assert witness.heard == [*(("log", i, "x") for i in range(200)), ("close",)]


def test_a_failure_at_the_very_end_is_raised_by_close():
    viewer = ThreadedViewer(lambda: Witness(fails_at=("log", 0, "x")))
    viewer.start("session")
    viewer.log(0, "x")
    with pytest.raises(AppError, match="disk is full"):
        viewer.close()


def test_one_that_cannot_start_says_so_at_once():
    with pytest.raises(AppError, match="disk is full"):
        ThreadedViewer(lambda: Witness(fails_at=("start", "session"))).start("session")


def test_it_makes_the_viewer_in_its_thread_and_tells_at_the_start_if_that_fails():
    made_in = []

    def make():
        made_in.append(threading.get_ident())
        raise OSError("no such viewer")

    viewer = ThreadedViewer(make)
    with pytest.raises(OSError, match="no such viewer"):
        viewer.start("session")
    assert made_in != [threading.get_ident()]
