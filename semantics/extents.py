"""Giving places their floor, and joining them by doorways, once a run's map is finished."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy import ndimage

from datasets import poses
from datasets.settings import Settings
from semantics.doorways import find_doorways
from semantics.graph import UNLABELLED, Extent, GraphNode, SemanticGraph
from semantics.labels import UNKNOWN
from semantics.regions import Regions, RegionSettings, segment
from semantics.watershed import RegionImage
from slam.survey import Survey

FloatArray = NDArray[np.float64]
# A spot's distance to the walls, as a share of the largest, from which it is far from them.
_INNERMOST = 0.8


class ExtentSettings(Settings):
    """How places and regions of the floor go together."""

    regions: RegionSettings = RegionSettings()
    min_agreement: float = Field(
        0.7, gt=0, le=1, description="of a region's votes, the share that makes it one place"
    )
    min_part: float = Field(
        0.2,
        gt=0,
        le=1,
        description="of a region's votes, the share that a part of it needs",
    )
    min_doorway_m: float = Field(0.4, ge=0, description="narrower gaps are no doorways")


@dataclass(frozen=True, slots=True)
class Vote:
    """What frame number `frame` says of the spot that it was taken from (world, metres)."""

    frame: int
    position_world: FloatArray
    label: str
    score: float


@dataclass(slots=True)
class _Part:
    """A place to be: its number in the image of parts, its label, and its nodes."""

    number: int
    label: str
    score: float
    nodes: list[int]


def with_extents(
    graph: SemanticGraph, surveyed: Survey, votes: Sequence[Vote], settings: ExtentSettings
) -> SemanticGraph:
    """Return the graph with extents and doorways, its nodes at the place that they lie in.

    All that lies in one room belongs to one place, whatever a single view looked like: this mends
    what a view through a door into the next room got wrong, and a room entered by two doors or
    twice is one. Where no label prevails in a region, as in an open plan, the region is parted
    between the labels by the nearest node.

    Parameters
    ----------
    graph : SemanticGraph
        As it came from the path.
    surveyed : Survey
        Free space and map frame of the finished map.
    votes : sequence of Vote
        Of all frames with a pose in the map that was surveyed. Nodes of other frames lie in a
        sub-map that never met it: they keep their places, under names of their own.
    settings : ExtentSettings
        How regions are cut, and when they are one place.
    """
    if not graph.nodes:
        return graph
    space, T = surveyed.space, surveyed.ground.T_map_world
    positions = np.array([vote.position_world for vote in votes]).reshape(-1, 3)
    cells = space.cells_of(poses.transform(T, positions))
    regions = segment(space, _by_cell(cells, votes, space.hits.shape[1:]), settings.regions)
    nodes_map = poses.transform(T, graph.positions)
    node_cells = space.cells_of(nodes_map)
    reach = settings.regions.detail_m / space.cell_m
    of_frames = _lookup(regions.seen, cells, reach)
    voted = {vote.frame for vote in votes}
    is_here = np.array([node.frame in voted for node in graph.nodes])
    of_nodes = np.where(is_here, _lookup(regions.seen, node_cells, reach), 0)
    parts, images = _parts(graph, node_cells, regions, of_nodes, of_frames, votes, settings)
    names = _names(parts)
    nodes = _placed(graph, parts, names, is_here)
    extents = tuple(
        _extent(names[i], part, graph, images.full == part.number, surveyed)
        for i, part in enumerate(parts)
        if (images.full == part.number).any()
    )
    numbers = {part.number: names[i] for i, part in enumerate(parts)}
    doorways = find_doorways(
        images.seen, numbers, nodes, nodes_map, surveyed, settings.min_doorway_m
    )
    return replace(graph, nodes=nodes, extents=extents, doorways=doorways, T_map_world=T)


def _by_cell(
    cells: NDArray[np.intp], votes: Sequence[Vote], shape: tuple[int, ...]
) -> dict[tuple[int, int], Counter[str]]:
    """Count the votes of each cell of the grid, weighed by their scores."""
    counts: dict[tuple[int, int], Counter[str]] = {}
    for (row, column), vote in zip(cells.tolist(), votes, strict=True):
        if 0 <= row < shape[0] and 0 <= column < shape[1]:
            here = counts.setdefault((row, column), Counter())
            if vote.label != UNKNOWN:
                here[vote.label] += vote.score  # type: ignore[assignment]
    return counts


def _lookup(regions: RegionImage, cells: NDArray[np.intp], reach: float) -> NDArray[np.int32]:
    """Return the region (N,) that cells (N, 2) lie in or next to; 0 for none within reach."""
    if not regions.any():
        return np.zeros(len(cells), dtype=np.int32)
    distance, nearest = ndimage.distance_transform_edt(regions == 0, return_indices=True)
    row, column = np.clip(cells, 0, np.array(regions.shape) - 1).T
    found = regions[nearest[0][row, column], nearest[1][row, column]]
    return np.where(distance[row, column] <= reach, found, 0)


def _parts(
    graph: SemanticGraph,
    node_cells: NDArray[np.intp],
    regions: Regions,
    of_nodes: NDArray[np.int32],
    of_frames: NDArray[np.int32],
    votes: Sequence[Vote],
    settings: ExtentSettings,
) -> tuple[list[_Part], Regions]:
    """Make a part of each visited region, or several; return them with their images."""
    seen, full = np.zeros_like(regions.seen), np.zeros_like(regions.full)
    parts: list[_Part] = []
    for region in dict.fromkeys(int(r) for r in of_nodes if r):
        here = [votes[int(i)] for i in np.flatnonzero(of_frames == region)]
        inside = np.flatnonzero(of_nodes == region)
        shares = _shares(here)
        kept = [label for label, share in shares.items() if share >= settings.min_part]
        kept = [label for label in kept if any(graph.nodes[i].label == label for i in inside)]
        if not kept or max(shares.values()) >= settings.min_agreement:
            kept = [max(shares, key=lambda label: shares[label])] if shares else [UNKNOWN]
        nearest = _nearest_label(graph, node_cells, inside, kept, regions.seen.shape)
        for which, label in enumerate(kept):
            number = len(parts) + 1
            for image, source in ((seen, regions.seen), (full, regions.full)):
                image[(source == region) & (nearest == which)] = number
            at = nearest[tuple(np.clip(node_cells[inside], 0, np.array(seen.shape) - 1).T)]
            chosen = inside[at == which].tolist()
            parts.append(_Part(number, label, _score(here, label), chosen))
    return sorted(parts, key=lambda part: min(part.nodes, default=len(graph.nodes))), Regions(
        seen, full
    )


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
    """Return which of the labels `kept` the node nearest to each cell (R, C) has."""
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


def _names(parts: Sequence[_Part]) -> list[str]:
    """Return names that number the places of each label in the order of first passing."""
    count: Counter[str] = Counter()
    names = []
    for part in parts:
        kind = UNLABELLED if part.label == UNKNOWN else part.label
        count[kind] += 1
        names.append(f"{kind}{count[kind]}")
    return names


def _placed(
    graph: SemanticGraph,
    parts: Sequence[_Part],
    names: Sequence[str],
    is_here: NDArray[np.bool_],
) -> tuple[GraphNode, ...]:
    """Put each node into its part; one that lies in none goes with the node before or after it."""
    of_node = {i: k for k, part in enumerate(parts) for i in part.nodes}
    known = np.array(sorted(of_node), dtype=np.intp)
    taken = set(names)
    elsewhere: dict[str, str] = {}
    nodes = []
    for i, node in enumerate(graph.nodes):
        if not is_here[i] or not len(known):
            if node.place not in elsewhere:
                elsewhere[node.place] = _free_name(node, taken)
            nodes.append(replace(node, place=elsewhere[node.place]))
            continue
        k = of_node[int(known[np.abs(known - i).argmin()])]
        label = parts[k].label
        nodes.append(replace(node, place=names[k], label=label, label_id=graph.labels.id_of(label)))
    return tuple(nodes)


def _free_name(node: GraphNode, taken: set[str]) -> str:
    """Return a name for a node's place that no other place has, and note it as taken."""
    name, number = node.place, 1
    while name in taken and name != UNKNOWN:
        name, number = f"{node.label}{number}", number + 1
    taken.add(name)
    return name


