"""Rendered places that look the same and are not: no false loop may break a map."""

from __future__ import annotations

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.datasets.camera import Intrinsics
from roomgraph.datasets.frame import Frame
from roomgraph.datasets.synthetic.building import Building
from roomgraph.datasets.synthetic.motion.walk import camera_poses
from roomgraph.datasets.synthetic.plans.layout import FloorPlan
from roomgraph.datasets.synthetic.renderer import Renderer
from roomgraph.datasets.synthetic.rendering.mesh import Material, Quad
from roomgraph.datasets.synthetic.textures import ink, patterns
from roomgraph.datasets.trajectory import Trajectory
from roomgraph.slam.backend.loop_verification import LoopVerifier
from roomgraph.slam.evaluation import compare
from roomgraph.slam.settings import SlamSettings
from roomgraph.slam.slam import Slam
from roomgraph.slam.tracking import TrackingState

pytestmark = pytest.mark.slow

CAMERA = Intrinsics(320, 240, 262.0, 262.0, 159.5, 119.5)
HEIGHT_M, BAY_M, BAYS = 2.4, 3.0, 5


def _upright(a, b, low, high, material):
    """A quad over the floor's points a and b, seen from the side where a is on the left."""
    corners = [(*a, high), (*b, high), (*b, low), (*a, low)]
    return Quad(np.array(corners, dtype=float), material)


def _lying(x0, y0, x1, y1, z, material):
    corners = [(x0, y1, z), (x1, y1, z), (x1, y0, z), (x0, y0, z)]
    return Quad(np.array(corners, dtype=float), material)


def _picture(rng):
    return Material(ink.framed(ink.poster(rng, 220, 300), (60, 50, 44), 5))


def _corridor(rng):
    """Five bays that are the same to the last speck of plaster, between two ends that are not."""
    plaster = Material(patterns.plaster(rng, 240, 300, (220, 214, 200)))
    floor = Material(patterns.linoleum(rng, 200, 300, (140, 124, 108)))
    left, right, beside = (_picture(rng) for _ in range(3))
    quads = []
    for bay in range(BAYS):
        x0, x1 = bay * BAY_M, (bay + 1) * BAY_M
        quads += [
            _lying(x0, -1.1, x1, 1.1, 0.0, floor), _lying(x0, -1.1, x1, 1.1, HEIGHT_M, plaster),
            _upright((x0, 1.1), (x1, 1.1), 0, HEIGHT_M, plaster),
            _upright((x1, -1.1), (x0, -1.1), 0, HEIGHT_M, plaster),
            _upright((x0 + 0.4, 1.08), (x0 + 1.3, 1.08), 1.0, 1.7, left),
            _upright((x0 + 1.9, 1.08), (x0 + 2.6, 1.08), 0.7, 1.4, beside),
            _upright((x0 + 2.0, -1.08), (x0 + 1.1, -1.08), 1.0, 1.7, right),
        ]  # fmt: skip
    for x, a, b in ((0, -1.1, 1.1), (BAYS * BAY_M, 1.1, -1.1)):
        quads.append(_upright((x, a), (x, b), 0, HEIGHT_M, _picture(rng)))
    return quads


