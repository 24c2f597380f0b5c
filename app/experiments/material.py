"""The data of an experiment: walks with described images, and the describer."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from roomgraph.app.console import Terminal
from roomgraph.app.experiments.data import Collection, Describer
from roomgraph.app.experiments.walks import (
    DESCRIPTOR_SEED,
    STRIDE,
    Walk,
    data_walks,
    rendered_walks,
)
from roomgraph.app.settings import AppSettings
from roomgraph.semantics.evaluation.splits import EvaluationSet, SplitResult
from roomgraph.semantics.recognition.model import PlaceModel

DESCRIPTOR_NOTE = "The descriptor is trained on images that are not used for testing: {}."


@dataclass(frozen=True, slots=True)
class Material:
    """The data of an experiment."""

    describer: Describer
    walks: list[Walk]
    collection: Collection
    evaluation_set: EvaluationSet
    data: tuple[str, ...]
    notes: tuple[str, ...]
    settings: AppSettings
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
        """Return a model trained on all buildings but one, with the descriptor of the data."""
        kept = [i for i, walk in enumerate(self.collection.walks) if walk.building != building]
        return self.describer.relearned(
            [self.collection.images[i] for i in kept], self.collection.vectors[kept],
            [self.collection.walks[i].building for i in kept], self.settings.seed,
        )  # fmt: skip


def gather(
    settings: AppSettings,
    data: Sequence[Path],
    terminal: Terminal,
    seeds: Sequence[int],
    stride: int,
) -> Material:
    """Return the user's data or rendered buildings, described with the given settings.

    Parameters
    ----------
    settings : AppSettings
        How images are described and labelled.
    data : sequence of Path
        The user's folders or sequences; none for rendered buildings.
    terminal : Terminal
        Shows progress.
    seeds : sequence of int
        Of the rendered buildings.
    stride : int
        Every n-th image of a rendered walk is taken.
    """
    if data:
        walks = data_walks(data)
        learned = [e for walk in walks for e in walk.examples[::STRIDE]]
        note = "The descriptor is trained on a quarter of all images, without their labels."
    else:
        walks = rendered_walks(seeds, terminal)
        aside = rendered_walks((DESCRIPTOR_SEED,), terminal)
        learned = [e for walk in aside for e in walk.examples[::STRIDE]]
        note = DESCRIPTOR_NOTE.format(f"building {DESCRIPTOR_SEED}")
    describer = Describer(settings, learned, terminal)
    collection = describer.collect(walks, 1 if data else stride)
    names = tuple(str(root) for root in data) or tuple(
        f"rendered {name}" for name in dict.fromkeys(walk.building for walk in walks)
    )
    return Material(
        describer=describer, walks=walks, collection=collection,
        evaluation_set=collection.evaluation_set(), data=names, notes=(note,),
        settings=settings, terminal=terminal,
    )  # fmt: skip
