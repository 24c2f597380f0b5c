"""The experiment of the paper's Fig. 9: number of visual words and cost."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from roomgraph.app.console import Terminal
from roomgraph.app.experiments.walks import DESCRIPTOR_SEED, STRIDE, data_walks, rendered_walks
from roomgraph.app.rounding import rounded
from roomgraph.datasets.files import replacing, write_text
from roomgraph.semantics.descriptors.neural_gas import NeuralGas
from roomgraph.semantics.recognition.preparation import prepare_images
from roomgraph.semantics.recognition.presets import PRESETS

NAME = "vocabulary"
NUMBERS = (10, 25, 50, 100, 200, 400)
SEEDS = (0, 1, 2)
# It takes minutes and hardly differs between seeds: once is enough.
ONCE = ("k-means",)
# Maximum number of descriptors sampled, from every n-th image of the walks.
MOST, IMAGE_STRIDE = 200_000, STRIDE // 2
# The number of words that the paper settles on.
CHOSEN = 100
# Samples a step of mini-batch k-means (its default).
BATCH = 1024


@dataclass(frozen=True, slots=True)
class Quantised:
    """One vocabulary: its method, its size and its quality.

    `samples` is the shape of the descriptors; `accuracy` the share of their variance that their
    words account for.
    """

    method: str
    vectors: int
    seed: int
    samples: tuple[int, ...]
    accuracy: float
    error: float
    cpu_s: float


def run_vocabulary(data: list[Path], terminal: Terminal) -> list[Quantised]:
    """Train vocabularies of several sizes by Neural Gas, k-means and mini-batch k-means."""
    descriptors = _descriptors(data, terminal)
    variance = float(descriptors.var(axis=0, dtype=np.float64).sum())
    found = []
    # One thread for all: threads that wait for others would be counted as CPU time.
    with threadpool_limits(1), terminal.progress("Training vocabularies") as advance:
        methods = _methods()
        plan = [
            (number, seed, name)
            for number in NUMBERS
            for seed in SEEDS
            for name in methods
            if name not in ONCE or seed == SEEDS[0]
        ]
        for number, seed, name in plan:
            started = time.process_time()
            error = methods[name](number, seed)(descriptors)
            seconds = time.process_time() - started
            found.append(
                Quantised(
                    method=name,
                    vectors=number,
                    seed=seed,
                    samples=descriptors.shape,
                    accuracy=1 - error / variance,
                    error=error,
                    cpu_s=seconds,
                )
            )
            advance(len(found), len(plan), f"{name}, {number} vectors")
    return found


def write_vocabulary(directory: Path, found: list[Quantised], data: list[Path]) -> dict[str, Any]:
    """Write vocabulary.json, vocabulary.md and vocabulary.png."""
    directory.mkdir(parents=True, exist_ok=True)
    rows = [_row(found, method, number) for number in NUMBERS for method in _methods()]
    chosen = {row["method"]: row for row in rows if row["vectors"] == CHOSEN}
    gas = chosen["Neural Gas"]
    slower = gas["cpu_s"] / chosen["mini-batch k-means"]["cpu_s"]
    worse = gas["error"] / chosen["k-means"]["error"]
    count, length = found[0].samples
    content = {
        "schema": "roomgraph/protocol/1",
        "protocol": NAME,
        "data": [str(root) for root in data] or [f"rendered building{DESCRIPTOR_SEED}"],
        "descriptors": [count, length],
        "accuracy_mean": gas["accuracy_mean"],
        "accuracy_std": gas["accuracy_std"],
        "per_class": {},
        "time_over_mini_batch_k_means": round(slower, 2),
        "error_over_k_means": round(worse, 4),
        "rows": rows,
        "notes": [
            f"At {CHOSEN} vectors, of {count:,} descriptors of {length} numbers, Neural Gas takes "
            f"{slower:.2f} times as long as mini-batch k-means; its error is {worse:.3f} times "
            "that of k-means.",
            "Accuracy: share of the variance of the descriptors that their words explain, at "
            f"{CHOSEN} Neural Gas vectors in the headline. Times: CPU seconds of one thread, "
            f"median. Mini-batch k-means is scikit-learn's, {BATCH} samples per step, and stops "
            "when it no longer improves.",
        ],
    }
    write_text(directory / f"{NAME}.json", json.dumps(content, indent=1) + "\n")
    write_text(directory / f"{NAME}.md", vocabulary_markdown(content))
    _draw(directory / f"{NAME}.png", rows)
    return content


def vocabulary_markdown(content: dict[str, Any]) -> str:
    """Return the table as Markdown."""
    lines = [
        f"# {NAME}", "", f"Data: {', '.join(content['data'])}.", "",
        "| vectors | method | accuracy | std | quantisation error | CPU s |",
        "| ---: | --- | ---: | ---: | ---: | ---: |",
    ]  # fmt: skip
    lines += [
        f"| {r['vectors']} | {r['method']} | {r['accuracy_mean']:.1%} | {r['accuracy_std']:.2%} | "
        f"{r['error']:.0f} | {r['cpu_s']:.2f} |"
        for r in content["rows"]
    ]
    return "\n".join([*lines, "", *(f"- {note}" for note in content["notes"])]) + "\n"


def _descriptors(data: list[Path], terminal: Terminal) -> NDArray[np.float32]:
    walks = data_walks(data) if data else rendered_walks((DESCRIPTOR_SEED,), terminal)
    paper = PRESETS["paper"]
    descriptor = paper.training.make_descriptor(paper.features)
    examples = [e for walk in walks for e in walk.examples[::IMAGE_STRIDE]]
    with terminal.progress("Describing images") as advance:
        images = prepare_images(
            examples, descriptor, paper.training.threads, to_fit=True,
            progress=lambda done, total: advance(done, total, "images"),
        )  # fmt: skip
    found = np.vstack([i.content for i in images if i is not None and i.content is not None])
    rows = np.random.default_rng(0).permutation(len(found))[:MOST]
    return np.ascontiguousarray(found[rows])


def _methods() -> dict[str, Callable[[int, int], Callable[[NDArray[np.float32]], float]]]:
    """Return functions that train words and return their mean squared error."""
    from sklearn.cluster import KMeans, MiniBatchKMeans

    return {
        "Neural Gas": lambda n, s: (
            lambda X: float(NeuralGas(n, random_state=s).fit(X).quantization_error_)
        ),
        "k-means": lambda n, s: (
            lambda X: float(KMeans(n, n_init=1, random_state=s).fit(X).inertia_ / len(X))
        ),
        "mini-batch k-means": lambda n, s: (
            lambda X: float(
                -MiniBatchKMeans(n, n_init=1, batch_size=BATCH, random_state=s).fit(X).score(X)
                / len(X)
            )
        ),
    }


def _row(found: list[Quantised], method: str, number: int) -> dict[str, Any]:
    own = [q for q in found if q.method == method and q.vectors == number]
    accuracy = [q.accuracy for q in own]
    return {
        "method": method,
        "vectors": number,
        "accuracy_mean": rounded(np.mean(accuracy)),
        "accuracy_std": rounded(np.std(accuracy)),
        "error": rounded(np.mean([q.error for q in own]), 2),
        "cpu_s": rounded(np.median([q.cpu_s for q in own]), 3),
    }


def _draw(path: Path, rows: list[dict[str, Any]]) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 4), layout="constrained")
    accuracy, times = figure.subplots(1, 2)
    for method in _methods():
        own = [row for row in rows if row["method"] == method]
        numbers = [row["vectors"] for row in own]
        accuracy.errorbar(
            numbers, [100 * row["accuracy_mean"] for row in own],
            [100 * row["accuracy_std"] for row in own], fmt="o-", capsize=3, label=method,
        )  # fmt: skip
        times.plot(numbers, [row["cpu_s"] for row in own], "o-", label=method)
    accuracy.set(xscale="log", xlabel="vectors", ylabel="explained variance (%)")
    times.set(xscale="log", yscale="log", xlabel="vectors", ylabel="CPU time (s)")
    for axis in (accuracy, times):
        axis.set_xticks(NUMBERS, [str(number) for number in NUMBERS])
        axis.minorticks_off()
        axis.spines[["top", "right"]].set_visible(False)
        axis.grid(alpha=0.3)
    accuracy.legend(frameon=False)
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=110)
