"""Places' floors and doorways, from rooms of boxes that a camera looked at."""

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.semantics.evaluation.topology import (
    evaluate_doorways,
    evaluate_rooms,
    largest_error,
)
from roomgraph.semantics.graph.graph import GraphNode, SemanticGraph
from roomgraph.semantics.labels import LabelSpace
from roomgraph.semantics.rooms.indoors import completed
from roomgraph.semantics.rooms.labelling import RoomSettings, Vote
from roomgraph.semantics.rooms.polygons import with_rooms
from roomgraph.slam.reconstruction.floor_analysis import FloorAnalysis
from roomgraph.slam.reconstruction.floor_plane import FloorPlane
from roomgraph.slam.reconstruction.occupancy_grid import occupancy
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolumeSettings, carve
from tests.slam.scene import NOISE, around, box_room, keyframes

pytestmark = pytest.mark.slow

LABELS = LabelSpace.of(["corridor", "kitchen", "office"])
SETTINGS = RoomSettings()
# Two offices on both sides of a corridor that one can see through, and walk through.
OFFICE = box_room(0, 0, 3, 3, [("e", 1.0, 1.9)])
HALL = box_room(3.1, 0, 5.1, 5, [("w", 1.0, 1.9), ("e", 3.0, 3.9)])
OTHER = box_room(5.2, 2, 8.2, 5, [("w", 3.0, 3.9)])
SPOTS = {"office1": (1.5, 1.5), "corridor1": (4.1, 2.5), "office2": (6.7, 3.5)}
WALK = [
    (1.5, 1.5, "office"), (2.6, 1.45, "office"), (3.6, 1.45, "corridor"), (4.1, 2.5, "corridor"),
    (4.6, 3.45, "corridor"), (5.8, 3.45, "office"), (6.7, 3.5, "office"), (4.1, 3.4, "corridor"),
]  # fmt: skip


@pytest.fixture(scope="module")
def floor():
    rng = np.random.default_rng(5)
    cameras = [T for x, y, _ in WALK for T in around(x, y, 1.2, 10, 10)]
    return floor_analysis_of(OFFICE + HALL + OTHER, cameras, rng)


def floor_analysis_of(boxes, cameras, rng):
    made, T_map = keyframes(boxes, cameras, np.eye(4), rng, with_planes=False)
    settings, floor_plane = OccupancyVolumeSettings(), FloorPlane(np.eye(4), True, True, True)
    volume = carve(made, T_map, floor_plane, settings, NOISE)
    path = np.array([T[:3, 3] for T in cameras])
    grid = occupancy(volume, np.eye(4), settings, path)
    return FloorAnalysis(floor_plane, volume, grid, tuple(range(len(made))), path, ())


def graph_of(walk, place=lambda label: f"{label}1"):
    nodes = tuple(
        GraphNode(
            i, i, float(i), np.array([x, y, 1.2]), label, LABELS.id_of(label), place(label), 0.8,
            np.empty(0),
        )
        for i, (x, y, label) in enumerate(walk)
    )  # fmt: skip
    return SemanticGraph(LABELS, nodes, ())


def votes_of(graph):
    return [Vote(n.frame, n.position_world, n.label, n.score) for n in graph.nodes]


def found_in(floor, walk=WALK, settings=SETTINGS):
    graph = graph_of(walk)
    return with_rooms(graph, floor, votes_of(graph), settings)


def test_rooms_have_their_floor_and_doors_join_them(floor):
    graph = found_in(floor)
    areas = {room.name: room.area_m2 for room in graph.rooms}
    assert areas == pytest.approx({"office1": 9.0, "corridor1": 10.0, "office2": 9.0}, rel=0.025)
    doors = {door.places: door for door in graph.doorways}
    assert set(doors) == {("office1", "corridor1"), ("corridor1", "office2")}
    first = doors["office1", "corridor1"]
    assert first.position_map == pytest.approx([3.05, 1.45], abs=0.15)
    assert first.width_m == pytest.approx(0.9, abs=0.12)
    for room in graph.rooms:
        assert room.score == pytest.approx(0.8)
        x, y = room.polygon_map.T
        shoelace = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
        assert shoelace == pytest.approx(room.area_m2, rel=0.05)
        assert np.all(np.abs(room.centre_map - SPOTS[room.name]) < 0.8)


