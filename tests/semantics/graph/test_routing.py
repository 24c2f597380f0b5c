"""Ways over a graph whose shortest paths are known."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.semantics.errors import SemanticsError
from roomgraph.semantics.graph.graph import (
    Doorway,
    EdgeKind,
    GraphEdge,
    GraphNode,
    RoomPolygon,
    SemanticGraph,
)
from roomgraph.semantics.graph.routing import find_route, nodes_of, turning
from roomgraph.semantics.graph.visits import Visit, summarise
from roomgraph.semantics.labels import LabelSpace
from roomgraph.slam.reconstruction.occupancy_grid import FREE, OCCUPIED, OccupancyGrid

LABELS = LabelSpace.of(("corridor", "kitchen", "office"))


def _graph(T_map_world=None, cut=()):
    """A corridor along x; an office to the left of its west end, another and a kitchen farther on.

    ::

        office1(0,1)      office2(4,1)
           |                 |
        c(0,0)-c(1,0)-...-c(4,0)-...-c(6,0)
                                        |
                                   kitchen1(6,-1)

    Walked: office1, corridor to x = 4, office2, back, on to x = 6, kitchen1.
    """
    spots = [
        (0, 1, "office1"), *((x, 0, "corridor1") for x in range(5)), (4, 1, "office2"),
        (4, 0.1, "corridor1"), (5, 0, "corridor1"), (6, 0, "corridor1"), (6, -1, "kitchen1"),
    ]  # fmt: skip
    T_world_map = np.eye(4) if T_map_world is None else se3.inverse(T_map_world)
    nodes = []
    for i, (x, y, place) in enumerate(spots):
        label = place[:-1]
        position = se3.transform(T_world_map, np.array([[x, y, 0.8]]))[0]
        score = 0.9 if i % 2 else 0.7
        nodes.append(
            GraphNode(i, 10 * i, 1.0 * i, position, label, LABELS.id_of(label), place, score,
                      np.empty(0))
        )  # fmt: skip
    pairs = [(i, i + 1, EdgeKind.PATH) for i in range(len(nodes) - 1)] + [(5, 7, EdgeKind.REVISIT)]
    edges = [
        GraphEdge(a, b, float(np.linalg.norm(nodes[a].position_world - nodes[b].position_world)), k)
        for a, b, k in pairs
        if (a, b) not in cut
    ]
    doors = (
        Doorway(("office1", "corridor1"), np.array([0, 0.5]), 0.9),
        Doorway(("corridor1", "office2"), np.array([4, 0.5]), None),
    )
    rooms = (
        RoomPolygon("office1", "office", LABELS.id_of("office"), 0.95,
               np.array([[-1, 0.5], [1, 0.5], [1, 3], [-1, 3]]), 5.0, np.array([0, 2])),
    )  # fmt: skip
    T = np.eye(4) if T_map_world is None else T_map_world
    return SemanticGraph(LABELS, tuple(nodes), tuple(edges), rooms, doors, T)


def test_a_way_between_rooms():
    route = find_route(_graph(), "office1", "kitchen1")
    # Not through office2: over the revisit, which is 0.1 m long.
    assert route.nodes == (0, 1, 2, 3, 4, 5, 7, 8, 9, 10)
    expected = 1 + 4 + 0.1 + np.hypot(1, 0.1) + 1 + 1
    assert route.length_m == pytest.approx(expected)
    assert [leg.place for leg in route.legs] == ["office1", "corridor1", "kitchen1"]
    assert sum(leg.length_m for leg in route.legs) == pytest.approx(route.length_m)
    assert route.legs[0].length_m == pytest.approx(0.5)
    assert route.legs[0].door.width_m == 0.9
    assert route.legs[1].door is None
    # South out of the office, then east: left; east along the corridor, then south: right.
    assert route.legs[0].turn_deg == pytest.approx(90)
    assert turning(route.legs[0].turn_deg) == "left"
    assert turning(route.legs[1].turn_deg) == "right"
    assert route.legs[2].turn_deg is None


def test_a_way_is_the_same_in_any_world(random_poses):
    plain = find_route(_graph(), "office1", "kitchen1")
    moved = find_route(_graph(random_poses[3]), "office1", "kitchen1")
    assert moved.nodes == plain.nodes
    assert [leg.length_m for leg in moved.legs] == pytest.approx([g.length_m for g in plain.legs])
    assert moved.legs[0].turn_deg == pytest.approx(plain.legs[0].turn_deg)


def test_back_is_as_far_and_turns_the_other_way():
    there, back = (
        find_route(_graph(), *ends) for ends in (("office1", "office2"), ("office2", "office1"))
    )
    assert back.length_m == pytest.approx(there.length_m)
    assert back.nodes == there.nodes[::-1]
    assert [turning(leg.turn_deg) for leg in there.legs[:-1]] == ["left", "left"]
    assert [turning(leg.turn_deg) for leg in back.legs[:-1]] == ["right", "right"]


def test_the_nearest_of_a_label_is_meant():
    graph = _graph()
    assert find_route(graph, "kitchen", "office").legs[-1].place == "office2"
    assert find_route(graph, "0,0", "office").legs[-1].place == "office1"
    assert len(nodes_of(graph, "office")) == 2


@pytest.mark.parametrize("name", ["office2", "Office 2", "OFFICE_2", "4,1", "4.1, 1.2", "4,1,0.8"])
def test_ways_to_name_a_place(name):
    assert nodes_of(_graph(), name) == (6,)


def test_coordinates_lie_on_the_floor_of_the_map(random_poses):
    graph = _graph(random_poses[5])
    assert nodes_of(graph, "6,-1.2") == (10,)
    x, y, z = graph.positions[8]
    assert nodes_of(graph, f"{x:.3f},{y:.3f},{z:.3f}") == (8,)


def test_staying_where_one_is():
    route = find_route(_graph(), "office1", "office1")
    assert (route.length_m, route.nodes, len(route.legs)) == (0.0, (0,), 1)


def test_what_is_no_way_is_refused():
    with pytest.raises(SemanticsError, match=r"no such place: attic.*office1"):
        find_route(_graph(), "attic", "office1")
    with pytest.raises(SemanticsError, match=r"not on the map: 900,1; .*got x 900.0 m"):
        find_route(_graph(), "900,1", "office1")
    with pytest.raises(SemanticsError, match="no known route"):
        find_route(_graph(cut=[(0, 1)]), "office1", "kitchen1")
    with pytest.raises(SemanticsError, match="no nodes"):
        find_route(SemanticGraph(LABELS, (), ()), "office1", "kitchen1")


def test_places_with_their_visits():
    office1, corridor, office2, kitchen = summarise(_graph())
    assert (office1.name, office1.label, office1.area_m2, office1.score) == (
        "office1", "office", 5.0, 0.95,
    )  # fmt: skip
    assert corridor.visits == (Visit(1.0, 5.0), Visit(7.0, 9.0))
    assert corridor.nodes == (1, 2, 3, 4, 5, 7, 8, 9)
    assert corridor.area_m2 is None
    assert corridor.score == pytest.approx((0.9 * 5 + 0.7 * 3) / 8)
    assert (office2.visits, kitchen.nodes) == ((Visit(6.0, 6.0),), (10,))


def _hall(wall_to=None):
    """A hall walked in a U, and its floor; a wall may stand between the arms up to some y."""
    spots = [(0.5, 0.5), (0.5, 4.5), (1.5, 4.5), (1.5, 0.5)]
    nodes = tuple(
        GraphNode(i, i, 1.0 * i, np.array([x, y, 0.0]), "office", LABELS.id_of("office"),
                  "office1", 0.9, np.empty(0))
        for i, (x, y) in enumerate(spots)
    )  # fmt: skip
    edges = tuple(
        GraphEdge(i, i + 1, length, EdgeKind.PATH) for i, length in enumerate((4.0, 1.0, 4.0))
    )
    outline = np.array([[0, 0], [2, 0], [2, 5], [0, 5]], dtype=float)
    rooms = (RoomPolygon("office1", "office", LABELS.id_of("office"), 0.9, outline, 10.0,
                      np.array([1.0, 2.5])),)  # fmt: skip
    cells = np.full((100, 40), FREE, dtype=np.int8)
    if wall_to is not None:
        cells[: round(wall_to / 0.05), 20] = OCCUPIED
    grid = OccupancyGrid(cells, 0.05, np.zeros(2), np.eye(4))
    return SemanticGraph(LABELS, nodes, edges, rooms, (), np.eye(4)), grid


@pytest.mark.parametrize(("wall_to", "length"), [(None, 1.0), (2.0, 4.0), (5.0, 9.0)])
def test_rooms_are_crossed_where_the_floor_is_free(wall_to, length):
    graph, grid = _hall(wall_to)
    assert find_route(graph, "0.5,0.5", "1.5,0.5").length_m == pytest.approx(9.0)
    route = find_route(graph, "0.5,0.5", "1.5,0.5", grid)
    # Over cells, ways go along eight directions and keep clear of the wall.
    assert route.length_m == pytest.approx(length, rel=0.12)
    assert route.length_m == pytest.approx(sum(leg.length_m for leg in route.legs))
