"""What the experiments work on: walks, described, and the words they are described by."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from roomgraph.app.console import Terminal
from roomgraph.app.experiments.data import Collection, Describer
from roomgraph.app.experiments.walks import STRIDE, WORD_SEED, Walk, data_walks, rendered_walks
from roomgraph.semantics.evaluation.splits import EvaluationSet, SplitResult
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.semantics.recognition.presets import Preset

WORDS_NOTE = "The words are learned from images that are never tested: {}."


@dataclass(frozen=True, slots=True)
class Material:
    """What an experiment works on."""

    describer: Describer
    walks: list[Walk]
    collection: Collection
    evaluation_set: EvaluationSet
    data: tuple[str, ...]
    notes: tuple[str, ...]
    seed: int
    terminal: Terminal

    def watched(
        self, title: str, found: Iterator[SplitResult], total: int
    ) -> tuple[SplitResult, ...]:
        """Return all results, with a progress bar."""
        done = []
        with self.terminal.progress(title) as advance:
            for result in found:
                done.append(result)
                advance(len(done), total, result.row)
        return tuple(done)

    def model_without(self, building: str) -> PlaceModel:
        """Return a model of all buildings but one; the words are those of the evaluation_set."""
        kept = [i for i, walk in enumerate(self.collection.walks) if walk.building != building]
        return self.describer.relearned(
            [self.collection.images[i] for i in kept], self.collection.vectors[kept],
            [self.collection.walks[i].building for i in kept], self.seed,
        )  # fmt: skip


def gather(
    preset: Preset,
    data: Sequence[Path],
    seed: int,
    terminal: Terminal,
    seeds: Sequence[int],
    stride: int,
) -> Material:
    """Return the user's data, or rendered buildings, described by a preset.

    Parameters
    ----------
    preset : {"best", "paper"}
        How images are described.
    data : sequence of Path
        The user's folders or sequences; none for rendered buildings.
    seed : int
        Of the words.
    terminal : Terminal
        Shows progress.
    seeds : sequence of int
        Of the rendered buildings.
    stride : int
        Every so many images of a rendered walk are taken.
    """
    if data:
        walks = data_walks(data)
        words = [e for walk in walks for e in walk.examples[::STRIDE]]
        note = "The words are learned from a quarter of all images, without their labels."
    else:
        walks = rendered_walks(seeds, terminal)
        words = [e for w in rendered_walks((WORD_SEED,), terminal) for e in w.examples[::STRIDE]]
        note = WORDS_NOTE.format(f"building {WORD_SEED}")
    describer = Describer(preset, words, seed, terminal)
    collection = describer.collect(walks, 1 if data else stride)
    names = tuple(str(root) for root in data) or tuple(
        f"rendered {name}" for name in dict.fromkeys(walk.building for walk in walks)
    )
    return Material(
        describer, walks, collection, collection.evaluation_set(), names, (note,), seed, terminal
    )