def floor_of(regions, walls=None):
    walls = regions == 0 if walls is None else walls
    return completed(regions, walls, SETTINGS.regions, cell_m=0.05)


def test_a_room_ends_where_half_of_its_wall_is():
    regions = np.zeros((50, 70), dtype=np.int32)
    regions[5:45, 10:60] = 1
    regions[45, 15:30] = 1  # depth noise
    regions[5:20, 8:10] = 1
    regions[24:45, 60] = 1  # a wall in the middle of its cells
    rows, columns = np.nonzero(floor_of(regions))
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (5, 44, 10, 60)


@pytest.mark.parametrize(("deep", "stays"), [(2, False), (3, True)])
def test_what_is_deeper_than_noise_is_an_alcove(deep, stays):
    regions = np.zeros((60, 70), dtype=np.int32)
    regions[10:50, 10:60] = 1
    regions[10 - deep : 10, 20:35] = 1
    assert (np.nonzero(floor_of(regions))[0].min() < 10) == stays


@pytest.mark.parametrize(("deep", "area"), [(16, 70 * 70), (30, 70 * 70 - 30 * 47)])
def test_shallow_blocks_beside_a_room_are_its_cupboards(deep, area):
    regions = np.zeros((80, 90), dtype=np.int32)
    regions[5:75, 10:80] = 1
    regions[5 : 5 + deep, 10:30] = regions[5 : 5 + deep, 55:80] = 0
    walls = np.zeros(regions.shape, dtype=bool)
    walls[4 + deep, 10:31] = walls[4 + deep, 54:80] = True  # fronts up to the ceiling
    walls[5 : 5 + deep, [30, 54]] = True
    assert np.count_nonzero(floor_of(np.where(walls, 0, regions), walls)) == area


def test_what_is_no_block_is_no_cupboard():
    regions = np.zeros((80, 90), dtype=np.int32)
    regions[5:75, 10:80] = 1
    cut = np.add.outer(np.arange(80), np.arange(90)) < 15 + 38  # a slanting wall
    regions[cut] = 0
    assert np.count_nonzero(floor_of(regions)) == np.count_nonzero(regions)


@pytest.mark.parametrize("swapped", [False, True])
def test_a_block_beside_another_room_is_not_taken(swapped):
    # An L-shaped room, another in its crook, and in that one's far corner a stall.
    regions = np.zeros((100, 100), dtype=np.int32)
    regions[5:95, 5:35] = regions[5:35, 5:95] = 1
    regions[38:95, 38:95] = 2
    regions[78:95, 65:95] = 0
    regions = np.where(swapped, np.choose(regions, [0, 2, 1]), regions)
    walls = np.zeros(regions.shape, dtype=bool)
    walls[35:38, 35:] = walls[35:, 35:38] = True
    full = floor_of(regions, walls)
    mine = regions == (2 if swapped else 1)
    np.testing.assert_array_equal(full == (2 if swapped else 1), mine)


def test_two_offices_side_by_side_are_two_though_the_path_took_them_for_one(floor):
    # `graph_of` calls both office1.
    places = [node.place for node in found_in(floor).nodes]
    assert places == [*["office1"] * 2, *["corridor1"] * 3, *["office2"] * 2, "corridor1"]


def test_a_room_seen_through_a_door_is_not_where_the_camera_is(floor):
    walk = [(x, y, "office" if i == 4 else label) for i, (x, y, label) in enumerate(WALK)]
    graph = found_in(floor, walk)
    assert graph.nodes[4].place == "corridor1"
    assert graph.nodes[4].label == "corridor"
    assert graph.nodes[4].label_id == LABELS.id_of("corridor")


