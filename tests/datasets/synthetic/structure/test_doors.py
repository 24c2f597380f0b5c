"""Leaves of doors: they close their opening, and open before the camera comes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.layout import WALL_M, Doorway, FloorPlan, Rectangle, Room
from roomgraph.datasets.synthetic.rendering.mesh import Material, Surfaces
from roomgraph.datasets.synthetic.rendering.raycast import Scene
from roomgraph.datasets.synthetic.structure.doors import (
    OPENING_S,
    STAYS_OPEN_S,
    build_leaf,
    leaf_outline,
    open_angle,
    opened_on_the_way,
    swing,
)
from roomgraph.datasets.synthetic.structure.shell import frame_doorway

FACE = np.full((260, 120, 3), 150, np.uint8)
ACROSS = {"x": np.array([0.0, 1.0]), "y": np.array([1.0, 0.0])}


def case(along: str, hinge: int, turned: bool, is_glass: bool = False) -> tuple[Doorway, FloorPlan]:
    """Return a door between two rooms; `turned` makes the second that of smaller coordinates."""
    cells = (Rectangle(0, 0, 4, 3), Rectangle(4 + WALL_M, 0, 8, 3))
    if along == "x":
        cells = (Rectangle(0, 0, 3, 4), Rectangle(0, 4 + WALL_M, 3, 8))
    first, second = reversed(cells) if turned else cells
    rooms = (Room("hall1", "hall", first), Room("office1", "office", second))
    xy = (4 + WALL_M / 2, 1.1) if along == "y" else (1.1, 4 + WALL_M / 2)
    door = Doorway(
        ("hall1", "office1"), xy, along, 0.9, 2.05, "door", "open",
        is_glass=is_glass, hinge=hinge, base_m=0.4,
    )  # fmt: skip
    return door, FloorPlan(rooms, (door,))


ALL = [case(a, h, t) for a in "xy" for h in (-1, 1) for t in (False, True)]


def surfaces() -> Surfaces:
    return Surfaces(np.random.default_rng(1))


def through(door: Doorway) -> tuple[np.ndarray, np.ndarray]:
    """Return rays through the opening from a metre before the wall, and their direction."""
    along, across = ACROSS["y" if door.along == "x" else "x"], ACROSS[door.along]
    points = [
        (*(np.array(door.xy) - across + a * along), door.base_m + z)
        for a in np.linspace(-0.47, 0.47, 21) * door.width_m
        for z in np.linspace(0.03, 0.97, 25) * door.height_m
    ]
    return np.array(points), np.tile((*across, 0.0), (len(points), 1))


def seen_through(scene: Scene, door: Doorway) -> np.ndarray:
    origin, direction = through(door)
    return scene.distances(origin, direction) > 2.0


@pytest.mark.parametrize("number", range(len(ALL)))
def test_a_closed_leaf_fills_its_opening_and_an_open_one_leaves_it_free(number):
    door, drawn = ALL[number]
    for angle, share in ((0.0, 0.0), (np.deg2rad(90), 0.9)):
        made = surfaces()
        build_leaf(made, door, swing(door, drawn), angle, FACE)
        free = seen_through(Scene(made.quads), door).mean()
        assert free == 0.0 if share == 0.0 else free > share
        assert [thing.name for thing in made.things] == ["door"]


@pytest.mark.parametrize("number", range(len(ALL)))
def test_a_leaf_turns_about_an_end_of_the_opening_into_the_second_room(number):
    door, drawn = ALL[number]
    turn = swing(door, drawn)
    middle = np.array(door.xy)
    shut = np.array(turn.tip(0.0, door.width_m))
    np.testing.assert_allclose((np.array(turn.hinge) + shut) / 2, middle, atol=1e-9)
    along = ACROSS["y" if door.along == "x" else "x"]
    assert (np.array(turn.hinge) - middle) @ along == pytest.approx(door.hinge * 0.45)
    into = np.array(drawn.rooms[1].floor.centre) - middle
    for angle in np.deg2rad((30, 60, 90)):
        tip = np.array(turn.tip(angle, door.width_m))
        assert np.linalg.norm(tip - turn.hinge) == pytest.approx(door.width_m)
        across = np.sign(into @ ACROSS[door.along]) * ACROSS[door.along]
        assert (tip - middle) @ across == pytest.approx(door.width_m * np.sin(angle))
        outline = leaf_outline(door, turn, float(angle))
        np.testing.assert_allclose(outline.mean(axis=0), (tip + turn.hinge) / 2, atol=1e-9)


def test_a_half_open_leaf_is_less_open_than_an_open_one():
    door, _ = ALL[0]
    rng = np.random.default_rng(0)
    half = [open_angle(replace(door, state="half"), rng) for _ in range(30)]
    wide = [open_angle(door, rng) for _ in range(30)]
    later = [open_angle(replace(door, state="closed"), rng) for _ in range(30)]
    assert np.deg2rad(50) < min(half) < max(half) < np.deg2rad(70)
    assert np.deg2rad(80) < min(wide + later) < max(wide + later) < np.deg2rad(101)


@pytest.mark.parametrize("number", range(len(ALL)))
def test_a_closed_door_opens_before_it_is_passed_and_closes_afterwards(number):
    door, drawn = ALL[number]
    made = surfaces()
    passes = np.array([20.0, 60.0])
    turn = swing(door, drawn)
    body = opened_on_the_way(made, door, turn, np.deg2rad(90), FACE, passes)
    assert made.quads == []
    assert made.things == []
    shut = body.corners(0.0)
    for stamp in (5.0, 15.0, 20 + STAYS_OPEN_S + OPENING_S, 45.0, 80.0):
        np.testing.assert_allclose(body.corners(stamp), shut, atol=1e-9)
    assert not seen_through(Scene.of(shut), door).any()
    for moment in passes:
        for stamp in (moment - 1.5, moment, moment + 1.5):
            assert seen_through(Scene.of(body.corners(stamp)), door).mean() > 0.9
        opened = body.centre(float(moment))[:2]
        into = np.array(drawn.rooms[1].floor.centre) - door.xy
        assert (opened - door.xy) @ into > 0
    stamps = np.arange(0.0, 80.0, 0.05)
    moved = np.diff([body.centre(float(stamp)) for stamp in stamps], axis=0)
    assert np.linalg.norm(moved, axis=1).max() < 0.1, "it does not jump"


def test_a_pane_of_glass_is_seen_through_but_for_its_rim():
    door, drawn = case("y", 1, False, is_glass=True)
    made = surfaces()
    build_leaf(made, door, swing(door, drawn), 0.0, FACE)
    assert 0.6 < seen_through(Scene(made.quads), door).mean() < 0.95


def test_a_frame_leaves_the_opening_clear_and_closes_the_wall_round_it():
    for door, _ in ALL:
        made = surfaces()
        frame_doorway(made, door, Material(FACE), Material(FACE))
        scene = Scene(made.quads)
        assert seen_through(scene, door).all()
        wide = replace(door, width_m=door.width_m + 0.1)
        origin, direction = through(wide)
        along = 1 if door.along == "y" else 0
        edge = np.abs(origin[:, along] - door.xy[along]) > door.width_m / 2 + 0.01
        assert edge.any()
        assert (scene.distances(origin, direction)[edge] < 1.0).all()
