"""What is told to be true of a world, against its geometry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.datasets.synthetic.truth import (
    LEAST_PIXELS,
    BoxFinder,
    object_truth,
    place_truth,
    room_shape,
    room_size,
)
from tests.datasets.synthetic.worlds import house, suite, suite_renderer

pytestmark = pytest.mark.slow
LEAST_CLASSES = 30


@pytest.fixture(scope="module")
def truth():
    return place_truth(house())


@pytest.fixture(scope="module")
def objects():
    return object_truth(house())


def crossings(xy, door):
    """The frames (N,) after which the camera is on the other side of a doorway's opening."""
    axis = 1 if door.along == "x" else 0
    side = xy[:, axis] - door.xy[axis]
    through = np.abs(xy[:, 1 - axis] - door.xy[1 - axis]) < door.width_m / 2
    return np.flatnonzero((side[:-1] * side[1:] < 0) & through[:-1] & through[1:])


def test_rooms_and_floors_are_where_the_camera_is(truth):
    world = house()
    plan, storey = world.building.plan, world.building.plan.storey_m
    for index, (name, label, floor) in enumerate(
        zip(truth.instances, truth.labels, truth.floors, strict=True)
    ):
        above = world.journey.floor_m[index] - floor * storey
        assert abs(above) <= storey / 2 + 1e-6
        here = world.trajectory.positions[index, :2]
        cells = [room for room in plan.rooms if room.name == name and room.level == floor]
        assert {room.label for room in cells} == {label}
        # In a doorway one is up to half a wall beside the room.
        assert min(room.floor.distance(here[None])[0] for room in cells) < 0.08


def test_a_transition_is_at_an_opening_of_its_kind(truth):
    world = house()
    seen = set(truth.transitions)
    assert {"", "door", "stairs", "elevator"} <= seen <= {"", "door", "jamb", "stairs", "elevator"}
    kinds = {"door": ("door",), "jamb": ("jamb", "passage")}
    places = world.trajectory.positions[:, :2]
    for xy, floor, label, told in zip(
        places, truth.floors, truth.labels, truth.transitions, strict=True
    ):
        in_shaft = {"stairwell": "stairs", "elevator": "elevator"}.get(label)
        if in_shaft or told in ("stairs", "elevator"):
            assert told == in_shaft
        elif told:
            off = [
                np.abs(xy - door.xy).max()
                for door in world.building.doorways
                if door.level == floor and door.kind in kinds[told]
            ]
            assert min(off) < 0.5 + 1e-9


def test_every_passage_through_an_opening_is_told(truth):
    world, passed = house(), 0
    xy, floors = world.trajectory.positions[:, :2], np.array(truth.floors)
    for door in world.building.doorways:
        for index in crossings(xy, door):
            if floors[index] != door.level or door.kind in ("open", "lift"):
                continue
            passed += 1
            told = set(truth.transitions[index : index + 2])
            expected = "door" if door.kind == "door" else "jamb"
            if not {truth.labels[index], truth.labels[index + 1]} & {"stairwell", "elevator"}:
                assert told == {expected}, door
            else:
                assert "" not in told
    # In and out of each room that is no passage.
    assert passed > 12


def test_the_first_version_tells_of_rooms_only():
    world = suite()
    plain = replace(world, settings=type(world.settings)())
    told = place_truth(plain)
    assert (told.floors, told.transitions) == ((), ())
    assert told.instances == place_truth(world).instances


def test_objects_are_the_bounds_of_their_surfaces(objects):
    building = house().building
    by_first = {item.first: item for item in objects}
    names = [item.name for item in objects]
    assert len(set(names)) == len(names)
    for thing in building.things:
        corners = np.concatenate([quad.corners for quad in building.quads[thing.quads]])
        found = [
            item for item in objects
            if (item.first, item.last, item.kind)
            == (2 * thing.quads.start, 2 * thing.quads.stop, thing.name)
        ]  # fmt: skip
        assert found
        half = np.array(found[0].size) / 2
        np.testing.assert_allclose(found[0].centre - half, corners.min(axis=0), atol=1e-9)
        np.testing.assert_allclose(found[0].centre + half, corners.max(axis=0), atol=1e-9)
        assert found[0].name.rstrip("0123456789") == thing.name
    first = 2 * len(building.quads)
    for body in (*house().animation.bodies, *house().animation.people):
        assert (by_first[first].last - first) == 2 * len(body.quads)
        first += 2 * len(body.quads)


def test_a_house_has_many_classes_in_its_rooms(objects):
    assert len({item.kind for item in objects}) >= LEAST_CLASSES
    plan = house().building.plan
    for item in objects:
        if item.kind == "person":
            continue
        cells = [r for r in plan.rooms if r.name == item.room and r.level == item.floor]
        assert min(r.floor.distance(np.array([item.centre[:2]]))[0] for r in cells) < 0.3, item
        low = item.centre[2] - item.size[2] / 2
        assert -0.1 < low - item.floor * plan.storey_m < plan.storey_m, item


def test_people_are_told_of_where_they_are_seen(objects):
    people = [item for item in objects if item.kind == "person"]
    assert len(people) == house().settings.people
    storey = house().building.plan.storey_m
    for item in people:
        low = item.centre[2] - item.size[2] / 2
        assert abs(low - item.floor * storey) < 0.1
        assert 1.1 < item.size[2] < 2.1


def brute_force(objects, triangle):
    """The bounds of each object's pixels and their number, one object after the other."""
    boxes = {}
    for number, item in enumerate(objects):
        seen = (triangle >= item.first) & (triangle < item.last)
        if seen.sum() >= LEAST_PIXELS:
            rows, columns = np.nonzero(seen)
            boxes[number] = (
                columns.min(), rows.min(), columns.max() + 1, rows.max() + 1, seen.sum(),
            )  # fmt: skip
    return boxes


def test_boxes_are_those_of_a_search_object_by_object():
    world, renderer = suite(), suite_renderer()
    listed = object_truth(world)
    finder, found, parts = BoxFinder(listed), 0, 0
    for index in range(0, len(world.trajectory), 100):
        stamp = float(world.trajectory.stamps_s[index])
        sight = renderer.look(renderer.eye, world.trajectory.T_world_camera[index], stamp)
        expected = brute_force(listed, sight.hits.triangle)
        boxes = finder.boxes(sight)
        assert {
            box.number: (box.left, box.top, box.right, box.bottom, box.pixels) for box in boxes
        } == expected
        found += len(boxes)
        inner = [(listed[a].first, listed[a].last) for a in expected]
        parts += sum(a != b and b[0] <= a[0] and a[1] <= b[1] for a in inner for b in inner)
    assert found > 60
    # Some are parts of others, so that the others' boxes had to include them.
    assert parts > 5


def test_shapes_and_sizes_of_rooms():
    for room in house().building.rooms:
        sides = sorted(np.ptp(room.floor.polygon, axis=0))
        if sides[1] > 2 * sides[0]:
            assert room_shape(room) == "elongated"
        assert (room_size(room) == "large") == (sides[1] >= 5.2)
        assert (room_size(room) == "small") == (sides[1] < 3.6)
