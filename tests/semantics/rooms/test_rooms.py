"""Which place is which, from the path to the finished map: a corridor and two offices beside it."""

from itertools import groupby, pairwise

import numpy as np
import pytest

from roomgraph.datasets.se3 import pose
from roomgraph.semantics.graph.topology import TopologicalMap, TopologySettings
from roomgraph.semantics.rooms.labelling import RoomSettings, Vote
from roomgraph.semantics.rooms.polygons import with_rooms
from roomgraph.slam.reconstruction.floor_analysis import FloorAnalysis
from roomgraph.slam.reconstruction.floor_plane import FloorPlane
from roomgraph.slam.reconstruction.occupancy_grid import occupancy
from roomgraph.slam.reconstruction.occupancy_volume import OccupancyVolumeSettings, carve
from tests.semantics.helpers import anchor, frame_label, label_space, view
from tests.slam.scene import NOISE, around, box_room, keyframes

pytestmark = pytest.mark.slow

HEIGHT_M = 1.2
# The offices share a wall; the second has two doors.
CORRIDOR = box_room(0, 0, 8, 1.9, [("n", 1.0, 1.9), ("n", 4.4, 5.3), ("n", 6.7, 7.6)])
FIRST = box_room(0, 2.0, 3.9, 5, [("s", 1.0, 1.9)])
SECOND = box_room(4.0, 2.0, 8, 5, [("s", 4.4, 5.3), ("s", 6.7, 7.6)])
IN_FIRST, IN_SECOND = (1.5, 3.6), (6.0, 3.8)
TO_FIRST = [(1.45, 0.9), (1.45, 2.5), IN_FIRST]
THROUGH_SECOND = [(4.85, 0.9), (4.85, 2.6), IN_SECOND, (7.15, 2.6), (7.15, 0.9)]


def true_label(x, y):
    return "corridor" if y < 1.95 else "office"


def path(corners, step=0.1):
    """Spots (N, 2) along a polygon of corners."""
    labelled = []
    for a, b in pairwise(np.array(corners)):
        count = max(1, round(float(np.linalg.norm(b - a)) / step))
        labelled.append(a + (b - a) * np.arange(count)[:, None] / count)
    return np.vstack([*labelled, corners[-1]])


@pytest.fixture(scope="module")
def floor():
    """The floor as a camera sees it that looks around in the corridor, rooms and doors."""
    spots = [(1.45, 0.9), (1.45, 2.3), IN_FIRST, (4.0, 0.9), (4.85, 2.4), IN_SECOND, (7.1, 2.3),
             (7.1, 0.9)]  # fmt: skip
    cameras = [T for x, y in spots for T in around(x, y, HEIGHT_M, 10, 10)]
    boxes, rng = CORRIDOR + FIRST + SECOND, np.random.default_rng(3)
    made, T_map = keyframes(boxes, cameras, np.eye(4), rng, with_planes=False)
    settings, floor_plane = OccupancyVolumeSettings(), FloorPlane(np.eye(4), True, True, True)
    volume = carve(made, T_map, floor_plane, settings, NOISE)
    taken = np.array([T[:3, 3] for T in cameras])
    grid = occupancy(volume, np.eye(4), settings, taken)
    return FloorAnalysis(floor_plane, volume, grid, tuple(range(len(made))), taken, ())


class Run:
    """A camera's walk: the graph grows on poses as they are believed, and is finished on others."""

    def __init__(self):
        self.map = TopologicalMap(TopologySettings(), label_space())
        self.spots, self.labels = [], []

    def walk(self, corners, label=true_label, drift=None, seen_again=None):
        """Walk along corners; with a drift, by a second keyframe that is so far off."""
        T = {0: np.eye(4), 1: pose(t=drift)}
        keyframe = 0 if drift is None else 1
        for x, y in path(corners):
            kind = label(x, y)
            # Each room looks different all along: three views for the corridor and the offices.
            seen = view(seen_again or (0 if kind == "corridor" else 1 if x < 3.95 else 2))
            item = frame_label(len(self.spots), kind, seen)
            self.map.update(item, anchor(x, y, keyframe), T)
            self.spots.append((x, y))
            self.labels.append(kind)
        return self

    def before(self, drift):
        """The graph as it lies in a drifted world."""
        return self.map.snapshot({0: np.eye(4), 1: pose(t=drift)})

    def finished(self, floor):
        """The graph of the corrected map."""
        up = pose(t=[0, 0, HEIGHT_M])
        graph = self.map.snapshot({0: up, 1: up})
        votes = [
            Vote(i, np.array([x, y, HEIGHT_M]), label, 0.9)
            for i, ((x, y), label) in enumerate(zip(self.spots, self.labels, strict=True))
        ]
        return with_rooms(graph, floor, votes, RoomSettings())


