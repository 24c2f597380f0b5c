"""Corrections of a run by the user: `roomgraph label MODEL RUN --set office2=library`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from roomgraph.app.console import Advance
from roomgraph.app.errors import AppError
from roomgraph.app.settings import load_settings
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.semantics.graph.correction import Correction, correct
from roomgraph.semantics.graph.files import read_graph_json, write_graph_json, write_graphml
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import write_labels
from roomgraph.semantics.recognition.exemplars import learn_more
from roomgraph.semantics.recognition.model import PlaceModel

# Images of a corrected place that the model learns from, evenly spread.
MOST_IMAGES = 60


def parse_changes(texts: Sequence[str]) -> dict[str, str]:
    """Return the new label of each place from texts like ``office2=library``.

    Raises
    ------
    AppError
        A text is not of that form.
    """
    changes = {}
    for text in texts:
        place, _, label = (part.strip() for part in text.partition("="))
        if not place or not label:
            raise AppError(
                "invalid correction", where="--set", expected="PLACE=LABEL", got=repr(text)
            )
        changes[place] = label
    return changes


def corrections_of(folder: RunFolder, changes: Mapping[str, str]) -> list[Correction]:
    """Return what renaming places of a run does to its graph, one after the other.

    Nothing is written.

    Raises
    ------
    AppError, SemanticsError
        The folder is no run's, or its graph has no such place.
    """
    graph = read_graph_json(folder.existing(folder.graph_json))
    settings = load_settings(folder.existing(folder.config), only=["semantics.labeller"])
    corrections = []
    for place, label in changes.items():
        correction = correct(graph, place, label, settings.semantics.labeller.change_m)
        corrections.append(correction)
        graph = correction.graph
    return corrections


def write_corrected(folder: RunFolder, graph: SemanticGraph) -> None:
    """Write a run's graph and labels again.

    The cloud and the table of frames stay as they were recorded.
    """
    write_graph_json(folder.graph_json, graph)
    write_graphml(folder.graphml, graph)
    write_labels(folder.labels, graph.labels)


def learn_from_run(
    model: PlaceModel,
    folder: RunFolder,
    corrections: Sequence[Correction],
    seed: int,
    advance: Advance,
) -> PlaceModel:
    """Return a model trained further on images of the corrected places of a run.

    Raises
    ------
    SemanticsError
        The model keeps no exemplars.
    """
    sequence = folder.read_input().open()
    for correction in corrections:
        label = next(n.label for n in correction.graph.nodes if n.id in correction.told)
        frames = frames_of_nodes(correction.graph, correction.told, len(sequence))
        vectors = []
        for done, frame in enumerate(frames, 1):
            vector = model.vector(sequence[frame].colour)
            if vector is not None:
                vectors.append(vector)
            advance(done, len(frames), label)
        model = learn_more(model, vectors, label, f"{sequence.root}#{correction.place}", seed)
    return model


def frames_of_nodes(graph: SemanticGraph, told: Sequence[int], count: int) -> list[int]:
    """Return at most `MOST_IMAGES` of `count` frames, those nearest to the nodes `told`."""
    at = np.array([node.frame for node in graph.nodes])
    nearest = np.abs(np.arange(count)[:, None] - at[None]).argmin(axis=1)
    wanted = np.isin([node.id for node in graph.nodes], told)[nearest]
    frames = np.flatnonzero(wanted)
    kept = np.unique(np.linspace(0, len(frames) - 1, min(MOST_IMAGES, len(frames))).astype(int))
    return [int(frame) for frame in frames[kept]]


def describe_correction(correction: Correction, before: str) -> str:
    """Return one line about the effect of a correction."""
    also = f" and {len(correction.inferred)} neighbouring" if correction.inferred else ""
    return f"{before} is now {correction.place}: {len(correction.told)} nodes{also}"
