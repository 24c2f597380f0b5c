"""One timed run of a sequence, in a separate process."""

from __future__ import annotations

import hashlib
import time
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from roomgraph.app.clock import StageClock
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.input import InputOptions

# What a frame costs on its way to a pose, whether it runs ahead in a thread or not.
FRAME_STAGES = ("features", "track")


@dataclass(frozen=True, slots=True)
class BenchJob:
    """A run to measure: a sequence, played once or `laps` times forward and backward."""

    input: InputOptions
    settings: AppSettings
    model: Path | None = None
    laps: int = 0


@dataclass(frozen=True, slots=True)
class BenchRun:
    """Time, memory and results of one run.

    Attributes
    ----------
    name : str
        The sequence's.
    metrics : dict
        The run's figures, as in ``metrics.json``.
    frame_ms : list of float
        For each frame, milliseconds from its image to its pose: features and tracking.
    frame_cpu_ms : list of float
        The same as processor time of the threads that did it.
    interval_ms : list of float
        Milliseconds from one finished frame to the next, everything included.
    memory_mb : list of float
        Resident memory after each frame.
    peak_mb : float
        Most resident memory that the process ever had.
    cpu_s : float
        Seconds of processor time, over all threads.
    trajectory_sha256 : str
        Of the trajectory's file.
    """

    name: str
    metrics: dict[str, Any]
    frame_ms: list[float]
    frame_cpu_ms: list[float]
    interval_ms: list[float]
    memory_mb: list[float]
    peak_mb: float
    cpu_s: float
    trajectory_sha256: str


@dataclass
class _Watch:
    """Records time and memory after each frame."""

    times_s: list[float] = field(default_factory=lambda: [time.perf_counter()])
    memory_mb: list[float] = field(default_factory=list)

    def __call__(self, done: int, total: int, remark: str) -> None:
        self.times_s.append(time.perf_counter())
        self.memory_mb.append(resident_mb("VmRSS"))


def bench_once(job: BenchJob) -> BenchRun:
    """Run a sequence once, without a viewer or a recording, and return what it took.

    Raises
    ------
    RoomgraphError
        The sequence or the model cannot be read.
    """
    from roomgraph.app.run.pipeline import Pipeline
    from roomgraph.app.run.session import examined, with_features_of
    from roomgraph.app.storage.recorder import Recorder
    from roomgraph.app.storage.run_folder import RunFolder
    from roomgraph.app.viewer.viewer import NoViewer
    from roomgraph.datasets.replay import PingPongReplay
    from roomgraph.datasets.sequence import Sequence
    from roomgraph.semantics.recognition.model_files import load_model

    sequence: Sequence = job.input.open()
    if job.laps:
        sequence = PingPongReplay(sequence, job.laps)
    model = load_model(job.model) if job.model is not None else None
    settings = with_features_of(model, job.settings)
    sequence = examined(sequence, settings).sequence
    with TemporaryDirectory() as scratch:
        folder, watch = RunFolder(Path(scratch)), _Watch()
        pipeline = Pipeline(
            sequence,
            settings,
            model=model,
            recorder=Recorder(folder),
            viewer=NoViewer(),
            progress=watch,
        )
        before = time.process_time()
        metrics = pipeline.run()
        cpu_s = time.process_time() - before
        trajectory = folder.trajectory.read_bytes()
    return BenchRun(
        sequence.name, metrics,
        frame_ms=_frame_ms(pipeline.clock),
        frame_cpu_ms=_frame_ms(pipeline.clock, cpu=True),
        interval_ms=[1e3 * (b - a) for a, b in pairwise(watch.times_s)],
        memory_mb=watch.memory_mb,
        peak_mb=resident_mb("VmHWM"), cpu_s=cpu_s,
        trajectory_sha256=hashlib.sha256(trajectory).hexdigest(),
    )  # fmt: skip


def _frame_ms(clock: StageClock, cpu: bool = False) -> list[float]:
    """Return what each frame took; both stages take the frames in their order."""
    stages = [clock.samples_s(stage, cpu) for stage in FRAME_STAGES]
    return [1e3 * sum(parts) for parts in zip(*stages, strict=True)]


def resident_mb(what: str) -> float:
    """Return resident memory now (``VmRSS``) or at most so far (``VmHWM``), MB of 2**20 bytes.

    Where the system does not tell, both are the peak since the process began.
    """
    try:
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith(what + ":"):
                return int(line.split()[1]) / 1024
    except OSError:
        pass
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