def _extent(
    name: str, part: _Part, graph: SemanticGraph, mask: NDArray[np.bool_], surveyed: Survey
) -> Extent:
    """Outline a place's largest piece."""
    space = surveyed.space
    pieces, _ = ndimage.label(mask)
    mask = pieces == np.bincount(pieces[mask]).argmax()
    fine = 3
    image = np.kron(mask, np.ones((fine, fine))).astype(np.uint8)
    outlines, _ = cv2.findContours(image, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    outline = cv2.approxPolyDP(max(outlines, key=len), 1.5 * fine, closed=True)[:, 0]
    polygon = (outline + 0.5) / fine * space.cell_m + space.origin_xy
    if _turns_clockwise(polygon):
        polygon = polygon[::-1]
    centre = _centre(mask) * space.cell_m + space.origin_xy
    return Extent(
        name, part.label, graph.labels.id_of(part.label), part.score, polygon,
        float(mask.sum() * space.cell_m**2), centre,
    )  # fmt: skip


def _centre(mask: NDArray[np.bool_]) -> FloatArray:
    """Return x and y (2,), in cells, of the spot next to the middle that is far from all walls."""
    depth = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    inner = np.argwhere(depth >= _INNERMOST * depth.max())
    middle = np.argwhere(mask).mean(axis=0)
    row, column = inner[int(np.linalg.norm(inner - middle, axis=1).argmin())]
    return np.array([column, row]) + 0.5


def _turns_clockwise(polygon: FloatArray) -> bool:
    x, y = polygon.T
    return bool(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0)
