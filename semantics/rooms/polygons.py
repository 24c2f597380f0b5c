"""Giving places their floor, and joining them by doorways, once a run's map is finished."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.datasets import se3
from roomgraph.semantics.graph.graph import UNLABELLED, Extent, GraphNode, SemanticGraph
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.rooms.doorways import find_doorways
from roomgraph.semantics.rooms.labelling import ExtentSettings, Part, Vote, make_parts
from roomgraph.semantics.rooms.outlines import area_m2, centre_of, largest_piece, outline_of
from roomgraph.semantics.rooms.regions import segment
from roomgraph.semantics.rooms.watershed import RegionImage
from roomgraph.slam.reconstruction.floor_analysis import Survey
from roomgraph.slam.reconstruction.occupancy_volume import Space


def with_extents(
    graph: SemanticGraph, surveyed: Survey, votes: Sequence[Vote], settings: ExtentSettings
) -> SemanticGraph:
    """Return the graph with extents and doorways, its nodes at the place that they lie in.

    All that lies in one room belongs to one place, whatever a single view looked like: this mends
    what a view through a door into the next room got wrong, and a room entered by two doors or
    twice is one. Where no label prevails in a region and several hold a room's worth of its floor,
    as in an open plan, the region is parted between the labels by the nearest node.

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
    cells = space.cells_of(se3.transform(T, positions))
    regions = segment(space, _by_cell(cells, votes, space.hits.shape[1:]), settings.regions)
    nodes_map = se3.transform(T, graph.positions)
    node_cells = space.cells_of(nodes_map)
    reach = settings.regions.detail_m / space.cell_m
    of_frames = _lookup(regions.seen, cells, reach)
    voted = {vote.frame for vote in votes}
    is_here = np.array([node.frame in voted for node in graph.nodes])
    of_nodes = np.where(is_here, _lookup(regions.seen, node_cells, reach), 0)
    parts, images = make_parts(
        graph, node_cells, regions, of_nodes, of_frames, votes, space.cell_m, settings
    )
    names = _names(parts)
    nodes = _placed(graph, parts, names, is_here)
    extents = tuple(
        _extent(names[i], part, graph, images.full == part.number, space)
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
) -> dict[tuple[int, int], defaultdict[str, float]]:
    """Count the votes of each cell of the grid, weighed by their scores."""
    counts: dict[tuple[int, int], defaultdict[str, float]] = {}
    for (row, column), vote in zip(cells.tolist(), votes, strict=True):
        if 0 <= row < shape[0] and 0 <= column < shape[1]:
            here = counts.setdefault((row, column), defaultdict(float))
            if vote.label != UNKNOWN:
                here[vote.label] += vote.score
    return counts


def _lookup(regions: RegionImage, cells: NDArray[np.intp], reach: float) -> NDArray[np.int32]:
    """Return the region (N,) that cells (N, 2) lie in or next to; 0 for none within reach."""
    if not regions.any():
        return np.zeros(len(cells), dtype=np.int32)
    distance, nearest = ndimage.distance_transform_edt(regions == 0, return_indices=True)
    row, column = np.clip(cells, 0, np.array(regions.shape) - 1).T
    found = regions[nearest[0][row, column], nearest[1][row, column]]
    return np.where(distance[row, column] <= reach, found, 0)


def _names(parts: Sequence[Part]) -> list[str]:
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
    parts: Sequence[Part],
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
    name: str, part: Part, graph: SemanticGraph, mask: NDArray[np.bool_], space: Space
) -> Extent:
    """Outline a place's largest piece."""
    mask = largest_piece(mask)
    return Extent(
        name, part.label, graph.labels.id_of(part.label), part.score, outline_of(mask, space),
        area_m2(mask, space), centre_of(mask, space),
    )  # fmt: skip
