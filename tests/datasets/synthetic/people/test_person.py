from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets.synthetic.people.figure import draw_figure
from roomgraph.datasets.synthetic.people.gait import (
    ARMS,
    LEGS,
    PARENTS,
    PARTS,
    part_transforms,
    sitting,
    standing,
    walking,
)
from roomgraph.datasets.synthetic.people.person import Person, Schedule

SEEDS = (0, 1, 2, 3)
FLOOR_M = 0.3


def person(seed: int, doing: str, speed: float = 1.0, seat_m: float = 0.45) -> Person:
    """One who does a single thing for 20 s on a floor 0.3 m up."""
    way = np.array([np.cos(0.7), np.sin(0.7)]) * (20 * speed if doing == "walk" else 0.0)
    schedule = Schedule(
        np.array([0.0, 20.0]), np.add([(1.0, 2.0)] * 2, [(0.0, 0.0), way]), np.full(2, 0.7),
        np.full(2, FLOOR_M), (doing,), seat_m,
    )  # fmt: skip
    return Person(draw_figure(np.random.default_rng(seed)), schedule, speed)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("doing", ["walk", "stand"])
def test_feet_are_on_the_floor(seed: int, doing: str) -> None:
    one = person(seed, doing)
    lowest = [one.corners(stamp)[..., 2].min() for stamp in np.linspace(0.0, 20.0, 150)]
    np.testing.assert_allclose(lowest, FLOOR_M, atol=0.03)


@pytest.mark.parametrize("seat_m", [0.40, 0.45, 0.50])
def test_who_sits_has_the_hips_on_the_seat_and_the_feet_on_the_floor(seat_m: float) -> None:
    for seed in SEEDS:
        one = person(seed, "sit", seat_m=seat_m)
        T = one.parts(3.0)
        hips = T[LEGS[0][0], 2, 3] - FLOOR_M
        assert seat_m < hips < seat_m + 0.13
        assert one.corners(3.0)[..., 2].min() == pytest.approx(FLOOR_M, abs=0.04)


@pytest.mark.parametrize("seed", SEEDS)
def test_limbs_keep_their_lengths(seed: int) -> None:
    joints = draw_figure(np.random.default_rng(seed)).joints
    poses = [walking(phase, speed) for phase in np.linspace(0, 1, 25) for speed in (0.7, 1.3)]
    poses += [pose(t) for pose in (standing, sitting) for t in (0.0, 1.7)]
    for pose in poses:
        found = part_transforms(joints, pose, np.eye(4))[:, :3, 3]
        for part in range(1, len(PARTS)):
            length = np.linalg.norm(joints[part] - joints[PARENTS[part]])
            actual = np.linalg.norm(found[part] - found[PARENTS[part]])
            assert actual == pytest.approx(length, abs=1e-9)


def test_legs_and_arms_swing_against_each_other() -> None:
    joints = draw_figure(np.random.default_rng(0)).joints
    (left, right), (hand, _) = [[limb[2] for limb in limbs] for limbs in (LEGS, ARMS)]
    at = part_transforms(joints, walking(0.0), np.eye(4))[:, 0, 3]
    half = part_transforms(joints, walking(0.5), np.eye(4))[:, 0, 3]
    assert at[left] - at[right] > 0.4
    assert half[right] - half[left] > 0.4
    assert half[hand] - at[hand] > 0.2


@pytest.mark.parametrize("speed", [0.8, 1.2])
def test_the_foot_that_carries_hardly_slides(speed: float) -> None:
    one = person(1, "walk", speed)
    shoes = [one.figure.weights[:, :, leg[2]].min(axis=1) > 0.99 for leg in LEGS]
    slid, step = [], 0.02
    for stamp in np.arange(5.0, 12.0, step):
        now, later = one.corners(stamp), one.corners(stamp + step)
        soles = [now[shoe].reshape(-1, 3) for shoe in shoes]
        foot = int(np.argmin([sole[:, 2].min() for sole in soles]))
        point = int(np.argmin(soles[foot][:, 2]))
        there = later[shoes[foot]].reshape(-1, 3)[point]
        slid.append(np.linalg.norm((there - soles[foot][point])[:2]) / step)
    # Metres a second; a foot that did not know of the way would slide as fast as the body.
    assert np.median(slid) < 0.15 * speed
    assert np.quantile(slid, 0.9) < 0.5 * speed


