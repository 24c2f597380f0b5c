"""Time measurement of the stages of a run."""

from __future__ import annotations

import threading
import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np


class StageClock:
    """Collects durations by stage; may be used from several threads."""

    def __init__(self) -> None:
        self._seconds: defaultdict[str, list[float]] = defaultdict(list)
        self._cpu_seconds: defaultdict[str, list[float]] = defaultdict(list)
        self._lock = threading.Lock()
        self._start = time.perf_counter()

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time the block as one more occurrence of a stage."""
        start, cpu_start = time.perf_counter(), time.thread_time()
        try:
            yield
        finally:
            seconds, cpu_seconds = time.perf_counter() - start, time.thread_time() - cpu_start
            with self._lock:
                self._seconds[name].append(seconds)
                self._cpu_seconds[name].append(cpu_seconds)

    @property
    def elapsed_s(self) -> float:
        """Seconds since this clock was made."""
        return time.perf_counter() - self._start

    def samples_s(self, name: str, cpu: bool = False) -> list[float]:
        """Return the durations of a stage so far, seconds, in the order in which they ended.

        With `cpu` it is the processor time of the thread that ran the stage, which other programs
        on the machine hardly change; threads that it made others work in don't count.
        """
        with self._lock:
            return list((self._cpu_seconds if cpu else self._seconds).get(name, ()))

    def summary(self) -> dict[str, dict[str, float]]:
        """Return median, 95th percentile, total (milliseconds) and count of each stage."""
        return {
            name: {
                "median": round(float(np.median(seconds)) * 1e3, 3),
                "p95": round(float(np.percentile(seconds, 95)) * 1e3, 3),
                "total": round(sum(seconds) * 1e3, 1),
                "count": len(seconds),
            }
            for name, seconds in self._seconds.items()
        }
