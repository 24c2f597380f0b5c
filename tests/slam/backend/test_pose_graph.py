import numpy as np
import pytest

from roomgraph.datasets import se3
from roomgraph.slam.backend.pose_graph import Constraint, PoseGraph, PoseGraphSettings
from roomgraph.slam.errors import SlamError
from tests.slam.helpers import motion_error


def _ring(count=12, radius=2.0):
    """Poses on a circle, looking outwards."""
    T = []
    for angle in 2 * np.pi * np.arange(count) / count:
        turn = se3.exponential(np.array([0, angle, 0, 0, 0, 0]))
        T.append(turn @ se3.pose(t=(0, 0, radius)))
    return np.array(T)


def _constraint(ring, i, j, is_loop=False, error=None):
    T = se3.inverse(ring[i]) @ ring[j]
    if error is not None:
        T = T @ se3.exponential(error)
    return Constraint(i, j, T, 1e4 * np.eye(6), is_loop)


def _graph(ring, noise, rng, **settings):
    """Chain the ring's poses by noisy constraints, each placed by the constraint before."""
    graph = PoseGraph(PoseGraphSettings(**settings))
    graph.add_keyframe(0, ring[0])
    for i in range(1, len(ring)):
        constraint = _constraint(ring, i - 1, i, error=noise * rng.normal(size=6))
        graph.add_keyframe(i, graph[i - 1] @ constraint.T_first_second)
        graph.add_constraint(constraint)
        graph.optimise()
    return graph


def test_ring_closes_on_its_known_optimum(rng):
    ring = _ring()
    graph = _graph(ring, 0.02, rng)
    before = motion_error(graph[len(ring) - 1], ring[-1])[0]
    graph.add_constraint(_constraint(ring, len(ring) - 1, 0, is_loop=True))
    graph.optimise()
    after = motion_error(graph[len(ring) - 1], ring[-1])[0]
    assert after < 0.3 * before
    assert np.allclose(graph[0], ring[0], atol=1e-5)


def test_ring_without_noise_stays(rng):
    ring = _ring()
    graph = _graph(ring, 0.0, rng)
    graph.add_constraint(_constraint(ring, len(ring) - 1, 0, is_loop=True))
    graph.optimise()
    assert all(np.allclose(graph[i], ring[i], atol=1e-6) for i in range(len(ring)))


def test_robust_kernel_keeps_a_wrong_loop_from_bending_the_ring(rng):
    ring = _ring()
    errors = {}
    for kernel in ("none", "cauchy"):
        graph = _graph(ring, 0.002, np.random.default_rng(1), kernel=kernel, reject_width=1000)
        for i in range(len(ring) - 2):
            graph.add_constraint(_constraint(ring, i, i + 2))
        wrong = _constraint(ring, 1, 7, is_loop=True, error=np.array([0, 1.0, 0, 0.5, 0, 0.5]))
        graph.add_constraint(wrong)
        graph.optimise()
        errors[kernel] = max(motion_error(graph[i], ring[i])[0] for i in range(len(ring)))
    assert errors["cauchy"] < 0.25 * errors["none"]
    assert errors["cauchy"] < 0.1


def test_g2o_is_read_back_with_several_poses(tmp_path, rng):
    import gtsam

    ring = _ring()
    graph = _graph(ring, 0.01, rng)
    graph.write_g2o(tmp_path / "graph.g2o")
    factors, values = gtsam.readG2o(str(tmp_path / "graph.g2o"), True)
    assert factors.size() == len(ring) - 1
    for key in range(len(ring)):
        assert np.allclose(values.atPose3(key).matrix(), graph[key], atol=1e-4)


def test_misuse_is_said(rng):
    graph = PoseGraph(PoseGraphSettings())
    graph.add_keyframe(0, np.eye(4))
    with pytest.raises(SlamError, match="already"):
        graph.add_keyframe(0, np.eye(4))
    with pytest.raises(SlamError, match="keyframe 5"):
        graph.add_constraint(Constraint(0, 5, np.eye(4), np.eye(6), False))
    graph.add_keyframe(1, np.eye(4))
    with pytest.raises(SlamError, match="constraint to every keyframe"):
        graph.optimise()


def _two_parts(ring, cut, rng, noise=0.0):
    """Chain a ring's poses, but begin anew, somewhere else, at `cut`."""
    graph = PoseGraph(PoseGraphSettings())
    elsewhere = se3.exponential(np.array([0.1, 2.0, 0.3, 5.0, -1.0, 3.0]))
    graph.add_keyframe(0, ring[0])
    for i in range(1, len(ring)):
        if i == cut:
            graph.add_keyframe(i, elsewhere @ ring[i], starts_component=True)
        else:
            constraint = _constraint(ring, i - 1, i, error=noise * rng.normal(size=6))
            graph.add_keyframe(i, graph[i - 1] @ constraint.T_first_second)
            graph.add_constraint(constraint)
        graph.optimise()
    return graph


