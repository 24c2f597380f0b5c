"""Stiff bodies, and the lamps under the ceiling."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.plans.layout import Rectangle, Room
from roomgraph.datasets.synthetic.rendering.lighting import EVENING, LAMP
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad, Surfaces
from roomgraph.datasets.synthetic.structure.lamps import hang_lamps
from roomgraph.datasets.synthetic.structure.moving import Stiff, shifted, smooth, turned

GREY = Material(np.full((4, 4, 3), 128, np.uint8))
SQUARE = np.array([(0, 0, 1), (2, 0, 1), (2, 0, 0), (0, 0, 0)], dtype=float)


def test_smooth_rises_from_0_to_1_and_never_falls():
    stamps = np.linspace(-1, 5, 200)
    values = np.array([smooth(float(s), 1.0, 3.0) for s in stamps])
    assert (values[stamps <= 1] == 0).all()
    assert (values[stamps >= 3] == 1).all()
    assert (np.diff(values) >= 0).all()
    assert smooth(2.0, 1.0, 3.0) == pytest.approx(0.5)
    assert (smooth(0.9, 1.0, 1.0), smooth(1.1, 1.0, 1.0)) == (0.0, 1.0)


def test_a_turn_keeps_its_axis_and_goes_counter_clockwise():
    T = turned((1.0, 2.0), np.pi / 2)
    np.testing.assert_allclose(T @ (1, 2, 7, 1), (1, 2, 7, 1), atol=1e-12)
    np.testing.assert_allclose(T @ (2, 2, 0, 1), (1, 3, 0, 1), atol=1e-12)


def test_a_stiff_body_is_where_its_motion_takes_it():
    body = Stiff(
        [Quad(SQUARE, GREY), Quad(SQUARE + np.array([0, 1, 0]), GREY)],
        lambda stamp: shifted(np.array([0, 0, stamp])),
    )
    np.testing.assert_allclose(body.corners(3.0)[0], SQUARE + np.array([0, 0, 3]))
    np.testing.assert_allclose(body.centre(3.0), (1, 0.5, 3.5))
    assert body.is_there(-5.0)
    away = np.linalg.norm(body.corners(9.0) - body.centre(9.0), axis=-1)
    assert body.radius_m == pytest.approx(away.max())


def hung(label: str, size: tuple[float, float], is_home: bool, is_on: bool) -> Surfaces:
    room = Room("it", label, Rectangle(1, 2, 1 + size[0], 2 + size[1]), 1, 3.0, 2.7)
    surfaces = Surfaces(np.random.default_rng(3))
    hang_lamps(surfaces, room, is_home, is_on)
    for quad in surfaces.quads:
        assert room.floor.distance(quad.corners[:, :2]).max() == 0
        assert (quad.corners[:, 2] <= 5.7 + 1e-9).all()
        assert (quad.corners[:, 2] > 3.0 + 1.7).all()
    assert {thing.name for thing in surfaces.things} == {"lamp"}
    return surfaces


def test_lamps_hang_in_the_room_above_peoples_heads():
    home, office = hung("bedroom", (4, 4), True, True), hung("office", (7, 5), False, True)
    assert len(home.things) == 1
    assert len(office.things) == 6
    for surfaces in (home, office):
        assert {lamp.channel for lamp in surfaces.lamps} == {LAMP, EVENING}
        for x, y, z in (lamp.position for lamp in surfaces.lamps):
            assert 1 < x < 8
            assert 2 < y < 7
            assert 4.7 < z < 5.7


@pytest.mark.parametrize("is_home", [False, True])
def test_lamps_that_are_off_give_no_light_and_glow_less(is_home):
    off, on = (hung("office", (4, 5), is_home, is_on) for is_on in (False, True))
    assert off.lamps == []
    assert on.lamps

    def glow(surfaces: Surfaces) -> float:
        return max(q.material.glow[1] for q in surfaces.quads if q.material.glow)

    assert glow(off) < 0.5 * glow(on)


def test_rooms_without_daylight_are_lit_more():
    def power(label: str) -> float:
        return max(lamp.power for lamp in hung(label, (4, 5), False, True).lamps)

    assert power("corridor") > 1.5 * power("office")