def stays(graph):
    """The places in the order of the walk, each stay once."""
    return [place for place, _ in groupby(node.place for node in graph.nodes)]


def wall(graph):
    """The places on both sides of the wall between the offices, by where their nodes lie."""
    inside = [node for node in graph.nodes if node.position_world[1] > 2.1]
    left = {node.place for node in inside if node.position_world[0] < 3.95}
    return left, {node.place for node in inside if node.position_world[0] > 3.95}


def test_two_offices_side_by_side_are_told_apart(floor):
    run = Run().walk([*TO_FIRST, *TO_FIRST[::-1], *THROUGH_SECOND])
    # Less than five metres apart: on the path alone they are one.
    assert wall(run.before([0, 0, 0])) == ({"office1"}, {"office1"})
    graph = run.finished(floor)
    assert wall(graph) == ({"office1"}, {"office2"})
    areas = {room.name: room.area_m2 for room in graph.rooms}
    expected = {"corridor1": 8 * 1.9, "office1": 3.9 * 3, "office2": 4 * 3}
    assert areas == pytest.approx(expected, rel=0.15)


def test_leaving_and_coming_back_is_the_same_office(floor):
    there, again = [*TO_FIRST, *TO_FIRST[::-1]], [(1.45, 0.9), (1.45, 2.5), (2.6, 3.0)]
    graph = Run().walk([*there, *THROUGH_SECOND, *again]).finished(floor)
    assert stays(graph) == ["corridor1", "office1", "corridor1", "office2", "corridor1", "office1"]


def test_a_loop_closure_makes_the_return_the_same_office(floor):
    drift = [0.0, 7.0, 0.0]
    run = Run().walk([*TO_FIRST, *TO_FIRST[::-1], (4.85, 0.9)])
    # What it sees on its return looks different, and lies seven metres off for now.
    run.walk([(4.85, 0.9), (1.45, 0.9), (1.45, 1.9)], drift=drift)
    run.walk([(1.45, 2.0), IN_FIRST, (2.6, 3.6)], drift=drift, seen_again=3)
    drifted = run.before(drift)
    assert {"office1", "office2"} <= set(drifted.places)
    graph = run.finished(floor)
    assert stays(graph) == ["corridor1", "office1", "corridor1", "office1"]
    moved = [node.position_world for node in graph.nodes if node.label == "office"]
    assert max(position[1] for position in moved) < 5


def test_a_room_entered_by_two_doors_is_one_with_two_doorways(floor):
    around_again = [*THROUGH_SECOND, *THROUGH_SECOND[::-1]]
    graph = Run().walk(around_again).finished(floor)
    assert stays(graph) == ["corridor1", "office1", "corridor1", "office1", "corridor1"]
    doors = sorted(
        (door.position_map[0], door.width_m)
        for door in graph.doorways
        if set(door.places) == {"corridor1", "office1"}
    )
    assert [x for x, _ in doors] == pytest.approx([4.85, 7.15], abs=0.2)
    assert [width for _, width in doors] == pytest.approx([0.9, 0.9], abs=0.15)


def test_a_room_seen_through_the_door_of_another_is_not_entered(floor):
    """In front of the second office's door the corridor looks like an office (paper, Fig. 16)."""

    def mistaken(x, y):
        return "office" if 4.4 < x < 5.3 else true_label(x, y)

    run = Run().walk([*TO_FIRST, *TO_FIRST[::-1]]).walk([(1.45, 0.9), (8 - 0.5, 0.9)], mistaken)
    assert any(n.label == "office" and n.position_world[1] < 1.9 for n in run.before([0] * 3).nodes)
    graph = run.finished(floor)
    assert stays(graph) == ["corridor1", "office1", "corridor1"]
    assert {room.label for room in graph.rooms if room.name == "corridor1"} == {"corridor"}