def _room(rng, x, poster):
    """A room of 4 by 4 metres around (x, 0) with pictures of its own, but for one poster."""
    plaster = Material(patterns.plaster(rng, 240, 400, (220, 214, 200)))
    floor = Material(patterns.linoleum(rng, 400, 400, (140, 124, 108)))
    turns = [np.array([(c, -s), (s, c)]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    quads = [_lying(x - 2, -2, x + 2, 2, z, floor) for z in (0.0, HEIGHT_M)]
    for side, R in enumerate(turns):

        def place(u, v, R=R):
            return tuple(np.array([x, 0.0]) + R @ (u, v))

        quads.append(_upright(place(-2, 2), place(2, 2), 0, HEIGHT_M, plaster))
        spots = [(-1.7, -0.9), (0.8, 1.7)] + ([] if side == 0 else [(-0.4, 0.4)])
        for a, b in spots:
            low = float(rng.uniform(0.6, 1.3))
            quads.append(_upright(place(a, 1.98), place(b, 1.98), low, low + 0.6, _picture(rng)))
    quads.append(_upright((x - 0.45, 1.98), (x + 0.45, 1.98), 0.9, 1.6, poster))
    return quads


def _panelled_room(rng):
    """A room of 4 by 4 metres: the same panels all round, other pictures above."""
    plaster = Material(patterns.plaster(rng, 240, 400, (220, 214, 200)))
    panels = Material(patterns.wood(rng, 240, 800, (170, 150, 130)))
    turns = [np.array([(c, -s), (s, c)]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    quads = []
    for side, R in enumerate(turns):
        a, b = (tuple(R @ (u, 2)) for u in (-2, 2))
        quads.append(_upright(a, b, 0, 0.85, panels))
        quads.append(_upright(a, b, 0.85, HEIGHT_M, plaster))
        for u in np.array([-1.7, -0.5, 0.7]) + 0.6 * (side // 2):
            a, b = (tuple(R @ (x, 1.98)) for x in (u, u + 0.7))
            low = float(rng.uniform(1.0, 1.3))
            quads.append(_upright(a, b, low, low + 0.7, Material(ink.photo(rng, 210, 210))))
    return quads


def _frames(quads, T_world_camera):
    building = Building(0, FloorPlan((), ()), quads, np.empty((0, 4)), [])
    renderer = Renderer(building, CAMERA)
    for i, T in enumerate(T_world_camera):
        view = renderer.render(T, seed=(0, i))
        yield Frame(i, i / 30, view.colours["day"], view.depth, CAMERA)


def _cameras(x, y, heading_deg):
    heading = np.radians(heading_deg)
    z = np.full(len(heading), 1.3)
    level = np.zeros(len(heading))
    return camera_poses(np.column_stack([x, y, z]), heading, level, level)


@pytest.fixture
def offered(monkeypatch):
    """All loops that are measured, whether they are believed or not."""
    seen = []
    admit = LoopVerifier.admit

    def noting(self, measured, *others):
        seen.append(measured.constraint)
        return admit(self, measured, *others)

    monkeypatch.setattr(LoopVerifier, "admit", noting)
    return seen


def _run(frames):
    slam = Slam(SlamSettings())
    trackings = [slam.process(frame) for frame in frames]
    slam.finish()
    return slam, trackings


def _off_m(slam, constraint, T_world_camera):
    """How far from the truth a constraint is, metres."""
    first, second = (
        T_world_camera[slam.keyframes[k].frame_index] for k in (constraint.first, constraint.second)
    )
    return float(
        np.linalg.norm((se3.inverse(first) @ second - constraint.T_first_second)[:3, 3])
    )  # fmt: skip


def test_bays_of_a_corridor_are_not_taken_for_one_another(rng, offered):
    count = 84
    x = np.linspace(1.2, BAYS * BAY_M - 3.5, count)
    T = _cameras(x, np.zeros(count), 35 + 10 * np.sin(np.arange(count) / 8))
    slam, trackings = _run(_frames(_corridor(rng), T))
    wrong = [constraint for constraint in offered if _off_m(slam, constraint, T) > 0.5]
    assert len(wrong) >= 3, "the bays are meant to be mistaken for one another"
    kept = [constraint for constraint in slam.constraints if constraint.is_loop]
    assert not [constraint for constraint in kept if _off_m(slam, constraint, T) > 0.1]
    estimate = Trajectory(
        np.array([t.stamp_s for t in trackings]),
        np.array([slam.pose_of(t.anchor) for t in trackings]),
    )
    error = compare(estimate, Trajectory(estimate.stamps_s, T))
    assert error.ate_rmse_m < 0.05


def test_one_poster_in_two_rooms_does_not_join_them(rng, offered):
    """A jump from one room into another; the camera turns, past a poster that hangs in both."""
    poster = _picture(rng)
    quads = _room(rng, 0.0, poster) + _room(rng, 20.0, poster)
    sweep = np.linspace(35, 145, 26)
    here = _cameras(np.linspace(-0.5, 0.5, 26), np.full(26, -0.4), sweep)
    there = _cameras(np.full(26, 20.1), np.full(26, -0.5), sweep)
    T = np.concatenate([here, there])
    slam, trackings = _run(_frames(quads, T))
    across = [
        constraint
        for constraint in offered
        if slam.keyframes[constraint.first].frame_index
        < 26
        <= slam.keyframes[constraint.second].frame_index
    ]
    assert len(across) >= 2, "the poster is meant to be recognised"
    assert slam.pose_graph.components == 2
    assert not [t for t in trackings[26:] if t.anchor and slam.is_placed(t.anchor)]


def test_a_jump_to_the_same_panels_on_another_wall_is_noticed(rng):
    """Half of what is seen fits where the camera was; the other half does not look like it."""
    sweep = np.linspace(80, 100, 15)
    still = np.zeros(15)
    here, there = (_cameras(still, still, sweep + turn) for turn in (0, 180))
    _, trackings = _run(_frames(_panelled_room(rng), np.concatenate([here, there])))
    assert all(t.state is TrackingState.OK for t in trackings[:15])
    assert trackings[15].state is TrackingState.LOST
    first = trackings[15].anchor.keyframe
    assert trackings[15].is_keyframe
    assert all(t.anchor.keyframe >= first for t in trackings[15:]), "a map of its own"
