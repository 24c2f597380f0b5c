"""How long each stage takes."""

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
        self._lock = threading.Lock()
        self._start = time.perf_counter()

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time the block as one more occurrence of a stage."""
        start = time.perf_counter()
        try:
            yield
        finally:
            with self._lock:
                self._seconds[name].append(time.perf_counter() - start)

    @property
    def elapsed_s(self) -> float:
        """Seconds since this clock was made."""
        return time.perf_counter() - self._start

    def samples_s(self, name: str) -> list[float]:
        """Return the durations of a stage so far, seconds, in the order in which they ended."""
        with self._lock:
            return list(self._seconds[name]) if name in self._seconds else []

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