@pytest.mark.parametrize("ends", [(2, 9), (9, 2)])
def test_constraint_between_two_sub_maps_moves_the_younger(rng, ends):
    ring = _ring()
    graph = _two_parts(ring, 6, rng)
    assert graph.components == 2
    assert [graph.component_of(i) for i in (0, 5, 6, 11)] == [0, 0, 6, 6]
    side = np.linalg.norm(ring[1][:3, 3] - ring[0][:3, 3])
    assert graph.path_length(0, 5, 9.0) == pytest.approx(5 * side)
    assert graph.path_length(0, 5, 2.0) == graph.path_length(5, 6, 9.0) == np.inf
    assert graph.around(1, 1.5 * side) == {0, 1, 2}
    assert motion_error(graph[8], ring[8])[0] > 1
    graph.add_constraint(_constraint(ring, *ends, is_loop=True))
    graph.optimise()
    assert graph.components == 1
    assert {graph.component_of(i) for i in range(12)} == {0}
    assert all(np.allclose(graph[i], ring[i], atol=1e-5) for i in range(12))


def test_joined_sub_maps_go_on_and_are_optimised_together(rng):
    ring = _ring(40)
    graph = _two_parts(ring, 20, rng, noise=0.01)
    graph.add_constraint(_constraint(ring, 0, 39, is_loop=True))
    graph.optimise()
    before = max(motion_error(graph[i], ring[i])[0] for i in range(40))
    graph.add_constraint(_constraint(ring, 19, 20, is_loop=True))
    graph.add_keyframe(40, graph[39])
    graph.add_constraint(Constraint(39, 40, np.eye(4), 1e4 * np.eye(6), False))
    graph.optimise()
    assert max(motion_error(graph[i], ring[i])[0] for i in range(40)) < before
    assert graph.component_of(40) == 0
    assert np.allclose(graph[40], graph[39], atol=1e-5)


def test_three_sub_maps_keep_the_world_of_the_first(rng):
    ring = _ring(6)
    graph = PoseGraph(PoseGraphSettings())
    for i in range(6):
        place = ring[i] if i < 2 else se3.pose(t=(i // 2, 0, 0)) @ ring[i]
        graph.add_keyframe(i, place, starts_component=i % 2 == 0)
        if i % 2:
            graph.add_constraint(_constraint(ring, i - 1, i))
    graph.optimise()
    assert graph.components == 3
    graph.add_constraint(_constraint(ring, 3, 5, is_loop=True))
    graph.optimise()
    assert graph.components == 2
    assert np.allclose(graph[5], se3.pose(t=(1, 0, 0)) @ ring[5], atol=1e-6)
    graph.add_constraint(_constraint(ring, 4, 1, is_loop=True))
    graph.optimise()
    assert all(np.allclose(graph[i], ring[i], atol=1e-5) for i in range(6))


def test_wrong_loops_are_taken_out_and_said(rng):
    ring = _ring(60)
    graph = _graph(ring, 0.002, np.random.default_rng(7))
    right = [_constraint(ring, i, 59 - i, is_loop=True) for i in range(0, 20, 2)]
    wrong = [
        _constraint(ring, i, 40 + i, is_loop=True, error=np.array([0, 0.5, 0, *rng.normal(size=3)]))
        for i in range(0, 9, 3)
    ]
    without = _graph(ring, 0.002, np.random.default_rng(7))
    for constraint in right:
        without.add_constraint(constraint)
        without.optimise()
    rejected = []
    for constraint in (*right[:4], *wrong, *right[4:]):
        graph.add_constraint(constraint)
        rejected += graph.optimise()
    assert {id(constraint) for constraint in rejected} == {id(constraint) for constraint in wrong}
    assert graph.rejected == rejected
    assert len(graph.constraints) == 59 + len(right)
    assert all(np.allclose(graph[i], without[i], atol=1e-3) for i in range(60))


def test_part_that_hung_on_a_wrong_loop_alone_is_a_sub_map_again(rng):
    ring = _ring(12)
    graph = _two_parts(ring, 6, rng)
    wrong = _constraint(ring, 0, 6, is_loop=True, error=np.array([0, 1.0, 0, 1.0, 0, 0]))
    graph.add_constraint(wrong)
    graph.optimise()
    for i in range(4):
        graph.add_constraint(_constraint(ring, i, 11 - i, is_loop=True))
    assert graph.optimise() == [wrong]
    assert graph.components == 1
    assert all(np.allclose(graph[i], ring[i], atol=1e-4) for i in range(12))


def test_a_beginning_that_was_soon_lost_gives_way_as_the_world(rng):
    ring = _ring(12)
    assert _two_parts(ring, 6, rng).world == 0
    assert _two_parts(ring, 3, rng).world == 3
    assert _two_parts(ring, 9, rng).world == 0
