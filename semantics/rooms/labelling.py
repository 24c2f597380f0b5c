"""Room labelling: labels of regions, from the votes of the frames taken in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy import ndimage

from roomgraph.datasets.settings import Settings
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.rooms.outlines import largest_piece
from roomgraph.semantics.rooms.regions import Regions
from roomgraph.semantics.rooms.settings import RegionSettings

FloatArray = NDArray[np.float64]


class RoomSettings(Settings):
    """How regions of the floor get their labels."""

    regions: RegionSettings = RegionSettings()
    min_agreement: float = Field(
        default=0.7,
        gt=0,
        le=1,
        description="share of a region's votes above which the whole region gets one label",
    )
    min_part: float = Field(
        default=0.2,
        gt=0,
        le=1,
        description="minimum share of a region's votes for a part of it to get its own label",
    )
    min_part_m2: float = Field(
        default=8.0,
        ge=0,
        description="minimum connected floor area for such a part, square metres",
    )
    min_doorway_m: float = Field(
        default=0.4, ge=0, description="narrower gaps are not doorways, metres"
    )


@dataclass(frozen=True, slots=True)
class Vote:
    """The vote of a frame for the label of its position (world, metres)."""

    frame: int
    position_world: FloatArray
    label: str
    score: float


@dataclass(slots=True)
class LabelledRegion:
    """A labelled region: its number in the image of regions, its label, and its nodes."""

    number: int
    label: str
    score: float
    nodes: list[int]


def label_rooms(
    graph: SemanticGraph,
    node_cells: NDArray[np.intp],
    regions: Regions,
    of_nodes: NDArray[np.int32],
    of_frames: NDArray[np.int32],
    votes: Sequence[Vote],
    cell_m: float,
    settings: RoomSettings,
) -> tuple[list[LabelledRegion], Regions]:
    """Label each visited region, or several parts of it; return them with their images.

    A part of an open plan is a room's worth of floor in one piece. Labels that hold less, here and
    there, are what views of the one room were mistaken for.
    """
    seen, full = np.zeros_like(regions.seen), np.zeros_like(regions.full)
    labelled: list[LabelledRegion] = []
    for region in dict.fromkeys(int(r) for r in of_nodes if r):
        here = [votes[int(i)] for i in np.flatnonzero(of_frames == region)]
        inside = np.flatnonzero(of_nodes == region)
        shares = _shares(here)
        kept = [label for label, share in shares.items() if share >= settings.min_part]
        kept = [label for label in kept if any(graph.nodes[i].label == label for i in inside)]
        if not kept or max(shares.values()) >= settings.min_agreement:
            kept = [max(shares, key=lambda label: shares[label])] if shares else [UNKNOWN]
        kept, nearest = _parted(
            kept,
            shares=shares,
            graph=graph,
            node_cells=node_cells,
            inside=inside,
            region=regions.full == region,
            least_cells=settings.min_part_m2 / cell_m**2,
        )
        for which, label in enumerate(kept):
            number = len(labelled) + 1
            for image, source in ((seen, regions.seen), (full, regions.full)):
                image[(source == region) & (nearest == which)] = number
            at = nearest[tuple(np.clip(node_cells[inside], 0, np.array(seen.shape) - 1).T)]
            chosen = inside[at == which].tolist()
            labelled.append(LabelledRegion(number, label, _score(here, label), chosen))
    return sorted(labelled, key=lambda part: min(part.nodes, default=len(graph.nodes))), Regions(
        seen, full
    )


def _parted(
    labels: list[str],
    shares: Mapping[str, float],
    graph: SemanticGraph,
    node_cells: NDArray[np.intp],
    inside: NDArray[np.intp],
    region: NDArray[np.bool_],
    least_cells: float,
) -> tuple[list[str], NDArray[np.intp]]:
    """Return the labels with enough area in a region, and the label of each cell (R, C).

    The one most voted for always does.
    """
    while True:
        nearest = _nearest_label(graph, node_cells, inside, labels, region.shape)
        strongest = max(labels, key=lambda label: shares.get(label, 0.0))
        small = [
            label
            for k, label in enumerate(labels)
            if label != strongest
            and np.count_nonzero(largest_piece(region & (nearest == k))) < least_cells
        ]
        if not small:
            return labels, nearest
        weakest = min(small, key=lambda label: shares[label])
        labels = [label for label in labels if label != weakest]


def _shares(votes: Sequence[Vote]) -> dict[str, float]:
    """Return the share of each label in the votes, unknown left out."""
    counts: dict[str, float] = {}
    for vote in votes:
        if vote.label != UNKNOWN:
            counts[vote.label] = counts.get(vote.label, 0.0) + vote.score
    total = sum(counts.values())
    return {label: count / total for label, count in counts.items()} if total else {}


def _score(votes: Sequence[Vote], label: str) -> float:
    agreeing = sum(vote.score for vote in votes if vote.label == label)
    return float(agreeing / len(votes)) if votes and label != UNKNOWN else 0.0


def _nearest_label(
    graph: SemanticGraph,
    node_cells: NDArray[np.intp],
    inside: NDArray[np.intp],
    kept: list[str],
    shape: tuple[int, ...],
) -> NDArray[np.intp]:
    """Return the index in `kept` of the label of the node nearest to each cell (R, C)."""
    if len(kept) == 1:
        return np.zeros(shape, dtype=np.intp)
    away = []
    for label in kept:
        free = np.ones(shape, dtype=bool)
        for i in inside:
            if graph.nodes[i].label == label:
                free[tuple(np.clip(node_cells[i], 0, np.array(shape) - 1))] = False
        away.append(ndimage.distance_transform_edt(free))
    return np.asarray(np.argmin(away, axis=0))
