"""Two laps of a corridor of look-alike pieces: every piece matches every other."""

import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.backend.alignment import Measured
from roomgraph.slam.backend.loop_verification import LoopVerificationSettings, LoopVerifier
from roomgraph.slam.backend.pose_graph import Constraint, PoseGraph, PoseGraphSettings

pytestmark = pytest.mark.slow

LAP = 128
PIECE = 8  # keyframes
STEP_M = 0.3
SIGMA = np.repeat([np.deg2rad(0.1), 0.005], 3)
INFORMATION = np.diag(1 / SIGMA**2)


def _corridor(laps=2.0):
    """Poses along a square of corridors, looking where the way goes."""
    T = [np.eye(4)]
    side = LAP // 4
    for i in range(1, int(laps * LAP)):
        turn = np.deg2rad(22.5) if i % side >= side - 4 else 0.0
        T.append(T[-1] @ se3.exponential(np.array([0, turn, 0, 0, 0, STEP_M])))
    return np.array(T)


def _measured(T, i, j, rng, like=None, is_loop=True):
    """A constraint from `i` to `j`, as it would be if `j` were at `like`."""
    motion = se3.inverse(T[i]) @ T[j if like is None else like]
    motion = motion @ se3.exponential(SIGMA * rng.normal(size=6))
    return Measured(Constraint(i, j, motion, INFORMATION, is_loop), 50, False)


def _walk(T, loops, rng):
    """Track along the corridor; offer each keyframe's loops as they come."""
    graph, verifier = PoseGraph(PoseGraphSettings()), LoopVerifier(LoopVerificationSettings())
    graph.add_keyframe(0, T[0])
    taken = []
    for j in range(1, len(T)):
        step = _measured(T, j - 1, j, rng, is_loop=False).constraint
        graph.add_keyframe(j, graph[j - 1] @ step.T_first_second)
        graph.add_constraint(step)
        for measured in loops.get(j, []):
            for admitted in verifier.admit(measured, graph):
                graph.add_constraint(admitted.constraint)
                taken.append(admitted)
        graph.optimise()
    kept = {id(constraint) for constraint in graph.constraints}
    return graph, [m for m in taken if id(m.constraint) in kept]


def _error_m(graph, T):
    return max(float(np.linalg.norm(graph[i][:3, 3] - T[i][:3, 3])) for i in range(len(T)))


def _right(T, rng, every=3):
    return {j: [_measured(T, j - LAP, j, rng)] for j in range(LAP, len(T), every)}