def test_an_open_plan_is_parted_between_its_labels(floor):
    walk = [(0.5, 2.0, "kitchen"), (0.7, 1.0, "kitchen"), (2.4, 2.0, "office"), *WALK[1:]]
    graph = found_in(floor, walk, SETTINGS.model_copy(update={"min_part_m2": 3.0}))
    assert [n.place for n in graph.nodes[:4]] == ["kitchen1", "kitchen1", "office1", "office1"]
    areas = {room.name: room.area_m2 for room in graph.rooms}
    assert areas["kitchen1"] + areas["office1"] == pytest.approx(9.0, rel=0.1)
    assert ("kitchen1", "office1") in {door.places for door in graph.doorways}


def test_a_corner_that_looks_like_something_else_is_no_room(floor):
    offices = [(2.4, 2.0, "office"), (2.4, 1.0, "office")]
    graph = found_in(floor, [(0.5, 2.0, "kitchen"), (0.7, 1.0, "kitchen"), *offices, *WALK[1:]])
    assert {n.place for n in graph.nodes[:5]} == {"office1"}
    assert "kitchen1" not in graph.places


def test_what_most_views_say_is_never_dropped(floor):
    # Long in a corner that looks like a kitchen, shortly in the rest.
    corner = [(0.5, 2.0 + 0.02 * i, "kitchen") for i in range(4)]
    walk = [*corner, (2.4, 2.0, "office"), (2.4, 1.0, "office"), *WALK[3:]]
    graph = found_in(floor, walk)
    assert {n.label for n in graph.nodes[:6]} == {"kitchen"}


def test_without_labels_there_are_rooms(floor):
    walk = [(x, y, "unknown") for x, y, _ in WALK]
    graph = found_in(floor, walk)
    assert graph.places == ("room1", "room2", "room3")
    assert {room.score for room in graph.rooms} == {0.0}


def test_nodes_of_another_sub_map_keep_a_place_of_their_own(floor):
    graph = graph_of(WALK)
    votes = [vote for vote in votes_of(graph) if vote.frame < 5]
    found = with_rooms(graph, floor, votes, SETTINGS)
    elsewhere = {node.place for node in found.nodes[5:]}
    assert elsewhere.isdisjoint({node.place for node in found.nodes[:5]})


def test_a_way_that_nobody_looked_along_is_still_a_doorway():
    rng = np.random.default_rng(2)
    cameras = [*around(1.5, 1.5, count=10), *around(6.7, 3.5, count=10)]
    apart = floor_analysis_of(OFFICE + OTHER, cameras, rng)
    graph = found_in(apart, [(1.5, 1.5, "office"), (6.7, 3.5, "kitchen")])
    assert [door.places for door in graph.doorways] == [("office1", "kitchen1")]
    assert graph.doorways[0].width_m is None


def test_an_empty_graph_stays_as_it_is(floor):
    empty = SemanticGraph(LABELS, (), ())
    assert with_rooms(empty, floor, [], SETTINGS) is empty


def test_precision_and_recall_of_places_and_doorways(floor):
    graph = found_in(floor)
    matches = {"a": "office1", "hall": "corridor1", "b": "office2"}
    places, errors = evaluate_rooms(graph, {"a": 9, "hall": 10, "b": 9, "attic": 5}, matches)
    assert (places.precision, places.recall) == (1.0, 0.75)
    assert largest_error(errors) < 0.1 and set(errors) == set(matches)
    doors = evaluate_doorways(graph, [("a", "hall"), ("hall", "b"), ("b", "attic")], matches)
    assert (doors.precision, doors.recall) == (1.0, pytest.approx(2 / 3))
    wrong = replace(graph.doorways[0], places=("office1", "office2"))
    doors = evaluate_doorways(replace(graph, doorways=(wrong,)), [("a", "hall")], matches)
    assert (doors.precision, doors.recall) == (0.0, 0.0)
    nothing = evaluate_doorways(replace(graph, doorways=()), [], {})
    assert np.isnan(nothing.precision) and np.isnan(nothing.recall)
    assert np.isnan(largest_error({}))
