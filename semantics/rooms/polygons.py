"""Room polygons of places, and doorways between them, from a finished map."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from roomgraph.datasets import se3
from roomgraph.semantics.graph.graph import UNLABELLED, GraphNode, RoomPolygon, SemanticGraph
from roomgraph.semantics.graph.instances import free_name
from roomgraph.semantics.labels import UNKNOWN
from roomgraph.semantics.rooms.doorways import find_doorways
from roomgraph.semantics.rooms.labelling import LabelledRegion, RoomSettings, Vote, label_rooms
from roomgraph.semantics.rooms.outlines import area_m2, centre_of, largest_piece, outline_of
from roomgraph.semantics.rooms.regions import segment
from roomgraph.semantics.rooms.watershed import RegionImage
from roomgraph.slam.reconstruction.floor_analysis import FloorAnalysis
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolume


def with_rooms(
    graph: SemanticGraph, floor: FloorAnalysis, votes: Sequence[Vote], settings: RoomSettings
) -> SemanticGraph:
    """Return the graph with rooms and doorways, and each node assigned to its room.

    All that lies in one room belongs to one place, whatever a single view looked like: this mends
    what a view through a door into the next room got wrong, and a room entered by two doors or
    twice is one. Where no label prevails in a region and several hold a room's worth of its floor,
    as in an open plan, the region is parted between the labels by the nearest node.

    Parameters
    ----------
    graph : SemanticGraph
        As it came from the path.
    floor : FloorAnalysis
        Free space and map frame of the finished map.
    votes : sequence of Vote
        Of all frames with a pose in the map. Nodes of other frames lie in a
        sub-map that never met it: they keep their places, under names of their own.
    settings : RoomSettings
        How regions are cut, and when they are one place.
    """
    if not graph.nodes:
        return graph
    volume, T = floor.volume, floor.floor_plane.T_map_world
    positions = np.array([vote.position_world for vote in votes]).reshape(-1, 3)
    cells = volume.cells_of(se3.transform(T, positions))
    regions = segment(volume, _by_cell(cells, votes, volume.hits.shape[1:]), settings.regions)
    nodes_map = se3.transform(T, graph.positions)
    node_cells = volume.cells_of(nodes_map)
    reach = settings.regions.detail_m / volume.cell_m
    of_frames = _lookup(regions.seen, cells, reach)
    voted = {vote.frame for vote in votes}
    is_here = np.array([node.frame in voted for node in graph.nodes])
    of_nodes = np.where(is_here, _lookup(regions.seen, node_cells, reach), 0)
    labelled, images = label_rooms(
        graph,
        node_cells=node_cells,
        regions=regions,
        of_nodes=of_nodes,
        of_frames=of_frames,
        votes=votes,
        cell_m=volume.cell_m,
        settings=settings,
    )
    names = _names(labelled)
    nodes = _placed(graph, labelled, names, is_here)
    rooms = tuple(
        _room(names[i], part, graph, images.full == part.number, volume)
        for i, part in enumerate(labelled)
        if (images.full == part.number).any()
    )
    numbers = {part.number: names[i] for i, part in enumerate(labelled)}
    doorways = find_doorways(
        images.seen,
        names=numbers,
        nodes=nodes,
        nodes_map=nodes_map,
        floor=floor,
        min_width_m=settings.min_doorway_m,
    )
    return replace(graph, nodes=nodes, rooms=rooms, doorways=doorways, T_map_world=T)


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


def _names(labelled: Sequence[LabelledRegion]) -> list[str]:
    """Return names that number the places of each label in the order of first passing."""
    count: Counter[str] = Counter()
    names = []
    for part in labelled:
        kind = UNLABELLED if part.label == UNKNOWN else part.label
        count[kind] += 1
        names.append(f"{kind}{count[kind]}")
    return names


def _placed(
    graph: SemanticGraph,
    labelled: Sequence[LabelledRegion],
    names: Sequence[str],
    is_here: NDArray[np.bool_],
) -> tuple[GraphNode, ...]:
    """Assign each node to its region; one outside all regions follows its neighbour in time."""
    of_node = {i: k for k, part in enumerate(labelled) for i in part.nodes}
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
        label = labelled[k].label
        nodes.append(replace(node, place=names[k], label=label, label_id=graph.labels.id_of(label)))
    return tuple(nodes)


def _free_name(node: GraphNode, taken: set[str]) -> str:
    """Return a name for a node's place that no other place has, and note it as taken."""
    name = node.place
    if name in taken and name != UNKNOWN:
        name = free_name(node.label, taken)
    taken.add(name)
    return name


def _room(
    name: str,
    part: LabelledRegion,
    graph: SemanticGraph,
    mask: NDArray[np.bool_],
    volume: OccupancyVolume,
) -> RoomPolygon:
    """Outline a place's largest piece."""
    mask = largest_piece(mask)
    return RoomPolygon(
        name=name, label=part.label, label_id=graph.labels.id_of(part.label), score=part.score,
        polygon_map=outline_of(mask, volume), area_m2=area_m2(mask, volume),
        centre_map=centre_of(mask, volume),
    )  # fmt: skip
