"""Several timed runs of sequences, and their summary."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from datetime import UTC, datetime
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from roomgraph.app.allocation import keep_memory
from roomgraph.app.bench.worker import BenchJob, BenchRun, bench_once
from roomgraph.app.errors import AppError

SCHEMA = "roomgraph/bench/1"
# The frames that the beginning and the end of a run are judged by.
TENTH = 0.1
ACCURACY = ("ate_rmse_m", "rpe_trans_rmse_m", "rpe_rot_rmse_deg")


def run_all(
    jobs: Sequence[BenchJob], repeats: int, advance: Callable[[int, int, str], None]
) -> list[list[BenchRun]]:
    """Run each job `repeats` times, one after the other; return the runs of each.

    The repeats of a job are spread over the whole time, so that a busy spell of the machine does
    not fall on one job alone.
    """
    runs: list[list[BenchRun]] = [[] for _ in jobs]
    for repeat in range(repeats):
        for number, job in enumerate(jobs):
            advance(repeat * len(jobs) + number, repeats * len(jobs), job.input.sequence.name)
            runs[number].append(bench_alone(job))
    advance(repeats * len(jobs), repeats * len(jobs), "")
    return runs


def bench_alone(job: BenchJob) -> BenchRun:
    """Run a job in a new process, so that its memory is its own.

    Raises
    ------
    RoomgraphError
        The sequence or the model cannot be read, or the process was ended from outside.
    """
    try:
        with ProcessPoolExecutor(
            1, mp_context=get_context("spawn"), initializer=keep_memory
        ) as pool:
            return pool.submit(bench_once, job).result()
    except BrokenProcessPool as error:
        raise AppError(
            "the benchmark process was killed",
            where=job.input.sequence,
            expected="a complete run",
            got="a process that ended early",
            hint="probably out of memory: close other programs, or use fewer --frames",
        ) from error


def summarise(runs: Sequence[BenchRun], job: BenchJob) -> dict[str, Any]:
    """Return the results of a job: medians over its repeats.

    `deterministic` says whether all repeats gave the same trajectory file to the byte; it is None
    for a single one.
    """
    first = runs[0].metrics
    summary: dict[str, Any] = {
        "sequence": runs[0].name,
        "model": str(job.model) if job.model is not None else None,
        "laps": job.laps,
        "repeats": len(runs),
        "frames": first["frames"],
        "path_length_m": _middle(run.metrics["path_length_m"] for run in runs),
        "fps": _middle(run.metrics["fps"] for run in runs),
        "seconds_total": _middle(run.metrics["seconds_total"] for run in runs),
        "cpu_ms_per_frame": _middle(1e3 * run.cpu_s / run.metrics["frames"] for run in runs),
        "frame_ms": _spread([run.frame_ms for run in runs]),
        "frame_cpu_ms": _spread([run.frame_cpu_ms for run in runs]),
        "interval_ms": _spread([run.interval_ms for run in runs]),
        "stage_ms": _stages(runs),
        "peak_rss_mb": _middle(run.peak_mb for run in runs),
        "memory_mb": _growth([run.memory_mb for run in runs]),
        "keyframes": _middle(run.metrics["keyframes"] for run in runs),
        "share_lost": _middle(
            1 - run.metrics["frames_tracked"] / run.metrics["frames"] for run in runs
        ),
        "deterministic": len({run.trajectory_sha256 for run in runs}) == 1
        if len(runs) > 1
        else None,
    }
    for name in ACCURACY:
        if all(name in run.metrics for run in runs):
            summary[name] = _middle(run.metrics[name] for run in runs)
    return summary


def report(summaries: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Return the output of `bench --json`: results, date and machine."""
    return {
        "schema": SCHEMA,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "machine": {
            "processor": _processor(),
            "cores": os.cpu_count(),
            "python": platform.python_version(),
            "system": platform.platform(),
        },
        "sequences": list(summaries),
    }


def frame_times(runs: Sequence[BenchRun]) -> list[dict[str, list[float]]]:
    """Return the time and the memory of each frame, in order, for each repeat."""
    return [
        {
            "frame_ms": [round(value, 3) for value in run.frame_ms],
            "frame_cpu_ms": [round(value, 3) for value in run.frame_cpu_ms],
            "interval_ms": [round(value, 3) for value in run.interval_ms],
            "memory_mb": [round(value, 1) for value in run.memory_mb],
        }
        for run in runs
    ]


def labelling_cost(summaries: Sequence[dict[str, Any]]) -> dict[str, float]:
    """Return the extra time of each sequence with a model, as a share of that without."""
    without = {s["sequence"]: s["seconds_total"] for s in summaries if s["model"] is None}
    return {
        s["sequence"]: round(s["seconds_total"] / without[s["sequence"]] - 1, 4)
        for s in summaries
        if s["model"] is not None and without.get(s["sequence"])
    }


def _spread(repeats: Sequence[Sequence[float]]) -> dict[str, float]:
    """Return median, 95th percentile, and the medians of the first and last tenth and their ratio.

    Of each, the median over the repeats.
    """
    return {
        "median": _middle(np.median(values) for values in repeats),
        "p95": _middle(np.percentile(values, 95) for values in repeats),
        **_growth(repeats),
    }


def _growth(repeats: Sequence[Sequence[float]]) -> dict[str, float]:
    first = [float(np.median(values[: _tenth(values)])) for values in repeats]
    last = [float(np.median(values[-_tenth(values) :])) for values in repeats]
    ratio = _middle(b / a for a, b in zip(first, last, strict=True))
    return {"first_tenth": _middle(first), "last_tenth": _middle(last), "growth": ratio}


def _tenth(values: Sequence[float]) -> int:
    return max(1, round(TENTH * len(values)))


def _stages(runs: Sequence[BenchRun]) -> dict[str, dict[str, float]]:
    """Return for each stage the medians over the repeats of its median, 95th percentile, total."""
    tables = [run.metrics["stage_ms"] for run in runs]
    return {
        stage: {
            key: _middle(table[stage][key] for table in tables if stage in table)
            for key in ("median", "p95", "total", "count")
        }
        for stage in tables[0]
    }


def _middle(values: Iterable[ArrayLike]) -> float:
    return round(float(np.median([float(np.asarray(value)) for value in values])), 6)


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