def _wrong_place(j, rng, pieces=None):
    """A keyframe of the first lap at the same place in another piece."""
    shift = PIECE * (pieces or int(rng.integers(1, LAP // PIECE)))
    return (j + shift) % LAP


def test_right_loops_end_the_drift(rng):
    T = _corridor()
    drifted, _ = _walk(T, {}, np.random.default_rng(1))
    closed, taken = _walk(T, _right(T, rng), np.random.default_rng(1))
    assert len(taken) == len(_right(T, rng))
    assert _error_m(closed, T) < 0.5 * _error_m(drifted, T)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5])
def test_scattered_wrong_loops_do_not_break_the_map(rng, share):
    T = _corridor()
    loops = _right(T, rng)
    right, _ = _walk(T, loops, np.random.default_rng(1))
    wrong = set()
    for j in range(LAP // 2, len(T)):
        if rng.random() < share:
            i = _wrong_place(j, rng)
            # It looks like i, so it is measured as if j were where i's double is.
            if i < j - PIECE and i != j % LAP:
                bad = _measured(T, i, j, rng, like=i)
                wrong.add(id(bad.constraint))
                loops[j] = [bad, *loops.get(j, [])]
    spoilt, taken = _walk(T, loops, np.random.default_rng(1))
    assert len(wrong) > 10
    assert not any(id(m.constraint) in wrong for m in taken)
    assert np.abs(spoilt.stacked()[1] - right.stacked()[1]).max() < 0.01


@pytest.mark.parametrize("start", [LAP // 2, LAP - 10, LAP + 40])
def test_a_run_of_wrong_loops_that_agree_does_not_break_the_map(rng, start):
    """Pieces taken for their neighbours: all ask for the same shift, of 2.4 m or twice that."""
    T = _corridor()
    loops = _right(T, rng)
    right, _ = _walk(T, loops, np.random.default_rng(1))
    for j in range(start, start + 2 * PIECE):
        i = j - 2 * PIECE if j < LAP else j - LAP + PIECE
        loops[j] = [_measured(T, i, j, rng, like=i)]
    spoilt, taken = _walk(T, loops, np.random.default_rng(1))
    assert all(m.constraint.first == m.constraint.second - LAP for m in taken)
    assert _error_m(spoilt, T) < 1.5 * _error_m(right, T) + 0.02


def test_large_correction_waits_for_two_others_and_is_used_with_them(rng):
    T = _corridor()
    graph = PoseGraph(PoseGraphSettings())
    for j in range(len(T)):
        graph.add_keyframe(j, T[j])
        if j:
            graph.add_constraint(_measured(T, j - 1, j, rng, is_loop=False).constraint)
    verifier = LoopVerifier(LoopVerificationSettings())
    # Between the likely drift of 38 m, 0.5 m, and the possible, 1.5 m.
    shifted = se3.pose(t=(0.9, 0, 0)) @ T
    loops = [
        Measured(
            Constraint(i, LAP + i, se3.inverse(T[i]) @ shifted[LAP + i], INFORMATION, True),
            50,
            False,
        )
        for i in (20, 21, 22)
    ]
    assert verifier.admit(loops[0], graph) == []
    assert verifier.admit(loops[0], graph) == []  # the same keyframe again confirms nothing
    assert verifier.admit(loops[1], graph) == []
    taken = verifier.admit(loops[2], graph)
    assert {id(m) for m in taken} == {id(m) for m in loops}
    assert verifier.held == []


def test_sub_maps_are_joined_only_by_loops_that_agree(rng):
    T = _corridor(1.5)
    graph, verifier = PoseGraph(PoseGraphSettings()), LoopVerifier(LoopVerificationSettings())
    for j in range(len(T)):
        starts = j in (0, LAP + 20)
        graph.add_keyframe(j, T[j] if j <= LAP else T[j - 100], starts_component=starts)
        if not starts:
            graph.add_constraint(_measured(T, j - 1, j, rng, is_loop=False).constraint)
    graph.optimise()
    for j in range(LAP + 22, LAP + 40, 2):
        i = _wrong_place(j, rng)
        for measured in (_measured(T, i, j, rng, like=i), _measured(T, j - LAP, j, rng)):
            for admitted in verifier.admit(measured, graph):
                graph.add_constraint(admitted.constraint)
        graph.optimise()
    assert graph.components == 1
    assert all(
        constraint.first == constraint.second - LAP
        for constraint in graph.constraints
        if constraint.is_loop
    )
    between = se3.inverse(graph[38]) @ graph[38 + LAP]
    assert np.linalg.norm(between[:3, 3]) < 0.05


def _turning(old_deg, new_deg, rng, like=0.0):
    """A map seen while turning from 0 to `old_deg`, and a sub-map from 0 to `new_deg`.

    Returns the graph, and a loop for each keyframe of the sub-map to the one of the map that looks
    nearest the same way, turned by `like` degrees.
    """

    def turned(degrees):
        return se3.exponential(np.array([0, np.deg2rad(degrees), 0, 0, 0, 0]))

    old, new = (np.arange(0, end + 1, 10.0) for end in (old_deg, new_deg))
    T = [turned(angle) for angle in (*old, *(new + like))]
    graph = PoseGraph(PoseGraphSettings())
    for j, pose in enumerate(T):
        starts = j in (0, len(old))
        elsewhere = se3.pose(t=(5.0, 0, 0)) if j >= len(old) else np.eye(4)
        graph.add_keyframe(j, elsewhere @ pose, starts_component=starts)
        if not starts:
            graph.add_constraint(_measured(T, j - 1, j, rng, is_loop=False).constraint)
    graph.optimise()
    loops = [
        _measured(T, int(np.abs(old - angle).argmin()), len(old) + k, rng)
        for k, angle in enumerate(new)
    ]
    return graph, loops


def _joined(graph, loops, view_deg=62.0):
    verifier = LoopVerifier(LoopVerificationSettings())
    for measured in loops:
        for admitted in verifier.admit(measured, graph, view_deg):
            graph.add_constraint(admitted.constraint)
        graph.optimise()
    return graph.components == 1


def test_a_camera_that_only_turns_is_joined_once_it_has_turned_wide(rng):
    graph, loops = _turning(120, 90, rng)
    assert not _joined(graph, loops[:6])
    graph, loops = _turning(120, 90, rng)
    assert _joined(graph, loops)
    between = se3.inverse(graph[0]) @ graph[13]
    assert np.linalg.norm(between[:3, 3]) < 0.02


def test_one_thing_seen_at_either_edge_joins_nothing(rng):
    """Turned as far as a poster stays in view: loops agree, but rest on that alone."""
    graph, loops = _turning(60, 60, rng)
    assert not _joined(graph, loops)
    # The sub-map turned further, but always met what looks the same.
    graph, loops = _turning(30, 90, rng)
    assert not _joined(graph, loops)
    # A wide camera keeps it in view for longer.
    graph, loops = _turning(120, 90, rng)
    assert not _joined(graph, loops, view_deg=100.0)