def test_corners_follow_the_schedule_and_stay_in_the_sphere() -> None:
    for doing in ("walk", "stand", "sit"):
        one = person(2, doing)
        for stamp in (0.0, 4.2, 19.9):
            corners, centre = one.corners(stamp), one.centre(stamp)
            assert corners.shape == (len(one.quads), 4, 3)
            assert np.linalg.norm(corners - centre, axis=2).max() < one.radius_m
            expected = one.place(stamp)[:2]
            assert np.linalg.norm(corners.mean(axis=(0, 1))[:2] - expected) < 0.3


def test_at_rest_the_corners_are_those_of_the_quads() -> None:
    one = person(3, "stand")
    still = np.array([quad.corners for quad in one.quads])
    np.testing.assert_allclose(one.figure.weights.sum(axis=2), 1.0)
    assert still[..., 2].min() == pytest.approx(0.0, abs=0.005)
    assert still[..., 2].max() == pytest.approx(one.figure.height_m, abs=0.04)


def test_people_differ_and_are_of_human_size() -> None:
    figures = [draw_figure(np.random.default_rng(seed)) for seed in range(40)]
    heights = np.array([figure.height_m for figure in figures])
    assert heights.min() >= 1.55
    assert heights.max() <= 1.92
    assert np.ptp(heights) > 0.15
    assert all(150 <= len(figure.quads) <= 300 for figure in figures)
    outfits = [figure.outfit for figure in figures]
    assert {outfit.woman for outfit in outfits} == {True, False}
    assert {outfit.coat for outfit in outfits} == {True, False}
    assert {outfit.backpack is None for outfit in outfits} == {True, False}


def test_quads_face_outwards() -> None:
    for seed in SEEDS:
        figure = draw_figure(np.random.default_rng(seed))
        head = np.array([q.corners for q in figure.quads if q.material is figure.outfit.head])
        normals = np.cross(head[:, 3] - head[:, 0], head[:, 1] - head[:, 0])
        outwards = head.mean(axis=1) - head.mean(axis=(0, 1))
        assert (np.einsum("ij,ij->i", normals, outwards) > 0).all()


def test_same_seed_same_person() -> None:
    first, second, other = (person(seed, "walk") for seed in (5, 5, 6))
    np.testing.assert_array_equal(first.corners(3.3), second.corners(3.3))
    for a, b in zip(first.quads, second.quads, strict=True):
        np.testing.assert_array_equal(a.material.image, b.material.image)
    assert first.figure.height_m != other.figure.height_m


def test_who_is_away_is_not_there() -> None:
    places = np.array([(0.0, 0.0), (1.0, 0.0), (5.0, 5.0), (6.0, 5.0)])
    stamps = np.array([0.0, 2.0, 8.0, 10.0])
    schedule = Schedule(stamps, places, np.zeros(4), np.zeros(4), ("walk", "away", "walk"))
    one = Person(draw_figure(np.random.default_rng(0)), schedule)
    there = [one.is_there(stamp) for stamp in (-0.1, 1.0, 5.0, 9.0, 10.1)]
    assert there == [False, True, False, True, False]
    assert one.corners(5.0)[..., 2].max() < -100
    with pytest.raises(ValueError, match="intervals"):
        Schedule(stamps, places, np.zeros(4), np.zeros(4), ("walk",))


def test_turns_are_smooth() -> None:
    corner = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 3.0)])
    schedule = Schedule(
        np.array([0.0, 3.0, 6.0]), corner, np.zeros(3), np.zeros(3), ("walk", "walk")
    )
    one = Person(draw_figure(np.random.default_rng(0)), schedule)

    def facing(stamp: float) -> float:
        T = one.parts(stamp)
        across = T[LEGS[0][0], :2, 3] - T[LEGS[1][0], :2, 3]
        return float(np.arctan2(-across[0], across[1]))

    headings = np.array([facing(stamp) for stamp in np.arange(2.0, 4.0, 0.05)])
    assert headings[0] == pytest.approx(0.0, abs=0.15)
    assert headings[-1] == pytest.approx(np.pi / 2, abs=0.15)
    assert np.abs(np.diff(headings)).max() < 0.35
